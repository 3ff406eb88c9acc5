//! Frames of both versions out of single bytes.
#![no_std]
#![no_main]

use sbgc_proto::frame::{Decoder, Event, Versions};
use sizes::{receive, send};

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut decoder = Decoder::new(Versions::Both);
    loop {
        let mut event = decoder.push(receive());
        while let Some(found) = event {
            if let Event::Frame { frame, .. } = found {
                send(frame.id);
                frame.payload.iter().copied().for_each(send);
            }
            event = decoder.more();
        }
    }
}
