//! Storage: what the board keeps.

mod bytes;
mod eeprom;
mod file;
mod i2c;
mod script;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Script(script::Script),
    File(file::File),
    Eeprom(eeprom::Eeprom),
    I2c(i2c::I2c),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Script(command) => command.run(global, output).await,
            Command::File(command) => command.run(global, output).await,
            Command::Eeprom(command) => command.run(global, output).await,
            Command::I2c(command) => command.run(global, output).await,
        }
    }
}
