//! Things that the board does at once: pins, servos, sounds, sensors, restarts.

mod beep;
mod boot;
mod imu;
mod pin;
mod reset;
mod servo;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Imu(imu::Imu),
    Beep(beep::Beep),
    Pin(pin::Pin),
    Servo(servo::Servo),
    Reset(reset::Reset),
    Boot(boot::Boot),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Imu(command) => command.run(global, output).await,
            Command::Beep(command) => command.run(global, output).await,
            Command::Pin(command) => command.run(global, output).await,
            Command::Servo(command) => command.run(global, output).await,
            Command::Reset(command) => command.run(global, output).await,
            Command::Boot(command) => command.run(global, output).await,
        }
    }
}
