//! Checksums of frames.
//!
//! # The CRC without a table
//! The polynomial of version 2 is `x^16 + x^15 + x^2 + 1 = (x + 1) (x^15 + x + 1)`. Both factors are so sparse that
//! shifts do the work of a table: modulo the first, a message is the parity of its bits; modulo the second, called Q
//! below, `x^15 = x + 1`, and by squaring `x^30 = x^2 + 1`, `x^32 = x^4 + x^2`, … `x^960 = x^64 + 1`. So 4 bytes cost
//! two shifts, and whole words of a long message move to where they weigh the same. At the end both remainders are put
//! together.
//!
//! That is faster than a table of 512 bytes on a microcontroller, as fast as one of 8 KiB on a computer, and takes no
//! room in flash or cache, so there is nothing to choose between.

/// Header checksum of both versions: id plus payload size, modulo 256.
pub const fn header_sum(id: u8, size: u8) -> u8 {
    id.wrapping_add(size)
}

/// Payload checksum of version 1: the sum of the payload bytes, modulo 256.
pub fn payload_sum(payload: &[u8]) -> u8 {
    payload.iter().fold(0, |sum, &byte| sum.wrapping_add(byte))
}

/// CRC16 of version 2, which covers all bytes from the id to the last payload byte.
///
/// In the terms of the Rocksoft model: polynomial 0x8005, initial value 0, input reflected, output not reflected, no
/// final XOR. It is CRC-16/ARC with its result bit-reversed and has no name in the usual catalogues.
///
/// ```
/// use sbgc_proto::frame::checksum::crc16;
///
/// assert_eq!(crc16(b"123456789"), 0xBCDD);
/// ```
pub fn crc16(bytes: &[u8]) -> u16 {
    // Only a computer, which does not count code, has frames so fast that ways of their own pay.
    #[cfg(target_pointer_width = "64")]
    return match bytes.len() {
        0..=8 => one_word(bytes).value(),
        9..=64 => short(bytes).value(),
        _ => long::remainder(bytes).value(),
    };
    #[cfg(not(target_pointer_width = "64"))]
    short(bytes).value()
}

/// Four bytes at a time.
fn short(bytes: &[u8]) -> Remainder {
    let (head, words) = bytes.split_at_checked(bytes.len() % 4).unwrap_or_default();
    // Zeros in front of a message do not change its remainder.
    let mut word = head.iter().fold(0, |word, &byte| word >> 8 | u32::from(byte) << 24);
    let mut message = Remainder { modulo_q: u64::from(word) << 32, parity: word };
    // Each word makes the unreduced remainder 4 bits longer: 32 bits and 7 times 4 are less than 64.
    for block in words.chunks(7 * 4) {
        for bytes in block.chunks_exact(4) {
            word = bytes.first_chunk().map_or(0, |&bytes| u32::from_le_bytes(bytes));
            message.parity ^= word;
            message.modulo_q = message.modulo_q >> 4 ^ message.modulo_q >> 2 ^ u64::from(word) << 32;
        }
        message.modulo_q = fold(message.modulo_q);
    }
    message
}

/// At most eight bytes.
#[cfg(target_pointer_width = "64")]
fn one_word(bytes: &[u8]) -> Remainder {
    let word = match (bytes.first_chunk(), bytes.last_chunk()) {
        // Where the two overlap they say the same.
        (Some(&first), Some(&last)) => {
            let front = u64::from(u32::from_le_bytes(first)) << (64 - 8 * bytes.len().min(8));
            front | u64::from(u32::from_le_bytes(last)) << 32
        }
        _ => bytes.iter().fold(0, |word, &byte| word >> 8 | u64::from(byte) << 56),
    };
    Remainder { modulo_q: word, parity: halves(word) }
}

/// A word's parity in half of its bits.
#[cfg(target_pointer_width = "64")]
#[expect(clippy::cast_possible_truncation, reason = "the upper half is in the lower one")]
const fn halves(word: u64) -> u32 {
    (word ^ word >> 32) as u32
}

/// A message modulo the two factors of the polynomial, neither reduced to the end.
#[derive(Clone, Copy)]
struct Remainder {
    /// Bits as they come on the wire: bit 63 is the factor of 1, bit 62 that of x.
    modulo_q: u64,
    /// Has as many set bits as the message, give or take an even number.
    parity: u32,
}

/// Reduces modulo Q from 64 bits to 36 by `x^32 = x^4 + x^2`.
const fn fold(value: u64) -> u64 {
    let high = value << 32;
    value >> 32 << 32 ^ high >> 4 ^ high >> 2
}

/// Reduces modulo Q by `x^15 = x + 1`: from 30 bits to 16, from 16 to 15.
const fn fold_15(value: u64) -> u64 {
    let high = value << 15;
    value >> 49 << 49 ^ high ^ high >> 1
}

impl Remainder {
    /// The CRC.
    const fn value(self) -> u16 {
        // Times x^16, which is x^2 + x: 38 bits.
        let value = fold(self.modulo_q);
        let value = value >> 2 ^ value >> 1;
        // By x^30 = x^2 + 1 to 30 bits.
        let high = value << 30;
        let value = fold_15(fold_15(value >> 34 << 34 ^ high ^ high >> 2));
        // The remainder, or Q more than it: whichever has the parity of the message.
        let value = (value >> 48) as u32;
        let parity = value ^ self.parity ^ self.parity >> 16;
        let parity = parity ^ parity >> 8;
        let parity = parity ^ parity >> 4;
        // Bit n is the parity of n.
        let odd = 0x6996 >> (parity & 15) & 1;
        let [low, high, ..] = (value ^ (odd * Q)).to_le_bytes();
        u16::from_le_bytes([low, high]).reverse_bits()
    }
}

/// `x^15 + x + 1`, bit 15 being the factor of 1.
const Q: u32 = 0xC001;

/// Long messages, by words that do not wait for each other.
#[cfg(target_pointer_width = "64")]
mod long {
    use super::{Remainder, fold, halves};
    use crate::frame::MAX_FRAME;

    /// Words that hold everything in a frame that the CRC covers.
    const WORDS: usize = MAX_FRAME.div_ceil(8);
    /// Bits of which there are too many above `x^960`.
    const ABOVE: usize = WORDS - 15;

    /// The remainder of at most [`MAX_FRAME`] bytes; of more, four at a time.
    pub(super) fn remainder(bytes: &[u8]) -> Remainder {
        let (mut words, mut parity) = ([0; WORDS], 0);
        let mut chunks = bytes.rchunks_exact(8);
        for (word, bytes) in words.iter_mut().rev().zip(&mut chunks) {
            *word = bytes.first_chunk().map_or(0, |&bytes| u64::from_le_bytes(bytes));
            parity ^= *word;
        }
        let head = chunks.remainder();
        let Some(start) = WORDS.checked_sub(bytes.len().div_ceil(8)) else { return super::short(bytes) };
        if let (false, Some(word)) = (head.is_empty(), words.get_mut(start)) {
            *word = head.iter().fold(0, |word, &byte| word >> 8 | u64::from(byte) << 56);
            parity ^= *word;
        }
        // x^960 = x^64 + 1: each word weighs the same 15 words on, and 14.
        for index in start..ABOVE {
            let word = words.get(index).copied().unwrap_or_default();
            for distance in [14, 15] {
                if let Some(other) = words.get_mut(index + distance) {
                    *other ^= word;
                }
            }
        }
        // x^480 = x^32 + 1: 7 and a half words on, and 7.
        for index in ABOVE..ABOVE + 7 {
            let word = words.get(index).copied().unwrap_or_default();
            for (distance, part) in [(7, word ^ word << 32), (8, word >> 32)] {
                if let Some(other) = words.get_mut(index + distance) {
                    *other ^= part;
                }
            }
        }
        let last = words.last_chunk::<8>();
        let (Some(high), Some(low)) = (last.and_then(|w| w.first_chunk()), last.and_then(|w| w.last_chunk()))
        else {
            return super::short(bytes);
        };
        // x^256 = x^32 + x^16.
        let high = fold(fold(four(high)));
        let modulo_q = high >> 32 ^ high >> 16 ^ four(low);
        Remainder { modulo_q, parity: halves(parity) }
    }

    /// Four words modulo Q, in 60 bits.
    fn four(words: &[u64; 4]) -> u64 {
        // x^64 = x^8 + x^4, x^128 = x^16 + x^8.
        let [a, b, c, d] = words.map(fold);
        let high = a >> 8 ^ a >> 4 ^ b;
        let low = c >> 8 ^ c >> 4 ^ d;
        high >> 16 ^ high >> 8 ^ low
    }
}

#[cfg(test)]
mod tests {
    use crc::{Algorithm, Crc};

    use super::*;

    const MODEL: Algorithm<u16> = Algorithm {
        width: 16,
        poly: 0x8005,
        init: 0,
        refin: true,
        refout: false,
        xorout: 0,
        check: 0xBCDD,
        residue: 0,
    };

    #[test]
    fn sums_wrap() {
        assert_eq!(header_sum(254, 4), 2);
        assert_eq!(payload_sum(&[]), 0);
        assert_eq!(payload_sum(&[0xFF, 0xFF, 3]), 1);
    }

    #[test]
    fn crc_is_that_of_the_model_at_every_length() {
        let (model, arc) = (Crc::<u16>::new(&MODEL), Crc::<u16>::new(&crc::CRC_16_ARC));
        let bytes: Vec<u8> =
            (0..400_u32).map(|index| ((index * index / 8) ^ index).to_le_bytes()[0]).collect();
        for start in [0, 1, 100] {
            for end in start..=bytes.len() {
                let bytes = &bytes[start..end];
                assert_eq!(crc16(bytes), model.checksum(bytes), "{start}..{end}");
                assert_eq!(short(bytes).value(), model.checksum(bytes), "{start}..{end}");
                assert_eq!(crc16(bytes), arc.checksum(bytes).reverse_bits());
            }
        }
    }

    /// The CRC is linear, so single bits at every place stand for every message.
    #[test]
    fn crc_of_single_bits() {
        let model = Crc::<u16>::new(&MODEL);
        for length in [1, 4, 7, 8, 64, 65, 121, 258, 261, 300] {
            for bit in 0..length * 8 {
                let mut bytes = vec![0; length];
                bytes[bit / 8] = 1 << (bit % 8);
                assert_eq!(crc16(&bytes), model.checksum(&bytes), "bit {bit} of {length} bytes");
                assert_eq!(short(&bytes).value(), model.checksum(&bytes), "bit {bit} of {length} bytes");
            }
        }
    }
}
