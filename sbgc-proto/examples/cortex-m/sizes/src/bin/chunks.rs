//! Frames of both versions out of what DMA has brought.
#![no_std]
#![no_main]

use sbgc_proto::frame::{Decoder, Event, Versions};
use sizes::{receive, send};

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut decoder = Decoder::new(Versions::Both);
    loop {
        let chunk = [receive(), receive(), receive(), receive(), receive(), receive(), receive(), receive()];
        let mut rest = &chunk[..usize::from(receive() & 7)];
        while let Some(event) = decoder.next(&mut rest) {
            if let Event::Frame { frame, .. } = event {
                send(frame.id);
                frame.payload.iter().copied().for_each(send);
            }
        }
    }
}
