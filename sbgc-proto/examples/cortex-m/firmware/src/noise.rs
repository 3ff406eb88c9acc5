//! A bad line: bytes that nobody sent, and bytes that are not what was sent.

use embedded_io::{ErrorType, Read, ReadReady};

/// The receiving half with noise on it, or without.
pub struct Noisy<R> {
    receive: R,
    noisy: bool,
    dice: u32,
    /// What comes before the next real byte.
    extra: &'static [u8],
}

/// A false start of a frame of 200 bytes, a whole frame with a bad check, and start bytes.
const EXTRA: [&[u8]; 3] = [&[0x24, 0x20, 0xC8, 0xE8], &[0x3E, 0x43, 0x01, 0x44, 0x11, 0x12], b">$>$"];

impl<R> Noisy<R> {
    pub fn new(receive: R, noisy: bool) -> Self {
        Self { receive, noisy, dice: 0x2545_F491, extra: if noisy { EXTRA[0] } else { &[] } }
    }

    fn roll(&mut self) -> u32 {
        self.dice ^= self.dice << 13;
        self.dice ^= self.dice >> 17;
        self.dice ^= self.dice << 5;
        self.dice
    }
}

impl<R: ErrorType> ErrorType for Noisy<R> {
    type Error = R::Error;
}

impl<R: Read> Read for Noisy<R> {
    fn read(&mut self, out: &mut [u8]) -> Result<usize, Self::Error> {
        if let (Some((&byte, rest)), Some(place)) = (self.extra.split_first(), out.first_mut()) {
            (self.extra, *place) = (rest, byte);
            return Ok(1);
        }
        let count = self.receive.read(out)?;
        if self.noisy {
            for byte in out.iter_mut().take(count) {
                match self.roll() & 0x3FF {
                    0 => *byte ^= 0x10,
                    number @ 1..=3 => {
                        self.extra = EXTRA.get(number as usize - 1).copied().unwrap_or_default();
                    }
                    _ => {}
                }
            }
        }
        Ok(count)
    }
}

impl<R: ReadReady> ReadReady for Noisy<R> {
    fn read_ready(&mut self) -> Result<bool, Self::Error> {
        Ok(!self.extra.is_empty() || self.receive.read_ready()?)
    }
}
