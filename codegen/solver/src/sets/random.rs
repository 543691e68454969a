//! Generates random numbers by their index.

use super::sobol::mixed;

/// Number of bits of a random number.
const RANDOM_BITS: u32 = 53;

/// Returns a coordinate of the random point with this index, between 0 and 1, both excluded.
pub fn random_coordinate(seed: u64, index: u32, dimension: usize) -> f64 {
    let bits = mixed(mixed(mixed(seed) ^ dimension as u64) ^ u64::from(index));
    let whole = bits >> (u64::BITS - RANDOM_BITS);
    (whole as f64 + 0.5) / (1_u64 << RANDOM_BITS) as f64
}

#[cfg(test)]
mod tests {
    use super::random_coordinate;

    /// Mean, variance, and covariance of neighbors, each within five standard errors.
    #[test]
    fn coordinates_are_uniform_and_independent() {
        let count = 100_000;
        for seed in [0, 1, 2, u64::MAX] {
            for dimension in [0, 1, 40] {
                let of = |index, dimension| random_coordinate(seed, index, dimension) - 0.5;
                let mean =
                    |of: &dyn Fn(u32) -> f64| (0..count).map(of).sum::<f64>() / f64::from(count);
                let root = f64::from(count).sqrt();
                let uniform = |it| of(it, dimension);
                assert!(mean(&uniform).abs() < 5.0 * (1.0_f64 / 12.0).sqrt() / root);
                let square = mean(&|it| uniform(it) * uniform(it)) - 1.0 / 12.0;
                assert!(square.abs() < 5.0 * (1.0_f64 / 180.0).sqrt() / root);
                for other in [1, 7] {
                    let pair = mean(&|it| uniform(it) * of(it, dimension + other));
                    assert!(pair.abs() < 5.0 / 12.0 / root);
                    let next = mean(&|it| uniform(it) * uniform(it + other as u32));
                    assert!(next.abs() < 5.0 / 12.0 / root);
                }
            }
        }
    }
}
