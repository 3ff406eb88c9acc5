//! Real-time data that the host chooses.

use sbgc_proto_macros::message;

use super::{
    AhrsDebugInfo, CommErrors, LimitDistances, MainImuState, Motor4Control, SystemPowerState,
    SystemStateBlock,
};
use crate::commands::PackedQuaternion;
use crate::frame::EncodeFrameError;
use crate::units::{Acceleration, Angle, EncoderAngle, FineAngle, LongAngle, RcSignal, SensorRate};
use crate::wire::{Float, FromWire, Layout, PerAxis, PerXyz, Reserved, ToWire, Writer, flags};
use crate::{DecodeError, Message};

use self::RealtimeDataCustomFlags as Flags;

/// Asks once for real-time data of your choice; [`DataStreamInterval`](crate::commands::DataStreamInterval) has them
/// sent again and again.
///
/// The board answers with [`RealtimeDataCustom`], which does not say what it holds: read it with the flags that were
/// asked for.
#[message(CMD_REALTIME_DATA_CUSTOM, outgoing, size = 10, since = "2.60", answer = RealtimeDataCustomView<'answer>,
    echo = flags(flags => body))]
#[derive(Copy)]
pub struct RealtimeDataCustomRequest {
    /// What the answer shall hold. Take care that it fits: see [`RealtimeDataCustomFlags::payload_len`].
    pub flags: RealtimeDataCustomFlags,
    pub reserved: Reserved<6>,
}

impl RealtimeDataCustomRequest {
    /// Asks for what `flags` choose.
    ///
    /// # Errors
    /// If the answer would be longer than a payload can be. What a board does with such a request is unknown.
    pub fn new(flags: RealtimeDataCustomFlags) -> Result<Self, EncodeFrameError> {
        let length = flags.payload_len();
        if length > 255 {
            return Err(EncodeFrameError::PayloadTooLong { length });
        }
        Ok(Self { flags, ..Self::default() })
    }
}

flags! {
    /// What chosen real-time data hold. Spec: `REALTIME_DATA_CUSTOM_FLAGS`.
    pub struct RealtimeDataCustomFlags: u32 {
        /// Where the camera points.
        const IMU_ANGLES = 1 << 0;
        /// Where it should point.
        const TARGET_ANGLES = 1 << 1;
        /// How fast it should turn.
        const TARGET_SPEED = 1 << 2;
        /// How far the joints are turned.
        const STATOR_ROTOR_ANGLE = 1 << 3;
        /// Gyroscope.
        const GYRO_DATA = 1 << 4;
        /// Control signals.
        const RC_DATA = 1 << 5;
        /// Attitude as two rows of the rotation matrix.
        const Z_VECTOR_H_VECTOR = 1 << 6;
        /// Channels of the serial receiver.
        const RC_CHANNELS = 1 << 7;
        /// Accelerometer.
        const ACC_DATA = 1 << 8;
        /// Data for the controller of a fourth axis, firmware 2.68 and later.
        const MOTOR4_CONTROL = 1 << 9;
        /// State of the attitude reference, firmware 2.66 and later.
        const AHRS_DEBUG_INFO = 1 << 10;
        /// Raw angles of the encoders, firmware 2.68 and later.
        const ENCODER_RAW24 = 1 << 11;
        /// Where the camera points, in radians, firmware 2.68b7 and later.
        const IMU_ANGLES_RAD = 1 << 12;
        /// Float variables of the running script, firmware 2.68b7 and later.
        const SCRIPT_VARS_FLOAT = 1 << 13;
        /// Integer variables of the running script, firmware 2.68b7 and later.
        const SCRIPT_VARS_INT16 = 1 << 14;
        /// Power and state of the motors, firmware 2.70b6 and later.
        const SYSTEM_POWER_STATE = 1 << 15;
        /// How fast the joints turn, firmware 2.70b6 and later.
        const FRAME_CAM_RATE = 1 << 16;
        /// Where the camera points, in fine steps, firmware 2.70b8 and later.
        const IMU_ANGLES_20 = 1 << 17;
        /// Where it should point, in fine steps, firmware 2.70b8 and later.
        const TARGET_ANGLES_20 = 1 << 18;
        /// Errors of communication, firmware 2.72b0 and later.
        const COMM_ERRORS = 1 << 19;
        /// What the system does, firmware 2.73 and later.
        const SYSTEM_STATE = 1 << 20;
        /// Attitude of the camera as quaternion, firmware 2.73 and later.
        const IMU_QUAT = 1 << 21;
        /// Target attitude as quaternion, firmware 2.73 and later.
        const TARGET_QUAT = 1 << 22;
        /// Rotation from IMU to frame as quaternion, firmware 2.73 and later.
        const IMU_TO_FRAME_QUAT = 1 << 23;
        /// Analog inputs, firmware 2.73 and later.
        const ADC_CH_RAW = 1 << 24;
        /// Distance of the joints to their software limits, firmware 2.73.8 and later.
        const SW_LIMITS_DIST = 1 << 25;
        /// Distance to the neutral point of follow mode, firmware 2.73.8 and later.
        const FOLLOW_DIST = 1 << 26;
        /// Limits of the target angles, firmware 2.73.8 and later.
        const EXT_TARGET_LIMIT = 1 << 27;
        /// How far the joints are turned, in fine steps. Published in the vendor's Python library only.
        const FRAME_CAM_ANGLE_20 = 1 << 28;
        /// State of the main IMU. Published in the vendor's Python library only.
        const MAIN_IMU_STATE = 1 << 29;
        /// These flags again, before all the rest. Published in the vendor's Python library only.
        const INCLUDE_FLAGS = 1 << 31;
    }
}

impl RealtimeDataCustomFlags {
    /// How many bytes the answer has: those of [`RealtimeDataCustom`] with these flags.
    ///
    /// ```
    /// use sbgc_proto::commands::RealtimeDataCustomFlags as Flags;
    ///
    /// assert_eq!((Flags::IMU_ANGLES | Flags::RC_DATA).payload_len(), 2 + 6 + 12);
    /// ```
    pub fn payload_len(self) -> usize {
        const ZEROS: &[u8] = &[0; <RealtimeDataCustom as Layout>::MAX_LEN];
        let rest = RealtimeDataCustom::read(ZEROS, self).map_or(0, |(rest, _)| rest.len());
        ZEROS.len() - rest
    }
}

/// Chosen real-time data: a time stamp, then what the flags of the request or the data stream choose, in the order of
/// the bits.
///
/// Where both are chosen, `motor4_control` comes before `ahrs_debug_info`, as the bits do and against the printed
/// table. The fields that were not chosen are `None`.
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
    /// The board's time, which starts again after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// The flags of the request.
    #[wire(when = selection.contains(Flags::INCLUDE_FLAGS))]
    pub flags: Option<RealtimeDataCustomFlags>,
    /// Where the camera points.
    #[wire(when = selection.contains(Flags::IMU_ANGLES))]
    pub imu_angles: Option<PerAxis<Angle>>,
    /// Where it should point.
    #[wire(when = selection.contains(Flags::TARGET_ANGLES))]
    pub target_angles: Option<PerAxis<Angle>>,
    /// How fast it should turn. [`Angles`](super::Angles) has the same in twice this step.
    #[wire(when = selection.contains(Flags::TARGET_SPEED))]
    pub target_speed: Option<PerAxis<SensorRate>>,
    /// How far the joints are turned. Newer documents call it FRAME_CAM_ANGLE.
    #[wire(when = selection.contains(Flags::STATOR_ROTOR_ANGLE))]
    pub stator_rotor_angle: Option<PerAxis<Angle>>,
    /// Gyroscope, with the calibrations applied.
    #[wire(when = selection.contains(Flags::GYRO_DATA))]
    pub gyro_data: Option<PerXyz<SensorRate>>,
    /// Control signals: ROLL, PITCH, YAW, CMD, FC_ROLL, FC_PITCH.
    #[wire(when = selection.contains(Flags::RC_DATA), range = -16384..=16384)]
    pub rc_data: Option<[RcSignal; 6]>,
    /// Gravity as a row of the rotation matrix. The third row is the cross product of the two.
    #[wire(when = selection.contains(Flags::Z_VECTOR_H_VECTOR), range = -1..=1)]
    pub z_vector: Option<PerXyz<Float>>,
    /// Heading as a row of the rotation matrix.
    #[wire(when = selection.contains(Flags::Z_VECTOR_H_VECTOR), range = -1..=1)]
    pub h_vector: Option<PerXyz<Float>>,
    /// Channels of the serial receiver (s-bus, Spektrum, Sum-PPM).
    #[wire(when = selection.contains(Flags::RC_CHANNELS), range = -16384..=16384)]
    pub rc_channels: Option<[RcSignal; 18]>,
    /// Accelerometer, with the calibrations applied.
    #[wire(when = selection.contains(Flags::ACC_DATA))]
    pub acc_data: Option<PerXyz<Acceleration>>,
    /// Data for the controller of a fourth axis.
    #[wire(when = selection.contains(Flags::MOTOR4_CONTROL), since = "2.68")]
    pub motor4_control: Option<Motor4Control>,
    /// State of the attitude reference.
    #[wire(when = selection.contains(Flags::AHRS_DEBUG_INFO), since = "2.66")]
    pub ahrs_debug_info: Option<AhrsDebugInfo>,
    /// Raw angles of the encoders.
    #[wire(when = selection.contains(Flags::ENCODER_RAW24), since = "2.68")]
    pub encoder_raw24: Option<PerAxis<EncoderAngle>>,
    /// Where the camera points, from −π to π.
    #[wire(when = selection.contains(Flags::IMU_ANGLES_RAD), unit = "rad", since = "2.68b7")]
    pub imu_angles_rad: Option<PerAxis<Float>>,
    /// Float variables of the running script.
    #[wire(when = selection.contains(Flags::SCRIPT_VARS_FLOAT), since = "2.68b7")]
    pub script_vars_float: Option<[Float; 10]>,
    /// Integer variables of the running script.
    #[wire(when = selection.contains(Flags::SCRIPT_VARS_INT16), since = "2.68b7")]
    pub script_vars_int16: Option<[i16; 10]>,
    /// Power and state of the motors.
    #[wire(when = selection.contains(Flags::SYSTEM_POWER_STATE), since = "2.70b6")]
    pub system_power_state: Option<SystemPowerState>,
    /// How fast the joints turn.
    #[wire(when = selection.contains(Flags::FRAME_CAM_RATE), since = "2.70b6")]
    pub frame_cam_rate: Option<PerAxis<SensorRate>>,
    /// Where the camera points, in fine steps.
    #[wire(when = selection.contains(Flags::IMU_ANGLES_20), since = "2.70b8")]
    pub imu_angles_20: Option<PerAxis<FineAngle>>,
    /// Where it should point, in fine steps.
    #[wire(when = selection.contains(Flags::TARGET_ANGLES_20), since = "2.70b8")]
    pub target_angles_20: Option<PerAxis<FineAngle>>,
    /// Errors of communication.
    #[wire(when = selection.contains(Flags::COMM_ERRORS), since = "2.72b0")]
    pub comm_errors: Option<CommErrors>,
    /// What the system does.
    #[wire(when = selection.contains(Flags::SYSTEM_STATE), since = "2.73")]
    pub system_state: Option<SystemStateBlock>,
    /// Attitude of the camera as a quaternion.
    #[wire(when = selection.contains(Flags::IMU_QUAT), since = "2.73")]
    pub imu_quat: Option<PackedQuaternion>,
    /// Target attitude as a quaternion.
    #[wire(when = selection.contains(Flags::TARGET_QUAT), since = "2.73")]
    pub target_quat: Option<PackedQuaternion>,
    /// Rotation from IMU to frame as a quaternion.
    #[wire(when = selection.contains(Flags::IMU_TO_FRAME_QUAT), since = "2.73")]
    pub imu_to_frame_quat: Option<PackedQuaternion>,
    /// Analog inputs 1 to 4, each the mean of 8 ms.
    #[wire(when = selection.contains(Flags::ADC_CH_RAW), range = 0..=4096, since = "2.73")]
    pub adc_ch_raw: Option<[u16; 4]>,
    /// Distance of the joints to their software limits.
    #[wire(when = selection.contains(Flags::SW_LIMITS_DIST), since = "2.73.8")]
    pub sw_limits_dist: Option<PerAxis<LimitDistances>>,
    /// Distance to the neutral point of follow mode; 0 where an axis does not follow.
    #[wire(when = selection.contains(Flags::FOLLOW_DIST), since = "2.73.8")]
    pub follow_dist: Option<PerAxis<Angle>>,
    /// Lower limits of the target angles. Where both limits are 0 there are none.
    #[wire(when = selection.contains(Flags::EXT_TARGET_LIMIT), since = "2.73.8")]
    pub ext_target_limit_min: Option<PerAxis<LongAngle>>,
    /// Upper limits of the target angles.
    #[wire(when = selection.contains(Flags::EXT_TARGET_LIMIT), since = "2.73.8")]
    pub ext_target_limit_max: Option<PerAxis<LongAngle>>,
    /// How far the joints are turned, in fine steps. The unit is taken from the name, for it is not stated.
    #[wire(when = selection.contains(Flags::FRAME_CAM_ANGLE_20))]
    pub frame_cam_angle_20: Option<PerAxis<FineAngle>>,
    /// State of the main IMU.
    #[wire(when = selection.contains(Flags::MAIN_IMU_STATE))]
    pub main_imu_state: Option<MainImuState>,
}

/// Chosen real-time data of which the choice is not known.
#[message(CMD_REALTIME_DATA_CUSTOM, incoming, size = 2..=255, since = "2.60")]
#[derive(Copy)]
pub struct RealtimeDataCustomView<'a> {
    /// The board's time, which starts again after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// The chosen data.
    pub body: &'a [u8],
}

impl RealtimeDataCustomView<'_> {
    /// Reads the data that `flags` choose.
    ///
    /// # Errors
    /// When it has less than that.
    pub fn decode_as(&self, flags: RealtimeDataCustomFlags) -> Result<RealtimeDataCustom, DecodeError> {
        decode_view(self, flags)
    }
}

/// Reads again, with what must be known, a message that was read without.
pub(in crate::commands) fn decode_view<M, C>(view: &impl ToWire, context: C) -> Result<M, DecodeError>
where
    M: Message + for<'b> FromWire<'b, C>,
{
    let mut payload = [0; 255];
    let mut writer = Writer::new(&mut payload);
    // What does not fit a payload did not come in one, and is missed below.
    let _ = view.write((), &mut writer);
    let length = writer.len();
    M::decode_with(payload.get(..length).unwrap_or_default(), context).map(|(message, _)| message)
}
