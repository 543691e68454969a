//! Formulas and whole systems in plain text.

mod inspect;
mod spelling;
pub(super) mod table;

pub(crate) use inspect::given;
pub use inspect::inspect;
pub use table::shown_width;

use super::Notation;
use super::formula::Printer;
use super::named_parts::LONGEST_FORMULA;
use crate::expr::ExprId;
use crate::program::ConstantPart;
use crate::system::{SymbolRole, System};

/// Number of characters of a line that holds a formula.
const LINE: u64 = 100;

/// Expression on one line, with the bodies mentioned in this order.
pub fn formula(system: &System, bodies: &[usize], notation: Notation, expr: ExprId) -> String {
    Printer::new(system, bodies, notation).expression(expr)
}

/// An unknown, its rate or its acceleration.
pub(crate) fn symbol(system: &System, notation: Notation, role: SymbolRole) -> String {
    Printer::new(system, &[], notation).symbol(role)
}

/// Expression on one line; `None` if it is too long to read at once.
pub fn readable(
    system: &System,
    bodies: &[usize],
    notation: Notation,
    expr: ExprId,
) -> Option<String> {
    let is_readable = system
        .mechanism
        .graph
        .is_written_within(expr, LONGEST_FORMULA);
    is_readable.then(|| formula(system, bodies, notation, expr))
}

/// Constant part of an expression, exactly; `None` if that exceeds a line.
pub fn constant(system: &System, part: &ConstantPart) -> Option<String> {
    let graph = &system.mechanism.graph;
    let fits = match part {
        ConstantPart::Sum(terms) => graph.is_sum_within(terms, LINE),
        ConstantPart::Product(number, factors) => graph.is_product_within(*number, factors, LINE),
    };
    fits.then(|| {
        Printer::new(system, &[], Notation::Ascii)
            .exact()
            .constant(part)
    })
}
