//! Access to registers of devices on the board's I2C buses.

use sbgc_proto_macros::{bit_fields, message, open_enum};

use crate::commands::Confirm;

/// Writes to a register of an I2C device.
///
/// Confirmed once the write has succeeded.
#[message(CMD_I2C_WRITE_REG_BUF, outgoing, size = 2..=255, answer = Confirm)]
pub struct I2cWriteRegBuf<'a> {
    /// Target device.
    pub device_addr: I2cDevice,
    /// Register to write.
    pub reg_addr: u8,
    /// Data to write. The vendor's library sends 1 to 240 bytes.
    pub data: &'a [u8],
}

/// Reads from a register of an I2C device.
///
/// Answered once the read has succeeded.
#[message(CMD_I2C_READ_REG_BUF, outgoing, size = 3, answer = I2cReadRegBuf<'answer>)]
pub struct I2cReadRegBufRequest {
    /// Target device.
    pub device_addr: I2cDevice,
    /// Register to read.
    pub reg_addr: u8,
    /// Number of bytes to read.
    #[wire(unit = "byte", range = 1..=255)]
    pub data_len: u8,
}

/// Data read from a register of an I2C device.
#[message(CMD_I2C_READ_REG_BUF, incoming, size = 1..=255)]
pub struct I2cReadRegBuf<'a> {
    /// Data, as many bytes as were requested.
    pub data: &'a [u8],
}

/// Device on one of the I2C buses.
///
/// ```
/// use sbgc_proto::commands::{I2cDevice, I2cPort};
///
/// assert_eq!(I2cDevice::new(I2cPort::External, 0x68), I2cDevice(0xD0));
/// ```
#[bit_fields(u8)]
pub struct I2cDevice {
    /// Bus that the device is connected to.
    #[wire(bits = 0)]
    pub port: I2cPort,
    /// 7-bit address of the device.
    #[wire(bits = 1..=7)]
    pub address: u8,
}

impl I2cDevice {
    /// Creates a device from its bus and 7-bit address.
    pub fn new(port: I2cPort, address: u8) -> Self {
        Self(0).with_port(port).with_address(address)
    }
}

/// I2C bus.
#[open_enum(u8)]
pub enum I2cPort {
    /// External bus, which connects the IMUs.
    External = 0,
    /// Internal bus, which connects the EEPROM.
    Internal = 1,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Message;

    /// Made by hand from the layout.
    #[test]
    fn the_lowest_bit_of_the_address_is_the_bus() {
        let mut buffer = [0; 255];
        let request = I2cReadRegBufRequest {
            device_addr: I2cDevice::new(I2cPort::Internal, 0x50),
            reg_addr: 6,
            data_len: 2,
        };
        assert_eq!(request.encode(&mut buffer), Ok(&[0xA1, 6, 2][..]));
        assert_eq!(I2cReadRegBufRequest::decode(&[0xA1, 6, 2]), Ok(request));

        let payload = [0xDF, 0xD5, 1, 2, 3];
        let write = I2cWriteRegBuf::decode(&payload).unwrap();
        assert_eq!((write.device_addr.port(), write.device_addr.address()), (I2cPort::Internal, 0x6F));
        assert_eq!((write.reg_addr, write.data), (0xD5, &[1, 2, 3][..]));
        assert_eq!(write.encode(&mut buffer), Ok(&payload[..]));
        assert_eq!(I2cReadRegBuf::decode(&[7]), Ok(I2cReadRegBuf { data: &[7] }));
    }
}
