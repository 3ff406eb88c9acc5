//! A program without std, allocator or panic runtime that asks for angles, reads them and moves the gimbal.
//!
//! It is linked, not run: a symbol of std or of an allocator anywhere in the library would be missing here.
#![no_std]
#![no_main]

use core::panic::PanicInfo;

use sbgc_proto::Message;
use sbgc_proto::commands::{Angles, Control, GetAngles};
use sbgc_proto::frame::{Decoder, Event, Version, Versions};
use sbgc_proto::units::ControlRate;

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}

/// The entry point where an operating system starts the program, and on bare metal.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    let mut decoder = Decoder::new(Versions::Both);
    let mut transmit = [0; 64];
    loop {
        let received = core::hint::black_box([0_u8; 16]);
        let length =
            if cfg!(feature = "three-commands") { turn(&mut decoder, &received, &mut transmit) } else { 0 };
        core::hint::black_box((length, &transmit));
    }
}

/// Takes what came in and says what goes out.
fn turn(decoder: &mut Decoder, mut received: &[u8], transmit: &mut [u8]) -> usize {
    while let Some(event) = decoder.next(&mut received) {
        let Event::Frame { frame, .. } = event else { continue };
        if frame.id != Angles::ID.raw() {
            continue;
        }
        if let Ok(angles) = Angles::decode(frame.payload) {
            let control = Control::angles(angles.axes.map(|axis| axis.target_angle), ControlRate::default());
            return control.encode_frame(Version::V2, transmit).map_or(0, <[u8]>::len);
        }
    }
    GetAngles.encode_frame(Version::V2, transmit).map_or(0, <[u8]>::len)
}
