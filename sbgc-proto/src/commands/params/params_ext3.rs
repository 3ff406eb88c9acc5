//! Block 4 of a profile's parameters: external IMU and, in newer firmware, various other settings.

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

/// Requests block 4 of a profile's parameters: external IMU and, in newer firmware, various other settings.
#[message(CMD_READ_PARAMS_EXT3, outgoing, size = 1, since = "2.66", answer = ParamsExt3, echo = profile(profile_id))]
pub struct ReadParamsExt3 {
    /// Profile to read; any number above 4 selects the active one.
    pub profile_id: ProfileId,
}

/// Writes block 4 of a profile's parameters and saves it to EEPROM.
///
/// Read the block first with [`ReadParamsExt3`], change the required fields and send the others unchanged. To write
/// several blocks, bracket them with [`WriteParamsSet`](super::WriteParamsSet), so that the board restarts only once.
///
/// The specification does not define an answer; the vendor's library waits for a confirmation.
#[message(CMD_WRITE_PARAMS_EXT3, outgoing, size = 221, since = "2.66", answer = Confirm)]
pub struct WriteParamsExt3(pub ParamsExt3);

/// Block 4 of a profile's parameters: external IMU and, in newer firmware, various other settings.
///
/// It always has 221 bytes. Firmware 2.66 uses the fields up to `GLOCK_MID_MOT_POS_CORR_RATE`, except for the three
/// fields of the external IMU that follow `EXT_IMU_FLAGS`. All other fields were added by newer firmware, up to 2.73,
/// and were reserved before; the version that introduced each field is not published.
#[message(CMD_READ_PARAMS_EXT3, incoming, size = 221, since = "2.66")]
pub struct ParamsExt3 {
    /// Profile these parameters belong to.
    pub profile_id: ProfileId,
    pub reserved: Reserved<21>,
    /// Model of the external IMU.
    pub ext_imu_type: ExtImuType,
    /// Port of the external IMU.
    pub ext_imu_port: DevicePort,
    /// Mounting position of the external IMU.
    pub ext_imu_position: ExtImuPosition,
    /// Orientation of the external IMU: the axes that point up and right, each as an index into X, Y, Z, -X, -Y, -Z.
    ///
    /// The byte is raw because sources disagree on its layout: the specification has 4 bits for up followed by 3 for
    /// right, the vendor's library 3 and 3.
    pub ext_imu_orientation: u8,
    /// Options of the external IMU.
    pub ext_imu_flags: ExtImuFlags,
    /// Correction of the mounting of the external IMU. Newer firmware.
    pub ext_imu_align_correction: PerAxis<i16>,
    /// Start-up time of the external IMU. Newer firmware.
    pub ext_imu_startup_delay: u8,
    /// Rate at which the external IMU corrects the gyroscope. Newer firmware.
    pub ext_imu_gyro_corr_rate: u8,
    pub ext_imu_reserved: Reserved<4>,
    /// Width of the soft limits of each axis. The limits are set by `FRAME_CAM_ANGLE_MIN` and `FRAME_CAM_ANGLE_MAX` in
    /// [`ParamsExt2`](super::ParamsExt2).
    #[wire(range = 1..=255)]
    pub soft_limit_width: PerAxis<LimitWidth>,
    /// Signals that replace analog inputs 1 to 3.
    pub adc_replace_src: [RcSource; 3],
    /// Correction rate of the middle motor position near gimbal lock.
    pub glock_mid_mot_pos_corr_rate: u8,
    /// Extra buttons 1 to 5.
    pub extra_btn_cfg: [ExtraButton; 5],
    /// Current at which the power control turns off.
    pub power_ctrl_overcurrent_protection: TripCurrent,
    /// Delay before the power control turns on.
    pub power_ctrl_power_on_delay: Delay,
    /// Delay before the power control turns off.
    pub power_ctrl_power_off_delay: Delay,
    /// Current limit while the power control turns on.
    pub power_ctrl_power_on_limiter: u8,
    pub power_ctrl_reserved: Reserved<4>,
    /// Inverse quality of the low-pass filter of each axis.
    pub lpf_q_inv: PerAxis<InverseQuality>,
    /// External sensor connected to the CAN IMU.
    pub can_imu_ext_sens_type: CanImuSensor,
    /// Settings of this profile.
    pub profile_flags2: ProfileFlags2,
    pub reserved3: Reserved<3>,
    /// Settings shared by all profiles.
    pub general_flags3: GeneralFlags3,
    /// Offset of the neutral point of follow mode.
    #[wire(range = -16384..=16384, since = "2.70")]
    pub follow_offset_ext: PerAxis<Angle>,
    /// Start-up delay of the motors.
    #[wire(unit = "ms")]
    pub motor_startup_delay: u16,
    /// Model of the main IMU.
    pub imu_model_main: u8,
    /// Model of the frame IMU.
    pub imu_model_frame: u8,
    /// Stabilization threshold of each axis. The unit is not published.
    #[wire(range = 15..=80)]
    pub stab_threshold_angle: PerAxis<u8>,
    /// Pin of an external buzzer.
    pub ext_buzzer_pin: u8,
    /// Speed at which each axis returns from beyond its limits.
    pub enc_limit_return_speed: PerAxis<u8>,
    /// Motion threshold below which tripod mode turns on automatically.
    pub tripod_mode_auto_threshold: u8,
    /// Dead band of RC control for PITCH, if `RC_EXPO_DEADBAND_SPLIT` is set.
    pub rc_deadband_pitch: u8,
    /// Dead band of RC control for YAW, if `RC_EXPO_DEADBAND_SPLIT` is set.
    pub rc_deadband_yaw: u8,
    /// Exponential curve of RC control for PITCH, if `RC_EXPO_DEADBAND_SPLIT` is set.
    pub rc_expo_rate_pitch: u8,
    /// Exponential curve of RC control for YAW, if `RC_EXPO_DEADBAND_SPLIT` is set.
    pub rc_expo_rate_yaw: u8,
    /// Settings of this profile.
    pub profile_flags3: ProfileFlags3,
    /// Profile that is activated at start-up.
    #[wire(range = 0..=4)]
    pub default_profile: ProfileId,
    /// Angle of each motor in the retracted position. The unit is not published.
    pub retracted_angle: PerAxis<i16>,
    /// Amplitude of the shake generator on ROLL, TILT and PAN, on a logarithmic scale.
    pub shake_amplitude: [u8; 3],
    /// Base frequency of the shake generator.
    pub shake_base_freq: ShakeFrequency,
    /// Frequency range of the shake generator.
    #[wire(range = 0..=100)]
    pub shake_freq_range: ShakeRange,
    /// Pause period of the shake generator.
    pub shake_pause_period: ShakePause,
    /// Balance between shaking and pauses.
    #[wire(range = 0..=100)]
    pub shake_pause_balance: u8,
    /// Remaining amplitude of the shake generator during pauses.
    #[wire(range = 0..=100)]
    pub shake_pause_attenuation: u8,
    /// Randomness of the shake generator's pauses.
    #[wire(range = 0..=100)]
    pub shake_pause_randomness: u8,
    /// Variation of the phase of the shake generator's pauses.
    #[wire(range = 0..=100)]
    pub shake_pause_phase_var: u8,
    /// Resonance gain of the shake generator on ROLL, TILT and PAN.
    pub shake_resonance_gain: [ResonanceGain; 3],
    /// Resonance frequency of the shake generator.
    pub shake_resonance_freq: ShakeResonance,
    /// Frequency shift of the shake generator on ROLL, TILT and PAN, on a logarithmic scale from 1/3 to 3.
    #[wire(range = -127..=127)]
    pub shake_freq_shift: [i8; 3],
    pub shake_reserved: Reserved<5>,
    /// CAN ids of the drivers of auxiliary motors 1 to 7.
    pub ext_motor_drv_ids: [u8; 7],
    /// Further encoder options of each axis.
    pub encoder_cfg_ext: PerAxis<EncoderConfigExt>,
    /// Parameters of the sensor selected by `CAN_IMU_EXT_SENS_TYPE`, in a layout that depends on the sensor.
    pub ext_sens_params: Bytes<16>,
    /// Correction of the IMU angle for ROLL.
    pub imu_angle_corr_r: CorrectionAngle,
    /// Correction of the IMU angle for PITCH.
    pub imu_angle_corr_p: CorrectionAngle,
    /// Virtual channels routed to the two servo outputs of the CAN IMU, counted from 1; 0 for none.
    #[wire(range = 0..=32)]
    pub can_imu_servo_out: [u8; 2],
    /// Repetition rate of the servo outputs of the CAN IMU.
    #[wire(range = 5..=40)]
    pub can_imu_servo_rate: ServoRate,
    /// Factor of the proportional term of the outer loop in servo mode.
    pub servo_outer_p_mult: ServoFactor,
    /// Integral term of the outer loop in servo mode.
    pub servo_outer_i: ServoTerm,
    /// Shunt resistance of an external power switch.
    pub ext_pwr_sw_shunt_r: ShuntResistance,
    /// Settings shared by all profiles.
    pub general_flags4: GeneralFlags4,
    /// Timeout of automated motion. The unit is not published.
    pub auto_motion_timeout: u8,
    pub reserved4: Reserved<48>,
}
