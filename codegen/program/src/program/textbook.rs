//! The functions of the textbook view.

use super::function::{Function, Written};
use super::lengths::Lengths;
use super::passes::sharing::share_all;
use crate::expr::ExprId;
use crate::system::{Row, System};

/// Φ, Φ_q, Φ_t and γ.
#[derive(Clone, Debug)]
pub struct Textbook {
    /// Φ: one result a row.
    pub residual: Function,
    /// Φ_q: one result for each entry that is not identically zero, row by row.
    pub jacobian: Function,
    /// Φ_t: one result a row.
    pub time_derivative: Function,
    /// γ: one result a row.
    pub gamma: Function,
    /// The residuals of the rows that are monitored instead of solved, where there are any.
    pub monitored: Option<Function>,
    /// What lengths are scaled by.
    pub scaled_by: Lengths,
}

/// More coordinates than these make a dense Φ_q of over 175 kB, which no firmware and few threads have room for.
pub const LARGEST_TEXTBOOK: usize = 150;

impl Textbook {
    /// The functions of a system of moderate size.
    pub(super) fn of(system: &mut System) -> Option<Textbook> {
        if system.coordinates.len() > LARGEST_TEXTBOOK {
            return None;
        }
        let rows = |rows: &[Row], of: fn(&Row) -> ExprId| {
            let results = rows.iter().map(|row| Written {
                expr: of(row),
                bodies: row.bodies.clone(),
            });
            Function {
                results: results.collect(),
                ..Function::default()
            }
        };
        let entries = system.rows.iter().flat_map(|row| {
            row.jacobian.iter().map(|entry| Written {
                expr: entry.value,
                bodies: row.bodies.clone(),
            })
        });
        let jacobian = Function {
            results: entries.collect(),
            ..Function::default()
        };
        let monitored = rows(&system.monitored, |row| row.residual);
        let mut textbook = Textbook {
            residual: rows(&system.rows, |row| row.residual),
            jacobian,
            time_derivative: rows(&system.rows, |row| row.time_derivative),
            gamma: rows(&system.rows, |row| row.gamma),
            monitored: (!monitored.results.is_empty()).then_some(monitored),
            scaled_by: Lengths::of_system(system),
        };
        for function in textbook.functions_mut() {
            share_all(function, system);
        }
        Some(textbook)
    }

    /// All of them.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let derived = [&self.jacobian, &self.time_derivative, &self.gamma];
        [&self.residual]
            .into_iter()
            .chain(derived)
            .chain(&self.monitored)
            .chain(&self.scaled_by.following)
    }

    fn functions_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        let derived = [
            &mut self.jacobian,
            &mut self.time_derivative,
            &mut self.gamma,
        ];
        [&mut self.residual]
            .into_iter()
            .chain(derived)
            .chain(&mut self.monitored)
    }
}
