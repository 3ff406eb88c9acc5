//! Traffic.

mod danger;
mod decode;
mod encode;
mod explain;
mod pieces;
mod proxy;
mod record;
mod replay;
mod send;
mod sim;
mod summary;

use clap::Subcommand;

use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::signals;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Record(record::Record),
    Replay(replay::Replay),
    Decode(decode::Decode),
    Encode(encode::Encode),
    Send(send::Send),
    Proxy(proxy::Proxy),
    Sim(sim::Sim),
}

impl Command {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self {
            Command::Record(command) => command.run(global, output).await,
            Command::Replay(command) => command.run(global, output).await,
            Command::Decode(command) => signals::blocking(|| command.run(output)),
            Command::Encode(command) => command.run(global, output),
            Command::Send(command) => command.run(global, output).await,
            Command::Proxy(command) => command.run(global, output).await,
            Command::Sim(command) => command.run(output).await,
        }
    }
}
