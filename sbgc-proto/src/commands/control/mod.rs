//! Motion control: by axis, by quaternion, and its configuration.

mod config;
mod extended;
mod quaternion;
#[cfg(test)]
mod tests;

use sbgc_proto_macros::{bit_fields, message, open_enum, record};

pub use config::*;
pub use extended::*;
pub use quaternion::*;

use crate::commands::Confirm;

use crate::units::{Angle, CoarseRcSignal, ControlRate, FineControlRate, RcSignal};
use crate::wire::PerAxis;

/// Moves the gimbal, with the same mode for all axes.
///
/// The older form of [`Control`], for firmware before 2.55b5; later firmware accepts it, too.
#[message(CMD_CONTROL, outgoing, form = "legacy", size = 13, length = 13, answer = Confirm)]
pub struct ControlLegacy {
    /// Control mode of all axes.
    pub control_mode: ControlMode,
    /// Speed and angle of each axis.
    #[wire(group)]
    pub axes: PerAxis<ControlAxis>,
}

/// Moves the gimbal, with a separate mode for each axis.
///
/// Overrides RC control until [`Control::release`] is sent or the timeout of [`ControlConfig`] expires. The recommended
/// rate is 50 to 125 Hz; at lower rates, the low-pass filters of [`ControlConfig`] smooth the motion. Automated tasks,
/// such as the menu command that levels the roll axis, take precedence on their axis until they are done.
///
/// Each command is confirmed, unless [`ControlConfigFlags::NO_CONFIRM`] is set. With
/// [`auto_task`](ControlMode::auto_task), a second confirmation with data 1 follows when all target angles are reached
/// to within one degree.
///
/// ```
/// use sbgc_proto::Message;
/// use sbgc_proto::commands::{Control, ControlAxis, ControlMode};
/// use sbgc_proto::units::{Angle, ControlRate};
/// use sbgc_proto::wire::PerAxis;
///
/// // The camera 45 degrees to the right, everything else as radio control has it.
/// let mut control = Control::default();
/// control.control_mode.yaw = ControlMode::ANGLE;
/// control.axes.yaw = ControlAxis::angle(Angle::from_degrees(45.0));
/// assert_eq!(control.encode(&mut [0; 15])?, [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8]);
///
/// // All axes to an angle, at 20 degrees per second.
/// let angles = PerAxis { roll: 0.0, pitch: -30.0, yaw: 90.0 }.map(Angle::from_degrees);
/// let control = Control::angles(angles, ControlRate::from_degrees_per_second(20.0)).with_auto_task();
/// assert!(control.control_mode.pitch.auto_task());
/// # Ok::<(), sbgc_proto::EncodeError>(())
/// ```
#[message(CMD_CONTROL, outgoing, form = "extended", default, size = 15, since = "2.55b5", answer = Confirm)]
#[derive(Copy)]
pub struct Control {
    /// Control mode of each axis.
    pub control_mode: PerAxis<ControlMode>,
    /// Speed and angle of each axis.
    #[wire(group)]
    pub axes: PerAxis<ControlAxis>,
}

impl Control {
    /// Ends serial control: returns all axes to RC control and undoes all changes made by [`ControlConfig`].
    pub fn release() -> Self {
        Self::default()
    }

    /// Moves all axes to Euler angles at one speed; speed 0 selects the speed of the RC settings.
    pub fn angles(angles: PerAxis<Angle>, speed: ControlRate) -> Self {
        Self {
            control_mode: [ControlMode::ANGLE; 3].into(),
            axes: angles.map(|angle| ControlAxis { speed, angle }),
        }
    }

    /// Moves the axes that have a target angle, at one speed, and leaves the others unchanged (firmware 2.70b4+).
    pub fn some_angles(target: PerAxis<Option<Angle>>, speed: ControlRate) -> Self {
        Self {
            control_mode: target
                .map(|angle| if angle.is_some() { ControlMode::ANGLE } else { ControlMode::IGNORE }),
            axes: target
                .map(|angle| angle.map_or(ControlAxis::default(), |angle| ControlAxis { speed, angle })),
        }
    }

    /// Moves all axes to angles from the neutral point relative to the frame, at one speed; speed 0 selects the speed
    /// of the RC settings.
    pub fn angles_rel_frame(angles: PerAxis<Angle>, speed: ControlRate) -> Self {
        Self { control_mode: [ControlMode::ANGLE_REL_FRAME; 3].into(), ..Self::angles(angles, speed) }
    }

    /// Rotates all axes at these speeds until the next command.
    pub fn speeds(speeds: PerAxis<ControlRate>) -> Self {
        Self { control_mode: [ControlMode::SPEED; 3].into(), axes: speeds.map(ControlAxis::speed) }
    }

    /// Rotates all axes at high-resolution, low speeds until the next command.
    pub fn fine_speeds(speeds: PerAxis<FineControlRate>) -> Self {
        Self {
            control_mode: [ControlMode::SPEED.with_high_res_speed(true); 3].into(),
            axes: speeds.map(ControlAxis::fine_speed),
        }
    }

    /// Moves all axes along a path: `axes` has the current angle of the path and the speed at which it changes.
    pub fn path(axes: PerAxis<ControlAxis>) -> Self {
        Self { control_mode: [ControlMode::SPEED_ANGLE; 3].into(), axes }
    }

    /// Returns the command as an automated task: with the speed and acceleration of such tasks, and with a second
    /// confirmation when the angles are reached. Affects only axes that move to an angle.
    #[must_use]
    pub fn with_auto_task(self) -> Self {
        let control_mode = self.control_mode.map(|mode| match mode.kind() {
            ControlModeKind::Angle | ControlModeKind::AngleRelFrame => mode.with_auto_task(true),
            _ => mode,
        });
        Self { control_mode, ..self }
    }
}

/// Set-point of one axis. Its [`ControlMode`] determines which of the two values apply, and how.
#[record(size = 4)]
#[derive(Copy)]
pub struct ControlAxis {
    /// Speed of rotation, which overrides that of the settings and adjustable variables.
    ///
    /// In the modes [`Angle`](ControlModeKind::Angle), [`AngleRelFrame`](ControlModeKind::AngleRelFrame),
    /// [`Rc`](ControlModeKind::Rc) and related ones, 0 selects the speed of the RC settings. The acceleration limit of
    /// the settings still applies. With [`high_res_speed`](ControlMode::high_res_speed), the unit is 0.001 degrees per
    /// second: see [`as_fine_speed`](Self::as_fine_speed) and [`speed_in`](Self::speed_in).
    pub speed: ControlRate,
    /// Target angle, or the control signal in RC modes.
    ///
    /// See [`as_rc_signal`](Self::as_rc_signal) and [`as_high_res_rc_signal`](Self::as_high_res_rc_signal).
    pub angle: Angle,
}

impl ControlAxis {
    /// Creates a set-point from an angle; the speed is that of the RC settings.
    pub const fn angle(angle: Angle) -> Self {
        Self { speed: ControlRate(0), angle }
    }

    /// Rotates at a speed.
    pub const fn speed(speed: ControlRate) -> Self {
        Self { speed, angle: Angle(0) }
    }

    /// Creates a set-point from a high-resolution speed, for modes with
    /// [`high_res_speed`](ControlMode::high_res_speed).
    pub const fn fine_speed(speed: FineControlRate) -> Self {
        Self::speed(ControlRate(speed.0))
    }

    /// Creates a set-point from an RC signal, for [`ControlMode::RC`].
    pub const fn rc_signal(signal: CoarseRcSignal) -> Self {
        Self::angle(Angle(signal.0))
    }

    /// Creates a set-point from a high-resolution RC signal, for [`ControlMode::RC_HIGH_RES`].
    pub const fn high_res_rc_signal(signal: RcSignal) -> Self {
        Self::angle(Angle(signal.0))
    }

    /// Speed as interpreted with [`high_res_speed`](ControlMode::high_res_speed).
    pub const fn as_fine_speed(self) -> FineControlRate {
        FineControlRate(self.speed.0)
    }

    /// Signal as interpreted in [`ControlMode::RC`].
    pub const fn as_rc_signal(self) -> CoarseRcSignal {
        CoarseRcSignal(self.angle.0)
    }

    /// Signal as interpreted in [`ControlMode::RC_HIGH_RES`].
    pub const fn as_high_res_rc_signal(self) -> RcSignal {
        RcSignal(self.angle.0)
    }

    /// Speed in degrees per second as interpreted in `mode`.
    pub fn speed_in(self, mode: ControlMode) -> f32 {
        if mode.high_res_speed() {
            self.as_fine_speed().degrees_per_second()
        } else {
            self.speed.degrees_per_second()
        }
    }
}

/// Control mode of an axis and its flags.
///
/// ```
/// use sbgc_proto::commands::{ControlMode, ControlModeKind};
///
/// let mode = ControlMode::ANGLE_REL_FRAME.with_auto_task(true);
/// assert_eq!(mode, ControlMode(0x45));
/// assert_eq!(mode.kind(), ControlModeKind::AngleRelFrame);
/// ```
#[bit_fields(u8)]
pub struct ControlMode {
    /// Control mode of the axis.
    #[wire(bits = 0..=3, spec = "CONTROL_MODE")]
    pub kind: ControlModeKind,
    /// Mixes the command with the motion of follow mode. For the modes `Rc`, `Speed`, `Angle` and `AngleShortest`.
    #[wire(bits = 4, spec = "CONTROL_FLAG_MIX_FOLLOW", since = "2.70b5")]
    pub mix_follow: bool,
    /// Reaches the target more precisely. For the modes `Angle` and `AngleRelFrame`.
    #[wire(bits = 5, spec = "CONTROL_FLAG_TARGET_PRECISE", since = "2.70b1")]
    pub target_precise: bool,
    /// Moves as an automated task. For the modes `Angle` and `AngleRelFrame`.
    ///
    /// Uses the acceleration of automated tasks, and their speed unless one is given. A second confirmation with data 1
    /// follows when all angles are reached. In the mode `Rc`, this bit is [`force_rc_speed`](Self::force_rc_speed).
    #[wire(bits = 6, spec = "CONTROL_FLAG_AUTO_TASK", since = "2.62b7")]
    pub auto_task: bool,
    /// Speeds are in units of 0.001 degrees per second, for very slow motion.
    #[wire(bits = 7, spec = "CONTROL_FLAG_HIGH_RES_SPEED", since = "2.60")]
    pub high_res_speed: bool,
}

impl ControlMode {
    /// Not controlled by the host.
    pub const NO_CONTROL: Self = Self(0);
    /// Rotates at a speed.
    pub const SPEED: Self = Self(1);
    /// Moves to an angle.
    pub const ANGLE: Self = Self(2);
    /// Rotates at a speed and corrects the remaining error to an angle.
    pub const SPEED_ANGLE: Self = Self(3);
    /// Follows an RC signal.
    pub const RC: Self = Self(4);
    /// Moves to an angle relative to the frame.
    pub const ANGLE_REL_FRAME: Self = Self(5);
    /// Follows a high-resolution RC signal.
    pub const RC_HIGH_RES: Self = Self(6);
    /// Leaves the axis unchanged.
    pub const IGNORE: Self = Self(7);
    /// Moves to an angle by the shortest way.
    pub const ANGLE_SHORTEST: Self = Self(8);

    /// Interprets the signal of the mode `Rc` as a speed, regardless of the dead band, trim and inversion settings.
    ///
    /// Filter, curve and acceleration limit still apply. For remote control whose direction must not depend on the
    /// settings. In the angle modes, this bit is [`auto_task`](Self::auto_task). Firmware 2.62b7+.
    ///
    /// Spec: `CONTROL_FLAG_FORCE_RC_SPEED`, bit 6.
    pub fn force_rc_speed(self) -> bool {
        self.auto_task()
    }

    /// Returns a copy with [`force_rc_speed`](Self::force_rc_speed) replaced.
    #[must_use]
    pub fn with_force_rc_speed(self, value: bool) -> Self {
        self.with_auto_task(value)
    }
}

impl From<ControlModeKind> for ControlMode {
    fn from(kind: ControlModeKind) -> Self {
        Self::default().with_kind(kind)
    }
}

/// Control mode of an axis. Spec: `CONTROL_MODE`.
#[open_enum(u8, prefix = "MODE_")]
pub enum ControlModeKind {
    /// Not controlled by the host. Send zeros for speed and angle.
    ///
    /// On all axes, it ends serial control and undoes the changes made by `CMD_CONTROL_CONFIG`. On a single axis, it
    /// returns that axis to RC control (firmware 2.68b9+); earlier firmware leaves the axis unchanged.
    NoControl = 0,
    /// Rotates at the speed, in Euler coordinates, until the next command. The angle is ignored.
    Speed = 1,
    /// Moves to the Euler angle at the speed, and decelerates near the target.
    Angle = 2,
    /// Rotates at the speed, while an outer loop corrects the remaining error to the angle.
    ///
    /// The most precise mode, but it requires a high command rate or low-pass filters.
    SpeedAngle = 3,
    /// Follows an RC signal given as the angle, -500 to 500 or -10000 for no signal, instead of any other source.
    ///
    /// The speed is ignored before firmware 2.61.
    Rc = 4,
    /// Moves to an Euler angle of up to ±360 degrees, counted from the neutral point relative to the frame.
    ///
    /// This is not a motor angle.
    AngleRelFrame = 5,
    /// Follows a high-resolution RC signal given as the angle, -16384 to 16384 or -32768 for no signal.
    #[wire(since = "2.66b2")]
    RcHighRes = 6,
    /// Leaves the axis unchanged: send zeros for speed and angle.
    #[wire(since = "2.70b4")]
    Ignore = 7,
    /// Moves to the Euler angle by the shortest way, unless a software limit blocks it.
    #[wire(since = "2.70b7")]
    AngleShortest = 8,
}
