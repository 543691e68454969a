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

/// Adds equations to one another, or subtracts them, as long as one mentions fewer unknowns then.
pub(super) fn shortened(
    mut equations: Vec<BlockEquation>,
    form: &VectorForm,
    graph: &mut Graph,
) -> Vec<BlockEquation> {
    if equations.len() < FEWEST {
        return equations;
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
            let pair = [equations[at].residual, equations[other].residual];
            let both = [
                graph.subtract(pair[0], pair[1]),
                graph.add(pair[0], pair[1]),
            ];
            let shorter = both.map(|residual| (mentioned(residual, graph), residual));
            let shortest = shorter
                .into_iter()
                .min_by_key(|(unknowns, _)| unknowns.len());
            if let Some((unknowns, residual)) = shortest
                && unknowns.len() < own[at].len()
            {
                equations[at].residual = residual;
                own[at] = unknowns;
                // It may shorten others now, and be shortened again.
                waiting = (0..equations.len()).collect();
            }
        }
    }
    equations
}
