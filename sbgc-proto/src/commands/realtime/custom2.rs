//! Second set of real-time data with fields selected by the host.

use sbgc_proto_macros::message;

use crate::DecodeError;
use crate::commands::selection::{decode_view, payload_len};
use crate::declare::flags;
use crate::units::{Acceleration, Angle, SensorRate, StabilizationError};
use crate::wire::{PerAxis, PerXyz, Reserved};

/// Requests selected real-time data of the second set once.
///
/// The board answers with [`RealtimeDataCustom2`], which does not identify its fields: decode it with the requested
/// flags, as [`decode_answer`](crate::Request::decode_answer) does.
#[message(
    CMD_REALTIME_DATA_CUSTOM2, outgoing, size = 10, since = "2.74.2", answer = RealtimeDataCustom2, given = self.flags,
    answer_len = self.flags.payload_len(), echo = flags(flags)
)]
#[derive(Copy)]
pub struct RealtimeDataCustom2Request {
    /// Flags that select the fields of the answer.
    pub flags: RealtimeDataCustom2Flags,
    pub reserved: Reserved<6>,
}

flags! {
    /// Selection of second-set real-time data. Spec: `REALTIME_DATA_CUSTOM2_FLAGS`.
    pub struct RealtimeDataCustom2Flags: u32 {
        /// Frame attitude.
        const FRAME_IMU_ANGLES = 1 << 0;
        /// Angular rates of the frame.
        const FRAME_GYRO = 1 << 1;
        /// Accelerations of the frame.
        const FRAME_ACC = 1 << 2;
        /// Debug values.
        const DEBUG = 1 << 3;
        /// Magnetometer.
        const MAG_SENS_DATA = 1 << 4;
        /// Levels of buttons and pins.
        const PIN_STATE = 1 << 5;
        /// Amplitude of the stabilization error. Firmware 2.74.4+.
        const STAB_ERR_AMPL = 1 << 6;
        /// Repeats these flags before the other fields.
        const INCLUDE_FLAGS = 1 << 31;
    }
}

impl RealtimeDataCustom2Flags {
    /// Number of payload bytes of a [`RealtimeDataCustom2`] with these flags.
    pub fn payload_len(self) -> usize {
        payload_len::<RealtimeDataCustom2, _>(self)
    }
}

/// Second set of custom real-time data: a time stamp, followed by the fields that the flags of the request or stream
/// select.
///
/// Fields are in the order of the flag bits. Fields not selected are `None`.
#[message(
    CMD_REALTIME_DATA_CUSTOM2, incoming, size = 2..=52, since = "2.74.2",
    context(selection: RealtimeDataCustom2Flags)
)]
#[derive(Copy)]
pub struct RealtimeDataCustom2 {
    /// Time stamp of the board, wrapping after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// Selection flags, as in the request.
    #[wire(flag = INCLUDE_FLAGS)]
    pub flags: Option<RealtimeDataCustom2Flags>,
    /// Frame attitude.
    #[wire(flag = FRAME_IMU_ANGLES)]
    pub frame_imu_angles: Option<PerAxis<Angle>>,
    /// Angular rates of the frame.
    #[wire(flag = FRAME_GYRO)]
    pub frame_gyro: Option<PerXyz<SensorRate>>,
    /// Accelerations of the frame.
    #[wire(flag = FRAME_ACC)]
    pub frame_acc: Option<PerXyz<Acceleration>>,
    /// Debug values (undocumented).
    #[wire(flag = DEBUG)]
    pub debug: Option<[i16; 4]>,
    /// Magnetometer.
    #[wire(flag = MAG_SENS_DATA)]
    pub mag_sens_data: Option<PerXyz<i16>>,
    /// Levels of extra buttons, two bits each: 0 low, 1 high, 2 not available.
    ///
    /// The newer specification gives 12 bytes for this and the next two fields; 8 is correct.
    #[wire(flag = PIN_STATE)]
    pub extra_buttons_state: Option<u16>,
    /// Levels of pins, two bits each: 0 low, 1 high, 2 not available.
    #[wire(flag = PIN_STATE)]
    pub pin_state: Option<u16>,
    #[wire(flag = PIN_STATE)]
    pub pin_state_reserved: Option<Reserved<4>>,
    /// Amplitude of the stabilization error.
    #[wire(flag = STAB_ERR_AMPL, since = "2.74.4")]
    pub stab_err_ampl: Option<PerAxis<StabilizationError>>,
}

/// Undecoded second-set data (selection flags unknown).
#[message(CMD_REALTIME_DATA_CUSTOM2, incoming, size = 2..=255, since = "2.74.2")]
#[derive(Copy)]
pub struct RealtimeDataCustom2View<'a> {
    /// Time stamp of the board, wrapping after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// Undecoded selected data.
    pub body: &'a [u8],
}

impl RealtimeDataCustom2View<'_> {
    /// Decodes the data that `flags` select.
    ///
    /// # Errors
    /// If it has less than that.
    pub fn decode_as(&self, flags: RealtimeDataCustom2Flags) -> Result<RealtimeDataCustom2, DecodeError> {
        decode_view(self, flags)
    }
}
