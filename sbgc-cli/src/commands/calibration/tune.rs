//! `sbgc tune`: automatic tuning of the PID loops.

use std::time::Duration;

use clap::{Args, ValueEnum};
use sbgc_host::calibrate::{Calibration, Tuning};
use sbgc_proto::wire::PerAxis;

use super::runner::{Plan, carry_out};
use crate::connect::with_board_to_the_end;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::values;

const EXAMPLES: &str = "Examples:
  sbgc --dry-run tune --axes pitch,yaw
  sbgc --yes tune --gain 100 --json";

/// Tune the PID loops automatically (asks first)
///
/// The gimbal shakes during tuning. The board saves the result in the active profile: back it up first with `sbgc
/// params dump`. Interrupting stops the tuning.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Tune {
    /// Axes to tune
    #[arg(long, value_enum, value_delimiter = ',', default_value = "roll,pitch,yaw")]
    axes: Vec<Axis>,

    /// 0 for stability, 255 for performance
    #[arg(long, default_value_t = 128)]
    gain: u8,

    /// Strength of the test signal
    #[arg(long, default_value_t = 100)]
    stimulus: u16,

    /// Tune the gain only; firmware 2.70+
    #[arg(long)]
    gain_only: bool,

    /// Start from the present values
    #[arg(long)]
    from_current: bool,

    /// Save the result to all profiles
    #[arg(long)]
    all_profiles: bool,

    /// Time after which to give up [default: 10m]
    #[arg(long, value_name = "TIME", value_parser = values::seconds)]
    patience: Option<Duration>,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Axis {
    Roll,
    Pitch,
    Yaw,
}

impl Tune {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let has = |axis| self.axes.contains(&axis);
        let calibration = Calibration::Tuning(Tuning {
            axes: PerAxis { roll: has(Axis::Roll), pitch: has(Axis::Pitch), yaw: has(Axis::Yaw) },
            gain: self.gain,
            stimulus: self.stimulus,
            gain_only: self.gain_only,
            from_current: self.from_current,
            all_profiles: self.all_profiles,
        });
        let question = if self.all_profiles {
            "Tune, and replace the PID settings of all profiles?"
        } else {
            "Tune, and replace the PID settings of the active profile?"
        };
        let plan = Plan { command: "tune", calibration, question: Some(question), patience: self.patience };
        with_board_to_the_end(global, async |gimbal, info| {
            carry_out(global, output, &gimbal, &info, plan).await
        })
        .await
    }
}
