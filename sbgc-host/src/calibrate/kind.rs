//! What can be calibrated, and what each calibration needs.

use std::time::Duration;

use bytes::Bytes;
use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    CalibAcc, CalibAccExtRef, CalibAction, CalibBat, CalibCogging, CalibExtGain, CalibGyro, CalibImu,
    CalibMag, CalibMode, CalibOffset, CalibOrientCorr, CalibPoles, CoggingAction, CoggingAxes, CoggingAxis,
    EncodersCalibFldOffset4Simple, EncodersCalibOffset4Simple, ImuCalibration,
};
use sbgc_proto::units::{Acceleration, FirmwareVersion, Voltage};
use sbgc_proto::wire::PerXyz;

use super::tune::{BodeTest, Tuning, frame};
use crate::error::{Error, Result};

/// A calibration, or a procedure that runs like one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Calibration {
    /// The accelerometer of a sensor.
    Accelerometer(CalibImu, CalibAction),
    /// The gyroscope of a sensor.
    Gyroscope(CalibImu, CalibAction),
    /// The magnetometer of a sensor.
    Magnetometer(CalibImu, CalibAction),
    /// Number of poles of the motors, and the direction in which they turn.
    Poles,
    /// The voltage sensor, against a measured voltage in volts.
    Battery(f32),
    /// The present position becomes the offset of follow mode.
    FollowOffset,
    /// The gains of the flight controller's signals.
    ExternalGain,
    /// The present position becomes the zero of all encoders.
    EncoderOffset,
    /// How the encoders stand to the fields of their motors.
    EncoderField,
    /// Correction for a misaligned sensor.
    Orientation,
    /// The main accelerometer against a better one on the frame.
    ExternalReference(ReferenceAcceleration),
    /// The magnetic link between motors and magnetometer; its payload is not published.
    MotorMagneticLink,
    /// Measures the cogging of these axes.
    Cogging(CoggingAxes),
    /// Automatic tuning of the PID loops.
    Tuning(Tuning),
    /// A Bode test.
    Bode(BodeTest),
}

/// What a reference accelerometer shows, in g: X right, Y forward, Z down.
pub type ReferenceAcceleration = [f32; 3];

/// How a run is seen to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// With the confirmation of the command.
    First,
    /// With a second confirmation.
    Second,
    /// With a confirmation that carries this.
    Confirmed(u32),
    /// With this message, which nobody has asked for.
    Message(CommandId),
    /// When real-time data no longer reports its mode.
    Mode,
}

/// What one calibration needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facts {
    pub(super) end: End,
    pub(super) mode: CalibMode,
    /// Whether the motors have to be on or off.
    pub(super) motors: Option<bool>,
    /// Whether the board confirms the start.
    pub(super) confirmed: bool,
    /// Whether the gimbal moves.
    pub(super) moves: bool,
    pub(super) timeout: Duration,
}

impl Calibration {
    /// What has to be done before, in words.
    pub fn preparation(&self) -> &'static str {
        match self {
            Self::Accelerometer(..) => {
                "Hold the sensor still; for all six points, turn each of its axes up and down in turn."
            }
            Self::Gyroscope(..) => "Hold the sensor still until it is done.",
            Self::Magnetometer(..) => "Turn the sensor slowly in all directions until it is done.",
            Self::Poles => "The gimbal moves: balance the camera, and do not touch the gimbal.",
            Self::Battery(_) => "Power the board from its battery, not from USB alone.",
            Self::FollowOffset => "The present position becomes the offset of follow mode.",
            Self::ExternalGain => {
                "Tilt the frame by hand once it runs, with the flight controller connected."
            }
            Self::EncoderOffset => "Put the gimbal into its normal position: all encoders read zero there.",
            Self::EncoderField => "The gimbal moves by 40 degrees: nothing may be in its way.",
            Self::Orientation => "Motors off; fix the joint between the inner and the middle motor.",
            Self::ExternalReference(_) => {
                "Hold the gimbal still, with one axis of the sensor within 20 degrees of the vertical."
            }
            Self::MotorMagneticLink => "The gimbal may move: do not touch it.",
            Self::Cogging(_) => "The gimbal moves: balance the camera well, and do not touch the gimbal.",
            Self::Tuning(_) => {
                "The gimbal shakes: mount the camera, balance it, and do not touch the gimbal."
            }
            Self::Bode(_) => "The gimbal shakes: do not touch it.",
        }
    }

    /// Whether the gimbal moves by itself meanwhile.
    pub fn moves(&self) -> bool {
        self.facts().moves
    }

    pub(super) fn facts(&self) -> Facts {
        let minutes = Duration::from_mins;
        let still = Facts {
            end: End::Mode,
            mode: CalibMode::None,
            motors: None,
            confirmed: false,
            moves: false,
            timeout: minutes(1),
        };
        let moving = Facts { motors: Some(true), moves: true, timeout: minutes(5), ..still };
        let sensor = Facts { end: End::Second, confirmed: true, timeout: minutes(10), ..still };
        match self {
            Self::Accelerometer(..) => Facts { mode: CalibMode::Acc, ..sensor },
            Self::Gyroscope(..) => Facts { mode: CalibMode::Gyro, ..sensor },
            Self::Magnetometer(..) => Facts { mode: CalibMode::Mag, ..sensor },
            Self::Poles => Facts { mode: CalibMode::Poles, ..moving },
            Self::Battery(_) => Facts { end: End::First, confirmed: true, ..still },
            Self::FollowOffset => still,
            Self::ExternalGain => Facts { mode: CalibMode::ExtGain, ..still },
            Self::EncoderOffset => Facts { mode: CalibMode::EncoderOffset, ..still },
            Self::EncoderField => Facts { mode: CalibMode::EncoderFldOffset, ..moving },
            Self::Orientation => Facts {
                end: End::Message(CommandId::ReadParamsExt2),
                mode: CalibMode::ImuOrientationCorr,
                motors: Some(false),
                confirmed: true,
                ..still
            },
            Self::ExternalReference(_) => Facts {
                end: End::First,
                mode: CalibMode::AccExtRef,
                timeout: Duration::from_secs(4),
                ..still
            },
            Self::MotorMagneticLink => Facts { mode: CalibMode::MotorMagLink, ..moving },
            Self::Cogging(_) => {
                let timeout = minutes(30);
                Facts {
                    end: End::Confirmed(255),
                    mode: CalibMode::Cogging,
                    confirmed: true,
                    timeout,
                    ..moving
                }
            }
            Self::Tuning(_) => Facts {
                end: End::Message(CommandId::ReadParams3),
                mode: CalibMode::AutoPid,
                confirmed: true,
                timeout: minutes(10),
                ..moving
            },
            Self::Bode(_) => Facts {
                end: End::Message(CommandId::BodeTestStartStop),
                mode: CalibMode::BodeTest,
                confirmed: true,
                ..moving
            },
        }
    }

    /// The command that starts it.
    ///
    /// # Errors
    /// If a value cannot be sent, or the firmware does not have it.
    pub fn command(&self, firmware: FirmwareVersion) -> Result<(CommandId, Bytes)> {
        let sensor = |imu_idx, action| ImuCalibration { imu_idx, action, ..ImuCalibration::default() };
        match *self {
            Self::Accelerometer(imu, action) => frame(&CalibAcc(sensor(imu, action))),
            Self::Gyroscope(imu, action) => frame(&CalibGyro(sensor(imu, action))),
            Self::Magnetometer(imu, action) => frame(&CalibMag(sensor(imu, action))),
            Self::Poles => frame(&CalibPoles {}),
            Self::Battery(volts) => frame(&CalibBat { actual_voltage: voltage(volts)? }),
            Self::FollowOffset => frame(&CalibOffset {}),
            Self::ExternalGain => frame(&CalibExtGain {}),
            Self::EncoderOffset => frame(&EncodersCalibOffset4Simple {}),
            Self::EncoderField => frame(&EncodersCalibFldOffset4Simple {}),
            Self::Orientation => frame(&CalibOrientCorr::default()),
            Self::ExternalReference(reference) => {
                frame(&CalibAccExtRef { acc_ref: acceleration(reference)?, ..CalibAccExtRef::default() })
            }
            Self::MotorMagneticLink => Ok((CommandId::CalibMotorMagLink, Bytes::new())),
            Self::Cogging(axes) => {
                let settings = CoggingAxis { angle: 360, smooth: 50, speed: 50, ..CoggingAxis::default() };
                frame(&CalibCogging {
                    action: CoggingAction::Calibrate,
                    axis_to_calibrate: axes,
                    axes: [settings; 3].into(),
                    iterations_num: 2,
                    ..CalibCogging::default()
                })
            }
            Self::Tuning(tuning) => tuning.command(firmware),
            Self::Bode(test) => frame(&test.command()),
        }
    }
}

fn voltage(volts: f32) -> Result<Voltage> {
    let (minimum, maximum) = (1.0, 100.0);
    match Voltage::try_from_volts(volts) {
        Ok(voltage) if (minimum..=maximum).contains(&f64::from(volts)) => Ok(voltage),
        _ => Err(Error::OutOfRange { what: "voltage", value: volts.into(), minimum, maximum, unit: "V" }),
    }
}

fn acceleration(reference: ReferenceAcceleration) -> Result<PerXyz<Acceleration>> {
    let mut parts = [Acceleration::default(); 3];
    for (place, value) in parts.iter_mut().zip(reference) {
        *place = Acceleration::try_from_g(value).map_err(|_| Error::OutOfRange {
            what: "reference acceleration",
            value: value.into(),
            minimum: -64.0,
            maximum: 63.99,
            unit: "g",
        })?;
    }
    Ok(parts.into())
}
