//! `sbgc motors`: power of the motors.

use clap::{Args, ValueEnum};
use sbgc_proto::commands::MotorsOffMode;

use crate::args::Global;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::output::Output;

#[derive(Args, Debug)]
pub(crate) struct Motors {
    /// What to do
    #[arg(value_enum)]
    switch: Switch,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Switch {
    /// Give them power
    On,
    /// Take it away; an unbalanced camera falls
    Off,
}

impl Motors {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let (state, word) = with_board(global, async |gimbal, _| {
            Ok(match self.switch {
                Switch::On => {
                    gimbal.motors_on().await?;
                    (true, "on")
                }
                Switch::Off => {
                    gimbal.motors_off(MotorsOffMode::Normal).await?;
                    (false, "off")
                }
            })
        })
        .await?;
        if output.is_json() {
            output.object(&serde_json::json!({ "motors_on": state }))?;
        } else {
            output.line(format_args!("motors {word}"))?;
        }
        Ok(())
    }
}
