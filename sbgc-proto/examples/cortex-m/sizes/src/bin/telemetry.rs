//! Frames, CMD_REALTIME_DATA_4 read and CMD_CONTROL written, in raw numbers.
#![no_std]
#![no_main]

use sbgc_proto::Message;
use sbgc_proto::commands::{Control, RealtimeData4};
use sbgc_proto::frame::{Decoder, Event, Version, Versions};
use sbgc_proto::units::ControlRate;
use sizes::{receive, send};

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut decoder = Decoder::new(Versions::Both);
    loop {
        let mut event = decoder.push(receive());
        while let Some(found) = event {
            if let Event::Frame { frame, .. } = found
                && frame.id == RealtimeData4::ID.raw()
                && let Ok(data) = RealtimeData4::decode(frame.payload)
            {
                // All of it, not only what is used below.
                core::hint::black_box(&data);
                let control = Control::angles(data.realtime_data_3.target_angle, ControlRate(500));
                let mut out = [0; 32];
                if let Ok(bytes) = control.encode_frame(Version::V2, &mut out) {
                    bytes.iter().copied().for_each(send);
                }
            }
            event = decoder.more();
        }
    }
}
