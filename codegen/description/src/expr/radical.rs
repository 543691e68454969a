//! Whole numbers under roots: *a whole number* → *its exact root, or its largest square found*.
//!
//! Squares are found by trial division up to 1000 and by a last look for a perfect square. This bounds the work at some 500
//! divisions; a square of a larger prime beside another factor may stay under the root.

/// The largest divisor whose square is looked for.
const LARGEST_DIVISOR: u128 = 1000;

/// The root of this order where it is a whole number.
pub(super) fn exact_root(value: u128, order: i128) -> Option<u128> {
    if order == 1 || value <= 1 {
        return Some(value);
    }
    let order = u32::try_from(order).ok()?;
    if order == 2 {
        let root = value.isqrt();
        return (root * root == value).then_some(root);
    }
    // A root of order three or more has at most 43 bits: the float is off by less than one.
    let estimate = (value as f64).powf(1.0 / f64::from(order)).round() as u128;
    (estimate.saturating_sub(1)..=estimate + 1).find(|root| root.checked_pow(order) == Some(value))
}

/// `(s, t)` with `value = s²·t` and no square left in t as far as it is found.
pub(super) fn extract_squares(value: u128) -> (u128, u128) {
    if value < 4 {
        return (1, value);
    }
    let (mut root, mut kept, mut rest) = (1, 1, value);
    let mut divisor = 2u128;
    // What has no divisor below d and is less than d³ is a prime, a product of two primes or the square of one.
    while divisor <= LARGEST_DIVISOR && divisor * divisor * divisor <= rest {
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
