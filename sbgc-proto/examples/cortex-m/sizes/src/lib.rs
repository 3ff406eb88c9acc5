//! What the programs share: a byte in, a byte out, and no panic.
#![no_std]

use core::panic::PanicInfo;
use core::ptr::{read_volatile, write_volatile};

/// The data register of the UART of mps2-an386. The programs are only linked, so any register would do.
const UART: *mut u32 = 0x4000_4000 as *mut u32;

/// A byte that the compiler cannot know.
#[inline(always)]
pub fn receive() -> u8 {
    // SAFETY: a register of the UART; reading it has no effect on memory.
    unsafe { read_volatile(UART) as u8 }
}

/// Uses a value in a way that the compiler cannot do without.
#[inline(always)]
pub fn send(byte: u8) {
    // SAFETY: a register of the UART; writing it has no effect on memory.
    unsafe { write_volatile(UART, u32::from(byte)) }
}

/// A panic path that the optimizer left in is an error of the linker: nobody defines the symbol.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn there_is_a_path_to_a_panic() -> !;
    }
    // SAFETY: it is never linked.
    unsafe { there_is_a_path_to_a_panic() }
}
