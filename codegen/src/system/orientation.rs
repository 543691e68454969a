//! Which bodies keep a constant angle to one another.
//!
//! A translational joint, or an absolute angle, ties the angle of one body to that of another up to a constant. Such bodies share
//! one sine and one cosine: that of their leader, the body that the joint names first.

use crate::expr::{ExprId, Graph, Node};
use crate::joint::Row;
use crate::joint::geometry::BodyId;
use crate::model::Body;

/// How the angle of each body follows from that of its leader.
#[derive(Clone, Debug)]
pub struct Orientations {
    /// For each body its leader and φ − φ of the leader, a constant. A leader follows itself by zero.
    leaders: Vec<(usize, ExprId)>,
}

impl Orientations {
    /// Every body is its own leader.
    pub(super) fn new(bodies: usize, graph: &Graph) -> Orientations {
        Orientations {
            leaders: (0..bodies).map(|body| (body, graph.zero())).collect(),
        }
    }

    /// The leader of a body and the constant φ − φ of the leader.
    pub fn leader(&self, body: BodyId) -> (BodyId, ExprId) {
        let (leader, offset) = self.leaders[body.0];
        (BodyId(leader), offset)
    }

    /// Ties two bodies where a row says φ_i − φ_j + constant = 0, or φ_i + constant = 0.
    pub(super) fn tie(&mut self, row: &Row, bodies: &[Body], graph: &mut Graph) {
        let Some((i, j, constant)) = constant_difference(row.residual, bodies, graph) else {
            return;
        };
        let ((leader, i_offset), (follower, j_offset)) = (self.leaders[i], self.leaders[j]);
        // The ground's angle is known, so it leads whatever is tied to it.
        let (leader, follower, offset) = if follower == 0 {
            // φ_leader = φ_follower + j_offset − i_offset − constant, with the ground as follower.
            let known = graph.subtract(j_offset, i_offset);
            (follower, leader, graph.subtract(known, constant))
        } else {
            let known = graph.subtract(i_offset, j_offset);
            (leader, follower, graph.add(known, constant))
        };
        if leader == follower {
            return;
        }
        for entry in &mut self.leaders {
            if entry.0 == follower {
                *entry = (leader, graph.add(entry.1, offset));
            }
        }
    }
}

/// `(i, j, c)` of φ_i − φ_j + c, with the ground as j of φ_i + c.
fn constant_difference(
    residual: ExprId,
    bodies: &[Body],
    graph: &mut Graph,
) -> Option<(usize, usize, ExprId)> {
    let symbols = graph.symbols(residual).to_vec();
    let angle_of = |symbol| {
        bodies
            .iter()
            .position(|body| body.coordinates.is_some_and(|own| own[2] == symbol))
    };
    let mut signed = [0, 0];
    let mut constant = residual;
    // Parameters are part of the constant.
    let moving = symbols
        .into_iter()
        .filter(|&symbol| graph.nominal(symbol).is_none())
        .collect::<Vec<_>>();
    for symbol in moving {
        let body = angle_of(symbol)?;
        let slope = graph.derivative(residual, symbol);
        let side = if slope == graph.one() {
            0
        } else if graph.negate(slope) == graph.one() {
            1
        } else {
            return None;
        };
        if signed[side] != 0 {
            return None;
        }
        signed[side] = body;
        let zero = graph.zero();
        constant = graph.substitute(constant, &[(symbol, zero)]);
    }
    match signed {
        [0, 0] => None,
        [i, j] if i != 0 => Some((i, j, constant)),
        // −φ_j + c = 0 says φ_j − c = 0.
        [_, j] => Some((j, 0, graph.negate(constant))),
    }
}

/// Whether an expression is a single symbol.
pub(super) fn as_symbol(expr: ExprId, graph: &Graph) -> Option<crate::expr::SymbolId> {
    match graph.node(expr) {
        Node::Symbol(symbol) => Some(*symbol),
        _ => None,
    }
}
