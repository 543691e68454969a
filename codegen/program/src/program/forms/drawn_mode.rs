//! The equations of a block without a closed form → the sign of their determinant in the drawing.
//!
//! The sign tells the assembly modes of a block apart, and it is that of the drawn geometry, whatever drives the mechanism: drivers
//! need not be where they are drawn, but everything else must fit. Deliberately unknown here: how the block is solved.

use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::program::lengths::Lengths;
use crate::system::{SymbolRole, System};

/// By how much an equation may miss, as a part of what it is scaled by: drawings are written with some digits.
const FITS: f64 = 1e-4;

/// The least determinant of rows of length 1 that decides, of blocks up to so many unknowns.
const DECIDED: f64 = 1e-6;
const LARGEST: usize = 64;

/// What the drawing says about the assembly mode of a block without a closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnMode {
    /// The determinant has this sign: whether it is positive.
    Sign(bool),
    /// The drawing does not fit the equations, or there are too many of them for a sign to tell modes apart.
    Open,
    /// The drawing fits, but is nearly singular.
    Undecided,
}

impl DrawnMode {
    /// Whether the determinant is positive, where the drawing says so.
    pub fn sign(self) -> Option<bool> {
        match self {
            DrawnMode::Sign(is_positive) => Some(is_positive),
            DrawnMode::Open | DrawnMode::Undecided => None,
        }
    }
}

/// The mode of the drawing. The Jacobian is given row by row.
pub(super) fn drawn_mode(
    residuals: &[ExprId],
    jacobian: &[ExprId],
    [rows, columns]: [&[Quantity]; 2],
    [row_lengths, column_lengths]: &[Lengths; 2],
    system: &System,
) -> DrawnMode {
    let order = residuals.len();
    if order > LARGEST {
        return DrawnMode::Open;
    }
    let fits = |(residual, row): (&ExprId, &Quantity)| {
        is_driven(*residual, system)
            || system.drawn_value(*residual).abs() <= FITS * row_lengths.scale(*row)
    };
    if !residuals.iter().zip(rows).all(fits) {
        return DrawnMode::Open;
    }
    let mut entries = Vec::with_capacity(order * order);
    for row in jacobian.chunks(order) {
        let row = row.iter().zip(columns);
        entries.extend(
            row.map(|(entry, column)| system.drawn_value(*entry) * column_lengths.scale(*column)),
        );
    }
    sign_of(&entries).map_or(DrawnMode::Undecided, DrawnMode::Sign)
}

/// Whether the determinant of a square matrix, row by row, is positive; `None` where that of its rows of length 1 is nearly zero.
pub fn sign_of(entries: &[f64]) -> Option<bool> {
    let order = entries.len().isqrt();
    let rows = entries.chunks(order.max(1)).map(|row| {
        let size = row.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        row.iter().map(|entry| entry / size).collect()
    });
    let determinant = determinant(rows.collect());
    // Written so that NaN decides nothing.
    (determinant.abs() >= DECIDED).then_some(determinant > 0.0)
}

/// Whether what is given from outside changes an equation.
fn is_driven(residual: ExprId, system: &System) -> bool {
    let symbols = system.mechanism.graph.symbols(residual).iter();
    let mut roles = symbols.map(|symbol| system.roles.get(symbol.index()));
    roles.any(|role| {
        matches!(
            role,
            Some(SymbolRole::Time | SymbolRole::Input { .. } | SymbolRole::Parameter(_))
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
        let own = &before[column];
        product *= own[column];
        if product == 0.0 {
            break;
        }
        for row in after {
            let factor = row[column] / own[column];
            for (entry, own) in row.iter_mut().zip(own).skip(column) {
                *entry -= factor * own;
            }
        }
    }
    product
}
