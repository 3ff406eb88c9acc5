//! Storage: what the board keeps.

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

/// Hex digits as `hexdump` shows them: sixteen bytes per line, after their address.
fn dump(output: &mut Output, address: u32, data: &[u8]) -> std::io::Result<()> {
    for (line, bytes) in data.chunks(16).enumerate() {
        let at = u64::from(address) + line as u64 * 16;
        let pairs: Vec<String> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        output.line(format_args!("{at:08x}  {}", pairs.join(" ")))?;
    }
    Ok(())
}

/// How many bytes differ, and where the first does.
fn differences(before: &[u8], after: &[u8]) -> (usize, Option<usize>) {
    let longer = before.len().max(after.len());
    let mut differing = (0..longer).filter(|&index| before.get(index) != after.get(index));
    let first = differing.next();
    (first.map_or(0, |_| 1 + differing.count()), first)
}
