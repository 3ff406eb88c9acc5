//! Types of the encoder settings.

use sbgc_proto_macros::{bit_fields, open_enum};

/// Encoder model of an axis, and its options.
#[bit_fields(u8)]
pub struct EncoderSelection {
    /// Model and interface of the encoder.
    #[wire(bits = 0..=3)]
    pub encoder_type: EncoderType,
    /// Whether detection of the encoder is skipped.
    #[wire(bits = 4)]
    pub skip_detection: bool,
    /// Whether the encoder is geared to its axis.
    #[wire(bits = 7, spec = "ENCODER_IS_GEARED")]
    pub geared: bool,
}

/// Model and interface of an encoder; 0 for none. Spec: `ENCODER_TYPE`.
#[open_enum(u8, prefix = "ENC_TYPE_")]
pub enum EncoderType {
    /// AMS AS5048A, SPI.
    #[wire(spec = "ENC_TYPE_AS5048A")]
    As5048a = 1,
    /// AMS AS5048B, I2C.
    #[wire(spec = "ENC_TYPE_AS5048B")]
    As5048b = 2,
    /// AMS AS5048, pulse width.
    #[wire(spec = "ENC_TYPE_AS5048_PWM")]
    As5048Pwm = 3,
    /// CUI AMT203, SPI.
    #[wire(spec = "ENC_TYPE_AMT203")]
    Amt203 = 4,
    /// US Digital MA3, 10-bit pulse width.
    #[wire(spec = "ENC_TYPE_MA3_10BIT")]
    Ma3Bits10 = 5,
    /// US Digital MA3, 12-bit pulse width.
    #[wire(spec = "ENC_TYPE_MA3_12BIT")]
    Ma3Bits12 = 6,
    /// Analog encoder.
    Analog = 7,
    /// Encoder of external motor driver 1.
    #[wire(spec = "ENC_TYPE_I2C_DRV1")]
    I2cDriver1 = 8,
    /// Encoder of external motor driver 2.
    #[wire(spec = "ENC_TYPE_I2C_DRV2")]
    I2cDriver2 = 9,
    /// Encoder of external motor driver 3.
    #[wire(spec = "ENC_TYPE_I2C_DRV3")]
    I2cDriver3 = 10,
    /// Encoder of external motor driver 4.
    #[wire(spec = "ENC_TYPE_I2C_DRV4")]
    I2cDriver4 = 11,
    /// AMS AS5600, pulse width.
    #[wire(spec = "ENC_TYPE_AS5600_PWM")]
    As5600Pwm = 12,
    /// AMS AS5600, I2C.
    #[wire(spec = "ENC_TYPE_AS5600_I2C")]
    As5600I2c = 13,
    /// RLS Orbis, SPI.
    RlsOrbis = 14,
    /// RLS Orbis, pulse width. The specification gives the name without `ENC_`.
    RlsOrbisPwm = 15,
}

/// Options for reading an encoder. Spec: `ENCODER_CFG`.
///
/// The names apply to SPI encoders. For encoders of external motor drivers, the number is an encoder type defined by
/// the driver, and the names do not apply.
#[open_enum(u8)]
pub enum EncoderConfig {
    /// SPI at 1 MHz.
    #[wire(spec = "SPI_SPEED_1MHz")]
    Spi1Mhz = 0,
    /// SPI at 2 MHz.
    #[wire(spec = "SPI_SPEED_2MHz")]
    Spi2Mhz = 1,
    /// SPI at 4 MHz.
    #[wire(spec = "SPI_SPEED_4MHz")]
    Spi4Mhz = 2,
    /// SPI at 500 kHz.
    #[wire(spec = "SPI_SPEED_500kHz")]
    Spi500Khz = 3,
}
