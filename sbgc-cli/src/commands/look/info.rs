//! `sbgc info`: what the board is.

use clap::Args;
use sbgc_host::Error;
use serde_json::{Map, Value};

use crate::connect::with_board;
use crate::failure::Failure;
use crate::fields;
use crate::options::Global;
use crate::output::Output;

const EXAMPLES: &str = "Examples:
  sbgc info
  sbgc info --json";

/// Show what the board is: versions, features, ids
///
/// Text output omits zero fields; --json includes them.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Info {}

impl Info {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let (info, more) = with_board(global, async |gimbal, info| {
            match gimbal.board_info3().await {
                Ok(more) => Ok((info, Some(more))),
                // Boards of the first generations do not know the command.
                Err(Error::Timeout { .. } | Error::Refused { .. }) => Ok((info, None)),
                Err(error) => Err(error.into()),
            }
        })
        .await?;
        if output.is_json() {
            let mut object = Map::new();
            fields::add_to_object(&mut object, &info);
            if let Some(more) = &more {
                fields::add_to_object(&mut object, more);
            }
            output.object(&Value::Object(object))?;
            return Ok(());
        }
        let (mut lines, mut zeros) = fields::that_say_something(&info);
        if let Some(more) = &more {
            let (more, more_zeros) = fields::that_say_something(more);
            lines.extend(more);
            zeros += more_zeros;
        }
        let width = lines.iter().map(|(path, _)| path.len()).max().unwrap_or_default();
        for (path, value) in lines {
            output.line(format_args!("{path:<width$}  {value}"))?;
        }
        if zeros > 0 {
            output.line(format_args!("({zeros} fields are 0; --json shows them all)"))?;
        }
        Ok(())
    }
}
