//! `sbgc info`: what the board is.

use std::io::{self, IsTerminal as _};

use clap::Args;
use sbgc_host::{Error, Gimbal};
use sbgc_proto::commands::{
    BoardFeatures, BoardFeaturesExt, BoardInfo, BoardInfo3, ModuleList, ModuleListRequest, ReadStateVars,
    StateVars,
};
use serde_json::{Map, Value};

use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{fields, text};

const EXAMPLES: &str = "Examples:
  sbgc info
  sbgc info --json";

/// Show what the board is
///
/// Prints versions, features, ids and memory. Statistics, such as the working time, and the modules on the CAN bus are shown where the board has them. Text output
/// omits zero fields; --json includes them.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Info {}

/// All that a board says of itself; nothing where it does not know the command.
struct Known {
    info: BoardInfo,
    more: Option<BoardInfo3>,
    modules: Option<ModuleList>,
    statistics: Option<StateVars>,
}

impl Known {
    async fn ask(gimbal: &Gimbal, info: BoardInfo) -> Result<Self, Failure> {
        let more = async { Ok(Some(gimbal.board_info3().await?)) };
        let modules = async {
            let present = info.board_features.contains(BoardFeatures::CAN_PORT);
            if present { gimbal.request(&ModuleListRequest {}).await.map(Some) } else { Ok(None) }
        };
        let statistics = async {
            let present = info.board_features_ext.contains(BoardFeaturesExt::STATE_VARS);
            if present { gimbal.request(&ReadStateVars {}).await.map(Some) } else { Ok(None) }
        };
        let (more, modules, statistics) = tokio::join!(more, modules, statistics);
        Ok(Self { info, more: known(more)?, modules: known(modules)?, statistics: known(statistics)? })
    }
}

/// Boards of the first generations do not know the commands.
fn known<T>(answer: Result<Option<T>, Error>) -> Result<Option<T>, Failure> {
    match answer {
        Ok(answer) => Ok(answer),
        Err(Error::Timeout { .. } | Error::Refused { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// Columns that values have at least.
const MIN_ROOM: usize = 30;

impl Info {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let known = with_board(global, async |gimbal, info| Known::ask(&gimbal, info).await).await?;
        let Known { info, more, modules, statistics } = &known;
        if output.is_json() {
            let mut object = Map::new();
            fields::add_to_object(&mut object, info);
            if let Some(more) = more {
                fields::add_to_object(&mut object, more);
            }
            if let Some(modules) = modules {
                fields::add_to_object(&mut object, modules);
            }
            if let Some(statistics) = statistics {
                fields::add_to_object(&mut object, statistics);
            }
            output.object(&Value::Object(object))?;
            return Ok(());
        }
        let mut parts = vec![fields::that_say_something(info)];
        parts.extend(more.as_ref().map(fields::that_say_something));
        parts.extend(modules.as_ref().map(fields::that_say_something));
        parts.extend(statistics.as_ref().map(fields::that_say_something));
        let zeros: usize = parts.iter().map(|(_, zeros)| zeros).sum();
        let lines = || parts.iter().flat_map(|(lines, _)| lines);
        let width = lines().map(|(path, _)| path.len()).max().unwrap_or_default();
        // Programs get one line per field.
        let terminal = io::stdout().is_terminal();
        let room = if terminal { text::width().saturating_sub(width + 2).max(MIN_ROOM) } else { usize::MAX };
        for (path, value) in lines() {
            let mut path = path.as_str();
            for line in text::wrap_names(value, room) {
                output.line(format_args!("{path:<width$}  {}", line.trim_end()))?;
                path = "";
            }
        }
        if zeros > 0 {
            output.line(format_args!("({zeros} fields are 0; --json shows them all)"))?;
        }
        Ok(())
    }
}
