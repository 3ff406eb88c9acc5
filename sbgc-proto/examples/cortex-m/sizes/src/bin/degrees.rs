//! The same in degrees: angles read, turned and sent as `f32`.
#![no_std]
#![no_main]

use sbgc_proto::Message;
use sbgc_proto::commands::{Control, RealtimeData4};
use sbgc_proto::frame::{Decoder, Event, Version, Versions};
use sbgc_proto::units::{Angle, ControlRate};
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
                let turned = |angle: Angle| Angle::from_degrees(angle.degrees() * 0.5 + 1.0);
                let speed = ControlRate::from_degrees_per_second(30.0);
                let control = Control::angles(data.realtime_data_3.target_angle.map(turned), speed);
                let mut out = [0; 32];
                if let Ok(bytes) = control.encode_frame(Version::V2, &mut out) {
                    bytes.iter().copied().for_each(send);
                }
            }
            event = decoder.more();
        }
    }
}
