//! Finds the lints that an item of generated code must allow, so that it is clean wherever it is included.

use crate::emit::code::Code;
use std::f64::consts;

/// Relative distance of a literal from a constant of the standard library up to which clippy objects.
const APPROXIMATION_TOLERANCE: f64 = 1e-3;

/// Constants of the standard library that clippy looks for among literals.
const KNOWN: [f64; 19] = [
    consts::E,
    consts::FRAC_1_PI,
    consts::FRAC_1_SQRT_2,
    consts::FRAC_2_PI,
    consts::FRAC_2_SQRT_PI,
    consts::FRAC_PI_2,
    consts::FRAC_PI_3,
    consts::FRAC_PI_4,
    consts::FRAC_PI_6,
    consts::FRAC_PI_8,
    consts::LN_2,
    consts::LN_10,
    consts::LOG10_2,
    consts::LOG10_E,
    consts::LOG2_10,
    consts::LOG2_E,
    consts::PI,
    consts::SQRT_2,
    consts::TAU,
];

/// Attribute that names with capitals need.
const CAPITALS: &str = "#[allow(non_snake_case)]";

/// Attribute that a module of this name needs.
pub(super) fn of_module(name: &str) -> Option<&'static str> {
    let is_snake = name == name.to_lowercase() && !name.trim_matches('_').contains("__");
    (!is_snake).then_some(CAPITALS)
}

/// Attributes of an item that a user may leave unused.
pub(super) fn unused_item(code: &Code) -> impl Iterator<Item = &'static str> + use<> {
    let [capitals, approximate] = both(code);
    [capitals, Some("#[allow(dead_code)]"), approximate]
        .into_iter()
        .flatten()
}

/// Attributes that code needs.
pub(super) fn of_code(code: &Code) -> impl Iterator<Item = &'static str> + use<> {
    both(code).into_iter().flatten()
}

/// Attributes for names with capitals or double underscores, and for literals close to a constant of the standard library, which are
/// exact values of the mechanism.
fn both(code: &Code) -> [Option<&'static str>; 2] {
    let has_capitals = code.names().any(has_capitals);
    let is_approximate = code.words().any(is_close);
    [
        has_capitals.then_some(CAPITALS),
        is_approximate.then_some("#[allow(clippy::approx_constant)]"),
    ]
}

/// True if the literal is close to a known constant.
fn is_close(literal: &str) -> bool {
    let is_number = literal.as_bytes().first().is_some_and(u8::is_ascii_digit);
    is_number
        && literal.parse::<f64>().is_ok_and(|value| {
            KNOWN
                .iter()
                .any(|known| (value - known).abs() < APPROXIMATION_TOLERANCE * known)
        })
}

/// True if the name of a value or function has capitals or double underscores from the description. Names of types and constants do not
/// mix capitals and small letters around an underscore.
fn has_capitals(name: &str) -> bool {
    let name = name.trim_matches('_');
    let has = |is_so: fn(&u8) -> bool| name.bytes().any(|byte| is_so(&byte));
    name.contains("__")
        || name.contains('_') && has(u8::is_ascii_uppercase) && has(u8::is_ascii_lowercase)
}
