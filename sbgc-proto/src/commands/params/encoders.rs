//! Values of encoders.

use sbgc_proto_macros::{bit_fields, open_enum};

/// Encoder type of an axis, and its options.
#[bit_fields(u8)]
pub struct EncoderSelection {
    /// Model and interface.
    #[wire(bits = 0..=3)]
    pub encoder_type: EncoderType,
    /// Whether the board assumes the sensor instead of detecting it.
    #[wire(bits = 4)]
    pub skip_detection: bool,
    /// Whether there are gears between it and the axis.
    #[wire(bits = 7, spec = "ENCODER_IS_GEARED")]
    pub geared: bool,
}

/// Model and interface of an encoder; 0 is none. Spec: `ENCODER_TYPE`.
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
    /// US Digital MA3, pulse width of 10 bits.
    #[wire(spec = "ENC_TYPE_MA3_10BIT")]
    Ma3Bits10 = 5,
    /// US Digital MA3, pulse width of 12 bits.
    #[wire(spec = "ENC_TYPE_MA3_12BIT")]
    Ma3Bits12 = 6,
    /// Analog.
    Analog = 7,
    /// That of external motor driver 1.
    #[wire(spec = "ENC_TYPE_I2C_DRV1")]
    I2cDriver1 = 8,
    /// That of external motor driver 2.
    #[wire(spec = "ENC_TYPE_I2C_DRV2")]
    I2cDriver2 = 9,
    /// That of external motor driver 3.
    #[wire(spec = "ENC_TYPE_I2C_DRV3")]
    I2cDriver3 = 10,
    /// That of external motor driver 4.
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
    /// RLS Orbis, pulse width. The specification prints the name without `ENC_`.
    RlsOrbisPwm = 15,
}

/// Options for reading an encoder. Spec: `ENCODER_CFG`.
///
/// The names are for encoders on SPI. For those of external motor drivers the number is the driver's own type of
/// encoder, and the names mean nothing.
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
