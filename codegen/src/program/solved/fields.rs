//! Which values several blocks need.

use std::collections::{HashMap, HashSet};

use super::{Action, BlockProgram};
use crate::expr::{ExprId, SymbolId};
use crate::system::{SymbolRole, System};

/// Arms and displacements, with their rates, that another function than their own reads, in order of definition.
pub(super) fn fields(blocks: &[BlockProgram], system: &System) -> Vec<SymbolId> {
    let mut home: HashMap<SymbolId, usize> = HashMap::new();
    let mut order: Vec<SymbolId> = Vec::new();
    for (index, block) in blocks.iter().enumerate() {
        let mut define = |symbol: SymbolId| {
            if home.insert(symbol, index).is_none() {
                order.push(symbol);
            }
        };
        for action in &block.actions {
            match action {
                Action::Let { target, .. } => define(*target),
                Action::SineCosine { sine, cosine, .. } => {
                    [*sine, *cosine].into_iter().for_each(&mut define)
                }
                _ => {}
            }
        }
        for &unknown in block.newton.iter().flat_map(|newton| &newton.unknowns) {
            let unknown = &system.vector_form.unknowns[unknown];
            [unknown.position, unknown.rate, unknown.acceleration]
                .into_iter()
                .for_each(&mut define);
        }
    }
    let coordinates = system.coordinates.len();
    let is_coordinate = |symbol: SymbolId| match system.roles[symbol.index()] {
        SymbolRole::Position(unknown)
        | SymbolRole::Rate(unknown)
        | SymbolRole::Acceleration(unknown) => unknown < coordinates,
        _ => false,
    };
    let mut shared: HashSet<SymbolId> = HashSet::new();
    for (index, block) in blocks.iter().enumerate() {
        let mut read: Vec<ExprId> = block.actions.iter().flat_map(Action::values).collect();
        if let Some(newton) = &block.newton {
            let lists = [
                &newton.residuals,
                &newton.jacobian,
                &newton.time_derivative,
                &newton.gamma,
            ];
            read.extend(lists.into_iter().flatten());
        }
        for symbol in read
            .into_iter()
            .flat_map(|expr| system.mechanism.graph.symbols(expr))
        {
            if home.get(symbol).is_some_and(|&place| place != index) {
                shared.insert(*symbol);
            }
        }
    }
    // Displacements that Newton-Raphson finds start from their last values, so they are kept.
    for &unknown in blocks
        .iter()
        .flat_map(|block| &block.newton)
        .flat_map(|newton| &newton.unknowns)
    {
        let unknown = &system.vector_form.unknowns[unknown];
        for symbol in [unknown.position, unknown.rate, unknown.acceleration] {
            shared.insert(symbol);
        }
    }
    order.retain(|&symbol| shared.contains(&symbol) && !is_coordinate(symbol));
    order
}
