//! Block 3 of a profile's parameters: MAVLink, limits, automated motion and signals.

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

/// Requests block 3 of a profile's parameters: MAVLink, limits, automated motion and signals.
#[message(CMD_READ_PARAMS_EXT2, outgoing, size = 1, answer = ParamsExt2, echo = profile(profile_id))]
pub struct ReadParamsExt2 {
    /// Profile to read; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// Writes block 3 of a profile's parameters and saves it to EEPROM.
///
/// Read the block first with [`ReadParamsExt2`], change the required fields and send the others unchanged. To write
/// several blocks, bracket them with [`WriteParamsSet`](super::WriteParamsSet), so that the board restarts only once.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation.
#[message(CMD_WRITE_PARAMS_EXT2, outgoing, size = 151, answer = Confirm)]
pub struct WriteParamsExt2(pub ParamsExt2);

/// Block 3 of a profile's parameters: MAVLink, limits, automated motion and signals.
///
/// It always has 151 bytes, but older firmware does not use all of them: 2.62 ends before
/// [`outer_mot_tilt_angle`](Self::outer_mot_tilt_angle).
#[message(CMD_READ_PARAMS_EXT2, incoming, size = 151)]
pub struct ParamsExt2 {
    /// Profile these parameters belong to.
    pub profile_id: ProfileId,
    /// MAVLink channels 1 and 2.
    #[wire(group)]
    pub mav_channels: [MavChannel; 2],
    /// Strength of the magnetic link between rotor and stator of the motor.
    #[wire(range = 0..=65000)]
    pub motor_mag_link_fine: PerAxis<MagneticLink>,
    /// Acceleration limit; 0 disables it.
    #[wire(range = 0..=200)]
    pub acc_limiter: PerAxis<AccelerationLimit>,
    /// Gain that multiplies all terms of the controller.
    pub pid_gain: PerAxis<PidGain>,
    /// Cut-off frequency of the low-pass filter of the frame IMU.
    #[wire(unit = "Hz", range = 0..=200)]
    pub frame_imu_lpf_freq: u8,
    /// Options of automatic PID tuning: the flags of `CMD_AUTO_PID`.
    pub auto_pid_cfg: AutoPidFlags,
    /// Goal of automatic PID tuning, from stability (0) to precision (255): `GAIN_VS_STABILITY` of `CMD_AUTO_PID`.
    pub auto_pid_gain: u8,
    /// Lower soft limit of each motor angle.
    #[wire(unit = "deg", since = "2.61")]
    pub frame_cam_angle_min: PerAxis<i16>,
    /// Upper soft limit of each motor angle.
    #[wire(unit = "deg", since = "2.61")]
    pub frame_cam_angle_max: PerAxis<i16>,
    /// Settings shared by all profiles.
    #[wire(since = "2.61")]
    pub general_flags2: GeneralFlags2,
    /// Speed of automated motion, on the scale of `RC_SPEED`.
    #[wire(range = 1..=255, since = "2.61")]
    pub auto_speed: u8,
    /// Acceleration limit of automated motion.
    #[wire(range = 1..=255, since = "2.61")]
    pub auto_acc_limiter: AccelerationLimit,
    /// Correction of the mounting of the main IMU, about its own axes.
    #[wire(since = "2.61")]
    pub imu_orientation_corr: PerXyz<CorrectionAngle>,
    /// Duration of a time-lapse motion.
    #[wire(unit = "s", since = "2.60")]
    pub timelapse_time: u16,
    /// Delay before the motors restart after an emergency stop.
    #[wire(unit = "ms")]
    pub emergency_stop_restart_delay: u16,
    /// Part of a time-lapse motion that is spent on acceleration and deceleration.
    #[wire(range = 0..=250)]
    pub timelapse_acc_part: TimeShare,
    /// Moment of inertia of each axis.
    #[wire(since = "2.62b7")]
    pub momentum: PerAxis<u16>,
    /// Motor power for calibrating the moment of inertia of each axis.
    #[wire(range = 1..=255, since = "2.62b7")]
    pub momentum_calib_stimulus: PerAxis<u8>,
    /// Dependence of the moment of inertia on the angles of the other axes. The specification spells it
    /// `MOMENTUM_ELITPICITY`.
    #[wire(range = 1..=255, since = "2.62b7")]
    pub momentum_ellipticity: PerAxis<Ellipticity>,
    /// Range of angles over which follow mode reaches its full speed.
    #[wire(unit = "deg", range = 1..=180, since = "2.62b7")]
    pub follow_range: PerAxis<u8>,
    /// Euler axis stabilized by each motor.
    #[wire(since = "2.62b7")]
    pub stab_axis: PerAxis<StabilizedAxis>,
    /// Tilt of the axis of the outer motor.
    #[wire(unit = "deg", range = -90..=90)]
    pub outer_mot_tilt_angle: i8,
    /// Actions to perform at start-up.
    #[wire(since = "2.66")]
    pub startup_action: [StartupAction; 4],
    /// Signals that trigger the start-up actions: two sources for each action, with the first sources of all four
    /// actions first.
    ///
    /// The specification does not define which index is the action; only this interpretation fits four actions.
    #[wire(since = "2.66")]
    pub startup_action_src: [[RcSource; 4]; 2],
    /// Levels that the trigger signals must reach, in the same order.
    #[wire(since = "2.66")]
    pub startup_action_threshold: [[SignalThreshold; 4]; 2],
    /// Fixed positions of each axis.
    #[wire(since = "2.66")]
    pub force_position_cfg: PerAxis<ForcePosition>,
    /// Step signals 1 to 6.
    #[wire(group)]
    pub step_signals: [StepSignal; 6],
    /// Calibrations of up to five control signals.
    #[wire(group)]
    pub rc_calibs: [RcCalibration; 5],
    /// Parking position.
    #[wire(since = "2.66")]
    pub parking_pos_cfg: ParkingPosition,
    /// Pin that mirrors the LED of the board; 0 for none.
    #[wire(since = "2.66")]
    pub ext_led_pin_id: TriggerPinId,
    /// Pin that signals interrupts, and the conditions.
    #[wire(since = "2.66")]
    pub interrupt_cfg: InterruptConfig,
    /// Maximum duration of motor overload.
    #[wire(since = "2.66")]
    pub overload_time: Delay,
    /// Weight of the camera for automatic PID tuning: `MOMENTUM` of `CMD_AUTO_PID`.
    #[wire(since = "2.66")]
    pub auto_pid_momentum: u8,
    /// Time in which the acceleration builds up.
    #[wire(unit = "ms", since = "2.66")]
    pub jerk_slope: PerAxis<u8>,
    /// Axes controlled by a MAVLink device.
    #[wire(range = 0..=2, since = "2.66")]
    pub mav_ctrl_mode: MavControlMode,
    /// Baud rate of the serial receiver port.
    #[wire(since = "2.66")]
    pub rc_serial_speed: SerialSpeed,
    /// Baud rate of UART2.
    #[wire(since = "2.66")]
    pub uart2_speed: SerialSpeed,
    /// Phase resistance of each motor.
    #[wire(since = "2.66")]
    pub motor_res: PerAxis<PhaseResistance>,
    /// Motor current limit.
    #[wire(since = "2.66")]
    pub current_limit: CurrentLimit,
    /// Tilt of the axis of the middle motor.
    #[wire(unit = "deg", range = -90..=90, since = "2.67")]
    pub middle_mot_tilt_angle: i8,
}

/// Settings of a MAVLink channel.
#[record(size = 8)]
#[derive(Copy)]
pub struct MavChannel {
    /// Port of the channel.
    pub mav_src: DevicePort,
    /// MAVLink system id.
    pub mav_sys_id: u8,
    /// MAVLink component id.
    pub mav_comp_id: u8,
    /// Options of the port and channel.
    pub mav_cfg_flags: MavConfig,
    pub mav_reserved: Reserved<4>,
}

/// Signal with several steps, generated from button presses. It can serve as a source of control signals.
#[record(size = 2)]
#[derive(Copy)]
pub struct StepSignal {
    /// Source of the button presses.
    #[wire(since = "2.66")]
    pub step_signal_src: RcSource,
    /// Conversion of button presses to steps.
    #[wire(since = "2.66")]
    pub step_signal_cfg: StepSignalConfig,
}

/// Calibration of a control signal: the offset is added first, then the scale for the resulting sign is applied.
#[record(size = 4)]
#[derive(Copy)]
pub struct RcCalibration {
    /// Signal source.
    #[wire(since = "2.66")]
    pub rc_calib_src: RcSource,
    /// Offset in 1/128 of half the signal range.
    ///
    /// Signed, although the type column of the specification differs.
    #[wire(since = "2.66")]
    pub rc_calib_offset: i8,
    /// Scale of negative signals: the factor is (80 + this value) / 100.
    #[wire(since = "2.66")]
    pub rc_calib_neg_scale: u8,
    /// Scale of positive signals: the factor is (80 + this value) / 100.
    #[wire(since = "2.66")]
    pub rc_calib_pos_scale: u8,
}
