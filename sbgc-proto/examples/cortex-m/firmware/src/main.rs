//! Finds a board, listens to it, moves the camera and watches it arrive.
//!
//! It runs in qemu with the emulated UART on `sbgc sim`; `run.sh` beside this workspace does all of that. What it does
//! is chosen by words on its command line: `v1` for frames of version 1 alone, `noise` for a bad line.
#![no_std]
#![no_main]

mod clock;
mod mission;
mod noise;
mod uart;

use core::panic::PanicInfo;

use cortex_m_semihosting::{debug, hprintln};
#[cfg(feature = "defmt")]
use defmt_semihosting as _;
use sbgc_proto::frame::{Version, Versions};
use sbgc_proto::link::port::Port;
use sbgc_proto::link::{Link, Settings};

use crate::noise::Noisy;
use crate::uart::Uart;

#[cortex_m_rt::entry]
fn main() -> ! {
    let clock = clock::start();
    let (receive, transmit) = Uart::halves();
    let receive = Noisy::new(receive, is_asked("noise"));
    let versions = if is_asked("v1") { Versions::Only(Version::V1) } else { Versions::Both };
    let settings = Settings { versions, attempts: 10, ..Settings::DEFAULT };
    let mut port = Port::new(Link::<128>::new(settings), receive, transmit, clock);
    match mission::fly(&mut port) {
        Ok(()) => {
            #[cfg(feature = "defmt")]
            defmt::info!("arrived; {}", port.link().decoder().counters());
            hprintln!("arrived: {:?}", port.link().decoder().counters());
            debug::exit(debug::EXIT_SUCCESS);
        }
        Err(failure) => {
            hprintln!("failed: {}", failure.as_str());
            debug::exit(debug::EXIT_FAILURE);
        }
    }
    loop {
        cortex_m::asm::wfi();
    }
}

/// Whether the word stands on the command line that qemu was given.
fn is_asked(word: &str) -> bool {
    let mut line = [0_u8; 64];
    let mut block = [line.as_mut_ptr() as usize, line.len()];
    // SAFETY: the debugger writes into `line`, at most as many bytes as the block says, and their number into the block.
    let failed = unsafe {
        cortex_m_semihosting::syscall1(cortex_m_semihosting::nr::GET_CMDLINE, block.as_mut_ptr() as usize)
    };
    let line = line.get(..block[1]).unwrap_or_default();
    failed == 0 && line.split(|byte| *byte == b' ').any(|part| part == word.as_bytes())
}

/// defmt's own code may panic.
#[cfg(feature = "defmt")]
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {
        debug::exit(debug::EXIT_FAILURE);
    }
}

/// A panic path that the optimizer left in is an error of the linker: nobody defines the symbol.
#[cfg(not(feature = "defmt"))]
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn there_is_a_path_to_a_panic() -> !;
    }
    // SAFETY: it is never linked.
    unsafe { there_is_a_path_to_a_panic() }
}
