//! Blocks → what of them something needs.
//!
//! From the last statement of the last block to the first of the first: what defines a value that nothing after it reads is left
//! out, and a block of which nothing remains is left out as a whole.

use std::collections::HashSet;

use super::{Action, BlockProgram, NewtonBlock};
use crate::expr::SymbolId;
use crate::system::System;

/// Leaves out of all blocks what neither `kept` nor anything that is kept asks for.
pub(super) fn prune(blocks: &mut [BlockProgram], kept: &dyn Fn(SymbolId) -> bool, system: &System) {
    let mut live = HashSet::new();
    for block in blocks.iter_mut().rev() {
        let actions = std::mem::take(&mut block.actions);
        block.actions = needed(actions, block.newton.as_ref(), &mut live, kept, system);
        if !block.actions.contains(&Action::Newton) {
            block.newton = None;
        }
    }
}

/// The statements that `live` values and `kept` ones need; afterwards `live` holds what they read.
pub(super) fn needed(
    actions: Vec<Action>,
    newton: Option<&NewtonBlock>,
    live: &mut HashSet<SymbolId>,
    kept: &dyn Fn(SymbolId) -> bool,
    system: &System,
) -> Vec<Action> {
    let mut needed = Vec::with_capacity(actions.len());
    // Whether anything after this place remains at all, and whether anything does before the next comment.
    let (mut remains, mut followed) = (false, false);
    for mut action in actions.into_iter().rev() {
        let wanted = |symbol: SymbolId| live.contains(&symbol) || kept(symbol);
        if let Action::Solve { targets, .. } = &mut action {
            for target in targets {
                *target = target.filter(|&symbol| wanted(symbol));
            }
        }
        let keep = match &action {
            Action::Let { .. } | Action::SineCosine { .. } | Action::Solve { .. } => {
                action.targets().into_iter().any(wanted)
            }
            Action::Factorize => needed
                .iter()
                .any(|later| matches!(later, Action::Solve { .. })),
            Action::Angle { unknown, .. } => wanted(system.vector_form.unknowns[*unknown].position),
            Action::Newton => {
                let found = newton.into_iter().flat_map(|newton| &newton.unknowns);
                let measure = newton.and_then(|newton| newton.measure);
                remains
                    || measure.into_iter().flatten().any(wanted)
                    || found.into_iter().any(|&unknown| {
                        let unknown = &system.vector_form.unknowns[unknown];
                        [unknown.position, unknown.rate, unknown.acceleration]
                            .into_iter()
                            .any(wanted)
                    })
            }
            // What is checked is needed by all that follows in the block.
            Action::Reach { .. } | Action::Nonzero { .. } => remains,
            // Sharing comes after this.
            Action::Share(_) => true,
            Action::Section(_) | Action::Comment(_) => std::mem::take(&mut followed),
        };
        if !keep {
            continue;
        }
        if !matches!(action, Action::Section(_) | Action::Comment(_)) {
            (remains, followed) = (true, true);
        }
        for expr in action.values() {
            live.extend(system.mechanism.graph.symbols(expr));
        }
        if let (Action::Newton, Some(newton)) = (&action, newton) {
            for expr in newton.expressions() {
                live.extend(system.mechanism.graph.symbols(expr));
            }
        }
        needed.push(action);
    }
    needed.reverse();
    needed
}
