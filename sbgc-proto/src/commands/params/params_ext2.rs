//! The third block of a profile's parameters: MavLink, limits, automated motion, signals.

use sbgc_proto_macros::{message, record};

use super::{
    AutoPidFlags, DevicePort, ForcePosition, GeneralFlags2, InterruptConfig, MavConfig, MavControlMode,
    ParkingPosition, SerialSpeed, StabilizedAxis, StartupAction, StepSignalConfig,
};
use crate::commands::{Confirm, ProfileId, RcSource, TriggerPinId};
use crate::units::{
    AccelerationLimit, CorrectionAngle, CurrentLimit, Delay, Ellipticity, MagneticLink, PhaseResistance,
    PidGain, SignalThreshold, TimeShare,
};
use crate::wire::{PerAxis, PerXyz, Reserved};

/// Requests the third block of a profile's parameters: MavLink, limits, automated motion, signals.
#[message(CMD_READ_PARAMS_EXT2, outgoing, size = 1, answer = ParamsExt2, echo = profile(profile_id))]
pub struct ReadParamsExt2 {
    /// Profile; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// Writes the third block of a profile's parameters and saves it to EEPROM.
///
/// Read the block first with [`ReadParamsExt2`], change what is to be changed and send all the rest as it came. Several
/// blocks are best written between the two [`WriteParamsSet`](super::WriteParamsSet), so that the board restarts once.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation.
#[message(CMD_WRITE_PARAMS_EXT2, outgoing, size = 151, answer = Confirm)]
pub struct WriteParamsExt2(pub ParamsExt2);

/// The third block of a profile's parameters: MavLink, limits, automated motion, signals.
///
/// It has 151 bytes in all firmware, but older firmware uses fewer of them: 2.62 none from
/// [`outer_mot_tilt_angle`](Self::outer_mot_tilt_angle) on.
#[message(CMD_READ_PARAMS_EXT2, incoming, size = 151)]
pub struct ParamsExt2 {
    /// Profile these parameters belong to.
    pub profile_id: ProfileId,
    /// The two channels that speak MavLink.
    #[wire(group)]
    pub mav_channels: [MavChannel; 2],
    /// Strength of the link between the motor's rotor and stator.
    #[wire(range = 0..=65000)]
    pub motor_mag_link_fine: PerAxis<MagneticLink>,
    /// Limit of acceleration, 0 for none.
    #[wire(range = 0..=200)]
    pub acc_limiter: PerAxis<AccelerationLimit>,
    /// Gain that multiplies all terms of the controller.
    pub pid_gain: PerAxis<PidGain>,
    /// Cut-off frequency of the low-pass filter of the frame IMU.
    #[wire(unit = "Hz", range = 0..=200)]
    pub frame_imu_lpf_freq: u8,
    /// Options of automatic PID tuning: the flags of `CMD_AUTO_PID`.
    pub auto_pid_cfg: AutoPidFlags,
    /// Goal of automatic tuning, from stability (0) to precision (255): `GAIN_VS_STABILITY` of `CMD_AUTO_PID`.
    pub auto_pid_gain: u8,
    /// Lower soft limit of each motor's angle.
    #[wire(unit = "deg", since = "2.61")]
    pub frame_cam_angle_min: PerAxis<i16>,
    /// Upper soft limit of each motor's angle.
    #[wire(unit = "deg", since = "2.61")]
    pub frame_cam_angle_max: PerAxis<i16>,
    /// Settings that all profiles share.
    #[wire(since = "2.61")]
    pub general_flags2: GeneralFlags2,
    /// Speed of automated motion, on the scale of `RC_SPEED`.
    #[wire(range = 1..=255, since = "2.61")]
    pub auto_speed: u8,
    /// Limit of acceleration of automated motion.
    #[wire(range = 1..=255, since = "2.61")]
    pub auto_acc_limiter: AccelerationLimit,
    /// Correction of how the main IMU is mounted, about its own axes.
    #[wire(since = "2.61")]
    pub imu_orientation_corr: PerXyz<CorrectionAngle>,
    /// Duration of a time-lapse motion.
    #[wire(unit = "s", since = "2.60")]
    pub timelapse_time: u16,
    /// Delay before the motors restart after an emergency stop.
    #[wire(unit = "ms")]
    pub emergency_stop_restart_delay: u16,
    /// The part of a time lapse in which it speeds up and slows down.
    #[wire(range = 0..=250)]
    pub timelapse_acc_part: TimeShare,
    /// Moment of inertia of each axis.
    #[wire(since = "2.62b7")]
    pub momentum: PerAxis<u16>,
    /// Motor power of the calibration of each axis.
    #[wire(range = 1..=255, since = "2.62b7")]
    pub momentum_calib_stimulus: PerAxis<u8>,
    /// Dependence on the angles of the other axes. The specification spells it `MOMENTUM_ELITPICITY`.
    #[wire(range = 1..=255, since = "2.62b7")]
    pub momentum_ellipticity: PerAxis<Ellipticity>,
    /// Over which range of angles follow mode grows to its full speed.
    #[wire(unit = "deg", range = 1..=180, since = "2.62b7")]
    pub follow_range: PerAxis<u8>,
    /// Euler axis stabilized by each motor.
    #[wire(since = "2.62b7")]
    pub stab_axis: PerAxis<StabilizedAxis>,
    /// Tilt of the outer motor's axis.
    #[wire(unit = "deg", range = -90..=90)]
    pub outer_mot_tilt_angle: i8,
    /// Actions that are done at start.
    #[wire(since = "2.66")]
    pub startup_action: [StartupAction; 4],
    /// The signals that start them: two sources for each action, first the first source of all four.
    ///
    /// The specification does not define which index is the action; only this reading fits four actions.
    #[wire(since = "2.66")]
    pub startup_action_src: [[RcSource; 4]; 2],
    /// The levels that those signals must reach, in the same order.
    #[wire(since = "2.66")]
    pub startup_action_threshold: [[SignalThreshold; 4]; 2],
    /// Fixed positions of each axis.
    #[wire(since = "2.66")]
    pub force_position_cfg: PerAxis<ForcePosition>,
    /// The six step signals.
    #[wire(group)]
    pub step_signals: [StepSignal; 6],
    /// Calibrations of five signals.
    #[wire(group)]
    pub rc_calibs: [RcCalibration; 5],
    /// Parking position.
    #[wire(since = "2.66")]
    pub parking_pos_cfg: ParkingPosition,
    /// The pin that shows what the LED on the board does; 0 for none.
    #[wire(since = "2.66")]
    pub ext_led_pin_id: TriggerPinId,
    /// The pin that signals interrupts, and when.
    #[wire(since = "2.66")]
    pub interrupt_cfg: InterruptConfig,
    /// Maximum time of motor overload.
    #[wire(since = "2.66")]
    pub overload_time: Delay,
    /// Weight of the camera for automatic tuning: `MOMENTUM` of `CMD_AUTO_PID`.
    #[wire(since = "2.66")]
    pub auto_pid_momentum: u8,
    /// The time in which acceleration builds up.
    #[wire(unit = "ms", since = "2.66")]
    pub jerk_slope: PerAxis<u8>,
    /// Axes controlled by a MavLink device.
    #[wire(range = 0..=2, since = "2.66")]
    pub mav_ctrl_mode: MavControlMode,
    /// Speed of the port of the serial receiver.
    #[wire(since = "2.66")]
    pub rc_serial_speed: SerialSpeed,
    /// Speed of UART2.
    #[wire(since = "2.66")]
    pub uart2_speed: SerialSpeed,
    /// Resistance of one phase of each motor.
    #[wire(since = "2.66")]
    pub motor_res: PerAxis<PhaseResistance>,
    /// Limit of the motors' current.
    #[wire(since = "2.66")]
    pub current_limit: CurrentLimit,
    /// Tilt of the middle motor's axis.
    #[wire(unit = "deg", range = -90..=90, since = "2.67")]
    pub middle_mot_tilt_angle: i8,
}

/// A channel that speaks MavLink.
#[record(size = 8)]
#[derive(Copy)]
pub struct MavChannel {
    /// The port.
    pub mav_src: DevicePort,
    /// The number of the system.
    pub mav_sys_id: u8,
    /// The number of the component.
    pub mav_comp_id: u8,
    /// Options of the port and channel.
    pub mav_cfg_flags: MavConfig,
    pub mav_reserved: Reserved<4>,
}

/// A signal of several steps, made of presses of a button. It can be a source of control signals.
#[record(size = 2)]
#[derive(Copy)]
pub struct StepSignal {
    /// The button.
    #[wire(since = "2.66")]
    pub step_signal_src: RcSource,
    /// Conversion of button presses to steps.
    #[wire(since = "2.66")]
    pub step_signal_cfg: StepSignalConfig,
}

/// Calibration of a control signal. The offset is added first, then the scale of the sign that results multiplies.
#[record(size = 4)]
#[derive(Copy)]
pub struct RcCalibration {
    /// Signal source.
    #[wire(since = "2.66")]
    pub rc_calib_src: RcSource,
    /// Offset in 1/128 of half the signal's range.
    ///
    /// Signed, although the specification's type column differs.
    #[wire(since = "2.66")]
    pub rc_calib_offset: i8,
    /// Scale of negative signals: they are multiplied by (80 + this) / 100.
    #[wire(since = "2.66")]
    pub rc_calib_neg_scale: u8,
    /// Scale of positive signals: they are multiplied by (80 + this) / 100.
    #[wire(since = "2.66")]
    pub rc_calib_pos_scale: u8,
}
