//! Finds bodies that keep a constant angle to one another.
//!
//! A translational joint or an absolute angle ties the angle of one body to that of another, except for a constant. Tied bodies
//! share the sine and cosine of their leader, the body that the joint names first.

use std::collections::HashMap;

use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::joint::Row;
use crate::joint::geometry::BodyId;

/// Leader of each body and constant angle between them.
#[derive(Clone, Debug)]
pub struct Orientations {
    /// For each body its leader and the constant φ − φ of the leader. A leader follows itself by zero. Before `settle`, another
    /// tied body may take the place of the leader.
    leaders: Vec<(usize, ExprId)>,
}

impl Orientations {
    /// Makes every body its own leader.
    pub(super) fn new(bodies: usize, graph: &Graph) -> Orientations {
        Orientations {
            leaders: (0..bodies).map(|body| (body, graph.zero())).collect(),
        }
    }

    /// Returns the leader of a body and the constant φ − φ of the leader.
    pub fn leader(&self, body: BodyId) -> (BodyId, ExprId) {
        let (leader, offset) = self.leaders[body.0];
        (BodyId(leader), offset)
    }

    /// Finds the leader of a body and shortens the chain of bodies that leads to it.
    fn find(&mut self, body: usize, graph: &mut Graph) -> (usize, ExprId) {
        let mut way = vec![body];
        let mut at = body;
        while self.leaders[at].0 != at {
            at = self.leaders[at].0;
            way.push(at);
        }
        // Runs back from the leader, so that the predecessor of each body is settled.
        for &body in way.iter().rev() {
            let (next, offset) = self.leaders[body];
            let (leader, further) = self.leaders[next];
            if leader != next {
                self.leaders[body] = (leader, graph.add(offset, further));
            }
        }
        self.leaders[body]
    }

    /// Gives every body its leader, after all ties.
    pub(super) fn settle(&mut self, graph: &mut Graph) {
        for body in 0..self.leaders.len() {
            self.find(body, graph);
        }
    }

    /// Ties two bodies if a row says φ_i − φ_j + constant = 0, or φ_i + constant = 0. `angles` maps angles to bodies.
    pub(super) fn tie(&mut self, row: &Row, angles: &HashMap<SymbolId, usize>, graph: &mut Graph) {
        let Some((i, j, constant)) = constant_difference(row.residual, angles, graph) else {
            return;
        };
        let (leader, i_offset) = self.find(i, graph);
        let (follower, j_offset) = self.find(j, graph);
        // The angle of the ground is constant, so the ground leads all bodies tied to it.
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
        self.leaders[follower] = (leader, offset);
    }
}

/// Returns `(i, j, c)` of φ_i − φ_j + c, with the ground as j of φ_i + c.
fn constant_difference(
    residual: ExprId,
    angles: &HashMap<SymbolId, usize>,
    graph: &mut Graph,
) -> Option<(usize, usize, ExprId)> {
    let symbols = graph.symbols(residual).to_vec();
    let mut signed = [0, 0];
    let mut constant = residual;
    // Parameters belong to the constant.
    let moving = symbols
        .into_iter()
        .filter(|&symbol| graph.nominal(symbol).is_none())
        .collect::<Vec<_>>();
    for symbol in moving {
        let body = *angles.get(&symbol)?;
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
        // −φ_j + c = 0 is equivalent to φ_j − c = 0.
        [_, j] => Some((j, 0, graph.negate(constant))),
    }
}

/// Returns the symbol that an expression consists of; `None` if the expression is not a symbol.
pub(super) fn as_symbol(expr: ExprId, graph: &Graph) -> Option<SymbolId> {
    match graph.node(expr) {
        Node::Symbol(symbol) => Some(*symbol),
        _ => None,
    }
}
