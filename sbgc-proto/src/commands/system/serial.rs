//! Serial ports of devices on the CAN bus.

use sbgc_proto_macros::{bit_fields, message, open_enum};

/// Sends bytes to a serial port of a device on the CAN bus.
///
/// Only boards of the extended family can.
#[message(CMD_TRANSPARENT_SAPI, outgoing, size = 1..=255, since = "2.72b0")]
pub struct TransparentSapiRequest<'a> {
    /// Target device and port.
    pub target: SapiTarget,
    /// Payload bytes.
    pub data: &'a [u8],
}

/// Bytes that came from a serial port of a device on the CAN bus.
///
/// The [`target`](Self::target) in this direction is that of the vendor's libraries; a third-party library has none.
#[message(CMD_TRANSPARENT_SAPI, incoming, size = 1..=255, since = "2.72b0")]
pub struct TransparentSapi<'a> {
    /// Target device and port.
    pub target: SapiTarget,
    /// Payload bytes.
    pub data: &'a [u8],
}

/// A serial port of a device.
///
/// | device | ports |
/// | --- | --- |
/// | the board itself | 0 UART1, 1 RC_SERIAL, 2 UART2, 3 USB |
/// | inertial measurement units | 0 UART1, 1 UART2 |
/// | split GPS receiver | 0 to 2 UART1 to UART3, 3 the receiver |
/// | serial hubs | 1 to 3 SERIAL1 to SERIAL3 |
/// | motor drivers | 0 UART2 |
#[bit_fields(u8)]
pub struct SapiTarget {
    /// The port; what the number means depends on the device.
    #[wire(bits = 0..=1)]
    pub port: u8,
    /// The device. The vendor's libraries list numbers that stand in these bits for the board only; for the
    /// others they take those of the published definitions, which are the ones here.
    #[wire(bits = 2..=5)]
    pub device: SapiDevice,
    /// Whether to wait until the bytes can be sent; otherwise they are dropped when the port is busy.
    #[wire(bits = 6)]
    pub wait: bool,
}

impl SapiTarget {
    /// A port of a device, without waiting.
    pub fn new(device: SapiDevice, port: u8) -> Self {
        Self(0).with_device(device).with_port(port)
    }
}

/// A device with serial ports. Spec: `TRANSPARENT_SAPI_DEVICE`.
#[open_enum(u8)]
pub enum SapiDevice {
    /// The board itself.
    #[wire(spec = "SBGC32")]
    Sbgc32 = 1,
    /// The GPS and IMU.
    GpsImu = 2,
    /// The main IMU on the CAN bus.
    CanImuMain = 3,
    /// The IMU of the frame on the CAN bus.
    CanImuFrame = 4,
    /// The split GPS receiver.
    GpsSplitRcvr = 5,
    /// The first serial hub on the CAN bus.
    #[wire(spec = "CAN_SERIAL_HUB1")]
    CanSerialHub1 = 6,
    /// The second serial hub on the CAN bus.
    #[wire(spec = "CAN_SERIAL_HUB2")]
    CanSerialHub2 = 7,
    /// The first motor driver on the CAN bus.
    #[wire(spec = "CAN_DRV1")]
    CanDrv1 = 8,
    /// The second motor driver on the CAN bus.
    #[wire(spec = "CAN_DRV2")]
    CanDrv2 = 9,
    /// The third motor driver on the CAN bus.
    #[wire(spec = "CAN_DRV3")]
    CanDrv3 = 10,
    /// The fourth motor driver on the CAN bus.
    #[wire(spec = "CAN_DRV4")]
    CanDrv4 = 11,
}
