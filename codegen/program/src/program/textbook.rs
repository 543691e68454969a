//! Makes the functions of the textbook formulation.

use super::function::{Function, Written};
use super::lengths::Lengths;
use super::passes::sharing::share_all;
use crate::expr::ExprId;
use crate::pool::Pool;
use crate::system::{Row, System};

/// Functions for Φ, Φ_q, Φ_t and γ.
#[derive(Clone, Debug)]
pub struct Textbook {
    /// Φ, one result per row.
    pub residual: Function,
    /// Φ_q, one result per entry that is not identically zero, row by row.
    pub jacobian: Function,
    /// Φ_t, one result per row.
    pub time_derivative: Function,
    /// γ, one result per row.
    pub gamma: Function,
    /// Residuals of the monitored rows; `None` if there are none.
    pub monitored: Option<Function>,
    /// Lengths that scale residuals.
    pub scaled_by: Lengths,
}

/// Largest number of coordinates with a dense Φ_q, of about 175 kB: most firmware and thread stacks have no room for more.
pub const LARGEST_TEXTBOOK: usize = 150;

impl Textbook {
    /// Returns the functions of a system; `None` if the system is too large.
    pub(super) fn of(pool: &mut Pool, system: &System) -> Option<Textbook> {
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
            scaled_by: Lengths::of_system(pool, system),
        };
        for function in textbook.functions_mut() {
            share_all(function, pool, system);
        }
        Some(textbook)
    }

    /// Returns all functions.
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
