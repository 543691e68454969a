//! Writes elementary functions of one lane, which compilers inline into loops over the lanes.
//!
//! Constants and polynomials are excerpts of the runtime, so that both have one origin. They get a prefix: another file of the same
//! program may contain the runtime.

use super::super::printer::Printer;
use super::super::runtime::in_scalar;
use crate::emit::code::Code;
use crate::emit::scalar::Scalar;

/// Functions of the mechanism's file, with marks as in the runtime.
const FUNCTIONS: &str = include_str!("elementary.c");

/// Functions of signals, for mechanisms with inputs.
const SIGNALS: [&str; 3] = ["remainder_of_signal", "allowance_of_signal", "holds_signal"];

/// Constants and functions of the runtime that these functions use.
const ITEMS: [&str; 9] = [
    "PI",
    "QUARTER_PI",
    "QUARTER_REST",
    "ROUNDER",
    "FOLD",
    "UNDERFLOW",
    "bits_of",
    "of_bits",
    "slight_bend_of",
];

/// Arguments that only the runtime reduces, in f64 and in f32.
const RARE: [&str; 2] = [
    "    const uint64_t is_close = (fabs(y) < 1.52587890625e-5) ? 1U : 0U;
    const uint64_t is_reduced = (quadrants > 0.0) ? 1U : 0U;
    const uint64_t rare = ((size <= 205000.0) ? 0U : 1U) | (is_close & is_reduced);",
    "    const uint32_t is_close = (fabsf(y) >= (quadrants * 3.8146973e-6f)) ? 0U : 1U;
    const uint32_t rare = ((size <= 12800.0f) ? 0U : 1U) | is_close;",
];

/// Writes the functions; those of signals only if a motion has inputs.
pub(super) fn functions(printer: &Printer<'_>, has_inputs: bool, text: &mut Code) {
    let scalar = printer.module.scalar;
    let (math, place) = match scalar {
        Scalar::F64 => (include_str!("../runtime/math_double.c"), 0),
        Scalar::F32 => (include_str!("../runtime/math_single.c"), 1),
    };
    let parts = [
        math,
        include_str!("../runtime/angle.c"),
        include_str!("../runtime/closed_form.c"),
        include_str!("../runtime/time_window.c"),
    ];
    let runtime = in_scalar(&parts.concat(), scalar);
    let signals: &[&str] = match has_inputs {
        true => &SIGNALS,
        false => &[],
    };
    let names = ITEMS.iter().chain(signals);
    let names: Vec<String> = names
        .map(|it| format!("{it}{}", printer.suffix()))
        .collect();
    let items = names.iter().map(|name| item(&runtime, name));
    // Functions stand apart.
    let items = items.map(|item| match item.ends_with("}\n") {
        true => format!("\n{item}"),
        false => item.to_string(),
    });
    let items: String = items.collect();
    let [reduction, polynomials] = parts_of_sine_and_cosine(&runtime, printer.real());
    let reduction = reduction.trim_end().replace("\n        ", "\n    ");
    let [top, eighth, half_root] = match scalar {
        Scalar::F64 => ["63", "61", "0.7071067811865476"],
        Scalar::F32 => ["31", "29", "0.70710677f"],
    };
    let written = in_scalar(FUNCTIONS, scalar)
        .replace("$excerpts", items.trim_end())
        .replace("$reduction", &format!("    {}", reduction.trim_start()))
        .replace("$rare", RARE[place])
        .replace("$polynomials", polynomials)
        .replace("$word", printer.word())
        .replace("$top", top)
        .replace("$eighth", eighth)
        .replace("$half_root", half_root)
        .replace("LINKWRIGHT_FUNCTION static", "LINKWRIGHT_LANE");
    for line in renamed(&written, &names).lines() {
        text.whole(line);
    }
}

/// Returns a constant or a function of the runtime with its line breaks; empty if there is none.
fn item<'a>(runtime: &'a str, name: &str) -> &'a str {
    let constant = format!(" {name} = ");
    let function = format!(" {name}(");
    let mut starts = runtime.match_indices("\n").map(|(place, _)| place + 1);
    let start = starts.find_map(|start| {
        let line = runtime[start..].lines().next().unwrap_or_default();
        let is_function =
            line.starts_with("LINKWRIGHT_FUNCTION static ") && line.contains(&function);
        let is_constant = line.starts_with("static const ") && line.contains(&constant);
        match (is_function, is_constant) {
            (true, _) => Some((start, "\n}\n")),
            (_, true) => Some((start, "\n")),
            _ => None,
        }
    });
    let (start, end) = start.unwrap_or((runtime.len(), ""));
    let length = runtime[start..].find(end).unwrap_or(0) + end.len();
    &runtime[start..start + length]
}

/// Returns the reduction of an angle and the polynomials of the remainder.
fn parts_of_sine_and_cosine<'a>(runtime: &'a str, real: &str) -> [&'a str; 2] {
    let (moved, square) = (
        format!("        const {real} moved"),
        format!("    const {real} z = y * y;"),
    );
    [
        between(runtime, &moved, "        quadrant = "),
        between(runtime, &square, "\n}\n"),
    ]
}

/// Returns the text from one mark to before another one.
fn between<'a>(text: &'a str, first: &str, end: &str) -> &'a str {
    let start = text.find(first).unwrap_or(text.len());
    let length = text[start..].find(end).unwrap_or(0);
    &text[start..start + length]
}

/// Returns the text, in which these names have the prefix of lanes.
fn renamed(text: &str, names: &[String]) -> String {
    let mut written = String::with_capacity(text.len());
    let is_letter = |it: char| it.is_ascii_alphanumeric() || it == '_';
    for part in text.split_inclusive(|it: char| !is_letter(it)) {
        let word = part.trim_end_matches(|it: char| !is_letter(it));
        if names.iter().any(|name| name == word) {
            let is_constant = word.starts_with(|it: char| it.is_ascii_uppercase());
            written.push_str(if is_constant { "LANE_" } else { "lane_" });
        }
        written.push_str(part);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn excerpts_are_complete() {
        for (scalar, math, real, suffix) in [
            (
                Scalar::F64,
                include_str!("../runtime/math_double.c"),
                "double",
                "",
            ),
            (
                Scalar::F32,
                include_str!("../runtime/math_single.c"),
                "float",
                "f",
            ),
        ] {
            let parts = [
                math,
                include_str!("../runtime/closed_form.c"),
                include_str!("../runtime/time_window.c"),
            ];
            let runtime = in_scalar(&parts.concat(), scalar);
            for name in ITEMS.iter().chain(&SIGNALS) {
                let item = item(&runtime, &format!("{name}{suffix}"));
                assert!(
                    item.ends_with("}\n") || item.ends_with(";\n"),
                    "{name}: {item}"
                );
            }
            let [reduction, polynomials] = parts_of_sine_and_cosine(&runtime, real);
            assert!(reduction.contains("tail = ") && polynomials.contains("*cosine = "));
        }
    }

    #[test]
    fn whole_names_get_the_prefix() {
        let names = ["PI".to_string(), "of_bits".to_string()];
        let text = "PI * HALF_PI + of_bits(bits_of_bits)";
        assert_eq!(
            renamed(text, &names),
            "LANE_PI * HALF_PI + lane_of_bits(bits_of_bits)"
        );
    }
}
