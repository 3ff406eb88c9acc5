//! Frames, and every message that comes from a board.
#![no_std]
#![no_main]

use sbgc_proto::IncomingCommand;
use sbgc_proto::frame::{Decoder, Event, Versions};
use sizes::{receive, send};

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut decoder = Decoder::new(Versions::Both);
    loop {
        let mut event = decoder.push(receive());
        while let Some(found) = event {
            if let Event::Frame { frame, .. } = found
                && let Ok((message, _)) = IncomingCommand::from_frame(&frame)
            {
                core::hint::black_box(&message);
                send(1);
            }
            event = decoder.more();
        }
    }
}
