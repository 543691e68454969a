//! A spring between two points: it pulls with stiffness · (ℓ − free) + preload along the line between them.

use super::{Element, Exerted, Place, Shape, opposite, scaled};
use crate::expr::{ExprId, Graph, Number, Rational};
use crate::joint::geometry::{Mark, dot, subtract};

/// Spring between two points, with the stored energy stiffness (ℓ − free)²/2 + preload (ℓ − free).
///
/// With a free length of zero and without a preload, the force is stiffness · (r_j − r_i), which needs neither a length nor a
/// direction.
#[derive(Clone, Debug)]
pub struct Spring {
    /// Ends.
    pub ends: [Mark; 2],
    /// Stiffness, in N/m.
    pub stiffness: ExprId,
    /// Length at which the force is the preload, in m.
    pub free: ExprId,
    /// Preload, in N.
    pub preload: ExprId,
}

impl Element for Spring {
    fn shape(&self) -> Shape {
        Shape::Spring
    }

    fn marks(&self) -> Vec<Mark> {
        self.ends.to_vec()
    }

    fn not_negative(&self) -> Vec<(ExprId, &'static str)> {
        vec![
            (self.stiffness, "the stiffness, unless zero,"),
            (self.free, "the free length, unless zero,"),
        ]
    }

    fn exerted(&self, places: &[Place], length: ExprId, graph: &mut Graph) -> Exerted {
        let [from, to] = [0, 1].map(|end| places[end].mark);
        let positions = [from, to].map(|mark| mark.position(graph));
        let gap = subtract(positions[1], positions[0], graph);
        let square = dot(gap, gap, graph);
        let half = Number::rational(Rational::HALF);
        let zero = graph.zero();
        let (pull, stored, own) = if [self.free, self.preload] == [zero; 2] {
            let work = graph.multiply(self.stiffness, square);
            let pull = scaled(gap, self.stiffness, graph);
            (pull, graph.scale(half, work), None)
        } else {
            let longer = graph.subtract(length, self.free);
            let elastic = graph.multiply(self.stiffness, longer);
            let tension = graph.add(elastic, self.preload);
            let work = graph.multiply(elastic, longer);
            let work = graph.scale(half, work);
            let before = graph.multiply(self.preload, longer);
            let share = graph.divide(tension, length);
            let pull = scaled(gap, share, graph);
            (pull, graph.add(work, before), Some(graph.sqrt(square)))
        };
        Exerted {
            forces: vec![(from, pull), (to, opposite(pull, graph))],
            stored: Some(stored),
            length: own,
            ..Exerted::default()
        }
    }
}
