//! Initializes the frame before the first one from the design configuration.

use super::Module;
use super::scope::{Place, Scope};
use crate::expr::SymbolId;
use crate::pool::SymbolRole;
use crate::program::Function;

/// Value of a field before the first frame.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::emit) enum Estimate<'a> {
    /// Coordinate of this name in the pose that the caller passes.
    Coordinate(&'a str),
    /// Result with this index of the design configuration as a function of the parameters.
    Drawn(usize),
    /// Constant.
    Number(f64),
}

/// Returns the fields of the frame before the first one that are not zero.
pub(in crate::emit) fn estimates<'a>(module: &Module<'a>) -> Vec<(SymbolId, Estimate<'a>)> {
    let system = module.system;
    let design = module.program.drawn.as_ref();
    let fields = module.program.fields.iter().filter_map(|&symbol| {
        let SymbolRole::Position(unknown) = module.pool.role(symbol) else {
            return None;
        };
        let estimate = if let Some(coordinate) = system.coordinates.get(unknown) {
            Estimate::Coordinate(&coordinate.name)
        } else if design.is_some_and(|function| is_variable(function, unknown, module)) {
            Estimate::Drawn(unknown)
        } else {
            Estimate::Number(system.drawn_unknown(unknown, module.pool))
        };
        Some((symbol, estimate))
    });
    fields.collect()
}

/// True if parameters change the estimate of an unknown.
fn is_variable(function: &Function, place: usize, module: &Module<'_>) -> bool {
    let graph = &module.pool.graph;
    function
        .results
        .get(place)
        .is_some_and(|result| !graph.is_constant(result.expr))
}

/// True if functions of a frame read parameters, so that the frame stores them.
pub(in crate::emit) fn frame_keeps_parameters(module: &Module<'_>) -> bool {
    let mut functions = module
        .program
        .points
        .iter()
        .chain(&module.program.pressures);
    let has_parameters = !module.system.mechanism.parameters.is_empty();
    has_parameters
        && functions.any(|function| {
            let scope = Scope::new(module, function, Place::Coordinates);
            scope.reads().parameters
        })
}
