//! Random numbers from a seed, equal on every machine (SplitMix64: Steele, Lea & Flood, OOPSLA 2014).

/// Environment variable with a factor for the numbers of random cases.
const FACTOR: &str = "LINKWRIGHT_CASES";

/// Number of random cases of a test: `few`, or this times the factor in `LINKWRIGHT_CASES`.
///
/// # Panics
/// If the factor is not a whole number.
pub fn cases(few: u64) -> u64 {
    let factor = std::env::var(FACTOR).map_or(Ok(1), |text| text.parse::<u64>());
    few * factor.unwrap_or_else(|error| panic!("{FACTOR}: {error}"))
}

/// A sequence of pseudo-random numbers.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The sequence that belongs to `seed`.
    pub fn new(seed: u64) -> Random {
        Random { state: seed }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.state;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number from `low` to below `high`, from 53 random bits.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let fraction = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * fraction
    }
}
