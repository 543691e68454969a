//! Determines the sign of the determinant of a block without a closed form in the design configuration.
//!
//! The sign distinguishes the assembly modes of a block. The sign is that of the design geometry, whatever the drivers require:
//! drivers may differ from the design configuration, all other equations must hold.

use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::pool::{Pool, SymbolRole};
use crate::program::lengths::Lengths;
use crate::system::System;

/// Largest residual of an equation in the design configuration, relative to its scale: descriptions have a limited number of
/// digits.
const FITS: f64 = 1e-4;

/// Smallest determinant of rows of length 1 that decides the mode; below, the largest number of unknowns of such blocks.
const DECIDED: f64 = 1e-6;
const MAX_UNKNOWNS: usize = 64;

/// Assembly mode of a block without a closed form in the design configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnMode {
    /// Sign of the determinant: true if positive.
    Sign(bool),
    /// Undefined, as the design configuration does not satisfy the equations, or as they are too many for a sign to distinguish
    /// modes.
    Open,
    /// Undecided, as the design configuration satisfies the equations but is nearly singular.
    Undecided,
}

impl DrawnMode {
    /// Returns true if the determinant is positive; `None` if the design configuration does not decide.
    pub fn sign(self) -> Option<bool> {
        match self {
            DrawnMode::Sign(is_positive) => Some(is_positive),
            DrawnMode::Open | DrawnMode::Undecided => None,
        }
    }
}

/// Returns the mode of the design configuration, for a Jacobian row by row.
pub(super) fn drawn_mode(
    residuals: &[ExprId],
    jacobian: &[ExprId],
    [rows, columns]: [&[Quantity]; 2],
    [row_lengths, column_lengths]: &[Lengths; 2],
    pool: &Pool,
    system: &System,
) -> DrawnMode {
    let order = residuals.len();
    if order > MAX_UNKNOWNS {
        return DrawnMode::Open;
    }
    let fits = |(residual, row): (&ExprId, &Quantity)| {
        is_driven(*residual, pool)
            || system.drawn_value(*residual, pool).abs() <= FITS * row_lengths.scale(*row)
    };
    if !residuals.iter().zip(rows).all(fits) {
        return DrawnMode::Open;
    }
    let mut entries = Vec::with_capacity(order * order);
    for row in jacobian.chunks(order) {
        let row = row.iter().zip(columns);
        entries.extend(row.map(|(entry, column)| {
            system.drawn_value(*entry, pool) * column_lengths.scale(*column)
        }));
    }
    sign_of(&entries).map_or(DrawnMode::Undecided, DrawnMode::Sign)
}

/// Returns true if the determinant of a square matrix, row by row, is positive; `None` if that of its rows of length 1 is nearly
/// zero.
pub fn sign_of(entries: &[f64]) -> Option<bool> {
    let order = entries.len().isqrt();
    let rows = entries.chunks(order.max(1)).map(|row| {
        let size = row.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        row.iter().map(|entry| entry / size).collect()
    });
    let determinant = determinant(rows.collect());
    // NaN must count as undecided, hence this comparison.
    (determinant.abs() >= DECIDED).then_some(determinant > 0.0)
}

/// True if time, inputs or parameters change an equation.
fn is_driven(residual: ExprId, pool: &Pool) -> bool {
    let symbols = pool.graph.symbols(residual).iter();
    let mut roles = symbols.map(|symbol| pool.role(*symbol));
    roles.any(|role| {
        matches!(
            role,
            SymbolRole::Time | SymbolRole::Input { .. } | SymbolRole::Parameter(_)
        )
    })
}

fn determinant(mut rows: Vec<Vec<f64>>) -> f64 {
    let mut product = 1.0;
    for column in 0..rows.len() {
        let pivots = (column..rows.len())
            .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()));
        let Some(pivot) = pivots else { break };
        if pivot != column {
            rows.swap(pivot, column);
            product = -product;
        }
        let (before, after) = rows.split_at_mut(column + 1);
        let pivot_row = &before[column];
        product *= pivot_row[column];
        if product == 0.0 {
            break;
        }
        for row in after {
            let factor = row[column] / pivot_row[column];
            for (entry, pivot) in row.iter_mut().zip(pivot_row).skip(column) {
                *entry -= factor * pivot;
            }
        }
    }
    product
}
