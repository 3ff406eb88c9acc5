//! What the gimbal is to do at this moment, checked before it is sent.

use bytes::Bytes;
use sbgc_proto::commands::{
    Angles, Control, ControlAxis, ControlExt, ControlExtAxis, ControlMode, ControlModeKind, ControlQuat,
    ControlQuatFlags,
};
use sbgc_proto::units::{
    Angle, CoarseRcSignal, ControlRate, FineControlRate, FineRate, FirmwareVersion, RcSignal,
};
use sbgc_proto::wire::{PerAxis, PerXyz};
use sbgc_proto::{CommandId, Message};

use crate::gimbal::encode;
use crate::{Error, Result};

/// Highest angle that can be sent, in degrees.
const ANGLE_LIMIT: f64 = 719.97;
/// Highest speed that can be sent, in degrees per second.
const SPEED_LIMIT: f64 = 4000.0;
/// Highest speed that can be sent in fine steps, in degrees per second.
const FINE_LIMIT: f64 = 32.767;
/// Lowest speed that is not the one of the settings.
const SPEED_STEP: f64 = 0.13;
/// Highest angular velocity of a rotation vector, in radians per second: the same limit.
const ROTATION_LIMIT: f64 = 69.8;
/// Full deflection of a radio control signal.
const SIGNAL_LIMIT: f64 = 500.0;

const IGNORE_SINCE: FirmwareVersion = FirmwareVersion::new(2, 70, 4);
const HIGH_RES_RC_SINCE: FirmwareVersion = FirmwareVersion::new(2, 66, 2);

/// What the gimbal is to do: where to go, or how fast.
///
/// Values are in degrees and degrees per second. Values that are not finite or that cannot be sent are refused with
/// [`Error::OutOfRange`]. Axes without a value are left as they are.
///
/// ```
/// use sbgc_host::Setpoint;
/// use sbgc_host::proto::wire::PerAxis;
///
/// let yaw = |speed| PerAxis { yaw: Some(speed), ..PerAxis::default() };
/// assert!(Setpoint::speeds(yaw(-15.0)).is_ok());
/// let error = Setpoint::speeds(yaw(f32::NAN)).unwrap_err();
/// assert_eq!(error.to_string(), "yaw speed: NaN is out of range; expected -4000 to 4000 deg/s");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setpoint {
    pub(super) command: Command,
    needs: Option<(&'static str, FirmwareVersion)>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Command {
    Axes(Control),
    Extended(ControlExt),
    Quaternion(ControlQuat),
}

/// What one axis is to do, for [`Setpoint::extended`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExtendedTarget {
    /// How the axis is controlled.
    pub mode: ControlMode,
    /// Speed in degrees per second, in steps of 0.001.
    pub speed: Option<f64>,
    /// Angle in degrees.
    pub angle: Option<f32>,
}

impl Setpoint {
    /// Moves to Euler angles at a speed, or at that of the board's settings.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn angles(target: PerAxis<Option<f32>>, speed: Option<f32>) -> Result<Self> {
        Self::to_angles(target, speed, ControlMode::ANGLE)
    }

    /// Moves to Euler angles by the shortest way round. Firmware 2.70b7+.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn angles_shortest(target: PerAxis<Option<f32>>, speed: Option<f32>) -> Result<Self> {
        let since = FirmwareVersion::new(2, 70, 7);
        Ok(Self::to_angles(target, speed, ControlMode::ANGLE_SHORTEST)?.since("the shortest way", since))
    }

    /// Moves to angles from the neutral point relative to the frame.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn angles_rel_frame(target: PerAxis<Option<f32>>, speed: Option<f32>) -> Result<Self> {
        Self::to_angles(target, speed, ControlMode::ANGLE_REL_FRAME)
    }

    /// Moves to the home position: roll and pitch level, yaw to the neutral point of the frame.
    ///
    /// # Errors
    /// If the speed cannot be sent.
    pub fn home(speed: Option<f32>) -> Result<Self> {
        let level = Self::angles([Some(0.0); 3].into(), speed)?;
        let Command::Axes(mut control) = level.command else { return Ok(level) };
        control.control_mode.yaw = ControlMode::ANGLE_REL_FRAME;
        Ok(Self::from(control))
    }

    fn to_angles(target: PerAxis<Option<f32>>, speed: Option<f32>, mode: ControlMode) -> Result<Self> {
        let speed = speed.map_or(Ok(ControlRate::default()), move_speed)?;
        let names = ["roll angle", "pitch angle", "yaw angle"];
        Self::of_axes(target, mode, names, |what, value| {
            Ok(ControlAxis { speed, angle: angle(what, value)? })
        })
    }

    /// Turns at speeds until the next set-point.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn speeds(speeds: PerAxis<Option<f32>>) -> Result<Self> {
        Self::of_axes(speeds, ControlMode::SPEED, SPEED_NAMES, |what, value| {
            speed(what, value).map(ControlAxis::speed)
        })
    }

    /// Turns at speeds of up to 32.767 degrees per second, in steps of 0.001. Firmware 2.60+.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn fine_speeds(speeds: PerAxis<Option<f32>>) -> Result<Self> {
        let mode = ControlMode::SPEED.with_high_res_speed(true);
        let setpoint = Self::of_axes(speeds, mode, SPEED_NAMES, |what, value| {
            let rate = FineControlRate::try_from_degrees_per_second(value);
            rate.map(ControlAxis::fine_speed)
                .map_err(|_| out_of_range(what, value.into(), FINE_LIMIT, "deg/s"))
        });
        Ok(setpoint?.since("high-resolution speed", FirmwareVersion::new(2, 60, 0)))
    }

    /// Follows a path: the angle of this moment, and the speed at which it changes.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn path(angles: PerAxis<Option<f32>>, speeds: PerAxis<Option<f32>>) -> Result<Self> {
        let names = ["roll angle", "pitch angle", "yaw angle"];
        let mut rates = [ControlRate::default(); 3];
        for ((place, value), what) in rates.iter_mut().zip(speeds.into_array()).zip(SPEED_NAMES) {
            *place = value.map_or(Ok(ControlRate::default()), |value| speed(what, value))?;
        }
        let mut rates = rates.into_iter();
        let mut targets = [None; 3];
        for ((place, value), what) in targets.iter_mut().zip(angles.into_array()).zip(names) {
            let speed = rates.next().unwrap_or_default();
            *place = value
                .map(|value| angle(what, value).map(|angle| ControlAxis { speed, angle }))
                .transpose()?;
        }
        Ok(Self::from(Control {
            control_mode: targets
                .map(|axis| axis.map_or(ControlMode::IGNORE, |_| ControlMode::SPEED_ANGLE))
                .into(),
            axes: targets.map(Option::unwrap_or_default).into(),
        }))
    }

    /// Moves to Euler angles in the mode that follows a path, at a speed toward each angle from where the camera is
    /// `now`.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn speed_angle(target: PerAxis<Option<f32>>, speed: f32, now: &Angles) -> Result<Self> {
        move_speed(speed)?;
        let now = now.axes.map(|axis| axis.imu_angle.degrees()).into_array();
        let mut speeds = [None; 3];
        for ((place, target), now) in speeds.iter_mut().zip(target.into_array()).zip(now) {
            *place = target.map(|target| speed.copysign(target - now));
        }
        Self::path(target, speeds.into())
    }

    /// Takes the place of radio control, with signals from -500 to 500.
    ///
    /// Fine steps are sent to firmware that has them, 2.66b2+.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn rc(signals: PerAxis<Option<f32>>) -> Result<Self> {
        let names = ["roll signal", "pitch signal", "yaw signal"];
        Self::of_axes(signals, ControlMode::RC_HIGH_RES, names, |what, value| {
            if value.is_finite() && f64::from(value).abs() <= SIGNAL_LIMIT {
                Ok(ControlAxis::high_res_rc_signal(RcSignal::from_fraction(value / 500.0)))
            } else {
                Err(out_of_range(what, value.into(), SIGNAL_LIMIT, "(full scale)"))
            }
        })
    }

    /// Turns to an attitude as a quaternion w, x, y, z of length 1. Firmware 2.73+.
    ///
    /// # Errors
    /// If it is not a unit quaternion.
    pub fn attitude(quaternion: [f32; 4]) -> Result<Self> {
        let length = quaternion.iter().map(|part| f64::from(*part).powi(2)).sum::<f64>().sqrt();
        if !(0.99..=1.01).contains(&length) {
            let what = "length of the quaternion";
            return Err(Error::OutOfRange { what, value: length, minimum: 0.99, maximum: 1.01, unit: "" });
        }
        Ok(Self::quaternion(ControlQuat::attitude(quaternion, ControlQuatFlags::empty())))
    }

    /// Turns about any axis: a rotation vector in radians per second. Firmware 2.73+.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn rotation(vector: PerXyz<f32>) -> Result<Self> {
        for value in [vector.x, vector.y, vector.z].map(f64::from) {
            if !value.is_finite() || value.abs() > ROTATION_LIMIT {
                return Err(out_of_range("angular velocity", value, ROTATION_LIMIT, "rad/s"));
            }
        }
        Ok(Self::quaternion(ControlQuat::speed(vector, ControlQuatFlags::empty())))
    }

    fn quaternion(command: ControlQuat) -> Self {
        let needs = Some(("control by quaternion", FirmwareVersion::new(2, 73, 0)));
        Self { command: Command::Quaternion(command), needs }
    }

    /// Moves chosen axes, each in a mode of its own, with speeds in fine steps. Firmware 2.72b0+.
    ///
    /// # Errors
    /// If a value cannot be sent.
    pub fn extended(axes: PerAxis<Option<ExtendedTarget>>) -> Result<Self> {
        let mut sent = [None; 3];
        for (place, target) in sent.iter_mut().zip(axes.into_array()) {
            let Some(target) = target else { continue };
            let rate = |value: f64| {
                let rate = FineRate::try_from_degrees_per_second(value).ok();
                rate.filter(|_| value.abs() <= SPEED_LIMIT)
                    .ok_or_else(|| out_of_range("speed", value, SPEED_LIMIT, "deg/s"))
            };
            *place = Some(ControlExtAxis {
                control_mode: target.mode,
                speed_32bit: target.speed.map(rate).transpose()?,
                angle: target.angle.map(|value| angle("angle", value)).transpose()?,
                ..ControlExtAxis::default()
            });
        }
        let command = Command::Extended(ControlExt::new(sent.into()));
        Ok(Self { command, needs: Some(("extended control", FirmwareVersion::new(2, 72, 0))) })
    }

    /// The same as an automated task, which the board reports when it is done. Only moves to angles are changed.
    #[must_use]
    pub fn with_auto_task(self) -> Self {
        match self.command {
            Command::Axes(control) => Self { command: Command::Axes(control.with_auto_task()), ..self },
            _ => self,
        }
    }

    fn of_axes(
        values: PerAxis<Option<f32>>,
        mode: ControlMode,
        names: [&'static str; 3],
        make: impl Fn(&'static str, f32) -> Result<ControlAxis>,
    ) -> Result<Self> {
        let (mut modes, mut axes) = ([ControlMode::IGNORE; 3], [ControlAxis::default(); 3]);
        let places = modes.iter_mut().zip(axes.iter_mut());
        for ((places, value), what) in places.zip(values.into_array()).zip(names) {
            if let Some(value) = value {
                *places.0 = mode;
                *places.1 = make(what, value)?;
            }
        }
        Ok(Self::from(Control { control_mode: modes.into(), axes: axes.into() }))
    }

    fn since(self, what: &'static str, since: FirmwareVersion) -> Self {
        Self { needs: Some((what, since)), ..self }
    }

    /// The command that carries it to a board with this firmware: id and payload.
    ///
    /// # Errors
    /// If the firmware does not know it.
    pub fn frame(self, firmware: FirmwareVersion) -> Result<(CommandId, Bytes)> {
        Ok(match self.for_firmware(firmware)?.command {
            Command::Axes(control) => (Control::ID, encode(&control)?),
            Command::Extended(control) => (ControlExt::ID, encode(&control)?),
            Command::Quaternion(control) => (ControlQuat::ID, encode(&control)?),
        })
    }

    /// The axes that it moves; all of them for a quaternion.
    pub fn moves(&self) -> PerAxis<bool> {
        match &self.command {
            Command::Axes(control) => control.control_mode.map(|mode| !is_left_alone(mode)),
            Command::Extended(control) => PerAxis {
                roll: control.roll.is_some(),
                pitch: control.pitch.is_some(),
                yaw: control.yaw.is_some(),
            },
            Command::Quaternion(_) => [true; 3].into(),
        }
    }

    /// The command as this firmware knows it.
    ///
    /// # Errors
    /// If it does not know it.
    pub(super) fn for_firmware(self, firmware: FirmwareVersion) -> Result<Self> {
        if let Some((what, since)) = self.needs
            && firmware < since
        {
            return Err(Error::TooOld { what, since, firmware });
        }
        let Command::Axes(control) = self.command else { return Ok(self) };
        Ok(Self { command: Command::Axes(adapted(control, firmware)), ..self })
    }
}

/// A command in typed units, such as a mode that has no constructor here.
impl From<Control> for Setpoint {
    fn from(control: Control) -> Self {
        Self { command: Command::Axes(control), needs: None }
    }
}

const SPEED_NAMES: [&str; 3] = ["roll speed", "pitch speed", "yaw speed"];

fn is_left_alone(mode: ControlMode) -> bool {
    matches!(mode.kind(), ControlModeKind::Ignore | ControlModeKind::NoControl)
}

/// The same for firmware that lacks modes: [`ControlMode::IGNORE`] and [`ControlMode::RC_HIGH_RES`].
pub(super) fn adapted(control: Control, firmware: FirmwareVersion) -> Control {
    let (mut modes, mut axes) = (control.control_mode.into_array(), control.axes.into_array());
    for (mode, axis) in modes.iter_mut().zip(axes.iter_mut()) {
        match mode.kind() {
            // Before, "not controlled" left an axis as it was.
            ControlModeKind::Ignore if firmware < IGNORE_SINCE => *mode = ControlMode::NO_CONTROL,
            ControlModeKind::RcHighRes if firmware < HIGH_RES_RC_SINCE => {
                let signal = axis.as_high_res_rc_signal().fraction();
                *mode = mode.with_kind(ControlModeKind::Rc);
                axis.angle = ControlAxis::rc_signal(CoarseRcSignal::from_fraction(signal)).angle;
            }
            _ => {}
        }
    }
    Control { control_mode: modes.into(), axes: axes.into() }
}

fn angle(what: &'static str, value: f32) -> Result<Angle> {
    Angle::try_from_degrees(value).map_err(|_| out_of_range(what, value.into(), ANGLE_LIMIT, "deg"))
}

fn speed(what: &'static str, value: f32) -> Result<ControlRate> {
    ControlRate::try_from_degrees_per_second(value)
        .map_err(|_| out_of_range(what, value.into(), SPEED_LIMIT, "deg/s"))
}

/// The speed of a move: 0 would be that of the settings, and the direction is for the angle to say.
fn move_speed(value: f32) -> Result<ControlRate> {
    match ControlRate::try_from_degrees_per_second(value) {
        Ok(rate) if rate.0 > 0 => Ok(rate),
        _ => Err(Error::OutOfRange {
            what: "speed",
            value: value.into(),
            minimum: SPEED_STEP,
            maximum: SPEED_LIMIT,
            unit: "deg/s",
        }),
    }
}

fn out_of_range(what: &'static str, value: f64, limit: f64, unit: &'static str) -> Error {
    Error::OutOfRange { what, value, minimum: -limit, maximum: limit, unit }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pitch<T>(value: T) -> PerAxis<Option<T>> {
        PerAxis { roll: None, pitch: Some(value), yaw: None }
    }

    #[test]
    fn what_cannot_be_sent_is_refused() {
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 5000.0, -5000.0] {
            let made = [
                Setpoint::angles(pitch(value), None),
                Setpoint::angles(pitch(10.0), Some(value)),
                Setpoint::angles_rel_frame(pitch(value), None),
                Setpoint::speeds(pitch(value)),
                Setpoint::fine_speeds(pitch(value)),
                Setpoint::path(pitch(value), pitch(1.0)),
                Setpoint::path(pitch(1.0), pitch(value)),
                Setpoint::rc(pitch(value)),
                Setpoint::rotation(PerXyz { x: 0.0, y: value, z: 0.0 }),
                Setpoint::attitude([value, 0.0, 0.0, 0.0]),
                Setpoint::extended(pitch(ExtendedTarget { angle: Some(value), ..ExtendedTarget::default() })),
                Setpoint::extended(pitch(ExtendedTarget {
                    speed: Some(value.into()),
                    ..ExtendedTarget::default()
                })),
            ];
            for (index, made) in made.into_iter().enumerate() {
                assert!(matches!(made, Err(Error::OutOfRange { .. })), "{index} with {value}: {made:?}");
            }
        }
        assert!(Setpoint::angles(pitch(10.0), Some(0.0)).is_err(), "that would be the speed of the settings");
        assert!(Setpoint::angles(pitch(-719.9), Some(4000.0)).is_ok());
    }

    #[test]
    fn old_firmware_gets_modes_that_it_knows() {
        let setpoint = Setpoint::rc(pitch(250.0)).unwrap();
        assert_eq!(setpoint.moves(), PerAxis { roll: false, pitch: true, yaw: false });
        let modes = |firmware| match setpoint.for_firmware(firmware).unwrap().command {
            Command::Axes(control) => (control.control_mode.into_array(), control.axes.pitch.angle.0),
            other => panic!("{other:?}"),
        };
        let (ignore, none) = (ControlMode::IGNORE, ControlMode::NO_CONTROL);
        assert_eq!(modes(FirmwareVersion::new(2, 73, 5)), ([ignore, ControlMode::RC_HIGH_RES, ignore], 8192));
        assert_eq!(modes(FirmwareVersion::new(2, 65, 0)), ([none, ControlMode::RC, none], 250));
        let fine = Setpoint::attitude([1.0, 0.0, 0.0, 0.0]).unwrap();
        let error = fine.for_firmware(FirmwareVersion::new(2, 68, 0)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "control by quaternion needs firmware 2.73.0 or later, the board has 2.68; update the firmware"
        );
    }
}
