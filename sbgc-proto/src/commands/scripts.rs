//! User scripts that the board runs on its own.

use sbgc_proto_macros::{message, open_enum};

use crate::commands::FsErrorCode;
use crate::wire::Reserved;

/// Starts or stops a script.
///
/// Requires [`BoardFeatures::SCRIPTING`](crate::commands::BoardFeatures::SCRIPTING). Whether the board confirms is
/// unknown: the specification does not define it, and the vendor's libraries do not wait for an answer. Accept a
/// `CMD_CONFIRM`, but do not rely on one.
#[message(CMD_RUN_SCRIPT, outgoing, size = 34)]
pub struct RunScript {
    /// Action to perform.
    pub mode: RunScriptMode,
    /// Script slot, counted from 0. Firmware 2.6x has five slots, newer firmware ten.
    #[wire(range = 0..=9)]
    pub slot: u8,
    pub reserved: Reserved<32>,
}

/// Progress of a script started with [`RunScriptMode::StartWithDebug`].
#[message(CMD_SCRIPT_DEBUG, incoming, size = 3)]
pub struct ScriptDebug {
    /// Number of the command that is being executed.
    pub cmd_count: u16,
    /// Error code. The specification refers to the error codes of files; the vendor's library uses the general error
    /// codes of `CMD_ERROR`, which have the same numbers.
    pub err_code: FsErrorCode,
}

/// Starts or stops a script. Spec: `RUN_SCRIPT_MODE`.
#[open_enum(u8)]
pub enum RunScriptMode {
    /// Stops the script.
    Stop = 0,
    /// Starts the script.
    Start = 1,
    /// Starts the script and reports each step with [`ScriptDebug`].
    StartWithDebug = 2,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Message;

    /// Made by hand from the layout.
    #[test]
    fn scripts_start_with_debug_and_report() {
        let mut payload = [0; 34];
        payload[..2].copy_from_slice(&[2, 4]);
        let request = RunScript { mode: RunScriptMode::StartWithDebug, slot: 4, ..RunScript::default() };
        assert_eq!(request.encode(&mut [0; 34]), Ok(&payload[..]));
        assert_eq!(RunScript::decode(&payload), Ok(request));

        let report = ScriptDebug::decode(&[0x39, 0x4A, 8]).unwrap();
        assert_eq!(report, ScriptDebug { cmd_count: 19_001, err_code: FsErrorCode::LimitReached });
        assert_eq!(report.encode(&mut [0; 3]), Ok(&[0x39, 0x4A, 8][..]));
    }
}
