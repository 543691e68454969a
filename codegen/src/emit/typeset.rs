//! What formulas have in common where they are typeset: bars of fractions, factors side by side, letters with an index.
//!
//! Deliberately unknown here: how any of it is spelled.

use super::formula::{Printer, Spelling};
use super::parts::{Fraction, Part};
use crate::expr::ExprId;
use crate::system::{Described, System};

/// A fraction as it is typeset.
pub(super) enum Typeset {
    /// On a line.
    Line(String),
    /// With a bar.
    Bar {
        above: String,
        below: String,
        /// What stands behind the bar, if anything does.
        beside: Option<String>,
    },
}

impl Typeset {
    /// Only short numerators go over the bar; a long one stands beside its coefficient. `is_short` is asked for the bases of powers.
    pub(super) fn of<S: Spelling>(
        fraction: &Fraction,
        printer: &Printer<'_, S>,
        spelling: S,
        is_short: impl Fn(ExprId) -> bool,
    ) -> Typeset {
        let product = |parts: &[Part]| match parts {
            [] => spelling.digits("1"),
            parts => printer.product(parts, false),
        };
        if fraction.denominators.is_empty() {
            return Typeset::Line(product(&fraction.numerators));
        }
        let is_above = |part: &Part| match part {
            Part::Power(base, _) => is_short(*base),
            Part::Digits(_) | Part::Root(_) => true,
        };
        let numerators = fraction.numerators.iter().cloned();
        let (above, beside): (Vec<Part>, Vec<Part>) = numerators.partition(is_above);
        Typeset::Bar {
            above: product(&above),
            below: product(&fraction.denominators),
            beside: (!beside.is_empty()).then(|| product(&beside)),
        }
    }
}

/// Factors, some of which are digits: these need a sign between after something else; symbols and functions stand side by side.
pub(super) fn side_by_side(factors: &[(bool, String)], sign: &str, gap: &str) -> String {
    let mut text = String::new();
    for (position, (is_digits, factor)) in factors.iter().enumerate() {
        text.push_str(match (position, is_digits) {
            (0, _) => "",
            (_, true) => sign,
            (_, false) => gap,
        });
        text.push_str(factor);
    }
    text
}

/// A name that is none of a coordinate's.
pub(super) enum Local<'a> {
    /// The square of the length of a vector, `|AB|^2`.
    SquaredLength(&'a str),
    /// A component of a vector along an axis, `l_c3_x`.
    Component(&'a str, &'static str),
    /// Any other.
    Name(&'a str),
}

impl<'a> Local<'a> {
    pub(super) fn of(name: &'a str) -> Local<'a> {
        let length = name.strip_prefix('|');
        if let Some(vector) = length.and_then(|rest| rest.strip_suffix("|^2")) {
            return Local::SquaredLength(vector);
        }
        let axis = ["x", "y"]
            .into_iter()
            .find_map(|axis| Some((name.strip_suffix(axis)?.strip_suffix('_')?, axis)));
        match axis {
            Some((vector, axis)) => Local::Component(vector, axis),
            None => Local::Name(name),
        }
    }
}

/// What an unknown's letter is followed by.
pub(super) enum Index<'a> {
    /// The name of a body or of a joint.
    Name(&'a str),
    /// The names of two ends with `_` between them.
    Ends(&'a str),
}

/// The letter of an unknown, one of x, y, φ, s, h and ℓ, and its index.
pub(super) fn letter_and_index(system: &System, unknown: usize) -> (char, Index<'_>) {
    let unknown = &system.vector_form.unknowns[unknown];
    match unknown.describes {
        Described::Pose { body, axis } => {
            let name = &system.mechanism.bodies[body].name;
            (['x', 'y', 'φ'][axis], Index::Name(name))
        }
        Described::Contact { joint } => ('s', Index::Name(&system.mechanism.joints[joint].slug)),
        Described::Auxiliary => {
            let symbols = [("phi_", 'φ'), ("offset_", 'h'), ("length_", 'ℓ')];
            let found = symbols
                .iter()
                .find_map(|(prefix, letter)| Some((*letter, unknown.name.strip_prefix(prefix)?)));
            let (letter, ends) = found.unwrap_or(('ℓ', &unknown.name));
            (letter, Index::Ends(ends))
        }
    }
}
