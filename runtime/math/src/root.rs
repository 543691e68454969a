//! Square root in f32, for processors that multiply f32 and have no root instruction for safe code.
//!
//! Three steps of Newton-Raphson, two of them for the reciprocal of the root, come to within one unit in the last
//! place. Integers then decide which of the neighboring numbers is nearest to the root. Let S be the digits of the
//! candidate, and M those of x at its scale. The root is nearest to S if −S < M − S² ≤ S. Both sides are small, so that
//! 32 bits of the products decide. The result is therefore correctly rounded, as that of a processor or of `libm`.

/// Bits of an f32 that store its exponent and its digits.
const EXPONENT: u32 = 0x7f80_0000;
const LOWEST_EXPONENT: u32 = 0x0080_0000;
const DIGITS: u32 = 0x007f_ffff;

/// Constant from which the bits of x, with halved exponent, yield those of 1/√x within a thirtieth.
const FIRST: u32 = 0x5f37_59df;

/// Returns the square root; NaN for a negative argument.
#[inline]
pub fn sqrt(x: f32) -> f32 {
    let is_normal = x.to_bits().wrapping_sub(LOWEST_EXPONENT) < EXPONENT - LOWEST_EXPONENT;
    if is_normal { of_normal(x) } else { of_other(x) }
}

#[inline]
fn of_normal(x: f32) -> f32 {
    let bits = x.to_bits();
    let half = 0.5 * x;
    let mut reciprocal = f32::from_bits(FIRST - (bits >> 1));
    reciprocal *= 1.5 - half * reciprocal * reciprocal;
    reciprocal *= 1.5 - half * reciprocal * reciprocal;
    let near = x * reciprocal;
    let near = near + 0.5 * reciprocal * (x - near * near);
    let near = near.to_bits();
    let digits = (near & DIGITS) | LOWEST_EXPONENT;
    let shift = if bits & LOWEST_EXPONENT == 0 { 24 } else { 23 };
    let rest = (bits << shift).wrapping_sub(digits.wrapping_mul(digits)) as i32;
    let digits = digits as i32;
    f32::from_bits(near + u32::from(rest > digits) - u32::from(rest <= -digits))
}

/// Returns the root of zeros, subnormal numbers, infinities and NaN, and of negative numbers.
#[cold]
fn of_other(x: f32) -> f32 {
    const UP: f32 = (1u32 << 24) as f32;
    const DOWN: f32 = 1.0 / (1u32 << 12) as f32;
    if x > 0.0 && x < f32::INFINITY {
        of_normal(x * UP) * DOWN
    } else if x < 0.0 {
        f32::NAN
    } else {
        x
    }
}

#[cfg(test)]
mod tests {
    use super::sqrt;

    /// The roots of all digits for exponents of both parities, which are those of all others up to a power of two; of
    /// all subnormal numbers; and of zeros, negative numbers, infinities and NaN.
    #[test]
    fn every_root_is_the_nearest_number() {
        extern crate std;
        let wrong = |bits: u32| {
            let x = f32::from_bits(bits);
            let (found, nearest) = (sqrt(x), x.sqrt());
            found.to_bits() != nearest.to_bits() && !(found.is_nan() && nearest.is_nan())
        };
        let scales = [1, 2, 100, 101, 126, 127, 253, 254];
        let normal = scales.iter().flat_map(|exponent| {
            let step = if matches!(exponent, 126 | 127) { 1 } else { 61 };
            (exponent << 23..(exponent + 1) << 23).step_by(step)
        });
        assert_eq!(normal.filter(|bits| wrong(*bits)).count(), 0);
        assert_eq!((0..1 << 23).filter(|bits| wrong(*bits)).count(), 0);
        let others = [
            0x8000_0000,
            0x8000_0001,
            0xbf80_0000,
            0x7f80_0000,
            0xff80_0000,
            0x7fc0_0000,
        ];
        assert!(!others.into_iter().any(wrong));
    }
}
