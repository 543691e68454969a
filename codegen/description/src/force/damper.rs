//! A damper between two points: it resists the rate of their distance.

use super::{Element, Exerted, Place, Shape, opposite, scaled};
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::{Mark, dot, subtract};

/// Damper between two points, with the tension damping · ℓ̇, where ℓ̇ = (r_j − r_i) · (v_j − v_i)/ℓ, and the dissipated power damping · ℓ̇².
#[derive(Clone, Debug)]
pub struct Damper {
    /// Ends.
    pub ends: [Mark; 2],
    /// Coefficient, in N·s/m.
    pub damping: ExprId,
}

impl Element for Damper {
    fn shape(&self) -> Shape {
        Shape::Damper
    }

    fn marks(&self) -> Vec<Mark> {
        self.ends.to_vec()
    }

    fn not_negative(&self) -> Vec<(ExprId, &'static str)> {
        vec![(self.damping, "the damping, unless zero,")]
    }

    fn exerted(&self, places: &[Place], length: ExprId, graph: &mut Graph) -> Exerted {
        let [from, to] = [0, 1].map(|end| places[end].mark);
        let positions = [from, to].map(|mark| mark.position(graph));
        let gap = subtract(positions[1], positions[0], graph);
        let parting = subtract(places[1].velocity, places[0].velocity, graph);
        let square = dot(gap, gap, graph);
        let along = dot(gap, parting, graph);
        let rate = graph.divide(along, length);
        let tension = graph.multiply(self.damping, rate);
        let share = graph.divide(tension, length);
        let pull = scaled(gap, share, graph);
        let lost = graph.multiply(tension, rate);
        Exerted {
            forces: vec![(from, pull), (to, opposite(pull, graph))],
            added: Some(graph.negate(lost)),
            length: Some(graph.sqrt(square)),
            ..Exerted::default()
        }
    }
}
