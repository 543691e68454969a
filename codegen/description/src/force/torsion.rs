//! Springs and dampers about a joint: they exert opposite torques on two bodies.

use super::{Element, Exerted, Place, Shape};
use crate::expr::{ExprId, Graph, Number, Rational};
use crate::joint::geometry::Mark;

/// Torsion spring, with the restoring torque stiffness · (φ_j − φ_i − free) + preload on the second body, and the opposite
/// torque on the first.
#[derive(Clone, Debug)]
pub struct TorsionSpring {
    /// Origins of the bodies' frames.
    pub bodies: [Mark; 2],
    /// Stiffness, in N·m/rad.
    pub stiffness: ExprId,
    /// Angle φ_j − φ_i at which the torque is the preload, in rad.
    pub free: ExprId,
    /// Preload, in N·m.
    pub preload: ExprId,
}

impl Element for TorsionSpring {
    fn shape(&self) -> Shape {
        Shape::TorsionSpring
    }

    fn marks(&self) -> Vec<Mark> {
        self.bodies.to_vec()
    }

    fn not_negative(&self) -> Vec<(ExprId, &'static str)> {
        vec![(self.stiffness, "the stiffness, unless zero,")]
    }

    fn exerted(&self, places: &[Place], _length: ExprId, graph: &mut Graph) -> Exerted {
        let [first, second] = [0, 1].map(|side| places[side].mark.frame);
        let relative = graph.subtract(second.angle, first.angle);
        let further = graph.subtract(relative, self.free);
        let elastic = graph.multiply(self.stiffness, further);
        let torque = graph.add(elastic, self.preload);
        let work = graph.multiply(elastic, further);
        let work = graph.scale(Number::rational(Rational::HALF), work);
        let before = graph.multiply(self.preload, further);
        Exerted {
            torques: vec![(first.body, torque), (second.body, graph.negate(torque))],
            stored: Some(graph.add(work, before)),
            ..Exerted::default()
        }
    }
}

/// Torsion damper, with the resisting torque damping · (φ̇_j − φ̇_i) on the second body, and the opposite torque on the first.
#[derive(Clone, Debug)]
pub struct TorsionDamper {
    /// Origins of the bodies' frames.
    pub bodies: [Mark; 2],
    /// Coefficient, in N·m·s/rad.
    pub damping: ExprId,
}

impl Element for TorsionDamper {
    fn shape(&self) -> Shape {
        Shape::TorsionDamper
    }

    fn marks(&self) -> Vec<Mark> {
        self.bodies.to_vec()
    }

    fn not_negative(&self) -> Vec<(ExprId, &'static str)> {
        vec![(self.damping, "the damping, unless zero,")]
    }

    fn exerted(&self, places: &[Place], _length: ExprId, graph: &mut Graph) -> Exerted {
        let [first, second] = [0, 1].map(|side| places[side].mark.frame.body);
        let rate = graph.subtract(places[1].turning, places[0].turning);
        let torque = graph.multiply(self.damping, rate);
        let lost = graph.multiply(torque, rate);
        Exerted {
            torques: vec![(first, torque), (second, graph.negate(torque))],
            added: Some(graph.negate(lost)),
            ..Exerted::default()
        }
    }
}
