//! `sbgc i2c`: registers of devices on the board's buses.

use clap::{Args, Subcommand, ValueEnum};
use sbgc_proto::commands::{I2cDevice, I2cPort, I2cWriteRegBuf};
use serde_json::json;

use super::bytes::dump;
use crate::connect::with_board;
use crate::failure::Failure;
use crate::options::Global;
use crate::output::Output;
use crate::{act, talk, values};

const EXAMPLES: &str = "Examples:
  sbgc i2c read 0x50 0 16 --bus internal
  sbgc --dry-run i2c write 0x68 0x6b 00";

/// Read and write registers of I2C devices
///
/// Addresses have 7 bits.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct I2c {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Print bytes of a register
    #[command(after_help = "Examples:
  sbgc i2c read 0x50 0 16 --bus internal
  sbgc i2c read 0x50 0x10 4 --bus internal --json")]
    Read {
        #[command(flatten)]
        place: Place,
        /// Number of bytes, 1 to 255
        #[arg(value_parser = length)]
        length: u8,
    },
    /// Write bytes to a register (asks first)
    #[command(after_help = "Examples:
  sbgc i2c write 0x68 0x6b 00 --dry-run
  sbgc --json --dry-run i2c write 0x68 0x6b 80")]
    Write {
        #[command(flatten)]
        place: Place,
        /// Bytes in hex, 1 to 240 of them
        #[arg(value_name = "HEX")]
        data: String,
    },
}

#[derive(Args, Debug)]
struct Place {
    /// Address of the device, 0 to 0x7f
    #[arg(value_parser = address)]
    address: u8,
    /// Register, 0 to 0xff
    #[arg(value_parser = register)]
    register: u8,
    /// Bus of the device
    #[arg(long, value_enum, default_value_t = Bus::External)]
    bus: Bus,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Bus {
    /// The bus of the sensors
    External,
    /// The bus of the EEPROM
    Internal,
}

fn address(text: &str) -> Result<u8, String> {
    within(text, 0, 0x7F)
}

fn register(text: &str) -> Result<u8, String> {
    within(text, 0, 0xFF)
}

fn length(text: &str) -> Result<u8, String> {
    within(text, 1, 0xFF)
}

fn within(text: &str, minimum: u8, maximum: u8) -> Result<u8, String> {
    match u8::try_from(values::number(text)?) {
        Ok(value) if (minimum..=maximum).contains(&value) => Ok(value),
        _ => Err(format!("{text} is out of range; expected {minimum} to {maximum}")),
    }
}

impl Place {
    fn device(&self) -> I2cDevice {
        let port = match self.bus {
            Bus::External => I2cPort::External,
            Bus::Internal => I2cPort::Internal,
        };
        I2cDevice::new(port, self.address)
    }
}

impl I2c {
    pub(crate) async fn run(self, global: &Global, output: &mut Output) -> Result<(), Failure> {
        match self.what {
            What::Read { place, length } => {
                let data = with_board(global, async |gimbal, _| {
                    Ok(gimbal.i2c_read(place.device(), place.register, length).await?)
                })
                .await?;
                if output.is_json() {
                    return show(output, &place, &data);
                }
                Ok(dump(output, place.register.into(), &data)?)
            }
            What::Write { place, data } => write(global, output, &place, &data).await,
        }
    }
}

async fn write(global: &Global, output: &mut Output, place: &Place, data: &str) -> Result<(), Failure> {
    let data = values::bytes(data).map_err(Failure::Usage)?;
    if !(1..=240).contains(&data.len()) {
        return Err(Failure::Usage(format!("{} bytes are out of range; expected 1 to 240", data.len())));
    }
    with_board(global, async |gimbal, _| {
        let Place { address, register, .. } = *place;
        let command = I2cWriteRegBuf { device_addr: place.device(), reg_addr: register, data: &data };
        if global.dry_run {
            return act::show(output, gimbal.version(), &command);
        }
        let count = data.len();
        talk::say(format_args!("{count} bytes go to register {register:#04x} of device {address:#04x}"));
        act::ask(global, "Write them?").await?;
        gimbal.i2c_write(place.device(), register, &data).await?;
        if output.is_json() {
            return show(output, place, &data);
        }
        Ok(output.line(format_args!("{count} bytes written"))?)
    })
    .await
}

fn show(output: &mut Output, place: &Place, data: &[u8]) -> Result<(), Failure> {
    Ok(output.object(&json!({
        "address": place.address, "register": place.register, "length": data.len(), "data": hex::encode(data),
    }))?)
}
