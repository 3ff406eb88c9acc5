//! The second set of real-time data that the host chooses.

use sbgc_proto_macros::message;

use super::custom::decode_view;
use crate::DecodeError;
use crate::units::{Acceleration, Angle, SensorRate, StabilizationError};
use crate::wire::{FromWire, Layout, PerAxis, PerXyz, Reserved, flags};

use self::RealtimeDataCustom2Flags as Flags;

/// Asks for data of the second set.
///
/// The board answers with [`RealtimeDataCustom2`], which does not say what it holds: read it with the flags that were
/// asked for.
#[message(
    CMD_REALTIME_DATA_CUSTOM2, outgoing, size = 10, since = "2.74.2", answer = RealtimeDataCustom2View<'answer>,
    echo = flags(flags => body)
)]
#[derive(Copy)]
pub struct RealtimeDataCustom2Request {
    /// What the answer shall hold.
    pub flags: RealtimeDataCustom2Flags,
    pub reserved: Reserved<6>,
}

flags! {
    /// What data of the second set hold. Spec: `REALTIME_DATA_CUSTOM2_FLAGS`.
    pub struct RealtimeDataCustom2Flags: u32 {
        /// How the frame stands.
        const FRAME_IMU_ANGLES = 1 << 0;
        /// Gyroscope of the frame.
        const FRAME_GYRO = 1 << 1;
        /// Accelerometer of the frame.
        const FRAME_ACC = 1 << 2;
        /// Debug values.
        const DEBUG = 1 << 3;
        /// Magnetometer.
        const MAG_SENS_DATA = 1 << 4;
        /// Levels of buttons and pins.
        const PIN_STATE = 1 << 5;
        /// How much the camera shakes, firmware 2.74.4 and later.
        const STAB_ERR_AMPL = 1 << 6;
        /// These flags again, before all the rest.
        const INCLUDE_FLAGS = 1 << 31;
    }
}

impl RealtimeDataCustom2Flags {
    /// How many bytes the answer has: those of [`RealtimeDataCustom2`] with these flags.
    pub fn payload_len(self) -> usize {
        const ZEROS: &[u8] = &[0; <RealtimeDataCustom2 as Layout>::MAX_LEN];
        let rest = RealtimeDataCustom2::read(ZEROS, self).map_or(0, |(rest, _)| rest.len());
        ZEROS.len() - rest
    }
}

/// Data of the second set: a time stamp, then what the flags of the request or the data stream choose, in the order
/// of the bits.
///
/// The fields that were not chosen are `None`.
#[message(
    CMD_REALTIME_DATA_CUSTOM2, incoming, size = 2..=52, since = "2.74.2",
    context(selection: RealtimeDataCustom2Flags)
)]
#[derive(Copy)]
pub struct RealtimeDataCustom2 {
    /// The board's time, which starts again after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// The flags of the request.
    #[wire(when = selection.contains(Flags::INCLUDE_FLAGS))]
    pub flags: Option<RealtimeDataCustom2Flags>,
    /// How the frame stands.
    #[wire(when = selection.contains(Flags::FRAME_IMU_ANGLES))]
    pub frame_imu_angles: Option<PerAxis<Angle>>,
    /// Gyroscope of the frame.
    #[wire(when = selection.contains(Flags::FRAME_GYRO))]
    pub frame_gyro: Option<PerXyz<SensorRate>>,
    /// Accelerometer of the frame.
    #[wire(when = selection.contains(Flags::FRAME_ACC))]
    pub frame_acc: Option<PerXyz<Acceleration>>,
    /// Debug values, which only the firmware's makers can read.
    #[wire(when = selection.contains(Flags::DEBUG))]
    pub debug: Option<[i16; 4]>,
    /// Magnetometer.
    #[wire(when = selection.contains(Flags::MAG_SENS_DATA))]
    pub mag_sens_data: Option<PerXyz<i16>>,
    /// Levels of extra buttons, two bits each: 0 low, 1 high, 2 not available.
    ///
    /// The newer specification prints 12 bytes for this and the two fields after it; 8 are right.
    #[wire(when = selection.contains(Flags::PIN_STATE))]
    pub extra_buttons_state: Option<u16>,
    /// Levels of pins, two bits each: 0 low, 1 high, 2 not available.
    #[wire(when = selection.contains(Flags::PIN_STATE))]
    pub pin_state: Option<u16>,
    #[wire(when = selection.contains(Flags::PIN_STATE))]
    pub pin_state_reserved: Option<Reserved<4>>,
    /// How much the camera shakes.
    #[wire(when = selection.contains(Flags::STAB_ERR_AMPL), since = "2.74.4")]
    pub stab_err_ampl: Option<PerAxis<StabilizationError>>,
}

/// Data of the second set of which the choice is not known.
#[message(CMD_REALTIME_DATA_CUSTOM2, incoming, size = 2..=255, since = "2.74.2")]
#[derive(Copy)]
pub struct RealtimeDataCustom2View<'a> {
    /// The board's time, which starts again after 65535.
    #[wire(unit = "ms")]
    pub timestamp_ms: u16,
    /// The chosen data.
    pub body: &'a [u8],
}

impl RealtimeDataCustom2View<'_> {
    /// Reads the data that `flags` choose.
    ///
    /// # Errors
    /// When it has less than that.
    pub fn decode_as(&self, flags: RealtimeDataCustom2Flags) -> Result<RealtimeDataCustom2, DecodeError> {
        decode_view(self, flags)
    }
}
