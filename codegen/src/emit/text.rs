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
use crate::program::{Constant, ConstantPart};
use crate::system::System;

/// Number of characters of a line that holds a formula.
const LINE: u64 = 100;

/// Expression on one line, with the bodies mentioned in this order.
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

/// Expression on one line; `None` if it is too long to read at once.
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

/// Remark beside a constant: its quantity and its exact value, as far as they fit into `room` characters; `None` if neither does.
pub fn constant(pool: &Pool, system: &System, constant: &Constant, room: usize) -> Option<String> {
    let meaning = constant.meaning.clone();
    let exact = exact(pool, system, &constant.part);
    let exact = exact.filter(|_| constant.part.literal(&pool.graph).is_none());
    let both = meaning.as_ref().zip(exact.as_ref());
    let both = both.map(|(meaning, exact)| format!("{meaning} = {exact}"));
    let mut remarks = [both, meaning, exact].into_iter().flatten();
    remarks.find(|it| it.chars().count() <= room)
}

/// A constant part of an expression, exactly; `None` if the part exceeds a line.
fn exact(pool: &Pool, system: &System, part: &ConstantPart) -> Option<String> {
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
