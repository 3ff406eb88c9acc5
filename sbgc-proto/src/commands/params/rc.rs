//! Values of remote control: what inputs read, what signals mean, how they are mixed.

use sbgc_proto_macros::{bit_fields, open_enum};

/// Options for reading the control signal of an axis.
#[bit_fields(u8)]
pub struct RcAxisMode {
    /// Meaning of the signal.
    #[wire(bits = 0..=2, spec = "RC_MODE")]
    pub mode: RcMode,
    /// Whether control is inverted.
    #[wire(bits = 3)]
    pub inverted: bool,
}

/// Meaning of a control signal. Spec: `RC_MODE`.
#[open_enum(u8, prefix = "RC_MODE_")]
pub enum RcMode {
    /// The angle to go to.
    Angle = 0,
    /// The speed to move with.
    Speed = 1,
    /// Tracking. The specification has it among the adjustable variables only.
    #[wire(since = "2.69b3")]
    Tracking = 2,
}

/// Input mode of the RC_ROLL pin. Spec: `RC_VIRT_MODE`.
#[open_enum(u8, prefix = "RC_VIRT_MODE_")]
pub enum RcVirtMode {
    /// One channel, as pulse width.
    Normal = 0,
    /// A sum signal of several channels (Sum-PPM).
    Cppm = 1,
    /// A Futaba s-bus receiver.
    Sbus = 2,
    /// A Spektrum satellite receiver.
    Spektrum = 3,
    /// Nothing: a second serial port for this protocol.
    Api = 10,
}

/// Mixing of a flight controller signal into a control signal.
///
/// The split into 6 and 2 bits is that of newer documents; copies of the older specification break off there.
#[bit_fields(u8)]
pub struct FcMix {
    /// Amount, 0 to 63.
    #[wire(bits = 0..=5)]
    pub rate: u8,
    /// Into which control signal.
    #[wire(bits = 6..=7)]
    pub target: FcMixTarget,
}

/// The control signal into which the flight controller's is mixed. Spec: `RC_MIX_FC_TARGET`.
#[open_enum(u8)]
pub enum FcMixTarget {
    /// None: it is not mixed.
    NoMix = 0,
    /// That of ROLL.
    Roll = 1,
    /// That of PITCH.
    Pitch = 2,
    /// That of YAW.
    Yaw = 3,
}

/// Protocol of a Spektrum receiver: generation, time of a frame, resolution. Spec: `SPEKTRUM_MODE`.
#[open_enum(u8)]
pub enum SpektrumMode {
    /// Found out by the board. The default.
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
    /// Nothing.
    Disabled = 0,
    /// The flight controller's attitude.
    #[wire(spec = "FOLLOW_MODE_FC")]
    FlightController = 1,
    /// The frame, on PITCH and in part on ROLL.
    Pitch = 2,
}
