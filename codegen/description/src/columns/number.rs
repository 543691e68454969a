//! Reads a cell as a number, a missing value or words.

use super::Decimal;

/// Texts of cells without a measured value, in lower case.
const MISSING: [&str; 16] = [
    "", "nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "---", "?", "1.#qnan", "-1.#ind",
    "<na>", "nan()", "-nan",
];

/// Maximum number of characters of a cell in a message.
const MAX_SHOWN_CHARACTERS: usize = 40;

/// Content of a cell.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Content {
    /// A number: its text with a decimal point, and its value.
    Number(String, f64),
    /// An empty cell, or a word for a missing value.
    Missing,
    /// Any other text.
    Words(Why),
}

/// Reason why a cell is not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Why {
    /// A digit is missing.
    NoNumber,
    /// The number is outside the range of `f64`.
    TooLarge,
    /// Digits are grouped, or both decimal marks occur.
    Groups,
    /// Letters follow a number.
    WithUnit,
}

impl Why {
    pub fn message(self, cell: &str) -> String {
        let excerpt: String = cell.chars().take(MAX_SHOWN_CHARACTERS).collect();
        let excerpt = excerpt.escape_debug();
        match self {
            Why::NoNumber => format!("`{excerpt}` is not a number"),
            Why::TooLarge => format!("`{excerpt}` is not a finite number"),
            Why::Groups => format!("`{excerpt}` has groups of digits, or the other decimal mark"),
            Why::WithUnit => format!("`{excerpt}` has letters after its number"),
        }
    }

    pub fn help(self) -> &'static str {
        match self {
            Why::NoNumber => {
                "leave the cell empty where nothing was measured, and put `#` before a comment"
            }
            Why::TooLarge => "leave the cell empty where nothing was measured",
            Why::Groups => {
                "export numbers without separators of thousands and with one decimal mark"
            }
            Why::WithUnit => "write the unit into the header: `x (mm)`",
        }
    }
}

/// Reads the content of a cell.
pub(super) fn content(cell: &str, decimal: Decimal) -> Content {
    let cell = cell.trim();
    // Cells that begin with a digit need no look-up.
    let is_digit =
        cell.starts_with(|it: char| it.is_ascii_digit()) && !cell.ends_with(char::is_alphabetic);
    if !is_digit && MISSING.contains(&cell.to_ascii_lowercase().as_str()) {
        return Content::Missing;
    }
    let mut written = String::with_capacity(cell.len());
    let mark = decimal.mark();
    let other = if mark == '.' { ',' } else { '.' };
    let (mut digits, mut marks, mut exponent) = (0, 0, false);
    let mut before = ' ';
    for (place, character) in cell.chars().enumerate() {
        let is_sign = matches!(character, '+' | '-' | '−');
        match character {
            '0'..='9' => {
                digits += 1;
                written.push(character);
            }
            _ if is_sign && (place == 0 || before == 'e') => match character {
                '+' => {}
                _ => written.push('-'),
            },
            'e' | 'E' | 'd' | 'D' if digits > 0 && !exponent => {
                exponent = true;
                digits = 0;
                written.push('e');
                before = 'e';
                continue;
            }
            _ if character == mark && marks == 0 && !exponent => {
                marks += 1;
                written.push('.');
            }
            _ if digits == 0 => return Content::Words(Why::NoNumber),
            _ if character == other
                || character == mark
                || matches!(character, ' ' | '\'' | '’' | '\u{a0}' | '\u{202f}') =>
            {
                return Content::Words(Why::Groups);
            }
            _ if character.is_alphabetic() || matches!(character, '°' | '%') => {
                let is_word = cell.contains([':', '_', '/']);
                return Content::Words(if is_word {
                    Why::NoNumber
                } else {
                    Why::WithUnit
                });
            }
            _ => return Content::Words(Why::NoNumber),
        }
        before = character;
    }
    // `1,` in a list between spaces is a number and a comma.
    if digits == 0 || (mark == ',' && before == ',') {
        return Content::Words(Why::NoNumber);
    }
    match written.parse::<f64>() {
        Ok(value) if value.is_finite() => Content::Number(written, value),
        Ok(_) => Content::Words(Why::TooLarge),
        Err(_) => Content::Words(Why::NoNumber),
    }
}
