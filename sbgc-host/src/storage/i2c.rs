//! Registers of devices on the board's I2C buses.

use sbgc_proto::commands::{I2cDevice, I2cReadRegBufRequest, I2cWriteRegBuf};

use crate::{Error, Gimbal, Result};

/// The longest write that the vendor's library sends.
const MAX_WRITE: usize = 240;

impl Gimbal {
    /// Reads bytes from a register of a device, 1 to 255.
    ///
    /// # Errors
    /// If the length is 0, if the device does not answer, or if the board does not.
    pub async fn i2c_read(&self, device: I2cDevice, register: u8, length: u8) -> Result<Vec<u8>> {
        if length == 0 {
            return Err(bad_length(0, 255));
        }
        let request = I2cReadRegBufRequest { device_addr: device, reg_addr: register, data_len: length };
        let answer = self.exchange(&request).await?;
        let data = answer.get().data;
        if data.len() != usize::from(length) {
            return Err(Error::WrongLength { what: "I2C data", expected: length.into(), got: data.len() });
        }
        Ok(data.to_vec())
    }

    /// Writes bytes to a register of a device, 1 to 240.
    ///
    /// # Errors
    /// If the length is out of range, if the device does not take it, or if the board does not answer. Nothing is
    /// written again by itself.
    pub async fn i2c_write(&self, device: I2cDevice, register: u8, data: &[u8]) -> Result<()> {
        if !(1..=MAX_WRITE).contains(&data.len()) {
            return Err(bad_length(data.len(), 240));
        }
        let write = I2cWriteRegBuf { device_addr: device, reg_addr: register, data };
        self.confirm(&write).await.map(drop)
    }
}

fn bad_length(length: usize, maximum: u8) -> Error {
    Error::OutOfRange {
        what: "length of I2C data",
        value: f64::from(u32::try_from(length).unwrap_or(u32::MAX)),
        minimum: 1.0,
        maximum: maximum.into(),
        unit: "bytes",
    }
}
