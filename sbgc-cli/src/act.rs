//! Carrying out what changes something: questions before it, and what `--dry-run` shows instead.

use std::io::{self, BufRead as _, IsTerminal as _};

use sbgc_host::Gimbal;
use sbgc_proto::commands::Confirm;
use sbgc_proto::frame::{MAX_FRAME, Version, encode_into};
use sbgc_proto::wire::ToWire;
use sbgc_proto::{CommandId, Direction, Message};
use tokio::sync::oneshot;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{signals, talk};

/// Asks before something is changed; returns once it was confirmed.
///
/// What would change has been shown on standard error before; `question` ends with a question mark. `--yes` is a yes.
/// With `--dry-run` nothing changes, so callers do not ask then.
///
/// # Errors
/// If the answer is anything but yes, or nobody can be asked: exit code 5.
pub(crate) async fn ask(global: &Global, question: &str) -> Result<(), Failure> {
    if global.yes {
        return Ok(());
    }
    let not_done = |why: &str| Failure::NotConfirmed(format!("not carried out: {why}"));
    if !io::stdin().is_terminal() {
        return Err(not_done("it needs confirmation, and there is no terminal to ask on; --yes confirms"));
    }
    // From here on, before anybody can know of the question.
    let interrupted = signals::interrupted();
    talk::print(format_args!("{question} [y/N] "));
    let (sender, answer) = oneshot::channel();
    // Reading a terminal cannot be given up, so it has a thread of its own, which may outlive the question.
    std::thread::spawn(move || {
        let mut line = String::new();
        let read = io::stdin().lock().read_line(&mut line).is_ok();
        let _ = sender.send(if read { line } else { String::new() });
    });
    tokio::select! {
        answer = answer => match answer.unwrap_or_default().trim().to_ascii_lowercase().as_str() {
            "y" | "yes" => Ok(()),
            _ => Err(not_done("not confirmed")),
        },
        () = interrupted => {
            talk::say("");
            Err(not_done("interrupted"))
        }
        signal = signals::stopped() => Err(Failure::Signal(signal)),
    }
}

/// Sends a command and waits for its confirmation; with `--dry-run` prints its frame and returns nothing.
pub(crate) async fn confirm<M: Message + ToWire>(
    global: &Global,
    output: &mut Output,
    gimbal: &Gimbal,
    command: &M,
) -> Result<Option<Confirm>, Failure> {
    if global.dry_run {
        show(output, gimbal.version(), command)?;
        return Ok(None);
    }
    Ok(Some(gimbal.confirm(command).await?))
}

/// Prints the frame of a command that `--dry-run` keeps from being sent.
pub(crate) fn show<M: Message + ToWire>(
    output: &mut Output,
    version: Version,
    command: &M,
) -> Result<(), Failure> {
    let mut buffer = [0; MAX_FRAME];
    let frame = command.encode_frame(version, &mut buffer).map_err(sbgc_host::Error::from)?;
    output.frame(Some(M::SPEC), M::ID.raw(), frame)?;
    Ok(())
}

/// Like [`show`], for payloads that were made elsewhere.
pub(crate) fn show_payload(
    output: &mut Output,
    version: Version,
    command: CommandId,
    payload: &[u8],
) -> Result<(), Failure> {
    let mut buffer = [0; MAX_FRAME];
    let frame = encode_into(version, command.raw(), payload, &mut buffer)
        .map_err(|error| Failure::Usage(error.to_string()))?;
    output.frame(command.spec_name(Direction::Outgoing), command.raw(), frame)?;
    Ok(())
}
