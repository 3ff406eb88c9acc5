//! The terminal: its keys, what is drawn on it, and that it is restored.

use std::io::{self, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crossterm::cursor::{Hide, MoveTo, Show};
use crossterm::event::{Event, KeyEvent, poll, read};
use crossterm::queue;
use crossterm::style::Print;
use crossterm::terminal::{
    Clear, ClearType, EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode,
};
use sbgc_proto::commands::Angles;
use sbgc_proto::wire::PerAxis;
use tokio::sync::mpsc;

use super::pilot::Pilot;

/// How often the thread that waits for keys looks whether anybody wants them.
const LOOK: Duration = Duration::from_millis(50);

/// The terminal in raw mode, until this is dropped.
#[derive(Debug)]
pub(super) struct Screen {
    shown: Vec<String>,
}

impl Screen {
    pub(super) fn open() -> io::Result<Self> {
        enable_raw_mode()?;
        let screen = Self { shown: Vec::new() };
        let mut out = io::stdout();
        queue!(out, EnterAlternateScreen, Hide, Clear(ClearType::All))?;
        out.flush()?;
        Ok(screen)
    }

    /// Draws the lines that have changed.
    pub(super) fn draw(
        &mut self,
        pilot: &Pilot,
        speeds: PerAxis<Option<f32>>,
        angles: Option<&Angles>,
    ) -> io::Result<()> {
        let lines = lines(pilot, speeds, angles);
        let mut out = io::stdout();
        for (row, line) in (0..).zip(&lines) {
            if self.shown.get(usize::from(row)) != Some(line) {
                queue!(out, MoveTo(0, row), Print(line), Clear(ClearType::UntilNewLine))?;
            }
        }
        self.shown = lines;
        out.flush()
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let mut out = io::stdout();
        // The terminal may be gone, and then needs nothing.
        let _ = queue!(out, Show, LeaveAlternateScreen);
        let _ = out.flush();
        let _ = disable_raw_mode();
    }
}

fn lines(pilot: &Pilot, speeds: PerAxis<Option<f32>>, angles: Option<&Angles>) -> Vec<String> {
    let mut lines = vec![
        format!("sbgc control jog                speed {} deg/s", pilot.speed()),
        String::new(),
        format!("{:<7}{:>12}{:>16}", "axis", "angle", "moving"),
    ];
    let angles = angles
        .map_or([None; 3], |angles| angles.axes.map(|axis| Some(axis.imu_angle.degrees())).into_array());
    for ((name, angle), speed) in ["ROLL", "PITCH", "YAW"].into_iter().zip(angles).zip(speeds.into_array()) {
        let angle = angle.map_or_else(|| String::from("-"), |angle| format!("{angle:.2} deg"));
        let speed = match speed {
            Some(speed) if speed != 0.0 => format!("{speed:+} deg/s"),
            _ => String::from("stopped"),
        };
        lines.push(format!("{name:<7}{angle:>12}{speed:>16}"));
    }
    lines.push(String::new());
    lines.push(String::from("left right  yaw      up down  pitch      a d  roll"));
    lines.push(String::from("+ -  speed           space  stop         q  quit"));
    lines
}

/// Keys as they are pressed.
#[derive(Debug)]
pub(super) struct Keys {
    keys: mpsc::Receiver<KeyEvent>,
    wanted: Arc<AtomicBool>,
}

impl Keys {
    /// Begins to read keys, in a thread of its own.
    pub(super) fn listen() -> Self {
        let (sender, keys) = mpsc::channel(64);
        let wanted = Arc::new(AtomicBool::new(true));
        let still_wanted = Arc::clone(&wanted);
        std::thread::spawn(move || {
            while still_wanted.load(Ordering::Relaxed) {
                let key = match poll(LOOK) {
                    Ok(true) => read(),
                    Ok(false) => continue,
                    Err(_) => return,
                };
                match key {
                    Ok(Event::Key(key)) if sender.blocking_send(key).is_err() => return,
                    Ok(_) => {}
                    Err(_) => return,
                }
            }
        });
        Self { keys, wanted }
    }

    /// The next key; nothing when the terminal is gone.
    pub(super) async fn next(&mut self) -> Option<KeyEvent> {
        self.keys.recv().await
    }
}

impl Drop for Keys {
    fn drop(&mut self) {
        self.wanted.store(false, Ordering::Relaxed);
    }
}
