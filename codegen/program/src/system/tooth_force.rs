//! Derives the force of teeth at the pitch point from the multiplier of their gear.
//!
//! Let C_i and C_j be the axes of the wheels and d = C_j − C_i. Let κ = −r_i/r_j for an external pair and r_i/r_j for an internal
//! one. The pitch point is C_j − d/(1 − κ) = C_i − κ d/(1 − κ). The gear's row applies the moments −λ and κ λ. At the pitch
//! point, a force F acts on the second wheel and −F on the first. They have these moments if the component of F across d is λ (1
//! − κ) d⊥/d².
//!
//! The component along d is tan α times as large. It points from the pitch point into the wheel with outer teeth, whichever flank
//! is loaded: along d on the second wheel of an external pair, against d on that of an internal pair.
//!
//! Relative to the carrier, the wheels have no sliding velocity at the pitch point. So F does no work, and the multipliers of all
//! rows stay unchanged. With F at both axes in place of a moment on the carrier, only the bearings between wheels and carrier
//! carry more.

use super::System;
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::{Vector, dot, perpendicular, subtract};
use crate::joint::{Feature, Mesh};
use crate::pool::Pool;

/// Force of teeth on the second wheel: one term for the multiplier of the gear's row and one for its magnitude.
#[derive(Clone, Copy, Debug)]
pub struct ToothForce {
    /// Factor of the multiplier: the force across the line of the axes.
    pub of_multiplier: Vector,
    /// Factor of the multiplier's magnitude: the force along the line of the axes.
    pub of_magnitude: Vector,
}

impl System {
    /// Returns the force of teeth in terms of the vector form, by their index among all teeth; `None` if the teeth are not a
    /// gear.
    pub fn tooth_force(&self, place: usize, pool: &mut Pool) -> Option<ToothForce> {
        let System {
            mechanism,
            vector_form: form,
            ..
        } = self;
        let teeth = mechanism.forces.teeth.get(place)?;
        let gear = &mechanism.joints[teeth.gear];
        let feature = gear.kind.feature(&gear.operands, &mut pool.graph);
        let Some(Feature::Wheels(mesh, ratio)) = feature else {
            return None;
        };
        let axes = teeth.axes.each_ref().map(|axis| axis.place);
        let [from, to] = axes.map(|it| form.mark_with_arm(&it, &mechanism.bodies, pool).arm);
        let graph = &mut pool.graph;
        let apart = subtract(to, from, graph);
        let across = perpendicular(apart, graph);
        // Both axes lie on the carrier, so their distance is the distance in its frame.
        let local = subtract(axes[1].local, axes[0].local, graph);
        let square = dot(local, local, graph);
        let one = graph.one();
        let (difference, is_outward) = match mesh {
            Mesh::Internal => (graph.subtract(one, ratio), false),
            _ => (graph.add(one, ratio), true),
        };
        let per_distance = graph.divide(difference, square);
        let of_multiplier = across.map(|part| graph.multiply(per_distance, part));
        let tangent = graph.tan(teeth.pressure_angle);
        let magnitude = match is_outward {
            // A ratio is positive.
            true => difference,
            false => graph.magnitude(difference),
        };
        let along = graph.multiply(magnitude, tangent);
        let along = graph.divide(along, square);
        let along = match is_outward {
            true => along,
            false => graph.negate(along),
        };
        let of_magnitude = apart.map(|part| graph.multiply(along, part));
        Some(ToothForce {
            of_multiplier,
            of_magnitude,
        })
    }

    /// Returns the teeth whose force belongs to a joint's action on its second body: their indices, and true if the force is
    /// reversed.
    pub fn teeth_of(&self, joint: usize) -> Vec<(usize, bool)> {
        let mut joint_teeth = Vec::new();
        for (place, teeth) in self.mechanism.forces.teeth.iter().enumerate() {
            if teeth.gear == joint {
                joint_teeth.push((place, false));
            }
            for (wheel, axis) in teeth.axes.iter().enumerate() {
                let bearings = axis.bearings.iter().filter(|it| it.joint == joint);
                // The bearing of the second wheel balances the force; the bearing of the first balances the opposite force.
                joint_teeth.extend(bearings.map(|it| (place, (wheel == 1) == it.is_wheel_second)));
            }
        }
        joint_teeth
    }
}

impl ToothForce {
    /// Returns the force for a multiplier.
    pub fn at(&self, multiplier: ExprId, graph: &mut Graph) -> Vector {
        let magnitude = graph.magnitude(multiplier);
        [0, 1].map(|axis| {
            let across = graph.multiply(self.of_multiplier[axis], multiplier);
            let along = graph.multiply(self.of_magnitude[axis], magnitude);
            graph.add(across, along)
        })
    }
}
