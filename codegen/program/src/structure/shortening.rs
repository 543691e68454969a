//! Replaces the equations of a block by equivalent ones that mention fewer unknowns.
//!
//! Positions follow from one another along the joints in written order, and one equation remains for each loop. If the written
//! order differs from that of the links, such a loop is longer than necessary. The sum or the difference of two loops is then
//! short.

use std::collections::BTreeSet;

use super::elimination::BlockEquation;
use crate::expr::ExprId;
use crate::pool::Pool;

/// Smallest number of equations that are shortened; loops of fewer equations are short.
const MIN_EQUATIONS: usize = 12;

/// Addition of an equation to another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Addition {
    /// Row of the vector form whose equation has changed.
    pub to: usize,
    /// Row whose equation was added, in its state at that time.
    pub added: usize,
    /// True if the equation was subtracted instead.
    pub is_subtracted: bool,
}

/// Adds or subtracts equations while one of them then mentions fewer unknowns. Returns the additions in order.
pub(super) fn shorten(equations: &mut [BlockEquation], pool: &mut Pool) -> Vec<Addition> {
    let mut additions = Vec::new();
    if equations.len() < MIN_EQUATIONS {
        return additions;
    }
    let mentioned = |residual: ExprId, pool: &Pool| -> BTreeSet<usize> {
        pool.mentioned(residual).into_iter().collect()
    };
    let unknowns_of = equations.iter().map(|it| mentioned(it.residual, pool));
    let mut unknowns_of: Vec<BTreeSet<usize>> = unknowns_of.collect();
    let mut waiting: BTreeSet<usize> = (0..equations.len()).collect();
    while let Some(at) = waiting.pop_first() {
        for other in 0..equations.len() {
            let shared = unknowns_of[at].intersection(&unknowns_of[other]).count();
            let are_alike = equations[at].quantity == equations[other].quantity;
            // Only shared unknowns can cancel.
            if other == at || !are_alike || 2 * shared <= unknowns_of[other].len() {
                continue;
            }
            let [first, second] = [at, other].map(|it| equations[it].residual);
            let tried = [true, false].map(|is_subtracted| {
                let residual = match is_subtracted {
                    true => pool.graph.subtract(first, second),
                    false => pool.graph.add(first, second),
                };
                (mentioned(residual, pool), residual, is_subtracted)
            });
            let shortest = tried
                .into_iter()
                .min_by_key(|(unknowns, ..)| unknowns.len());
            if let Some((unknowns, residual, is_subtracted)) = shortest
                && unknowns.len() < unknowns_of[at].len()
            {
                additions.push(Addition {
                    to: equations[at].row,
                    added: equations[other].row,
                    is_subtracted,
                });
                equations[at].residual = residual;
                unknowns_of[at] = unknowns;
                // The new equation may shorten others, and may become shorter itself.
                waiting = (0..equations.len()).collect();
            }
        }
    }
    additions
}
