//! A block that evaluates functions of unknowns → the same with every such value, and what is used more than once, computed once.
//!
//! Arms and closed forms never need it: their sines and cosines are symbols already. Where the path of a curve or a law of an
//! unknown stands in the equations, its functions would otherwise be written out wherever they occur. What is shared is
//! computed right before its first use, when everything in it has been found.

use std::collections::HashSet;

use super::evaluation::note_constants;
use super::{Action, BlockProgram};
use crate::expr::{ExprId, Graph};
use crate::program::Straight;
use crate::program::constants::Constants;
use crate::program::operations::is_function;
use crate::system::System;

/// Whether some function in these expressions has no name in `known`.
pub(super) fn calls_functions(
    expressions: impl IntoIterator<Item = ExprId>,
    known: &Straight,
    graph: &Graph,
) -> bool {
    let mut seen: HashSet<ExprId> = HashSet::new();
    let mut stack: Vec<ExprId> = expressions.into_iter().collect();
    while let Some(expr) = stack.pop() {
        if graph.is_constant(expr) || known.name_of(expr).is_some() || !seen.insert(expr) {
            continue;
        }
        if is_function(graph.node(expr)) {
            return true;
        }
        stack.extend(graph.operands(expr));
    }
    false
}

/// Shares what the actions and the Newton-Raphson of the block compute; a block without functions of unknowns stays as it is.
pub(super) fn share(block: &mut BlockProgram, system: &System, constants: &mut Constants) {
    let graph = &system.mechanism.graph;
    let values: Vec<ExprId> = block.actions.iter().flat_map(Action::values).collect();
    if calls_functions(values.iter().copied(), &block.time, graph) {
        let shared = straight(&values, &block.actions, &block.time, system, constants);
        note_constants(&values, system, &shared, constants);
        let actions = std::mem::take(&mut block.actions);
        let mut computed = vec![false; shared.statements.len()];
        for action in actions {
            for place in shared.needed_by(&action.values(), system) {
                if !std::mem::replace(&mut computed[place], true) {
                    let statement = shared.statements[place].clone();
                    block.actions.push(Action::Share(statement));
                }
            }
            block.actions.push(action);
        }
        block.shared = Some(shared);
    }
    if let Some(newton) = &mut block.newton {
        let values: Vec<ExprId> = newton.expressions().collect();
        if calls_functions(values.iter().copied(), &block.time, graph) {
            let shared = straight(&values, &newton.geometry, &block.time, system, constants);
            note_constants(&values, system, &shared, constants);
            newton.shared = Some(shared);
        }
    }
}

/// The statements for these values beside those of `known`, with names that the actions do not use.
fn straight(
    values: &[ExprId],
    actions: &[Action],
    known: &Straight,
    system: &System,
    constants: &mut Constants,
) -> Straight {
    let taken = actions
        .iter()
        .flat_map(Action::targets)
        .map(|symbol| system.local_name(symbol).to_string());
    let results = values.iter().map(|&value| (value, Vec::new())).collect();
    Straight::beside(known, taken, results, system, constants)
}
