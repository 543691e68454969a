//! Text of a DXF: pairs of a group code and a value, one value a line.

use std::fmt::Write as _;

use super::super::plane::Point;

/// Number of significant digits of a coordinate at the edge of the drawing; the rest is rounding.
const DIGITS: f64 = 12.0;

/// Largest number of decimals: those of a double near one.
const MOST_DECIMALS: f64 = 15.0;

/// Name that other objects refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Handle(pub u32);

/// Pairs of an object or of a section.
#[derive(Clone, Debug, Default)]
pub(super) struct Pairs {
    text: String,
    /// Decimals of numbers.
    decimals: usize,
}

/// Hands out handles, each once.
#[derive(Debug)]
pub(super) struct Handles(u32);

impl Handles {
    /// The first handle follows zero, which means none.
    pub fn new() -> Handles {
        Handles(0)
    }

    pub fn next(&mut self) -> Handle {
        self.0 += 1;
        Handle(self.0)
    }
}

impl Pairs {
    /// Pairs whose numbers have as many decimals as a drawing of this extent needs.
    pub fn of_extent(extent: f64) -> Pairs {
        let decimals = (DIGITS - extent.log10().ceil()).clamp(0.0, MOST_DECIMALS);
        Pairs {
            text: String::new(),
            decimals: decimals as usize,
        }
    }

    /// Empty pairs with these decimals.
    pub fn alike(&self) -> Pairs {
        Pairs {
            text: String::new(),
            decimals: self.decimals,
        }
    }

    /// Adds a text as it is.
    pub fn word(&mut self, code: u16, word: &str) -> &mut Pairs {
        let _ = writeln!(self.text, "{code:>3}\n{word}");
        self
    }

    /// Adds a text of the user.
    pub fn text(&mut self, code: u16, text: &str) -> &mut Pairs {
        self.word(code, &encoded(text))
    }

    pub fn integer(&mut self, code: u16, value: i64) -> &mut Pairs {
        self.word(code, &value.to_string())
    }

    pub fn real(&mut self, code: u16, value: f64) -> &mut Pairs {
        let number = decimal(value, self.decimals);
        self.word(code, &number)
    }

    pub fn handle(&mut self, code: u16, handle: Handle) -> &mut Pairs {
        self.word(code, &format!("{:X}", handle.0))
    }

    /// Adds x, y and z = 0 with the codes `code`, `code` + 10 and `code` + 20.
    pub fn point(&mut self, code: u16, [x, y]: Point) -> &mut Pairs {
        self.real(code, x).real(code + 10, y).real(code + 20, 0.0)
    }

    /// Adds x and y with the codes `code` and `code` + 10.
    pub fn flat(&mut self, code: u16, [x, y]: Point) -> &mut Pairs {
        self.real(code, x).real(code + 10, y)
    }

    /// Adds fixed pairs.
    pub fn all(&mut self, pairs: &[(u16, &str)]) -> &mut Pairs {
        for (code, word) in pairs {
            self.word(*code, word);
        }
        self
    }

    pub fn append(&mut self, other: &Pairs) -> &mut Pairs {
        self.text += &other.text;
        self
    }

    pub fn into_text(self) -> String {
        self.text
    }
}

/// Number without zeros at its end, except for the first decimal.
fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{value:.*}", decimals.max(1));
    let text = text.trim_end_matches('0');
    match text.strip_suffix('.') {
        Some("-0") => "0.0".to_string(),
        Some(whole) => format!("{whole}.0"),
        None => text.to_string(),
    }
}

/// Text in ASCII: other letters by their number in Unicode.
fn encoded(text: &str) -> String {
    let mut encoded = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            // A caret begins a control character.
            '^' => encoded.push_str("^ "),
            letter if letter.is_control() => encoded.push(' '),
            letter if letter.is_ascii() => encoded.push(letter),
            letter => match u32::from(letter) {
                number @ ..=0xffff => {
                    let _ = write!(encoded, "\\U+{number:04X}");
                }
                // The notation has four digits.
                _ => encoded.push('?'),
            },
        }
    }
    encoded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_outside_of_ascii_have_numbers() {
        assert_eq!(encoded("Kurbel φ_1²"), "Kurbel \\U+03C6_1\\U+00B2");
        assert_eq!(encoded("x^2\n𝛼"), "x^ 2 ?");
    }

    #[test]
    fn numbers_have_a_point_and_no_negative_zero() {
        let text = [1.0, -1e-12, 0.5, -2.25, 1e12].map(|it| decimal(it, 9));
        assert_eq!(text, ["1.0", "0.0", "0.5", "-2.25", "1000000000000.0"]);
    }

    #[test]
    fn numbers_have_the_digits_of_the_extent() {
        let mut pairs = Pairs::of_extent(250.0);
        pairs.real(40, 100.0 / 3.0).real(40, 0.1 + 0.2);
        assert_eq!(pairs.into_text(), " 40\n33.333333333\n 40\n0.3\n");
        assert_eq!(Pairs::of_extent(1e-9).decimals, 15);
    }
}
