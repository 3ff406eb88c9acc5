//! The I2C bus: an EEPROM at 0x50 and an inertial sensor at 0x68. Both ports lead to it, since boards differ in what
//! stands on which.
//!
//! Real: the sensor has the register file of the usual sensors of this kind: its identity in register 0x75, 14 bytes of
//! measurements from 0x3B on. The EEPROM is that of the board, 256 bytes of which a register address of one byte
//! reaches.

use sbgc_proto::commands::I2cDevice;

use super::eeprom::Eeprom;

/// The address of the EEPROM, and of the sensor.
const EEPROM: u8 = 0x50;
const SENSOR: u8 = 0x68;

/// The register with the identity of the sensor, and what it holds.
const WHO_AM_I: usize = 0x75;
const IDENTITY: u8 = 0x68;

/// The first register with measurements.
const MEASUREMENTS: usize = 0x3B;

#[derive(Debug)]
pub(super) struct Bus {
    sensor: [u8; 128],
}

impl Bus {
    pub(super) fn new() -> Self {
        let mut sensor = [0; 128];
        if let Some(place) = sensor.get_mut(WHO_AM_I) {
            *place = IDENTITY;
        }
        Self { sensor }
    }

    /// Puts a measurement into the registers of the sensor, high byte first.
    pub(super) fn measure(&mut self, acc: [i16; 3], temperature: i16, gyro: [i16; 3]) {
        let words = acc.into_iter().chain([temperature]).chain(gyro);
        let bytes = words.flat_map(i16::to_be_bytes);
        for (place, byte) in self.sensor.iter_mut().skip(MEASUREMENTS).zip(bytes) {
            *place = byte;
        }
    }

    /// Reads registers; `None` if no device answers.
    pub(super) fn read(
        &self,
        eeprom: &Eeprom,
        sensor: bool,
        device: I2cDevice,
        register: u8,
        length: u8,
    ) -> Option<Vec<u8>> {
        let start = usize::from(register);
        let memory = match device.address() {
            EEPROM => eeprom.read(0, 256)?,
            SENSOR if sensor => self.sensor.as_slice(),
            _ => return None,
        };
        // Addresses start again after the last one.
        Some(memory.iter().cycle().skip(start).take(length.into()).copied().collect())
    }

    /// Writes registers; false if no device answers.
    pub(super) fn write(
        &mut self,
        eeprom: &mut Eeprom,
        sensor: bool,
        device: I2cDevice,
        register: u8,
        data: &[u8],
    ) -> bool {
        match device.address() {
            EEPROM => {
                for (offset, byte) in data.iter().enumerate() {
                    eeprom.write((usize::from(register) + offset) % 256, &[*byte]);
                }
                true
            }
            SENSOR if sensor => {
                for (place, byte) in self.sensor.iter_mut().skip(register.into()).zip(data) {
                    *place = *byte;
                }
                true
            }
            _ => false,
        }
    }
}
