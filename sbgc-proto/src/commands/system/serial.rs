//! Serial ports of the board and of devices on the CAN bus.

use sbgc_proto_macros::{bit_fields, message, open_enum};

/// Sends bytes to a serial port of a device.
///
/// Available on boards of the extended family only.
#[message(CMD_TRANSPARENT_SAPI, outgoing, size = 1..=255, since = "2.72b0")]
pub struct TransparentSapiRequest<'a> {
    /// Target device and port.
    pub target: SapiTarget,
    /// Payload bytes.
    pub data: &'a [u8],
}

/// Bytes received from a serial port of a device.
///
/// In this direction, only the vendor's libraries have the [`target`](Self::target); a third-party library has none.
#[message(CMD_TRANSPARENT_SAPI, incoming, size = 1..=255, since = "2.72b0")]
pub struct TransparentSapi<'a> {
    /// Target device and port.
    pub target: SapiTarget,
    /// Payload bytes.
    pub data: &'a [u8],
}

/// Serial port of a device.
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
    /// Port number, whose meaning depends on the device.
    #[wire(bits = 0..=1)]
    pub port: u8,
    /// Device. The vendor's libraries list values that match these bits for the board only; the others here are those
    /// of the published definitions.
    #[wire(bits = 2..=5)]
    pub device: SapiDevice,
    /// Whether to wait until the bytes can be sent; otherwise they are dropped if the port is busy.
    #[wire(bits = 6)]
    pub wait: bool,
}

impl SapiTarget {
    /// Creates a target from a device and a port, without waiting.
    pub fn new(device: SapiDevice, port: u8) -> Self {
        Self(0).with_device(device).with_port(port)
    }
}

/// Device with serial ports. Spec: `TRANSPARENT_SAPI_DEVICE`.
#[open_enum(u8)]
pub enum SapiDevice {
    /// SimpleBGC32 board.
    #[wire(spec = "SBGC32")]
    Sbgc32 = 1,
    /// GPS_IMU.
    GpsImu = 2,
    /// Main IMU on the CAN bus.
    CanImuMain = 3,
    /// Frame IMU on the CAN bus.
    CanImuFrame = 4,
    /// Split GPS receiver.
    GpsSplitRcvr = 5,
    /// Serial hub 1 on the CAN bus.
    #[wire(spec = "CAN_SERIAL_HUB1")]
    CanSerialHub1 = 6,
    /// Serial hub 2 on the CAN bus.
    #[wire(spec = "CAN_SERIAL_HUB2")]
    CanSerialHub2 = 7,
    /// CAN motor driver 1.
    #[wire(spec = "CAN_DRV1")]
    CanDrv1 = 8,
    /// CAN motor driver 2.
    #[wire(spec = "CAN_DRV2")]
    CanDrv2 = 9,
    /// CAN motor driver 3.
    #[wire(spec = "CAN_DRV3")]
    CanDrv3 = 10,
    /// CAN motor driver 4.
    #[wire(spec = "CAN_DRV4")]
    CanDrv4 = 11,
}
