//! Writes the components of a rotated vector as waves of its angle.

use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::system::{SymbolRole, System};

/// Coefficients of cosine and sine in a sum of vectors that rotate with one angle.
pub(super) type Amplitude = [ExprId; 2];

/// Returns the symbol whose bounds determine those of a symbol.
pub(super) fn base(symbol: SymbolId, system: &System) -> SymbolId {
    match system.roles.get(symbol.index()) {
        Some(&SymbolRole::Arm(place)) => {
            system.vector_form.unknowns[system.vector_form.arms[place].angle].position
        }
        _ => symbol,
    }
}

/// Returns the angle of a rotated vector's component, and the component as a wave of that angle; `None` for other symbols.
pub(super) fn arm(symbol: SymbolId, system: &mut System) -> Option<(usize, Amplitude)> {
    let SymbolRole::Arm(place) = *system.roles.get(symbol.index())? else {
        return None;
    };
    let arm = &system.vector_form.arms[place];
    let [x, y] = arm.local;
    let amplitude = match symbol == arm.symbols[0] {
        true => [x, system.mechanism.graph.negate(y)],
        false => [y, x],
    };
    Some((arm.angle, amplitude))
}

pub(super) fn length(amplitude: Amplitude, graph: &mut Graph) -> ExprId {
    let squares = amplitude.map(|part| graph.multiply(part, part));
    let square = graph.sum(&squares);
    graph.sqrt(square)
}

/// Returns a constant bound on the magnitude of a value; `None` if it is not obvious.
pub(super) fn constant_size(value: ExprId, system: &mut System) -> Option<ExprId> {
    match *system.mechanism.graph.node(value) {
        Node::Sin(_) | Node::Cos(_) => Some(system.mechanism.graph.one()),
        Node::Symbol(symbol) => {
            let (_, amplitude) = arm(symbol, system)?;
            Some(length(amplitude, &mut system.mechanism.graph))
        }
        _ if system.mechanism.graph.is_fixed(value) => {
            Some(system.mechanism.graph.magnitude(value))
        }
        _ => None,
    }
}
