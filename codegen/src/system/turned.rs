//! Residuals → what they are as functions of one angle: a cos φ + b sin φ + rest, or a turned vector.

use super::{Arm, VectorForm};
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::Vector;

/// α cos φ + β sin φ + rest.
#[derive(Clone, Copy, Debug)]
pub struct Turned {
    /// α.
    pub cosine: ExprId,
    /// β.
    pub sine: ExprId,
    /// What the angle does not turn.
    pub rest: ExprId,
}

impl VectorForm {
    /// Whether an equation mentions an unknown, itself or through an arm that it turns.
    pub fn mentions(&self, residual: ExprId, unknown: usize, graph: &Graph) -> bool {
        graph.depends_on(residual, self.unknowns[unknown].position)
            || self.is_turned_by(residual, unknown, graph)
    }

    /// Whether an equation holds an arm that the unknown turns.
    pub fn is_turned_by(&self, residual: ExprId, unknown: usize, graph: &Graph) -> bool {
        !self.arms_in(residual, unknown, graph).is_empty()
    }

    /// The places of the arms in an equation that an unknown turns: ascending.
    fn arms_in(&self, residual: ExprId, unknown: usize, graph: &Graph) -> Vec<usize> {
        let symbols = graph.symbols(residual).iter();
        let places = symbols.filter_map(|&symbol| self.place_of_symbol(symbol));
        let mut own: Vec<usize> = places
            .filter(|&place| self.arms[place].angle == unknown)
            .collect();
        own.sort_unstable();
        own.dedup();
        own
    }

    /// A residual by the arms of one angle; `None` where it is not linear in them or mentions the angle otherwise.
    pub fn split(&self, residual: ExprId, unknown: usize, graph: &mut Graph) -> Option<Turned> {
        let zero = graph.zero();
        let (mut cosine, mut sine, mut rest) = (Vec::new(), Vec::new(), residual);
        for place in self.arms_in(residual, unknown, graph) {
            let Arm {
                symbols: [ax, ay],
                local: [sx, sy],
                ..
            } = self.arms[place];
            let slopes = [ax, ay].map(|symbol| graph.derivative(residual, symbol));
            if slopes == [zero, zero] {
                continue;
            }
            // a_x = cos φ s_x − sin φ s_y and a_y = sin φ s_x + cos φ s_y.
            let [nx, ny] = slopes;
            cosine.extend([graph.multiply(nx, sx), graph.multiply(ny, sy)]);
            let backward = graph.multiply(nx, sy);
            sine.extend([graph.multiply(ny, sx), graph.negate(backward)]);
            rest = graph.substitute(rest, &[(ax, zero), (ay, zero)]);
        }
        let turned = Turned {
            cosine: graph.sum(&cosine),
            sine: graph.sum(&sine),
            rest,
        };
        let parts = [turned.cosine, turned.sine, turned.rest];
        let linear = parts
            .iter()
            .all(|&part| !self.mentions(part, unknown, graph));
        linear.then_some(turned)
    }

    /// `(p, rest)` of R(φ) p + rest, where the two residuals are the components of such a vector.
    pub fn turned_vector(
        &self,
        residuals: [ExprId; 2],
        unknown: usize,
        graph: &mut Graph,
    ) -> Option<(Vector, Vector)> {
        let x = self.split(residuals[0], unknown, graph)?;
        let y = self.split(residuals[1], unknown, graph)?;
        let is_rotation = y.sine == x.cosine && graph.negate(y.cosine) == x.sine;
        is_rotation.then_some(([x.cosine, y.cosine], [x.rest, y.rest]))
    }
}
