//! The first UART of the two boards, asked byte by byte.

use core::convert::Infallible;
use core::ptr::{read_volatile, write_volatile};

use embedded_io::{ErrorType, Read, ReadReady, Write};

#[cfg(not(feature = "lm3s6965evb"))]
mod registers {
    //! CMSDK UART 0 of mps2-an386.
    pub const BASE: usize = 0x4000_4000;
    pub const DATA: usize = 0x00;
    pub const STATE: usize = 0x04;
    /// What `STATE` shows while there is a byte.
    pub const RECEIVED: (u32, u32) = (1 << 1, 1 << 1);
    /// What `STATE` shows while there is room for one.
    pub const FREE: (u32, u32) = (1 << 0, 0);
    /// Bit rate (the least that qemu takes: it knows no time on the line), then both halves on.
    pub const START: [(usize, u32); 2] = [(0x10, 16), (0x08, 3)];
}

#[cfg(feature = "lm3s6965evb")]
mod registers {
    //! PL011 UART 0 of lm3s6965evb.
    pub const BASE: usize = 0x4000_C000;
    pub const DATA: usize = 0x00;
    pub const STATE: usize = 0x18;
    /// What `STATE` shows while there is a byte.
    pub const RECEIVED: (u32, u32) = (1 << 4, 0);
    /// What `STATE` shows while there is room for one.
    pub const FREE: (u32, u32) = (1 << 5, 0);
    /// Eight bits, no parity, queues on; then both halves on.
    pub const START: [(usize, u32); 2] = [(0x2C, 0x70), (0x30, 0x301)];
}

fn read(offset: usize) -> u32 {
    // SAFETY: a register of the UART, which nothing else here uses.
    unsafe { read_volatile((registers::BASE + offset) as *const u32) }
}

fn write(offset: usize, value: u32) {
    // SAFETY: a register of the UART, which nothing else here uses.
    unsafe { write_volatile((registers::BASE + offset) as *mut u32, value) }
}

fn shows((mask, value): (u32, u32)) -> bool {
    read(registers::STATE) & mask == value
}

/// The UART.
pub struct Uart;

/// Its receiving half.
pub struct Receive;

/// Its sending half.
pub struct Transmit;

impl Uart {
    /// Switches it on.
    pub fn halves() -> (Receive, Transmit) {
        for (offset, value) in registers::START {
            write(offset, value);
        }
        (Receive, Transmit)
    }
}

impl ErrorType for Receive {
    type Error = Infallible;
}

impl ErrorType for Transmit {
    type Error = Infallible;
}

impl ReadReady for Receive {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(shows(registers::RECEIVED))
    }
}

impl Read for Receive {
    fn read(&mut self, out: &mut [u8]) -> Result<usize, Infallible> {
        let Some(place) = out.first_mut() else { return Ok(0) };
        while !shows(registers::RECEIVED) {}
        *place = read(registers::DATA).to_le_bytes()[0];
        Ok(1)
    }
}

impl Write for Transmit {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        let Some(&byte) = bytes.first() else { return Ok(0) };
        while !shows(registers::FREE) {}
        write(registers::DATA, byte.into());
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}
