//! Formats a number for a reader: six significant digits, without trailing zeros.

/// Magnitude that counts as rounding beside one.
const ROUNDING: f64 = 1e-12;

/// Magnitudes without an exponent: from the first value to below the second.
const PLAIN_RANGE: [f64; 2] = [1e-3, 1e7];

/// Number of significant digits.
const DIGITS: i32 = 6;

/// Returns the number as text, with a typographic minus sign.
pub fn number(value: f64) -> String {
    plain(value).replace('-', "−")
}

/// Returns the number as MathML.
pub fn mathml(value: f64) -> String {
    let text = plain(value);
    let (sign, size) = match text.strip_prefix('-') {
        Some(size) => ("<mo>−</mo>", size),
        None => ("", text.as_str()),
    };
    match size.split_once('e') {
        Some((significand, exponent)) => format!(
            "<mrow>{sign}<mn>{significand}</mn><mo>·</mo><msup><mn>10</mn><mn>{}</mn></msup></mrow>",
            exponent.replace('-', "−")
        ),
        None => format!("<mrow>{sign}<mn>{size}</mn></mrow>"),
    }
}

fn plain(value: f64) -> String {
    let size = value.abs();
    if size < ROUNDING {
        return "0".to_string();
    }
    if !(PLAIN_RANGE[0]..PLAIN_RANGE[1]).contains(&size) {
        let text = format!("{value:.5e}");
        return match text.split_once('e') {
            Some((significand, exponent)) => format!("{}e{exponent}", shortened(significand)),
            None => text,
        };
    }
    let before = size.log10().floor() as i32 + 1;
    let decimals = (DIGITS - before).max(0) as usize;
    shortened(&format!("{value:.decimals$}")).to_string()
}

/// Removes trailing zeros behind the point.
fn shortened(text: &str) -> &str {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::{mathml, number};

    #[test]
    fn numbers_have_six_digits() {
        let texts = [0.0, 1.0, -0.5, 1.0 / 30.0, 1234.56789, 2e7, 1e-5, -1e-15].map(number);
        assert_eq!(
            texts,
            ["0", "1", "−0.5", "0.0333333", "1234.57", "2e7", "1e−5", "0"]
        );
        assert_eq!(mathml(-2.5), "<mrow><mo>−</mo><mn>2.5</mn></mrow>");
        assert!(mathml(1.5e-7).contains("<msup><mn>10</mn><mn>−7</mn></msup>"));
    }
}
