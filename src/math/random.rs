//! Random numbers that are the same everywhere: no seed of the system's, no number of the platform's.

/// The SplitMix64 generator (Steele, Lea & Flood 2014).
#[derive(Clone, Debug)]
pub struct SplitMix(u64);

impl SplitMix {
    /// The numbers of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_a_seed_are_uniform_and_its_own() {
        let numbers = |seed| {
            let mut random = SplitMix::new(seed);
            std::iter::repeat_with(move || random.unit()).take(10_000).collect::<Vec<_>>()
        };
        assert_eq!(numbers(7), numbers(7));
        assert_ne!(numbers(7), numbers(8));
        for cell in 0..10 {
            let share = |x: &&f64| (**x * 10.0) as usize == cell;
            let count = numbers(7).iter().filter(share).count();
            // Five standard deviations of a fair draw.
            assert!(count.abs_diff(1000) < 150, "{count} in cell {cell}");
        }
    }
}
