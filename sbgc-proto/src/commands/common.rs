//! Types shared by several topics.

use sbgc_proto_macros::{bit_fields, open_enum};

/// Boolean value. Spec: `NO_YES`.
#[open_enum(u8)]
pub enum Switch {
    /// Off, no.
    #[wire(spec = "NO")]
    Off = 0,
    /// On, yes.
    #[wire(spec = "YES")]
    On = 1,
}

/// Parameter profile. Spec: `PROFILE_ID`.
#[open_enum(u8)]
pub enum ProfileId {
    /// Profile 1.
    #[wire(spec = "PROFILE_1")]
    Profile1 = 0,
    /// Profile 2.
    #[wire(spec = "PROFILE_2")]
    Profile2 = 1,
    /// Profile 3.
    #[wire(spec = "PROFILE_3")]
    Profile3 = 2,
    /// Profile 4.
    #[wire(spec = "PROFILE_4")]
    Profile4 = 3,
    /// Profile 5.
    #[wire(spec = "PROFILE_5")]
    Profile5 = 4,
    /// Erases the whole EEPROM. For `CMD_USE_DEFAULTS` only.
    EraseEeprom = 253,
    /// Resets the active profile. For `CMD_USE_DEFAULTS` only.
    ResetCurrent = 254,
    /// The active profile.
    Current = 255,
}

/// Gimbal axis. Spec: `BODE_TEST_AXIS`, `SYNC_MOTORS_AXIS`.
#[open_enum(u8)]
pub enum Axis {
    /// Rotation about the optical axis.
    Roll = 0,
    /// Rotation up and down.
    Pitch = 1,
    /// Rotation left and right.
    Yaw = 2,
}

/// IMU, numbered from 1. Spec: `IMU_TYPE`.
///
/// A few commands use other numbers: see [`ImuIndex`](super::ImuIndex) and [`CalibImu`](super::CalibImu).
#[open_enum(u8, prefix = "IMU_TYPE_")]
pub enum ImuType {
    /// IMU on the camera platform.
    Main = 1,
    /// IMU on the frame.
    Frame = 2,
}

/// Signal source: a kind of input and a channel number. Zero means not assigned.
///
/// ```
/// use sbgc_proto::commands::{RcSource, RcSourceKind};
///
/// assert_eq!(RcSource::API_VIRT_CH.with_channel(3), RcSource(131));
/// assert_eq!(RcSource(34).kind(), RcSourceKind::Analog);
/// ```
#[bit_fields(u8)]
pub struct RcSource {
    /// Channel number, counted from 1.
    #[wire(bits = 0..=4)]
    pub channel: u8,
    /// Kind of input.
    #[wire(bits = 5..=7, spec = "RC_MAP_TYPE")]
    pub kind: RcSourceKind,
    /// Not assigned.
    #[wire(value = 0)]
    pub NOT_ASSIGNED: Self,
    /// PWM input of the ROLL channel.
    #[wire(value = 1)]
    pub RC_INPUT_ROLL: Self,
    /// PWM input of the PITCH channel.
    #[wire(value = 2)]
    pub RC_INPUT_PITCH: Self,
    /// PWM input for the ROLL signal of a flight controller.
    #[wire(value = 3)]
    pub EXT_FC_INPUT_ROLL: Self,
    /// PWM input for the PITCH signal of a flight controller.
    #[wire(value = 4)]
    pub EXT_FC_INPUT_PITCH: Self,
    /// PWM input of the YAW channel.
    #[wire(value = 5)]
    pub RC_INPUT_YAW: Self,
    /// Analog input 1.
    #[wire(value = 33)]
    pub ADC1: Self,
    /// Analog input 2.
    #[wire(value = 34)]
    pub ADC2: Self,
    /// Analog input 3.
    #[wire(value = 35)]
    pub ADC3: Self,
    /// Analog input 4; some boards only. Newer firmware.
    #[wire(value = 36)]
    pub ADC4: Self,
}

impl RcSource {
    /// Base value for channels 1 to 31 of a serial receiver (s-bus, Spektrum, Sum-PPM): add the channel number.
    pub const RC_SERIAL_CH: Self = Self(64);
    /// Base value for virtual channels 1 to 31, set by `CMD_API_VIRT_CH_CONTROL`: add the channel number.
    pub const API_VIRT_CH: Self = Self(128);
    /// Base value for step signals 1 to 6: add the signal number. Firmware 2.66+.
    pub const STEP_SIGNAL_CH: Self = Self(160);
}

/// Kind of input: bits 5 to 7 of a signal source.
#[open_enum(u8)]
pub enum RcSourceKind {
    /// PWM inputs, channels 1 to 5. Channel 0 means not assigned.
    Pwm = 0,
    /// Analog inputs, channels 1 to 3, or 4 on some boards.
    Analog = 1,
    /// Channels 1 to 31 of a serial receiver.
    RcSerial = 2,
    /// Virtual channels 1 to 31, set by a host.
    ApiVirt = 4,
    /// Step signals 1 to 6.
    #[wire(since = "2.66")]
    StepSignal = 5,
}
