//! Expresses cosine and sine of sums of body angles by rotated unit vectors.
//!
//! cos(φ + δ) and sin(φ + δ) are the components of R(φ) (cos δ, sin δ), and further angles rotate the result. Closed forms for
//! rotated vectors therefore apply to these functions. Other arguments are left unchanged.

use super::resolve::Resolver;
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::{Mark, Vector, turned};

impl Resolver<'_> {
    /// Returns cosine and sine of ±φ_1 ± φ_2 … + δ with a constant δ; `None` for other arguments, and outside equations.
    pub(super) fn live_direction(&mut self, argument: ExprId) -> Option<Vector> {
        self.formulas.kinematic.as_ref()?;
        let (zero, one) = (self.graph.zero(), self.graph.one());
        let mut angles = Vec::new();
        for symbol in self.graph.symbols(argument).to_vec() {
            let Some(&(body, _)) = self.linkage.coordinate_places.get(&symbol) else {
                continue;
            };
            let slope = self.graph.derivative(argument, symbol);
            let is_backward = slope != one;
            if is_backward && self.graph.negate(slope) != one {
                return None;
            }
            let [_, _, angle] = self.linkage.bodies[body.0].coordinates;
            if angle.map(|it| it.symbol) != Some(symbol) {
                return None;
            }
            angles.push((body, symbol, is_backward));
        }
        let still: Vec<(SymbolId, ExprId)> = angles.iter().map(|it| (it.1, zero)).collect();
        let offset = self.graph.substitute(argument, &still);
        if angles.is_empty() || !self.graph.is_fixed(offset) {
            return None;
        }
        let mut direction = [self.graph.cos(offset), self.graph.sin(offset)];
        for (turn, (body, _, is_backward)) in angles.into_iter().enumerate() {
            // The first angle rotates a constant vector, which is a rotated local vector.
            let local = match (turn, is_backward) {
                (0, false) => direction,
                (0, true) => [direction[0], self.graph.negate(direction[1])],
                _ => [one, zero],
            };
            let frame = self.linkage.bodies[body.0].frame;
            let mark = Mark::new(frame, local, &mut self.graph);
            let [cosine, sine] = self.live_arm(mark);
            let sine = match is_backward {
                true => self.graph.negate(sine),
                false => sine,
            };
            direction = match turn {
                0 => [cosine, sine],
                _ => turned(cosine, sine, direction, &mut self.graph),
            };
        }
        Some(direction)
    }
}
