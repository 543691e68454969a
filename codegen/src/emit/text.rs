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
use crate::pool::{Pool, SymbolRole};
use crate::program::ConstantPart;
use crate::system::System;

/// The characters of a line that holds a formula.
const LINE: u64 = 100;

/// One expression on one line, with the bodies mentioned in this order.
pub fn formula(
    pool: &Pool,
    system: &System,
    bodies: &[usize],
    notation: Notation,
    expr: ExprId,
) -> String {
    Printer::new(pool, system, bodies, notation).expression(expr)
}

/// An unknown, its rate or its acceleration.
pub(crate) fn symbol(pool: &Pool, system: &System, notation: Notation, role: SymbolRole) -> String {
    Printer::new(pool, system, &[], notation).symbol(role)
}

/// The same where somebody would read it at one piece.
pub fn readable(
    pool: &Pool,
    system: &System,
    bodies: &[usize],
    notation: Notation,
    expr: ExprId,
) -> Option<String> {
    let is_readable = pool.graph.is_written_within(expr, LONGEST_FORMULA);
    is_readable.then(|| formula(pool, system, bodies, notation, expr))
}

/// A constant part of an expression, exactly; none where that takes more than a line.
pub fn constant(pool: &Pool, system: &System, part: &ConstantPart) -> Option<String> {
    let graph = &pool.graph;
    let fits = match part {
        ConstantPart::Sum(terms) => graph.is_sum_within(terms, LINE),
        ConstantPart::Product(number, factors) => graph.is_product_within(*number, factors, LINE),
    };
    fits.then(|| {
        Printer::new(pool, system, &[], Notation::Ascii)
            .exact()
            .constant(part)
    })
}
