//! Splits a number into digits and unit: `30deg` into 30 and `deg`, `2e3mm` into 2e3 and `mm`. `1e5` has no unit.

use super::formula::{ExpressionKind, Name};
use super::reader::Outcome;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Splits a number. Its digits are valid for `f64` and for exact decimals.
pub(super) fn number(written: &Name) -> Outcome<ExpressionKind> {
    let text = written.text.as_str();
    let bytes = text.as_bytes();
    let run = |from: usize| {
        bytes[from..]
            .iter()
            .position(|it| !it.is_ascii_digit() && *it != b'_')
            .map_or(bytes.len(), |it| from + it)
    };
    let mut end = run(0);
    if bytes.get(end) == Some(&b'.') {
        end = run(end + 1);
    }
    if let Some(b'e' | b'E') = bytes.get(end) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
            end = run(end + 1 + sign);
        }
    }
    let digits: String = text[..end].chars().filter(|it| *it != '_').collect();
    if !text.starts_with(|it: char| it.is_ascii_digit()) {
        let message = format!("`{text}` is not a number of this language");
        let finding = Diagnostic::error(Code::OutsideGrammar, written.span, message);
        return Err(Box::new(finding.help("write the number in decimal digits")));
    }
    let unit = &text[end..];
    // An exponent was begun in `1e` and `1e_5`, as no unit has such a name.
    let begun = unit
        .strip_prefix(['e', 'E'])
        .is_some_and(|rest| rest.is_empty() || rest.starts_with(['_', '+', '-']));
    if begun {
        let finding = Diagnostic::error(
            Code::OutsideGrammar,
            written.span,
            format!("`{text}` has no exponent"),
        )
        .label("expected digits after the `e`")
        .help(format!("write `{digits}e3`, or `{digits}` without the `e`"));
        return Err(Box::new(finding));
    }
    let place = written.span.range();
    // A repaired number differs in length from the source, so its unit has no location of its own.
    let span = if place.len() == text.len() {
        Span::new(place.start + end, place.end)
    } else {
        written.span
    };
    let unit = (!unit.is_empty()).then(|| Name {
        text: unit.to_string(),
        span,
    });
    Ok(ExpressionKind::Number { digits, unit })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str) -> Result<(String, Option<(String, u32)>), String> {
        match number(&Name {
            text: text.to_string(),
            span: Span::new(10, 10 + text.len()),
        }) {
            Ok(ExpressionKind::Number { digits, unit }) => {
                Ok((digits, unit.map(|it| (it.text, it.span.start))))
            }
            Ok(other) => Err(format!("{other:?}")),
            Err(finding) => Err(finding.message),
        }
    }

    #[test]
    fn digits_and_units() {
        for (text, digits, unit) in [
            ("30deg", "30", Some(("deg", 12))),
            ("50mm", "50", Some(("mm", 12))),
            ("0.05m", "0.05", Some(("m", 14))),
            ("1e5", "1e5", None),
            ("1E-3", "1E-3", None),
            ("2e3mm", "2e3", Some(("mm", 13))),
            ("1.5e+3rad", "1.5e+3", Some(("rad", 16))),
            ("1em", "1", Some(("em", 11))),
            ("1_000", "1000", None),
            ("1_000.000_1", "1000.0001", None),
            ("5_m", "5", Some(("m", 12))),
            ("7.", "7.", None),
            ("007", "007", None),
        ] {
            let expected = Ok((
                digits.to_string(),
                unit.map(|(unit, at)| (unit.to_string(), at)),
            ));
            assert_eq!(split(text), expected, "{text}");
            assert!(digits.parse::<f64>().is_ok());
        }
    }

    #[test]
    fn an_exponent_needs_digits() {
        for text in ["1e", "2E", "1.5e", "1e_5"] {
            assert!(
                split(text).is_err_and(|message| message.contains("no exponent")),
                "{text}"
            );
        }
        for text in ["", "_1", "e5", "(", "é"] {
            assert!(split(text).is_err(), "{text}");
        }
    }
}
