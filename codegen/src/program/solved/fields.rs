//! Which values several blocks need.

use std::collections::{HashMap, HashSet};

use super::{Action, BlockProgram};
use crate::expr::{ExprId, SymbolId};
use crate::system::{SymbolRole, System};

/// Values that another function than their own reads, and those in `outputs`, in order of definition. Where `whole`, the
/// coordinates are not among them: they have their own place.
pub(super) fn fields(
    blocks: &[BlockProgram],
    outputs: &HashSet<SymbolId>,
    whole: bool,
    system: &System,
) -> Vec<SymbolId> {
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
                Action::Solve { .. } => action.targets().into_iter().for_each(&mut define),
                Action::Angle { unknown, .. } => {
                    define(system.vector_form.unknowns[*unknown].position)
                }
                _ => {}
            }
        }
        if let Some(newton) = &block.newton {
            newton.measure.into_iter().flatten().for_each(&mut define);
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
            read.extend(newton.expressions());
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
    // What Newton-Raphson finds starts from its last values, and an angle is wound up from its last one.
    for &unknown in blocks
        .iter()
        .flat_map(|block| &block.newton)
        .flat_map(|newton| &newton.unknowns)
    {
        let unknown = &system.vector_form.unknowns[unknown];
        shared.extend([unknown.position, unknown.rate, unknown.acceleration]);
    }
    for action in blocks.iter().flat_map(|block| &block.actions) {
        if let Action::Angle { unknown, .. } = action {
            shared.insert(system.vector_form.unknowns[*unknown].position);
        }
    }
    shared.extend(outputs);
    order.retain(|&symbol| shared.contains(&symbol) && !(whole && is_coordinate(symbol)));
    order
}
