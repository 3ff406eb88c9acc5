//! Values of what is connected to the board: external IMUs and sensors, buttons, extended encoders.

use sbgc_proto_macros::{bit_fields, open_enum};

use crate::commands::TriggerPinId;

/// Model of an external IMU; 0 is none. Spec: `EXT_IMU_TYPE`.
#[open_enum(u8)]
pub enum ExtImuType {
    /// An autopilot that speaks MavLink 1.
    #[wire(spec = "MavLink1")]
    MavLink1 = 1,
    /// An autopilot that speaks MavLink 2.
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
    /// With the main IMU, on the camera platform.
    MainImu = 9,
}

/// An extra button: its pin, and how it works. Newer firmware.
///
/// The pin has five bits as the vendor's library reads them: the buzzer and the power of the Spektrum connector
/// cannot be expressed.
#[bit_fields(u8)]
pub struct ExtraButton {
    /// The pin; 0 is none.
    #[wire(bits = 0..=4)]
    pub pin: TriggerPinId,
    /// Whether it stays pressed until it is pressed again.
    #[wire(bits = 6)]
    pub latching: bool,
    /// Whether its level is inverted.
    #[wire(bits = 7, spec = "INVERT")]
    pub inverted: bool,
}

/// More on how an encoder is read. Newer firmware; bits 8 to 15 are not listed.
#[bit_fields(u16)]
pub struct EncoderConfigExt {
    /// Its resolution in bits, less 12.
    #[wire(bits = 0..=4)]
    pub resolution: u8,
    /// Number of turns it counts.
    #[wire(bits = 5..=7)]
    pub multi_turn: MultiTurn,
}

/// Bits in which an encoder counts turns. The specification has no names for them.
#[open_enum(u8)]
pub enum MultiTurn {
    /// It counts none.
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

/// A sensor that is connected to the IMU on the CAN bus. Spec: `CAN_IMU_EXT_SENS_TYPE`. All are of newer firmware.
#[open_enum(u8)]
pub enum CanImuSensor {
    /// None.
    Disabled = 0,
    /// KVH 1725.
    #[wire(spec = "KVH_1725")]
    Kvh1725 = 1,
    /// KVH 1750 with accelerometers to 2 g.
    #[wire(spec = "KVH_1750_ACC_2G")]
    Kvh1750Acc2g = 2,
    /// KVH 1750 with accelerometers to 10 g.
    #[wire(spec = "KVH_1750_ACC_10G")]
    Kvh1750Acc10g = 3,
    /// KVH 1750 with accelerometers to 30 g.
    #[wire(spec = "KVH_1750_ACC_30G")]
    Kvh1750Acc30g = 4,
    /// KVH 1775 with accelerometers to 10 g.
    #[wire(spec = "KVH_1775_ACC_10G")]
    Kvh1775Acc10g = 5,
    /// KVH 1775 with accelerometers to 25 g.
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
