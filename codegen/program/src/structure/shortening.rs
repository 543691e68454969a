//! The equations of a block → as many that say the same and mention fewer unknowns each.
//!
//! Positions follow from one another along the joints as they are written, and an equation remains for each loop that these leave. In
//! another order than that of the links such a loop goes a long way round; the sum or the difference of two of them is then a short
//! one. Deliberately unknown here: how equations are solved.

use std::collections::BTreeSet;

use super::elimination::BlockEquation;
use crate::expr::{ExprId, Graph};
use crate::system::VectorForm;

/// The fewest equations that are looked at. Of fewer no loop is long.
const FEWEST: usize = 12;

/// An equation that another one was added to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Addition {
    /// The row of the vector form whose equation has changed.
    pub to: usize,
    /// The row whose equation was added, as it was then.
    pub added: usize,
    /// Whether it was subtracted instead.
    pub is_subtracted: bool,
}

/// Adds equations to one another, or subtracts them, as long as one mentions fewer unknowns then. Says in order what was done.
pub(super) fn shorten(
    equations: &mut [BlockEquation],
    form: &VectorForm,
    graph: &mut Graph,
) -> Vec<Addition> {
    let mut additions = Vec::new();
    if equations.len() < FEWEST {
        return additions;
    }
    let mentioned = |residual: ExprId, graph: &Graph| -> BTreeSet<usize> {
        form.mentioned(residual, graph).into_iter().collect()
    };
    let own = equations.iter().map(|it| mentioned(it.residual, graph));
    let mut own: Vec<BTreeSet<usize>> = own.collect();
    let mut waiting: BTreeSet<usize> = (0..equations.len()).collect();
    while let Some(at) = waiting.pop_first() {
        for other in 0..equations.len() {
            let shared = own[at].intersection(&own[other]).count();
            let are_alike = equations[at].quantity == equations[other].quantity;
            // What both mention is all that can vanish.
            if other == at || !are_alike || 2 * shared <= own[other].len() {
                continue;
            }
            let [first, second] = [at, other].map(|it| equations[it].residual);
            let tried = [true, false].map(|is_subtracted| {
                let residual = match is_subtracted {
                    true => graph.subtract(first, second),
                    false => graph.add(first, second),
                };
                (mentioned(residual, graph), residual, is_subtracted)
            });
            let shortest = tried
                .into_iter()
                .min_by_key(|(unknowns, ..)| unknowns.len());
            if let Some((unknowns, residual, is_subtracted)) = shortest
                && unknowns.len() < own[at].len()
            {
                additions.push(Addition {
                    to: equations[at].row,
                    added: equations[other].row,
                    is_subtracted,
                });
                equations[at].residual = residual;
                own[at] = unknowns;
                // It may shorten others now, and be shortened again.
                waiting = (0..equations.len()).collect();
            }
        }
    }
    additions
}
