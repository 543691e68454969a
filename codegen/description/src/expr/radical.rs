//! Extracts exact roots and square factors of whole numbers.
//!
//! Squares are found by trial division up to 1000 and a final test for a perfect square. This bounds the work to some 500
//! divisions. A square of a larger prime beside another factor may stay under the root.

/// Bound on trial divisors.
const MAX_DIVISOR: u128 = 1000;

/// Returns the root of this order; `None` if it is not a whole number.
pub(super) fn exact_root(value: u128, order: i128) -> Option<u128> {
    if order == 1 || value <= 1 {
        return Some(value);
    }
    let order = u32::try_from(order).ok()?;
    if order == 2 {
        let root = value.isqrt();
        return (root * root == value).then_some(root);
    }
    // A root of order three or more has at most 43 bits, so the float is accurate to less than one.
    let estimate = (value as f64).powf(1.0 / f64::from(order)).round() as u128;
    (estimate.saturating_sub(1)..=estimate + 1).find(|root| root.checked_pow(order) == Some(value))
}

/// Returns `(s, t)` with `value = s²·t`, where t has no detectable square factor.
pub(super) fn extract_squares(value: u128) -> (u128, u128) {
    if value < 4 {
        return (1, value);
    }
    let (mut root, mut kept, mut rest) = (1, 1, value);
    let mut divisor = 2u128;
    // A number below d³ without a divisor below d is a prime, a product of two primes, or the square of one.
    while divisor <= MAX_DIVISOR && divisor * divisor * divisor <= rest {
        while rest % (divisor * divisor) == 0 {
            rest /= divisor * divisor;
            root *= divisor;
        }
        if rest % divisor == 0 {
            rest /= divisor;
            kept *= divisor;
        }
        divisor += if divisor == 2 { 1 } else { 2 };
    }
    let square = rest.isqrt();
    if square * square == rest {
        (root * square, kept)
    } else {
        (root, kept * rest)
    }
}
