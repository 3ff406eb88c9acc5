//! Commands whose payload nobody has published: bytes under their name.
//!
//! In which directions they go is not known either, so there is a struct for each.

use sbgc_proto_macros::message;

macro_rules! unpublished {
    ($(
        $command:ident:
        $(#[doc = $outgoing_doc:literal])+ $outgoing:ident,
        $(#[doc = $incoming_doc:literal])+ $incoming:ident;
    )*) => { $(
        $(#[doc = $outgoing_doc])+
        #[message($command, outgoing, size = 0..=255)]
        pub struct $outgoing<'a> {
            /// The payload.
            pub data: &'a [u8],
        }

        $(#[doc = $incoming_doc])+
        #[message($command, incoming, size = 0..=255)]
        pub struct $incoming<'a> {
            /// The payload.
            pub data: &'a [u8],
        }
    )* };
}

unpublished! {
    CMD_UART_BYPASS:
        /// Passes bytes through to another serial port; how is not published.
        UartBypassRequest,
        /// Bytes passed through from another serial port; how is not published.
        UartBypass;
    CMD_SERIAL_PROXY:
        /// Makes the board stand between two serial ports; how is not published.
        SerialProxyRequest,
        /// Belongs to a board that stands between two serial ports; what it says is not published.
        SerialProxy;
    CMD_EXT_LICENSE_INFO:
        /// Concerns the license of additional functions; its payload is not published.
        ExtLicenseInfoRequest,
        /// Tells of the license of additional functions; its payload is not published.
        ExtLicenseInfo;
    CMD_OBGC:
        /// For boards with the OpenBGC firmware; its payload is not published.
        ObgcRequest,
        /// From boards with the OpenBGC firmware; its payload is not published.
        Obgc;
    CMD_MAVLINK_INFO:
        /// Concerns the connection by MAVLink; its payload is not published.
        MavlinkInfoRequest,
        /// Tells of the connection by MAVLink; its payload is not published.
        MavlinkInfo;
    CMD_MAVLINK_DEBUG:
        /// Concerns the search for faults in MAVLink; its payload is not published.
        MavlinkDebugRequest,
        /// Helps to find faults in MAVLink; its payload is not published.
        MavlinkDebug;
}
