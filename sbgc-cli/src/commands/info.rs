//! `sbgc info`: what the board is.

use clap::Args;
use sbgc_host::Error;
use serde_json::{Map, Value};

use crate::args::Global;
use crate::connect::connect;
use crate::failure::Failure;
use crate::fields;
use crate::output::Output;

#[derive(Args, Debug)]
pub(crate) struct Info {}

impl Info {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let (gimbal, info) = connect(global).await?;
        let more = match gimbal.board_info3().await {
            Ok(more) => Some(more),
            // Boards of the first generations do not know the command.
            Err(Error::Timeout { .. } | Error::Refused { .. }) => None,
            Err(error) => return Err(error.into()),
        };
        if output.is_json() {
            let mut object = Map::new();
            fields::add_to_object(&mut object, &info);
            if let Some(more) = &more {
                fields::add_to_object(&mut object, more);
            }
            output.object(&Value::Object(object))?;
            return Ok(());
        }
        fields::print(output, &info)?;
        if let Some(more) = &more {
            fields::print(output, more)?;
        }
        Ok(())
    }
}
