//! What Gaussian elimination takes, as the runtime does it: a reciprocal for each pivot, and columns that are multiplied by it.

use super::costs::Operations;

/// The elimination of a square matrix.
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

/// One solution with its factors.
pub(super) fn substitution(order: usize) -> Operations {
    let below = order * order.saturating_sub(1);
    Operations {
        additions: below,
        multiplications: below,
        divisions: order,
        ..Operations::default()
    }
}
