//! Random numbers that are the same everywhere: splitmix64 (Steele, Lea, Flood 2014; constants of Vigna's public domain
//! version). Only integer arithmetic and exact conversions, so that a seed means the same targets on every machine.

/// A stream of random numbers.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The stream for one purpose, independent of what other purposes have drawn. `words` say which (a shape, a count).
    pub fn of(seed: u64, purpose: &str, number: u64) -> Self {
        let mut mixed = Self::new(seed);
        for byte in purpose.bytes() {
            mixed.state ^= u64::from(byte);
            mixed.state = mixed.bits();
        }
        mixed.state ^= number;
        let state = mixed.bits();
        Self { state }
    }

    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`, a multiple of `2^-53`.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in `[low, high)`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in `0..count` (the bias of the remainder is below `count / 2^64`).
    pub fn index(&mut self, count: usize) -> usize {
        (self.bits() % count.max(1) as u64) as usize
    }

    /// A direction, uniform over the circle: a point of the disk, made a unit vector.
    pub fn direction(&mut self) -> [f64; 2] {
        loop {
            let (x, y) = (self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            let squared = x * x + y * y;
            if (0.01..=1.0).contains(&squared) {
                let length = squared.sqrt();
                return [x / length, y / length];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_sequence_comes_out() {
        // The first values of splitmix64 from seed 1234567, as published with the algorithm.
        let mut random = Random::new(1_234_567);
        let expected = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423_u64];
        assert_eq!([random.bits(), random.bits(), random.bits()], expected);
    }

    #[test]
    fn streams_are_repeatable_and_independent() {
        let draw = |purpose, number| Random::of(7, purpose, number).bits();
        assert_eq!(draw("pig", 1), draw("pig", 1));
        assert!(draw("pig", 1) != draw("pig", 2) && draw("pig", 1) != draw("gip", 1));
    }

    #[test]
    fn ranges_are_kept() {
        let mut random = Random::new(3);
        for _ in 0..1000 {
            let v = random.between(-2.0, 3.0);
            let [x, y] = random.direction();
            assert!((-2.0..3.0).contains(&v) && (x.hypot(y) - 1.0).abs() < 1e-15 && random.index(7) < 7);
        }
    }
}
