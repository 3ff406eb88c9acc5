//! Numbers that look random and are the same in every run with the same seed.

/// A small generator (xorshift64*): the same seed gives the same numbers.
#[derive(Clone, Debug)]
pub(super) struct Noise(u64);

impl Noise {
    pub(super) fn new(seed: u64) -> Self {
        // A state of 0 would stay 0; the multiplication spreads small seeds over all bits.
        Self(seed.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// True with this probability.
    pub(super) fn chance(&mut self, probability: f64) -> bool {
        probability > 0.0 && self.fraction() < probability
    }

    pub(super) fn byte(&mut self) -> u8 {
        let [.., high] = self.next().to_le_bytes();
        high
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    /// Between 0 and 1.
    #[allow(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub(super) fn fraction(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// About 0, with a spread of about 1, and within ±3.
    pub(super) fn bell(&mut self) -> f64 {
        let sum: f64 = (0..3).map(|_| self.fraction()).sum();
        (sum - 1.5) * 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_its_own_numbers_again() {
        let numbers = |seed| {
            let mut noise = Noise::new(seed);
            (0..100).map(|_| noise.next()).collect::<Vec<_>>()
        };
        assert_eq!(numbers(7), numbers(7));
        assert_ne!(numbers(7), numbers(8));
    }

    #[test]
    fn chances_come_out_as_often_as_they_should() {
        let mut noise = Noise::new(0);
        let hits = (0..10_000).filter(|_| noise.chance(0.1)).count();
        assert!((900..1100).contains(&hits), "{hits}");
        assert!(!noise.chance(0.0));
    }

    #[test]
    fn noise_is_about_zero_and_bounded() {
        let mut noise = Noise::new(0);
        let bells: Vec<_> = (0..10_000).map(|_| noise.bell()).collect();
        assert!(bells.iter().all(|bell| bell.abs() <= 3.0));
        assert!(bells.iter().sum::<f64>().abs() < 300.0);
    }
}
