//! Formats numbers for readers. Exponents have a sign and two digits, as most tools print them.

/// Returns a number with `digits` decimals and an exponent: `-1.343628e-02`.
pub fn scientific(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$e}");
    match text.split_once('e') {
        Some((significand, exponent)) => {
            let (sign, magnitude) = match exponent.strip_prefix('-') {
                Some(magnitude) => ('-', magnitude),
                None => ('+', exponent),
            };
            format!("{significand}e{sign}{magnitude:0>2}")
        }
        None => text,
    }
}

/// Returns a number with `decimals` decimals, without the sign of a rounded zero.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|it| it == '0' || it == '.') => digits.to_string(),
        _ => text,
    }
}

/// Returns a time with the digits to which it was located, without trailing zeros.
pub fn time(t: f64) -> String {
    let text = fixed(t, 9);
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// Returns a count with its noun: `1 frame`, `2 frames`.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_have_two_digits() {
        assert_eq!(scientific(-1.343_628_4e-2, 6), "-1.343628e-02");
        assert_eq!(scientific(1e300, 1), "1.0e+300");
        assert_eq!(scientific(0.0, 2), "0.00e+00");
        assert_eq!(scientific(f64::INFINITY, 2), "inf");
    }

    #[test]
    fn zero_has_no_sign() {
        assert_eq!(fixed(-1e-9, 6), "0.000000");
        assert_eq!(fixed(-1e-6, 6), "-0.000001");
        assert_eq!(counted(1, "frame"), "1 frame");
        assert_eq!(counted(0, "frame"), "0 frames");
    }
}
