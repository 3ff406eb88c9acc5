//! Monitoring commands whose payload nobody has published: bytes under their name, in both directions, since it is not
//! known which way they go.

use sbgc_proto_macros::message;

/// Asks what the system does; its payload is not published.
#[message(CMD_SYSTEM_STATE, outgoing, size = 0..=255)]
#[derive(Copy)]
pub struct SystemStateRequest<'a> {
    /// The payload.
    pub data: &'a [u8],
}

/// What the system does; its payload is not published. It is not [`SystemStateBlock`](super::SystemStateBlock).
#[message(CMD_SYSTEM_STATE, incoming, size = 0..=255)]
#[derive(Copy)]
pub struct SystemState<'a> {
    /// The payload.
    pub data: &'a [u8],
}

/// Asks for real-time data of CAN motor drivers; its payload is not published.
#[message(CMD_REALTIME_DATA_CAN_DRV, outgoing, size = 0..=255)]
#[derive(Copy)]
pub struct RealtimeDataCanDrvRequest<'a> {
    /// The payload.
    pub data: &'a [u8],
}

/// Real-time data of CAN motor drivers; its payload is not published.
#[message(CMD_REALTIME_DATA_CAN_DRV, incoming, size = 0..=255)]
#[derive(Copy)]
pub struct RealtimeDataCanDrv<'a> {
    /// The payload.
    pub data: &'a [u8],
}
