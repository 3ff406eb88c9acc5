//! Sizes of types, as sizes of symbols; nothing runs here.
#![no_std]
#![no_main]

use sbgc_proto::commands::{Control, RealtimeData4};
use sbgc_proto::frame::Decoder;
use sbgc_proto::link::Link;
use sbgc_proto::{IncomingCommand, OutgoingCommand};
use sizes::send;

#[used]
#[unsafe(no_mangle)]
static SIZE_OF_DECODER: [u8; size_of::<Decoder>()] = [0; size_of::<Decoder>()];
#[used]
#[unsafe(no_mangle)]
static SIZE_OF_LINK_64: [u8; size_of::<Link<64>>()] = [0; size_of::<Link<64>>()];
#[used]
#[unsafe(no_mangle)]
static SIZE_OF_REALTIME_DATA_4: [u8; size_of::<RealtimeData4>()] = [0; size_of::<RealtimeData4>()];
#[used]
#[unsafe(no_mangle)]
static SIZE_OF_CONTROL: [u8; size_of::<Control>()] = [0; size_of::<Control>()];
#[used]
#[unsafe(no_mangle)]
static SIZE_OF_INCOMING_COMMAND: [u8; size_of::<IncomingCommand<'_>>()] =
    [0; size_of::<IncomingCommand<'_>>()];
#[used]
#[unsafe(no_mangle)]
static SIZE_OF_OUTGOING_COMMAND: [u8; size_of::<OutgoingCommand<'_>>()] =
    [0; size_of::<OutgoingCommand<'_>>()];

#[cortex_m_rt::entry]
fn main() -> ! {
    loop {
        send(0);
    }
}
