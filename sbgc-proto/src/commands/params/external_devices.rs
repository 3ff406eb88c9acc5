//! Types of the settings for connected devices: external IMUs and sensors, buttons and encoders.

use sbgc_proto_macros::{bit_fields, open_enum};

use crate::commands::TriggerPinId;

/// Model of an external IMU; 0 for none. Spec: `EXT_IMU_TYPE`.
#[open_enum(u8)]
pub enum ExtImuType {
    /// Autopilot with MAVLink 1.
    #[wire(spec = "MavLink1")]
    MavLink1 = 1,
    /// Autopilot with MAVLink 2.
    #[wire(spec = "MavLink2")]
    MavLink2 = 2,
    /// Vectornav VN200.
    #[wire(spec = "Vectornav_VN200")]
    VectornavVn200 = 3,
    /// Inertialsense uAHRS.
    #[wire(spec = "Inertialsense_uAHRS")]
    InertialsenseUahrs = 4,
}

/// Mounting position of an external IMU. Spec: `EXT_IMU_POSITION`.
#[open_enum(u8)]
pub enum ExtImuPosition {
    /// Below the outer motor.
    BelowOuter = 1,
    /// Above the outer motor, on the frame.
    AboveOuter = 2,
    /// Below the middle motor.
    BelowMiddle = 8,
    /// On the camera platform, with the main IMU.
    MainImu = 9,
}

/// Extra button: its pin and options. Newer firmware.
///
/// According to the vendor's library, the pin has five bits, so the buzzer and the power of the Spektrum connector
/// cannot be expressed.
#[bit_fields(u8)]
pub struct ExtraButton {
    /// Pin; 0 for none.
    #[wire(bits = 0..=4)]
    pub pin: TriggerPinId,
    /// Whether the button latches: it stays pressed until pressed again.
    #[wire(bits = 6)]
    pub latching: bool,
    /// Whether the level is inverted.
    #[wire(bits = 7, spec = "INVERT")]
    pub inverted: bool,
}

/// Further options of an encoder. Newer firmware; bits 8 to 15 are not published.
#[bit_fields(u16)]
pub struct EncoderConfigExt {
    /// Resolution in bits, minus 12.
    #[wire(bits = 0..=4)]
    pub resolution: u8,
    /// Size of the turn counter.
    #[wire(bits = 5..=7)]
    pub multi_turn: MultiTurn,
}

/// Size of an encoder's turn counter. The specification does not name the values.
#[open_enum(u8)]
pub enum MultiTurn {
    /// No turn counter.
    #[wire(spec = "NONE")]
    None = 0,
    /// 12 bits.
    #[wire(spec = "12")]
    Bits12 = 1,
    /// 16 bits.
    #[wire(spec = "16")]
    Bits16 = 2,
    /// 20 bits.
    #[wire(spec = "20")]
    Bits20 = 3,
    /// 24 bits.
    #[wire(spec = "24")]
    Bits24 = 4,
}

/// External sensor connected to the CAN IMU. Spec: `CAN_IMU_EXT_SENS_TYPE`. Newer firmware.
#[open_enum(u8)]
pub enum CanImuSensor {
    /// None.
    Disabled = 0,
    /// KVH 1725.
    #[wire(spec = "KVH_1725")]
    Kvh1725 = 1,
    /// KVH 1750 with 2 g accelerometers.
    #[wire(spec = "KVH_1750_ACC_2G")]
    Kvh1750Acc2g = 2,
    /// KVH 1750 with 10 g accelerometers.
    #[wire(spec = "KVH_1750_ACC_10G")]
    Kvh1750Acc10g = 3,
    /// KVH 1750 with 30 g accelerometers.
    #[wire(spec = "KVH_1750_ACC_30G")]
    Kvh1750Acc30g = 4,
    /// KVH 1775 with 10 g accelerometers.
    #[wire(spec = "KVH_1775_ACC_10G")]
    Kvh1775Acc10g = 5,
    /// KVH 1775 with 25 g accelerometers.
    #[wire(spec = "KVH_1775_ACC_25G")]
    Kvh1775Acc25g = 6,
    /// KVH 1760.
    #[wire(spec = "KVH_1760")]
    Kvh1760 = 7,
    /// Analog Devices ADXRS453.
    #[wire(spec = "ADXRS453")]
    Adxrs453 = 8,
    /// Analog Devices ADIS16460.
    #[wire(spec = "ADIS16460")]
    Adis16460 = 9,
    /// Sensonor STIM210.
    #[wire(spec = "STIM210")]
    Stim210 = 10,
    /// Sensonor STIM300.
    #[wire(spec = "STIM300")]
    Stim300 = 11,
    /// Murata SCHA63x.
    #[wire(spec = "SCHA63X")]
    Scha63x = 12,
    /// Vectornav VN100 or VN200 on a serial port.
    #[wire(spec = "VECTORNAV_VN100_200_UART")]
    VectornavUart = 64,
    /// Vectornav VN100 or VN200 on SPI.
    #[wire(spec = "VECTORNAV_VN100_200_SPI")]
    VectornavSpi = 65,
}
