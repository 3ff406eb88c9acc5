//! `sbgc calibrate`: sensors, motors and encoders.

use std::time::Duration;

use clap::{Args, ValueEnum};
use sbgc_host::calibrate::{BodeTest, Calibration};
use sbgc_proto::commands::{Axis as GimbalAxis, CalibAction, CalibImu, CoggingAxes};

use super::runner::{Plan, carry_out};
use crate::connect::with_board_to_the_end;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::values;

const EXAMPLES: &str = "Examples:
  sbgc calibrate gyro
  sbgc calibrate battery --voltage 15.5
  sbgc --yes calibrate poles --json";

/// Calibrate sensors, motors and encoders
///
/// Prints instructions, the progress and the outcome. Calibrations of poles and encoders ask first. What moves stops
/// when the command is interrupted: with the motors, gently.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Calibrate {
    /// What to calibrate
    #[arg(value_enum, value_name = "KIND")]
    kind: Kind,

    /// Sensor, for acc, gyro and mag
    #[arg(long, value_enum, default_value_t = Imu::Main)]
    imu: Imu,

    /// Calibrate over temperature, for acc and gyro
    #[arg(long)]
    temperature: bool,

    /// Measured voltage, for battery
    #[arg(long, value_name = "V", required_if_eq("kind", "battery"), value_parser = volts)]
    voltage: Option<f32>,

    /// Reference in g as X,Y,Z of the frame, for external-reference
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, default_value = "0,0,1", value_parser = reference)]
    reference: [f32; 3],

    /// Axis, for cogging and bode
    #[arg(long, value_enum, default_value_t = Axis::Yaw)]
    axis: Axis,

    /// Time after which to give up [default: as long as it may take]
    #[arg(long, value_name = "TIME", value_parser = values::seconds)]
    patience: Option<Duration>,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Kind {
    /// Accelerometer
    Acc,
    /// Gyroscope
    Gyro,
    /// Magnetometer
    Mag,
    /// Poles and direction of the motors; the gimbal moves
    Poles,
    /// Voltage sensor
    Battery,
    /// Zero of the encoders
    EncoderOffset,
    /// Encoders to the fields of their motors; the gimbal moves
    EncoderFieldOffset,
    /// Correction for a misaligned sensor
    Orientation,
    /// Accelerometer by a better one on the frame
    ExternalReference,
    /// Magnetic link of motors and magnetometer
    MotorMagLink,
    /// Cogging of a motor; the gimbal moves
    Cogging,
    /// Offset of follow mode
    FollowOffset,
    /// Gains of the flight controller's signals
    ExtGain,
    /// Bode test of an axis; the gimbal shakes
    Bode,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Imu {
    /// On the camera platform
    Main,
    /// On the frame
    Frame,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Axis {
    Roll,
    Pitch,
    Yaw,
}

fn volts(text: &str) -> Result<f32, String> {
    let digits = text.trim().trim_end_matches(['V', 'v']).trim_end();
    match digits.parse() {
        Ok(volts) if (1.0..=100.0).contains(&volts) => Ok(volts),
        Ok(_) => Err(format!("{text} is out of range; expected 1 to 100 V")),
        Err(_) => Err(format!("expected a voltage such as 15.5, got \"{text}\"")),
    }
}

fn reference(text: &str) -> Result<[f32; 3], String> {
    let expected = || format!("expected three numbers such as 0,0,1, got \"{text}\"");
    let parts: Vec<f32> =
        text.split(',').map(|part| part.trim().parse()).collect::<Result<_, _>>().map_err(|_| expected())?;
    parts.try_into().map_err(|_| expected())
}

impl Calibrate {
    fn plan(&self) -> Plan {
        let imu = match self.imu {
            Imu::Main => CalibImu::Main,
            Imu::Frame => CalibImu::Frame,
        };
        let action = if self.temperature { CalibAction::Temperature } else { CalibAction::Regular };
        let (axis, cogging) = match self.axis {
            Axis::Roll => (GimbalAxis::Roll, CoggingAxes::ROLL),
            Axis::Pitch => (GimbalAxis::Pitch, CoggingAxes::PITCH),
            Axis::Yaw => (GimbalAxis::Yaw, CoggingAxes::YAW),
        };
        let bode = BodeTest { axis, gain: 100, samples: 10_000, frequencies: (3, 100) };
        let (command, calibration) = match self.kind {
            Kind::Acc => ("calibrate acc", Calibration::Accelerometer(imu, action)),
            Kind::Gyro => ("calibrate gyro", Calibration::Gyroscope(imu, action)),
            Kind::Mag => ("calibrate mag", Calibration::Magnetometer(imu, CalibAction::Regular)),
            Kind::Poles => ("calibrate poles", Calibration::Poles),
            Kind::Battery => ("calibrate battery", Calibration::Battery(self.voltage.unwrap_or_default())),
            Kind::EncoderOffset => ("calibrate encoder-offset", Calibration::EncoderOffset),
            Kind::EncoderFieldOffset => ("calibrate encoder-field-offset", Calibration::EncoderField),
            Kind::Orientation => ("calibrate orientation", Calibration::Orientation),
            Kind::ExternalReference => {
                ("calibrate external-reference", Calibration::ExternalReference(self.reference))
            }
            Kind::MotorMagLink => ("calibrate motor-mag-link", Calibration::MotorMagneticLink),
            Kind::Cogging => ("calibrate cogging", Calibration::Cogging(cogging)),
            Kind::FollowOffset => ("calibrate follow-offset", Calibration::FollowOffset),
            Kind::ExtGain => ("calibrate ext-gain", Calibration::ExternalGain),
            Kind::Bode => ("calibrate bode", Calibration::Bode(bode)),
        };
        let question = match self.kind {
            Kind::Poles => Some("Find the poles of the motors and replace the settings?"),
            Kind::EncoderOffset => Some("Replace the zero of all encoders?"),
            Kind::EncoderFieldOffset => Some("Measure the encoders and replace their field offsets?"),
            _ => None,
        };
        Plan { command, calibration, question, patience: self.patience }
    }

    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        let plan = self.plan();
        with_board_to_the_end(global, async |gimbal, info| {
            carry_out(global, output, &gimbal, &info, plan).await
        })
        .await
    }
}
