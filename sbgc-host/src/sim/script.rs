//! Scripts of the user, by a small interpreter.
//!
//! What the vendor's compiler makes of a script is not published, so scripts are taken as text, a command per line, in
//! capitals or not. Empty lines and what follows `#` or `//` are passed over:
//!
//! | command | what it does |
//! | --- | --- |
//! | `ANGLE(roll, pitch, yaw)` | moves to angles in degrees and waits until they are reached; `_` leaves an axis alone |
//! | `SPEED(roll, pitch, yaw)` | turns with speeds in degrees per second |
//! | `HOME()` | moves to 0, 0, 0 and waits |
//! | `WAIT(ms)`, `DELAY(ms)` | waits |
//! | `MENU(n)` | runs a command of the menu |
//! | `MOTORS(0)`, `MOTORS(1)` | turns the motors off or on |
//! | `PROFILE(1)` … `PROFILE(5)` | changes the profile |
//! | `GOTO(n)` | goes on with command n, counted from 1 |
//! | `END()` | ends the script |
//!
//! A file that holds anything else, such as a compiled script, ends with `ERR_FILE_CORRUPTED` at the command that
//! cannot be read. Variables, conditions and expressions of the vendor's language are not simulated.

use std::time::Duration;

/// How long a command takes at least.
pub(super) const STEP: Duration = Duration::from_millis(8);

/// A command of a script.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Command {
    Angle([Option<f64>; 3]),
    Speed([f64; 3]),
    Wait(Duration),
    Menu(u8),
    Motors(bool),
    Profile(u8),
    Goto(usize),
    End,
}

/// A script that runs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Script {
    pub(super) slot: u8,
    /// The port that receives each command, and whether it asked for that.
    pub(super) port: u8,
    pub(super) traced: bool,
    commands: Vec<Option<Command>>,
    next: usize,
    /// How many commands were carried out.
    pub(super) count: u16,
    /// Until when it waits.
    pub(super) until: Duration,
    /// Whether it waits until the axes have arrived.
    pub(super) moving: bool,
}

impl Script {
    pub(super) fn new(slot: u8, port: u8, traced: bool, file: &[u8]) -> Self {
        let text = String::from_utf8_lossy(file);
        let lines = text.lines().map(|line| {
            let line = line.split('#').next().unwrap_or_default();
            line.split("//").next().unwrap_or_default().trim().trim_matches('\0')
        });
        let commands = lines.filter(|line| !line.is_empty()).map(parse).collect();
        Self { slot, port, traced, commands, next: 0, count: 0, until: Duration::ZERO, moving: false }
    }

    /// The next command; `None` at the end, an error where it cannot be read.
    pub(super) fn fetch(&mut self) -> Option<Result<Command, ()>> {
        let command = *self.commands.get(self.next)?;
        self.next += 1;
        self.count = self.count.wrapping_add(1);
        match command {
            Some(Command::End) => None,
            Some(Command::Goto(place)) => {
                self.next = place.saturating_sub(1);
                Some(Ok(Command::Goto(place)))
            }
            Some(command) => Some(Ok(command)),
            None => Some(Err(())),
        }
    }
}

fn parse(line: &str) -> Option<Command> {
    let (name, rest) = line.split_once('(')?;
    let arguments: Vec<&str> =
        rest.trim().strip_suffix(')')?.split(',').map(str::trim).filter(|text| !text.is_empty()).collect();
    let one = || match arguments.as_slice() {
        [text] => text.parse::<u32>().ok(),
        _ => None,
    };
    let byte = || one().and_then(|number| u8::try_from(number).ok());
    let number = |index: usize| arguments.get(index).and_then(|text| text.parse::<f64>().ok());
    let finite = |value: f64| value.is_finite().then_some(value);
    Some(match name.trim().to_ascii_uppercase().as_str() {
        "ANGLE" if arguments.len() == 3 => {
            let mut angles = [None; 3];
            for (index, place) in angles.iter_mut().enumerate() {
                if arguments.get(index) != Some(&"_") {
                    *place = Some(finite(number(index)?)?);
                }
            }
            Command::Angle(angles)
        }
        "SPEED" if arguments.len() == 3 => Command::Speed([number(0)?, number(1)?, number(2)?]),
        "HOME" if arguments.is_empty() => Command::Angle([Some(0.0); 3]),
        "WAIT" | "DELAY" => Command::Wait(Duration::from_millis(one()?.into())),
        "MENU" => Command::Menu(byte()?),
        "MOTORS" => Command::Motors(byte()? != 0),
        "PROFILE" => Command::Profile(byte()?.checked_sub(1).filter(|profile| *profile < 5)?),
        "GOTO" => Command::Goto(usize::try_from(one()?).ok().filter(|place| *place > 0)?),
        "END" if arguments.is_empty() => Command::End,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_are_read_line_by_line() {
        let file = b"# look around\nangle(_, -30, 90.5)\nWAIT(500) // rest\n\nGOTO(1)\n";
        let mut script = Script::new(0, 0, true, file);
        assert_eq!(script.fetch(), Some(Ok(Command::Angle([None, Some(-30.0), Some(90.5)]))));
        assert_eq!(script.fetch(), Some(Ok(Command::Wait(Duration::from_millis(500)))));
        assert_eq!(script.fetch(), Some(Ok(Command::Goto(1))));
        assert_eq!(script.fetch(), Some(Ok(Command::Angle([None, Some(-30.0), Some(90.5)]))));
        assert_eq!(script.count, 4);
    }

    #[test]
    fn what_is_no_command_is_an_error_and_the_end_is_the_end() {
        for bad in
            ["ANGLE(1,2)", "JUMP()", "WAIT(x)", "PROFILE(6)", "\u{1}\u{2}", "ANGLE(1,2,nan)", "GOTO(0)"]
        {
            assert_eq!(Script::new(0, 0, false, bad.as_bytes()).fetch(), Some(Err(())), "{bad}");
        }
        assert_eq!(Script::new(0, 0, false, b"END()\nHOME()").fetch(), None);
        assert_eq!(Script::new(0, 0, false, b"").fetch(), None);
    }
}
