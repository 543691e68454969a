//! *A number* → *its text for a reader*: six significant digits, and no zeros at the end.

/// What is less than this beside one is rounding.
const ROUNDING: f64 = 1e-12;

/// Sizes from the one to below the other are written without an exponent.
const PLAIN: [f64; 2] = [1e-3, 1e7];

/// How many digits are written.
const DIGITS: i32 = 6;

/// The number as text, with a minus sign as it is printed.
pub fn number(value: f64) -> String {
    plain(value).replace('-', "−")
}

/// The number as MathML.
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
    if !(PLAIN[0]..PLAIN[1]).contains(&size) {
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

/// Without zeros behind the point.
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
