//! `sbgc monitor`: the board at a glance, live.

mod draw;
mod view;

use std::io::{self, IsTerminal as _};
use std::time::Duration;

use clap::Args;
use crossterm::event::{self, Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};
use crossterm::execute;
use crossterm::terminal::{EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode};
use ratatui::Terminal;
use ratatui::backend::CrosstermBackend;
use sbgc_host::Gimbal;
use sbgc_proto::Message as _;
use sbgc_proto::commands::{BoardInfo, RealtimeData3, StreamSource};
use tokio::sync::mpsc;
use tokio::time::{MissedTickBehavior, interval};

use crate::connect::{address, with_followed_board};
use crate::failure::{Failure, until_stopped};
use crate::options::Global;
use crate::sampling::{Next, Sampling};
use crate::values;
use view::View;

const EXAMPLES: &str = "Examples:
  sbgc monitor
  sbgc monitor --interval 20ms --color never";

/// Watch the board live
///
/// Shows attitude, targets, motor power, battery, errors, the link, and plots. Needs a terminal, preferably of 80
/// columns and 24 lines or more. `q` or Ctrl-C ends it, `p` pauses, `c` clears the plots.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Monitor {
    /// Interval (20ms) or rate (50Hz)
    #[arg(long, default_value = "50ms", value_parser = values::interval, value_name = "TIME", allow_hyphen_values = true)]
    interval: u16,
}

/// How often the picture changes.
const FRAME: Duration = Duration::from_millis(100);

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    End,
    Pause,
    Clear,
    Nothing,
}

fn asked(key: KeyEvent) -> Asked {
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    match key.code {
        _ if key.kind == KeyEventKind::Release => Asked::Nothing,
        KeyCode::Char('c' | 'C') if control => Asked::End,
        KeyCode::Char('q' | 'Q') | KeyCode::Esc => Asked::End,
        KeyCode::Char('p' | 'P' | ' ') => Asked::Pause,
        KeyCode::Char('c' | 'C') => Asked::Clear,
        _ => Asked::Nothing,
    }
}

impl Monitor {
    pub(crate) async fn run(self, global: &Global) -> Result<(), Failure> {
        if !io::stdout().is_terminal() || !io::stdin().is_terminal() {
            return Err(Failure::Usage(String::from(
                "monitor needs a terminal; use `sbgc stream` for pipes",
            )));
        }
        until_stopped(
            with_followed_board(global, async |gimbal, info| self.watch(global, &gimbal, &info).await).await,
        )
    }

    async fn watch(&self, global: &Global, gimbal: &Gimbal, info: &BoardInfo) -> Result<(), Failure> {
        let mut sampling = Sampling::start(gimbal, StreamSource::RealtimeData3, self.interval).await?;
        let port = address(global)?.to_string();
        let mut view = View::new(&port, info, gimbal.version(), global.color.is_on(true));
        let screen = Screen::open()?;
        let mut terminal = Terminal::new(CrosstermBackend::new(io::stdout()))?;
        let mut keys = keys();
        let mut frames = interval(FRAME);
        frames.set_missed_tick_behavior(MissedTickBehavior::Skip);
        let outcome = loop {
            tokio::select! {
                biased;
                _ = frames.tick() => {
                    view.link(&gimbal.counters());
                    if let Err(error) = terminal.draw(|frame| draw::draw(frame, &view)) {
                        break Err(error.into());
                    }
                }
                event = keys.recv() => match event {
                    Some(Event::Key(key)) => match asked(key) {
                        Asked::End => break Ok(()),
                        Asked::Pause => view.pause(),
                        Asked::Clear => view.clear(),
                        Asked::Nothing => {}
                    },
                    Some(_) => {}
                    // The terminal is gone.
                    None => break Ok(()),
                },
                sample = sampling.next() => match sample {
                    Ok(Next::Sample(payload, time)) => match RealtimeData3::decode(&payload) {
                        Ok(data) => view.add(time, &data),
                        Err(error) => break Err(sbgc_host::Error::from(error).into()),
                    },
                    Ok(Next::Lost(lost)) => view.lose(lost),
                    Ok(Next::Said(what)) => tracing::info!("{what}"),
                    Err(failure) => break Err(failure),
                },
            }
        };
        drop(terminal);
        drop(screen);
        outcome
    }
}

/// Key presses and changes of the terminal's size. The thread ends with the program.
fn keys() -> mpsc::UnboundedReceiver<Event> {
    let (sender, receiver) = mpsc::unbounded_channel();
    std::thread::spawn(move || {
        while let Ok(event) = event::read() {
            if sender.send(event).is_err() {
                return;
            }
        }
    });
    receiver
}

/// The terminal as a picture; put back as it was when dropped.
struct Screen;

impl Screen {
    fn open() -> io::Result<Self> {
        enable_raw_mode()?;
        let screen = Screen;
        execute!(io::stdout(), EnterAlternateScreen, crossterm::cursor::Hide)?;
        Ok(screen)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = execute!(io::stdout(), LeaveAlternateScreen, crossterm::cursor::Show);
        let _ = disable_raw_mode();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_mean_what_the_help_says() {
        let key = |code, modifiers| asked(KeyEvent::new(code, modifiers));
        assert_eq!(key(KeyCode::Char('q'), KeyModifiers::NONE), Asked::End);
        assert_eq!(key(KeyCode::Char('c'), KeyModifiers::CONTROL), Asked::End);
        assert_eq!(key(KeyCode::Char('c'), KeyModifiers::NONE), Asked::Clear);
        assert_eq!(key(KeyCode::Char('p'), KeyModifiers::NONE), Asked::Pause);
        assert_eq!(key(KeyCode::Char('x'), KeyModifiers::NONE), Asked::Nothing);
    }
}
