//! Statements → those that something needs.

use std::collections::HashSet;

use super::Action;
use crate::expr::SymbolId;
use crate::system::System;

/// Drops, from the last to the first, what defines a value that nothing after it reads. `kept` tells which values are read
/// elsewhere. A comment stays while something follows it before the next comment.
pub(super) fn needed(
    actions: Vec<Action>,
    read: impl IntoIterator<Item = SymbolId>,
    kept: impl Fn(SymbolId) -> bool,
    system: &System,
) -> Vec<Action> {
    let mut live: HashSet<SymbolId> = read.into_iter().collect();
    let mut needed = Vec::with_capacity(actions.len());
    let mut followed = false;
    for action in actions.into_iter().rev() {
        let keep = match &action {
            Action::Let { target, .. } => live.contains(target) || kept(*target),
            Action::SineCosine { sine, cosine, .. } => [sine, cosine]
                .into_iter()
                .any(|part| live.contains(part) || kept(*part)),
            Action::Comment(_) => std::mem::take(&mut followed),
            Action::Angle { .. }
            | Action::Reach { .. }
            | Action::Nonzero { .. }
            | Action::Newton => true,
        };
        if !keep {
            continue;
        }
        followed |= !matches!(action, Action::Comment(_));
        for expr in action.values() {
            live.extend(system.mechanism.graph.symbols(expr));
        }
        needed.push(action);
    }
    needed.reverse();
    needed
}
