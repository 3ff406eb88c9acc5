//! Runs in qemu and prints instructions and stack: with `-icount shift=0` an instruction takes a nanosecond, and the
//! timer of mps2-an386 ticks once in 40.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_semihosting::{debug, hprintln};
use sbgc_proto::commands::RealtimeData4;
use sbgc_proto::frame::{Decoder, MAX_FRAME, Version, Versions, encode_into};
use sbgc_proto::units::Angle;
use sbgc_proto::{CommandId, IncomingCommand, Message, OutgoingCommand};

/// Nothing here can panic in a way that matters: a measurement is all that is lost.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        debug::exit(debug::EXIT_FAILURE);
    }
}

const INSTRUCTIONS_PER_TICK: u32 = 40;
const ROUNDS: u32 = 400;

#[cortex_m_rt::entry]
fn main() -> ! {
    if let Some(mut peripherals) = cortex_m::Peripherals::take() {
        peripherals.SYST.set_clock_source(SystClkSource::Core);
        peripherals.SYST.set_reload(0x00FF_FFFF);
        peripherals.SYST.clear_current();
        peripherals.SYST.enable_counter();
    }
    for (version, name) in [(Version::V1, "version 1"), (Version::V2, "version 2")] {
        let mut out = [0; MAX_FRAME];
        for size in [2, 124] {
            let Ok(frame) = encode_into(version, 25, &[7; 124][..size], &mut out) else { continue };
            let mut decoder = Decoder::new(Versions::Both);
            let count = instructions(|| {
                for &byte in frame {
                    black_box(decoder.push(byte).is_some());
                }
            });
            hprintln!(
                "push, {}, {} bytes of payload: {} instructions per byte",
                name,
                size,
                count / frame.len() as u32
            );
        }
        // Behind a false start that announces 255 bytes, the last of them.
        let mut waiting = Decoder::new(Versions::Both);
        let start = [version.start_byte(), 0x40, 0xFF, 0x3F];
        for index in 0..version.frame_len(255) - 1 {
            waiting.push(start[index & 3]);
        }
        let copies = instructions(|| {
            black_box(&mut waiting.clone());
        });
        let both = instructions(|| {
            let mut decoder = waiting.clone();
            black_box(black_box(&mut decoder).push(0).is_some());
        });
        hprintln!("push, {}, worst byte: {} instructions", name, both.saturating_sub(copies));
    }
    let count = instructions(|| {
        black_box(&RealtimeData4::decode(black_box(&[3; 124])));
    });
    hprintln!("CMD_REALTIME_DATA_4 decoded: {} instructions", count);
    // The loop around a call takes some, too.
    let empty = instructions(|| {
        black_box(black_box(Angle(4321)));
    });
    let count = instructions(|| {
        black_box(black_box(Angle(4321)).degrees());
    });
    hprintln!("an angle to degrees: {} instructions", count.saturating_sub(empty));
    let count = instructions(|| {
        black_box(Angle::from_degrees(black_box(94.9)));
    });
    hprintln!("degrees to an angle: {} instructions", count.saturating_sub(empty));
    let count = instructions(|| {
        black_box(Angle::from_millidegrees(black_box(94_900)));
    });
    hprintln!("thousandths of a degree to an angle: {} instructions", count.saturating_sub(empty));
    hprintln!("stack, decoder: {} bytes", stack(push));
    hprintln!("stack, incoming: {} bytes", stack(incoming));
    hprintln!("stack, outgoing: {} bytes", stack(outgoing));
    debug::exit(debug::EXIT_SUCCESS);
    loop {}
}

/// Instructions of one call, from many.
fn instructions(mut call: impl FnMut()) -> u32 {
    let start = SYST::get_current();
    for _ in 0..ROUNDS {
        call();
    }
    (start.wrapping_sub(SYST::get_current()) & 0x00FF_FFFF) * INSTRUCTIONS_PER_TICK / ROUNDS
}

#[inline(never)]
fn push() {
    let mut decoder = Decoder::new(Versions::Both);
    for byte in *b"\x24\x52\x01\x53\x01\x12\x3D" {
        black_box(decoder.push(byte).is_some());
    }
}

#[inline(never)]
fn incoming() {
    for id in 0..=255 {
        if let Ok((message, _)) = IncomingCommand::decode(CommandId::from_raw(id), black_box(&[0; 255])) {
            black_box(&message);
        }
    }
}

#[inline(never)]
fn outgoing() {
    for id in 0..=255 {
        if let Ok((message, _)) = OutgoingCommand::decode(CommandId::from_raw(id), black_box(&[0; 255])) {
            black_box(&message);
        }
    }
}

/// How much stack a call takes: what is below is painted before, and looked at after it.
#[inline(never)]
fn stack(call: fn()) -> u32 {
    const DEPTH: usize = 16 * 1024;
    const PAINT: u32 = 0xA5A5_5A5A;
    let here = cortex_m::register::msp::read() as usize & !3;
    let cells = || (1..DEPTH / 4).map(|index| (here - DEPTH + 4 * index) as *mut u32);
    let gap = 64 / 4;
    for cell in cells().take(DEPTH / 4 - gap) {
        // SAFETY: free stack, far enough below what this function uses.
        unsafe { cell.write_volatile(PAINT) };
    }
    call();
    // SAFETY: the same memory.
    let untouched = cells().take_while(|cell| unsafe { cell.read_volatile() } == PAINT).count();
    (DEPTH - 4 * untouched) as u32
}
