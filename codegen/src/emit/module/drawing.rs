//! The drawing → what stands in the frame before the first one.

use super::Module;
use super::scope::{Place, Scope};
use crate::expr::SymbolId;
use crate::pool::SymbolRole;
use crate::program::Function;

/// What a field is before the first frame.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::emit) enum Estimate<'a> {
    /// The coordinate of this name in the pose that is given.
    Coordinate(&'a str),
    /// The result of this place of the drawing, which parameters change.
    Drawn(usize),
    /// A number.
    Number(f64),
}

/// The fields in which the frame before the first one differs from one at rest in the origin.
pub(in crate::emit) fn estimates<'a>(module: &Module<'a>) -> Vec<(SymbolId, Estimate<'a>)> {
    let system = module.system;
    let given = module.program.drawn.as_ref();
    let fields = module.program.fields.iter().filter_map(|&symbol| {
        let SymbolRole::Position(unknown) = module.pool.role(symbol) else {
            return None;
        };
        let estimate = if let Some(coordinate) = system.coordinates.get(unknown) {
            Estimate::Coordinate(&coordinate.name)
        } else if given.is_some_and(|function| is_given(function, unknown, module)) {
            Estimate::Drawn(unknown)
        } else {
            Estimate::Number(system.drawn_unknown(unknown, module.pool))
        };
        Some((symbol, estimate))
    });
    fields.collect()
}

/// Whether parameters change the estimate of an unknown.
fn is_given(function: &Function, place: usize, module: &Module<'_>) -> bool {
    let graph = &module.pool.graph;
    function
        .results
        .get(place)
        .is_some_and(|result| !graph.is_constant(result.expr))
}

/// Whether a frame keeps the parameters that its points are found with.
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
