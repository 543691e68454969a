//! Keeps values at the ends of ranges in the range, if only rounding separates them.

/// Relative difference of a number that is read in two ways: rounding of the factor of its unit.
pub const ROUNDED_END: f64 = 1e-14;

/// Returns an end of the range in place of a value that differs from it by rounding alone; other values stay as they are.
pub fn on_end(value: f64, range: [f64; 2]) -> f64 {
    let finite = range.into_iter().filter(|end| end.is_finite());
    let mut near = finite.filter(|end| (value - end).abs() <= ROUNDED_END * end.abs());
    near.next().unwrap_or(value)
}
