//! Types of the RC control settings: inputs, interpretation and mixing of signals.

use sbgc_proto_macros::{bit_fields, open_enum};

/// Interpretation of the control signal of an axis.
#[bit_fields(u8)]
pub struct RcAxisMode {
    /// Meaning of the control signal.
    #[wire(bits = 0..=2, spec = "RC_MODE")]
    pub mode: RcMode,
    /// Whether the control signal is inverted.
    #[wire(bits = 3)]
    pub inverted: bool,
}

/// Meaning of a control signal. Spec: `RC_MODE`.
#[open_enum(u8, prefix = "RC_MODE_")]
pub enum RcMode {
    /// Target angle.
    Angle = 0,
    /// Speed.
    Speed = 1,
    /// Tracking. The specification lists it for adjustable variables only.
    #[wire(since = "2.69b3")]
    Tracking = 2,
}

/// Input mode of the RC_ROLL pin. Spec: `RC_VIRT_MODE`.
#[open_enum(u8, prefix = "RC_VIRT_MODE_")]
pub enum RcVirtMode {
    /// One PWM channel.
    Normal = 0,
    /// Sum signal of several channels (Sum-PPM).
    Cppm = 1,
    /// Futaba s-bus receiver.
    Sbus = 2,
    /// Spektrum satellite receiver.
    Spektrum = 3,
    /// Second serial port for this protocol.
    Api = 10,
}

/// Mixing of a flight controller signal into a control signal.
///
/// The division into 6 and 2 bits is that of newer documents; the text is incomplete in copies of the older
/// specification.
#[bit_fields(u8)]
pub struct FcMix {
    /// Mixing rate, 0 to 63.
    #[wire(bits = 0..=5)]
    pub rate: u8,
    /// Control signal to mix into.
    #[wire(bits = 6..=7)]
    pub target: FcMixTarget,
}

/// Control signal that a flight controller signal is mixed into. Spec: `RC_MIX_FC_TARGET`.
#[open_enum(u8)]
pub enum FcMixTarget {
    /// None; mixing is disabled.
    NoMix = 0,
    /// Control signal for ROLL.
    Roll = 1,
    /// Control signal for PITCH.
    Pitch = 2,
    /// Control signal for YAW.
    Yaw = 3,
}

/// Protocol of a Spektrum receiver: generation, frame period and resolution. Spec: `SPEKTRUM_MODE`.
#[open_enum(u8)]
pub enum SpektrumMode {
    /// Detected automatically (default).
    #[wire(spec = "AUTO_DETECTION")]
    Auto = 0,
    /// DSM2, 11 ms, 10 bits.
    #[wire(spec = "DSM2_11MS_10BIT")]
    Dsm2Ms11Bits10 = 1,
    /// DSM2, 11 ms, 11 bits.
    #[wire(spec = "DSM2_11MS_11BIT")]
    Dsm2Ms11Bits11 = 2,
    /// DSM2, 22 ms, 10 bits.
    #[wire(spec = "DSM2_22MS_10BIT")]
    Dsm2Ms22Bits10 = 3,
    /// DSM2, 22 ms, 11 bits.
    #[wire(spec = "DSM2_22MS_11BIT")]
    Dsm2Ms22Bits11 = 4,
    /// DSMX, 11 ms, 10 bits.
    #[wire(spec = "DSMX_11MS_10BIT")]
    DsmxMs11Bits10 = 5,
    /// DSMX, 11 ms, 11 bits.
    #[wire(spec = "DSMX_11MS_11BIT")]
    DsmxMs11Bits11 = 6,
    /// DSMX, 22 ms, 10 bits.
    #[wire(spec = "DSMX_22MS_10BIT")]
    DsmxMs22Bits10 = 7,
    /// DSMX, 22 ms, 11 bits.
    #[wire(spec = "DSMX_22MS_11BIT")]
    DsmxMs22Bits11 = 8,
}

/// Follow mode of ROLL and PITCH. Spec: `FOLLOW_MODE`.
#[open_enum(u8, prefix = "FOLLOW_MODE_")]
pub enum FollowMode {
    /// Follow mode is disabled.
    Disabled = 0,
    /// Follows the attitude of the flight controller.
    #[wire(spec = "FOLLOW_MODE_FC")]
    FlightController = 1,
    /// Follows the frame on PITCH and partly on ROLL.
    Pitch = 2,
}
