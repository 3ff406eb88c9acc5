//! The fourth block of a profile's parameters: external IMU and, in newer firmware, much else.

use sbgc_proto_macros::message;

use super::{
    CanImuSensor, DevicePort, EncoderConfigExt, ExtImuFlags, ExtImuPosition, ExtImuType, ExtraButton,
    GeneralFlags3, GeneralFlags4, ProfileFlags2, ProfileFlags3,
};
use crate::commands::{Confirm, ProfileId, RcSource};
use crate::units::{
    Angle, CorrectionAngle, Delay, InverseQuality, LimitWidth, ResonanceGain, ServoFactor, ServoRate,
    ServoTerm, ShakeFrequency, ShakePause, ShakeRange, ShakeResonance, ShuntResistance, TripCurrent,
};
use crate::wire::{Bytes, PerAxis, Reserved};

/// Requests the fourth block of a profile's parameters: external IMU and, in newer firmware, much else.
#[message(CMD_READ_PARAMS_EXT3, outgoing, size = 1, since = "2.66", answer = ParamsExt3, echo = profile(profile_id))]
pub struct ReadParamsExt3 {
    /// Profile; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// Writes the fourth block of a profile's parameters and saves it to EEPROM.
///
/// Read the block first with [`ReadParamsExt3`], change what is to be changed and send all the rest as it came. Several
/// blocks are best written between the two [`WriteParamsSet`](super::WriteParamsSet), so that the board restarts once.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation.
#[message(CMD_WRITE_PARAMS_EXT3, outgoing, size = 221, since = "2.66", answer = Confirm)]
pub struct WriteParamsExt3(pub ParamsExt3);

/// The fourth block of a profile's parameters: external IMU and, in newer firmware, much else.
///
/// It always has 221 bytes. Firmware 2.66 uses those up to `GLOCK_MID_MOT_POS_CORR_RATE`, without the three fields of
/// the external IMU behind `EXT_IMU_FLAGS`; all else is of newer firmware, up to 2.73, and was reserved before. Which
/// firmware began with which field is not published.
#[message(CMD_READ_PARAMS_EXT3, incoming, size = 221, since = "2.66")]
pub struct ParamsExt3 {
    /// Profile these parameters belong to.
    pub profile_id: ProfileId,
    pub reserved: Reserved<21>,
    /// Model of the external IMU.
    pub ext_imu_type: ExtImuType,
    /// The port of the external IMU.
    pub ext_imu_port: DevicePort,
    /// Mounting position of the external IMU.
    pub ext_imu_position: ExtImuPosition,
    /// Orientation of the external IMU: the axes that point up and right, each as an index into X,
    /// Y, Z, -X, -Y, -Z.
    ///
    /// The byte is raw here, for its division is unknown: the specification has 4 bits for up and then 3 for right,
    /// the vendor's library 3 and 3.
    pub ext_imu_orientation: u8,
    /// Options of the external IMU.
    pub ext_imu_flags: ExtImuFlags,
    /// Correction of how the external IMU is mounted. Newer firmware.
    pub ext_imu_align_correction: PerAxis<i16>,
    /// Start-up time of the external IMU. Newer firmware.
    pub ext_imu_startup_delay: u8,
    /// Rate at which the external IMU corrects the gyroscope. Newer firmware.
    pub ext_imu_gyro_corr_rate: u8,
    pub ext_imu_reserved: Reserved<4>,
    /// Width of each axis' soft limits, which `FRAME_CAM_ANGLE_MIN` and `_MAX` in [`ParamsExt2`](super::ParamsExt2)
    /// set.
    #[wire(range = 1..=255)]
    pub soft_limit_width: PerAxis<LimitWidth>,
    /// Signals that take the place of the three analog inputs.
    pub adc_replace_src: [RcSource; 3],
    /// Correction rate of the middle motor's position near gimbal lock.
    pub glock_mid_mot_pos_corr_rate: u8,
    /// Five extra buttons.
    pub extra_btn_cfg: [ExtraButton; 5],
    /// The current at which the power control switches off.
    pub power_ctrl_overcurrent_protection: TripCurrent,
    /// Delay of the power control before it switches on.
    pub power_ctrl_power_on_delay: Delay,
    /// Delay of the power control before it switches off.
    pub power_ctrl_power_off_delay: Delay,
    /// Current limit of the power control at switch-on.
    pub power_ctrl_power_on_limiter: u8,
    pub power_ctrl_reserved: Reserved<4>,
    /// Quality of each axis' low-pass filter.
    pub lpf_q_inv: PerAxis<InverseQuality>,
    /// The sensor that is connected to the IMU on the CAN bus.
    pub can_imu_ext_sens_type: CanImuSensor,
    /// Settings of this profile.
    pub profile_flags2: ProfileFlags2,
    pub reserved3: Reserved<3>,
    /// Settings that all profiles share.
    pub general_flags3: GeneralFlags3,
    /// Offset of the neutral point in follow mode.
    #[wire(range = -16384..=16384, since = "2.70")]
    pub follow_offset_ext: PerAxis<Angle>,
    /// Start-up delay of the motors.
    #[wire(unit = "ms")]
    pub motor_startup_delay: u16,
    /// Model of the main IMU.
    pub imu_model_main: u8,
    /// Model of the frame IMU.
    pub imu_model_frame: u8,
    /// Threshold of each axis' stabilization. The unit is not published.
    #[wire(range = 15..=80)]
    pub stab_threshold_angle: PerAxis<u8>,
    /// The pin of an external buzzer.
    pub ext_buzzer_pin: u8,
    /// Return speed of each axis from beyond its limits.
    pub enc_limit_return_speed: PerAxis<u8>,
    /// Below which motion tripod mode switches itself on.
    pub tripod_mode_auto_threshold: u8,
    /// Dead band of PITCH, where `RC_EXPO_DEADBAND_SPLIT` is set.
    pub rc_deadband_pitch: u8,
    /// Dead band of YAW, where `RC_EXPO_DEADBAND_SPLIT` is set.
    pub rc_deadband_yaw: u8,
    /// Exponential rate of PITCH, where `RC_EXPO_DEADBAND_SPLIT` is set.
    pub rc_expo_rate_pitch: u8,
    /// Exponential rate of YAW, where `RC_EXPO_DEADBAND_SPLIT` is set.
    pub rc_expo_rate_yaw: u8,
    /// Settings of this profile.
    pub profile_flags3: ProfileFlags3,
    /// The profile that is active at start.
    #[wire(range = 0..=4)]
    pub default_profile: ProfileId,
    /// Angle of each motor in the retracted position. The unit is not published.
    pub retracted_angle: PerAxis<i16>,
    /// Amplitude of the shake generator on ROLL, TILT and PAN, on a logarithmic scale.
    pub shake_amplitude: [u8; 3],
    /// Base frequency of the shake generator.
    pub shake_base_freq: ShakeFrequency,
    /// Range of frequencies of the shake generator.
    #[wire(range = 0..=100)]
    pub shake_freq_range: ShakeRange,
    /// Period of pauses of the shake generator.
    pub shake_pause_period: ShakePause,
    /// Balance between shake and pause.
    #[wire(range = 0..=100)]
    pub shake_pause_balance: u8,
    /// Remaining shake during a pause.
    #[wire(range = 0..=100)]
    pub shake_pause_attenuation: u8,
    /// Irregularity of pauses.
    #[wire(range = 0..=100)]
    pub shake_pause_randomness: u8,
    /// Variation of the phases of pauses.
    #[wire(range = 0..=100)]
    pub shake_pause_phase_var: u8,
    /// Gain of the shake generator's resonance on ROLL, TILT and PAN.
    pub shake_resonance_gain: [ResonanceGain; 3],
    /// Frequency of the shake generator's resonance.
    pub shake_resonance_freq: ShakeResonance,
    /// Shift of frequencies on ROLL, TILT and PAN, on a logarithmic scale from 1/3 to 3.
    #[wire(range = -127..=127)]
    pub shake_freq_shift: [i8; 3],
    pub shake_reserved: Reserved<5>,
    /// Ids on the CAN bus of the drivers of auxiliary motors 1 to 7.
    pub ext_motor_drv_ids: [u8; 7],
    /// More on how each axis' encoder is read.
    pub encoder_cfg_ext: PerAxis<EncoderConfigExt>,
    /// Parameters of the sensor that `CAN_IMU_EXT_SENS_TYPE` names; their layout is its own.
    pub ext_sens_params: Bytes<16>,
    /// Correction of the IMU's angle of ROLL.
    pub imu_angle_corr_r: CorrectionAngle,
    /// Correction of the IMU's angle of PITCH.
    pub imu_angle_corr_p: CorrectionAngle,
    /// Virtual channels that are put out on the two servo outputs of the IMU on the CAN bus, from 1 on; 0 for none.
    #[wire(range = 0..=32)]
    pub can_imu_servo_out: [u8; 2],
    /// Repetition rate of those outputs.
    #[wire(range = 5..=40)]
    pub can_imu_servo_rate: ServoRate,
    /// Factor of the outer loop's proportional term in servo mode.
    pub servo_outer_p_mult: ServoFactor,
    /// Integral term of the outer loop in servo mode.
    pub servo_outer_i: ServoTerm,
    /// Resistance of the shunt of an external power switch.
    pub ext_pwr_sw_shunt_r: ShuntResistance,
    /// Settings that all profiles share.
    pub general_flags4: GeneralFlags4,
    /// Timeout of automated motion; the unit is unpublished.
    pub auto_motion_timeout: u8,
    pub reserved4: Reserved<48>,
}
