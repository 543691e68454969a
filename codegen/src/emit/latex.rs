//! Formulas and whole systems in LaTeX, for amsmath.

mod inspect;
pub(super) mod lines;
mod spelling;

pub use inspect::{inspect, inspect_fragment};
pub(crate) use spelling::{Latex, escaped, vector_name};

use super::formula::Printer;
use crate::expr::ExprId;
use crate::pool::{Pool, SymbolRole};
use crate::system::System;

/// One expression for math mode, with the bodies mentioned in this order.
pub fn formula(pool: &Pool, system: &System, bodies: &[usize], expr: ExprId) -> String {
    Printer::new(pool, system, bodies, Latex).expression(expr)
}

/// An unknown, its rate or its acceleration.
pub(crate) fn symbol(pool: &Pool, system: &System, role: SymbolRole) -> String {
    Printer::new(pool, system, &[], Latex).symbol(role)
}
