//! Writes the components of a rotated vector as waves of its angle.

use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::pool::{Pool, SymbolRole};

/// Coefficients of cosine and sine in a sum of vectors that rotate with one angle.
pub(super) type Amplitude = [ExprId; 2];

/// Returns the symbol whose bounds determine those of a symbol.
pub(super) fn base(symbol: SymbolId, pool: &Pool) -> SymbolId {
    match pool.role(symbol) {
        SymbolRole::Arm(place) => pool.position(pool.arms()[place].angle),
        _ => symbol,
    }
}

/// Returns the angle of a rotated vector's component, and the component as a wave of that angle; `None` for other symbols.
pub(super) fn arm(symbol: SymbolId, pool: &mut Pool) -> Option<(usize, Amplitude)> {
    let SymbolRole::Arm(place) = pool.role(symbol) else {
        return None;
    };
    let arm = pool.arms()[place].clone();
    let [x, y] = arm.local;
    let amplitude = match symbol == arm.symbols[0] {
        true => [x, pool.graph.negate(y)],
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
pub(super) fn constant_size(value: ExprId, pool: &mut Pool) -> Option<ExprId> {
    match *pool.graph.node(value) {
        Node::Sin(_) | Node::Cos(_) => Some(pool.graph.one()),
        Node::Symbol(symbol) => {
            let (_, amplitude) = arm(symbol, pool)?;
            Some(length(amplitude, &mut pool.graph))
        }
        _ if pool.graph.is_fixed(value) => Some(pool.graph.magnitude(value)),
        _ => None,
    }
}
