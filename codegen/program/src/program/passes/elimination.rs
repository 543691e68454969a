//! Counts the operations of Gaussian elimination in the runtime: a reciprocal for each pivot, and multiplied columns.

use super::costs::Operations;

/// Returns the operations of eliminating a square matrix.
pub(super) fn elimination(order: usize) -> Operations {
    let below = order * order.saturating_sub(1);
    let squares = below * (2 * order).saturating_sub(1) / 6;
    Operations {
        additions: squares,
        multiplications: squares + below / 2,
        divisions: order,
        ..Operations::default()
    }
}

/// Returns the operations of one solution with the factors.
pub(super) fn substitution(order: usize) -> Operations {
    let below = order * order.saturating_sub(1);
    Operations {
        additions: below,
        multiplications: below,
        divisions: order,
        ..Operations::default()
    }
}
