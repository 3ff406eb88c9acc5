//! Real-time data with fields selected by the host.

use sbgc_proto_macros::message;

use super::{
    AhrsDebugInfo, CommErrors, LimitDistances, MainImuState, Motor4Control, SystemPowerState,
    SystemStateBlock,
};
use crate::DecodeError;
use crate::commands::selection::{decode_view, payload_len};
use crate::declare::flags;
use crate::frame::EncodeFrameError;
use crate::units::{
    Acceleration, Angle, EncoderAngle, FineAngle, LongAngle, PackedQuaternion, RcSignal, SensorRate,
};
use crate::wire::{Float, PerAxis, PerXyz, Reserved};

/// Requests selected real-time data once; [`DataStreamInterval`](crate::commands::DataStreamInterval) has them
/// sent periodically.
///
/// The board answers with [`RealtimeDataCustom`], which does not identify its fields: decode it with the requested
/// flags, as [`decode_answer`](crate::Request::decode_answer) does.
#[message(
    CMD_REALTIME_DATA_CUSTOM, outgoing, size = 10, since = "2.60", answer = RealtimeDataCustom, given = self.flags,
    answer_len = self.flags.payload_len(), echo = flags(flags)
)]
#[derive(Copy)]
pub struct RealtimeDataCustomRequest {
    /// Flags that select the fields of the answer, which must fit into a payload: see
    /// [`RealtimeDataCustomFlags::payload_len`].
    pub flags: RealtimeDataCustomFlags,
    pub reserved: Reserved<6>,
}

impl RealtimeDataCustomRequest {
    /// Creates a request for the fields that `flags` select.
    ///
    /// # Errors
    /// If the answer would exceed the maximum payload length. The behavior of a board in that case is unknown.
    pub fn new(flags: RealtimeDataCustomFlags) -> Result<Self, EncodeFrameError> {
        let length = flags.payload_len();
        if length > 255 {
            return Err(EncodeFrameError::PayloadTooLong { length });
        }
        Ok(Self { flags, ..Self::default() })
    }
}

flags! {
    /// Selection of custom real-time data. Spec: `REALTIME_DATA_CUSTOM_FLAGS`.
    pub struct RealtimeDataCustomFlags: u32 {
        /// Camera angles.
        const IMU_ANGLES = 1 << 0;
        /// Target angles.
        const TARGET_ANGLES = 1 << 1;
        /// Target speed.
        const TARGET_SPEED = 1 << 2;
        /// Joint (stator–rotor) angles.
        const STATOR_ROTOR_ANGLE = 1 << 3;
        /// Angular rates.
        const GYRO_DATA = 1 << 4;
        /// Control signals.
        const RC_DATA = 1 << 5;
        /// Attitude as two rows of a rotation matrix.
        const Z_VECTOR_H_VECTOR = 1 << 6;
        /// Channels of the serial receiver.
        const RC_CHANNELS = 1 << 7;
        /// Accelerations.
        const ACC_DATA = 1 << 8;
        /// Data for an external controller of a fourth axis. Firmware 2.68+.
        const MOTOR4_CONTROL = 1 << 9;
        /// State of the attitude and heading reference system. Firmware 2.66+.
        const AHRS_DEBUG_INFO = 1 << 10;
        /// Raw encoder angles. Firmware 2.68+.
        const ENCODER_RAW24 = 1 << 11;
        /// Camera angles in radians. Firmware 2.68b7+.
        const IMU_ANGLES_RAD = 1 << 12;
        /// Float variables of the running script. Firmware 2.68b7+.
        const SCRIPT_VARS_FLOAT = 1 << 13;
        /// Integer variables of the running script. Firmware 2.68b7+.
        const SCRIPT_VARS_INT16 = 1 << 14;
        /// Power and state of the motors. Firmware 2.70b6+.
        const SYSTEM_POWER_STATE = 1 << 15;
        /// Joint (stator–rotor) speed. Firmware 2.70b6+.
        const FRAME_CAM_RATE = 1 << 16;
        /// Camera angles at high resolution. Firmware 2.70b8+.
        const IMU_ANGLES_20 = 1 << 17;
        /// Target angles at high resolution. Firmware 2.70b8+.
        const TARGET_ANGLES_20 = 1 << 18;
        /// Communication errors. Firmware 2.72b0+.
        const COMM_ERRORS = 1 << 19;
        /// System state. Firmware 2.73+.
        const SYSTEM_STATE = 1 << 20;
        /// Camera attitude as a quaternion. Firmware 2.73+.
        const IMU_QUAT = 1 << 21;
        /// Target attitude as a quaternion. Firmware 2.73+.
        const TARGET_QUAT = 1 << 22;
        /// Rotation from IMU to frame as a quaternion. Firmware 2.73+.
        const IMU_TO_FRAME_QUAT = 1 << 23;
        /// Analog inputs. Firmware 2.73+.
        const ADC_CH_RAW = 1 << 24;
        /// Distance of the joints to their software limits. Firmware 2.73.8+.
        const SW_LIMITS_DIST = 1 << 25;
        /// Distance to the neutral point of follow mode. Firmware 2.73.8+.
        const FOLLOW_DIST = 1 << 26;
        /// Limits of the target angles. Firmware 2.73.8+.
        const EXT_TARGET_LIMIT = 1 << 27;
        /// Joint (stator–rotor) angles at high resolution. Published in the vendor's Python library only.
        const FRAME_CAM_ANGLE_20 = 1 << 28;
        /// State of the main IMU. Published in the vendor's Python library only.
        const MAIN_IMU_STATE = 1 << 29;
        /// Repeats these flags before the other fields. Published in the vendor's Python library only.
        const INCLUDE_FLAGS = 1 << 31;
    }
}

impl RealtimeDataCustomFlags {
    /// Number of payload bytes of a [`RealtimeDataCustom`] with these flags.
    ///
    /// ```
    /// use sbgc_proto::commands::RealtimeDataCustomFlags as Flags;
    ///
    /// assert_eq!((Flags::IMU_ANGLES | Flags::RC_DATA).payload_len(), 2 + 6 + 12);
    /// ```
    pub fn payload_len(self) -> usize {
        payload_len::<RealtimeDataCustom, _>(self)
    }
}

/// Custom real-time data: a time stamp, followed by the fields that the flags of the request or stream select.
///
/// Fields are in the order of the flag bits; contrary to the specification's table, `motor4_control` therefore precedes
/// `ahrs_debug_info`. Fields not selected are `None`.
///
/// ```
/// use sbgc_proto::commands::{RealtimeDataCustom, RealtimeDataCustomFlags as Flags};
/// use sbgc_proto::Message;
///
/// let payload = [0x10, 0x27, 0x00, 0x10, 0x00, 0x00, 0x00, 0xF8];
/// let (data, _) = RealtimeDataCustom::decode_with(&payload, Flags::IMU_ANGLES)?;
/// assert_eq!(data.timestamp_ms, 10_000);
/// assert_eq!(data.imu_angles.map(|angles| angles.roll.degrees()), Some(90.0));
/// # Ok::<(), sbgc_proto::DecodeError>(())
/// ```
#[message(
    CMD_REALTIME_DATA_CUSTOM, incoming, size = 2..=255, since = "2.60",
    context(selection: RealtimeDataCustomFlags)
)]
#[derive(Copy)]
pub struct RealtimeDataCustom {
    /// Time stamp of the board, wrapping after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// Selection flags, as in the request.
    #[wire(flag = INCLUDE_FLAGS)]
    pub flags: Option<RealtimeDataCustomFlags>,
    /// Camera angles.
    #[wire(flag = IMU_ANGLES)]
    pub imu_angles: Option<PerAxis<Angle>>,
    /// Target angles.
    #[wire(flag = TARGET_ANGLES)]
    pub target_angles: Option<PerAxis<Angle>>,
    /// Target speed, in half the unit that [`Angles`](super::Angles) uses.
    #[wire(flag = TARGET_SPEED)]
    pub target_speed: Option<PerAxis<SensorRate>>,
    /// Joint (stator–rotor) angles. Newer documents call them `FRAME_CAM_ANGLE`.
    #[wire(flag = STATOR_ROTOR_ANGLE)]
    pub stator_rotor_angle: Option<PerAxis<Angle>>,
    /// Calibrated angular rates.
    #[wire(flag = GYRO_DATA)]
    pub gyro_data: Option<PerXyz<SensorRate>>,
    /// Control signals: ROLL, PITCH, YAW, CMD, FC_ROLL, FC_PITCH.
    #[wire(flag = RC_DATA, range = -16384..=16384)]
    pub rc_data: Option<[RcSignal; 6]>,
    /// Gravity vector, a row of the rotation matrix. The third row is the cross product of this and `h_vector`.
    #[wire(flag = Z_VECTOR_H_VECTOR, range = -1..=1)]
    pub z_vector: Option<PerXyz<Float>>,
    /// Heading vector, a row of the rotation matrix.
    #[wire(flag = Z_VECTOR_H_VECTOR, range = -1..=1)]
    pub h_vector: Option<PerXyz<Float>>,
    /// Channels of the serial receiver (s-bus, Spektrum, Sum-PPM).
    #[wire(flag = RC_CHANNELS, range = -16384..=16384)]
    pub rc_channels: Option<[RcSignal; 18]>,
    /// Calibrated accelerations.
    #[wire(flag = ACC_DATA)]
    pub acc_data: Option<PerXyz<Acceleration>>,
    /// Data for an external controller of a fourth axis.
    #[wire(flag = MOTOR4_CONTROL, since = "2.68")]
    pub motor4_control: Option<Motor4Control>,
    /// State of the attitude and heading reference system.
    #[wire(flag = AHRS_DEBUG_INFO, since = "2.66")]
    pub ahrs_debug_info: Option<AhrsDebugInfo>,
    /// Raw encoder angles.
    #[wire(flag = ENCODER_RAW24, since = "2.68")]
    pub encoder_raw24: Option<PerAxis<EncoderAngle>>,
    /// Camera angles, from −π to π.
    #[wire(flag = IMU_ANGLES_RAD, unit = "rad", since = "2.68b7")]
    pub imu_angles_rad: Option<PerAxis<Float>>,
    /// Float variables of the running script.
    #[wire(flag = SCRIPT_VARS_FLOAT, since = "2.68b7")]
    pub script_vars_float: Option<[Float; 10]>,
    /// Integer variables of the running script.
    #[wire(flag = SCRIPT_VARS_INT16, since = "2.68b7")]
    pub script_vars_int16: Option<[i16; 10]>,
    /// Power and state of the motors.
    #[wire(flag = SYSTEM_POWER_STATE, since = "2.70b6")]
    pub system_power_state: Option<SystemPowerState>,
    /// Joint (stator–rotor) speed.
    #[wire(flag = FRAME_CAM_RATE, since = "2.70b6")]
    pub frame_cam_rate: Option<PerAxis<SensorRate>>,
    /// Camera angles at high resolution.
    #[wire(flag = IMU_ANGLES_20, since = "2.70b8")]
    pub imu_angles_20: Option<PerAxis<FineAngle>>,
    /// Target angles at high resolution.
    #[wire(flag = TARGET_ANGLES_20, since = "2.70b8")]
    pub target_angles_20: Option<PerAxis<FineAngle>>,
    /// Communication errors.
    #[wire(flag = COMM_ERRORS, since = "2.72b0")]
    pub comm_errors: Option<CommErrors>,
    /// System state.
    #[wire(flag = SYSTEM_STATE, since = "2.73")]
    pub system_state: Option<SystemStateBlock>,
    /// Camera attitude as a quaternion.
    #[wire(flag = IMU_QUAT, since = "2.73")]
    pub imu_quat: Option<PackedQuaternion>,
    /// Target attitude as a quaternion.
    #[wire(flag = TARGET_QUAT, since = "2.73")]
    pub target_quat: Option<PackedQuaternion>,
    /// Rotation from IMU to frame as a quaternion.
    #[wire(flag = IMU_TO_FRAME_QUAT, since = "2.73")]
    pub imu_to_frame_quat: Option<PackedQuaternion>,
    /// Analog inputs 1 to 4, each averaged over 8 ms.
    #[wire(flag = ADC_CH_RAW, range = 0..=4096, since = "2.73")]
    pub adc_ch_raw: Option<[u16; 4]>,
    /// Distance of the joints to their software limits.
    #[wire(flag = SW_LIMITS_DIST, since = "2.73.8")]
    pub sw_limits_dist: Option<PerAxis<LimitDistances>>,
    /// Distance to the neutral point of follow mode; 0 for axes that are not in follow mode.
    #[wire(flag = FOLLOW_DIST, since = "2.73.8")]
    pub follow_dist: Option<PerAxis<Angle>>,
    /// Lower limits of the target angles. An axis has no limits if both are 0.
    #[wire(flag = EXT_TARGET_LIMIT, since = "2.73.8")]
    pub ext_target_limit_min: Option<PerAxis<LongAngle>>,
    /// Upper limits of the target angles.
    #[wire(flag = EXT_TARGET_LIMIT, since = "2.73.8")]
    pub ext_target_limit_max: Option<PerAxis<LongAngle>>,
    /// Joint (stator–rotor) angles in fine steps. The unit is inferred from the name.
    #[wire(flag = FRAME_CAM_ANGLE_20)]
    pub frame_cam_angle_20: Option<PerAxis<FineAngle>>,
    /// State of the main IMU.
    #[wire(flag = MAIN_IMU_STATE)]
    pub main_imu_state: Option<MainImuState>,
}

/// Undecoded custom real-time data (selection flags unknown).
#[message(CMD_REALTIME_DATA_CUSTOM, incoming, size = 2..=255, since = "2.60")]
#[derive(Copy)]
pub struct RealtimeDataCustomView<'a> {
    /// Time stamp of the board, wrapping after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// Undecoded selected data.
    pub body: &'a [u8],
}

impl RealtimeDataCustomView<'_> {
    /// Decodes the data that `flags` select.
    ///
    /// # Errors
    /// If it has less than that.
    pub fn decode_as(&self, flags: RealtimeDataCustomFlags) -> Result<RealtimeDataCustom, DecodeError> {
        decode_view(self, flags)
    }
}
