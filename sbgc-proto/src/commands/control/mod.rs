//! Moving the gimbal: by axis, by quaternion, and how that is handled.

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

/// Moves the gimbal, all axes in the same mode.
///
/// The older form of [`Control`], for firmware before 2.55b5; later firmware takes it too.
#[message(CMD_CONTROL, outgoing, form = "legacy", size = 13, length = 13, answer = Confirm)]
pub struct ControlLegacy {
    /// Control mode of all axes.
    pub control_mode: ControlMode,
    /// Speed and angle of each axis.
    #[wire(group)]
    pub axes: PerAxis<ControlAxis>,
}

/// Moves the gimbal, each axis in a mode of its own.
///
/// It overrides radio control until [`Control::release`] is sent or the timeout of [`ControlConfig`] ends it. The best
/// rate is 50 to 125 Hz; at lower rates the low-pass filters of [`ControlConfig`] prevent steps. Automated tasks, such
/// as the menu command that levels the roll axis, come before it on their axis until they are done.
///
/// Each one is confirmed unless [`ControlConfigFlags::NO_CONFIRM`] is set. With
/// [`auto_task`](ControlMode::auto_task) a second confirmation, with data 1, follows when all target angles are reached
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
    /// Ends serial control: all axes go back to radio control, and all that [`ControlConfig`] has changed is undone.
    pub fn release() -> Self {
        Self::default()
    }

    /// All axes to Euler angles, at one speed; speed 0 is that of the radio control settings.
    pub fn angles(angles: PerAxis<Angle>, speed: ControlRate) -> Self {
        Self {
            control_mode: [ControlMode::ANGLE; 3].into(),
            axes: angles.map(|angle| ControlAxis { speed, angle }),
        }
    }

    /// Moves the axes that have an angle to it, at a speed; the others are left as they are, which firmware before
    /// 2.70b4 does not know.
    pub fn some_angles(target: PerAxis<Option<Angle>>, speed: ControlRate) -> Self {
        Self {
            control_mode: target
                .map(|angle| if angle.is_some() { ControlMode::ANGLE } else { ControlMode::IGNORE }),
            axes: target
                .map(|angle| angle.map_or(ControlAxis::default(), |angle| ControlAxis { speed, angle })),
        }
    }

    /// All axes to angles from the neutral point relative to the frame, at one speed; speed 0 is that of the radio
    /// control settings.
    pub fn angles_rel_frame(angles: PerAxis<Angle>, speed: ControlRate) -> Self {
        Self { control_mode: [ControlMode::ANGLE_REL_FRAME; 3].into(), ..Self::angles(angles, speed) }
    }

    /// All axes at speeds, kept until the next command.
    pub fn speeds(speeds: PerAxis<ControlRate>) -> Self {
        Self { control_mode: [ControlMode::SPEED; 3].into(), axes: speeds.map(ControlAxis::speed) }
    }

    /// All axes at slow speeds in fine steps, kept until the next command.
    pub fn fine_speeds(speeds: PerAxis<FineControlRate>) -> Self {
        Self {
            control_mode: [ControlMode::SPEED.with_high_res_speed(true); 3].into(),
            axes: speeds.map(ControlAxis::fine_speed),
        }
    }

    /// All axes along a path: `axes` has the angle of this moment and the speed at which it changes.
    pub fn path(axes: PerAxis<ControlAxis>) -> Self {
        Self { control_mode: [ControlMode::SPEED_ANGLE; 3].into(), axes }
    }

    /// The same as an automated task: with the speed and acceleration of such, and confirmed once more when the angles
    /// are reached. Only axes that go to an angle are changed.
    #[must_use]
    pub fn with_auto_task(self) -> Self {
        let control_mode = self.control_mode.map(|mode| match mode.kind() {
            ControlModeKind::Angle | ControlModeKind::AngleRelFrame => mode.with_auto_task(true),
            _ => mode,
        });
        Self { control_mode, ..self }
    }
}

/// Set-point of one axis; the [`ControlMode`] of the axis defines which of the two numbers apply, and how.
#[record(size = 4)]
#[derive(Copy)]
pub struct ControlAxis {
    /// Speed of rotation, in place of that of the settings and adjustable variables.
    ///
    /// In the modes [`Angle`](ControlModeKind::Angle), [`AngleRelFrame`](ControlModeKind::AngleRelFrame),
    /// [`Rc`](ControlModeKind::Rc) and their kin 0 takes the speed of the radio control settings. An acceleration limit
    /// there still applies. With [`high_res_speed`](ControlMode::high_res_speed) it is in thousandths of a degree a
    /// second: see [`as_fine_speed`](Self::as_fine_speed) and [`speed_in`](Self::speed_in).
    pub speed: ControlRate,
    /// The target angle; in the radio control modes the signal instead.
    ///
    /// See [`as_rc_signal`](Self::as_rc_signal) and [`as_high_res_rc_signal`](Self::as_high_res_rc_signal).
    pub angle: Angle,
}

impl ControlAxis {
    /// To an angle, at the speed of the radio control settings.
    pub const fn angle(angle: Angle) -> Self {
        Self { speed: ControlRate(0), angle }
    }

    /// At a speed.
    pub const fn speed(speed: ControlRate) -> Self {
        Self { speed, angle: Angle(0) }
    }

    /// At a slow speed, for modes with [`high_res_speed`](ControlMode::high_res_speed).
    pub const fn fine_speed(speed: FineControlRate) -> Self {
        Self::speed(ControlRate(speed.0))
    }

    /// As a radio control signal, for [`ControlMode::RC`].
    pub const fn rc_signal(signal: CoarseRcSignal) -> Self {
        Self::angle(Angle(signal.0))
    }

    /// As a radio control signal in fine steps, for [`ControlMode::RC_HIGH_RES`].
    pub const fn high_res_rc_signal(signal: RcSignal) -> Self {
        Self::angle(Angle(signal.0))
    }

    /// The speed as interpreted with [`high_res_speed`](ControlMode::high_res_speed).
    pub const fn as_fine_speed(self) -> FineControlRate {
        FineControlRate(self.speed.0)
    }

    /// The signal as [`ControlMode::RC`] means it.
    pub const fn as_rc_signal(self) -> CoarseRcSignal {
        CoarseRcSignal(self.angle.0)
    }

    /// The signal as [`ControlMode::RC_HIGH_RES`] means it.
    pub const fn as_high_res_rc_signal(self) -> RcSignal {
        RcSignal(self.angle.0)
    }

    /// The speed in degrees per second as `mode` means it.
    pub fn speed_in(self, mode: ControlMode) -> f32 {
        if mode.high_res_speed() {
            self.as_fine_speed().degrees_per_second()
        } else {
            self.speed.degrees_per_second()
        }
    }
}

/// Control mode of an axis, with its flags.
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
    /// Mixes the command with the motion of follow mode, in the modes `Rc`, `Speed`, `Angle` and `AngleShortest`.
    #[wire(bits = 4, spec = "CONTROL_FLAG_MIX_FOLLOW", since = "2.70b5")]
    pub mix_follow: bool,
    /// Goes to the target more precisely, in the modes `Angle` and `AngleRelFrame`.
    #[wire(bits = 5, spec = "CONTROL_FLAG_TARGET_PRECISE", since = "2.70b1")]
    pub target_precise: bool,
    /// Moves as an automated task, in the modes `Angle` and `AngleRelFrame`.
    ///
    /// That is with the speed and acceleration of such, unless a speed is given, and confirmed once more, with
    /// data 1, when all angles are reached. The same bit is [`force_rc_speed`](Self::force_rc_speed) in the mode
    /// `Rc`.
    #[wire(bits = 6, spec = "CONTROL_FLAG_AUTO_TASK", since = "2.62b7")]
    pub auto_task: bool,
    /// Speeds are in thousandths of a degree per second, for very slow motion.
    #[wire(bits = 7, spec = "CONTROL_FLAG_HIGH_RES_SPEED", since = "2.60")]
    pub high_res_speed: bool,
}

impl ControlMode {
    /// Not controlled by the host.
    pub const NO_CONTROL: Self = Self(0);
    /// At a speed.
    pub const SPEED: Self = Self(1);
    /// To an angle.
    pub const ANGLE: Self = Self(2);
    /// At a speed, and corrected to an angle.
    pub const SPEED_ANGLE: Self = Self(3);
    /// Follows a radio control signal.
    pub const RC: Self = Self(4);
    /// To an angle relative to the frame.
    pub const ANGLE_REL_FRAME: Self = Self(5);
    /// Follows a radio control signal in fine steps.
    pub const RC_HIGH_RES: Self = Self(6);
    /// As it is.
    pub const IGNORE: Self = Self(7);
    /// To an angle by the shortest way.
    pub const ANGLE_SHORTEST: Self = Self(8);

    /// Takes the signal of the mode `Rc` as a speed, and leaves the dead band, trim and inversion of the settings out;
    /// filter, curve and acceleration limit still apply. For remote control whose direction must not depend on
    /// settings.
    ///
    /// The same bit is [`auto_task`](Self::auto_task) in the angle modes. Firmware 2.62b7+.
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
    /// Not the host: send zeros for speed and angle.
    ///
    /// For all axes it ends serial control and undoes what `CMD_CONTROL_CONFIG` has changed. For one axis it gives that
    /// one back to radio control with firmware 2.68b9+; before, it left that one as it was.
    NoControl = 0,
    /// Turns at the speed, in Euler coordinates, until the next command; the angle is ignored.
    Speed = 1,
    /// Goes to the Euler angle at the speed, more slowly near it.
    Angle = 2,
    /// Turns at the speed, and an outer loop corrects what is left to the angle.
    ///
    /// The most precise mode, but it needs a high rate of commands, or low-pass filters.
    SpeedAngle = 3,
    /// The angle is a radio control signal of -500 to 500, -10000 for none, in place of any other source.
    ///
    /// The speed is ignored before firmware 2.61.
    Rc = 4,
    /// Goes to an Euler angle, up to 360 degrees either way, counted from the neutral point relative to the frame.
    ///
    /// It is not the angle of a motor.
    AngleRelFrame = 5,
    /// The angle is a radio control signal of -16384 to 16384, -32768 for none.
    #[wire(since = "2.66b2")]
    RcHighRes = 6,
    /// Leaves the axis unchanged: send zeros for speed and angle.
    #[wire(since = "2.70b4")]
    Ignore = 7,
    /// As [`Angle`](Self::Angle), by the shortest way round unless a software limit blocks that.
    #[wire(since = "2.70b7")]
    AngleShortest = 8,
}
