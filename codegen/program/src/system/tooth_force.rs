//! Derives the force of teeth at the pitch point from the multiplier of their gear.
//!
//! With the axes C_i and C_j of both wheels, d = C_j − C_i, and κ = −r_i/r_j for an external pair and r_i/r_j for an internal one, the
//! pitch point is C_j − d/(1 − κ) = C_i − κ d/(1 − κ). A force F on the second wheel there and −F on the first one have the moments
//! that the gear's row exerts, −λ and κ λ, if the part of F across d is λ (1 − κ) d⊥/d². The part along d is tan α times as large. It
//! points from the pitch point into the wheel with outer teeth, whichever flank is loaded: along d on the second wheel of an external
//! pair, against d on that of an internal one. Seen from the carrier the wheels are at rest against one another at the pitch point, so F
//! does no work, and the multipliers of all rows stay what they are: with F at both axes in place of a moment on the carrier, only the
//! bearings between the wheels and the carrier carry more.

use super::{SymbolRole, System};
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::{Vector, dot, perpendicular, subtract};
use crate::joint::{Feature, Mesh};

/// The force of teeth on the second wheel: the sum of a part for the multiplier of the gear's row and a part for its magnitude.
#[derive(Clone, Copy, Debug)]
pub struct ToothForce {
    /// Factor of the multiplier: the force across the line of the axes.
    pub of_multiplier: Vector,
    /// Factor of its magnitude: the force along the line of the axes.
    pub of_magnitude: Vector,
}

impl System {
    /// The force of teeth, by their place among all teeth of the mechanism, in terms of the vector form; `None` for what is no gear.
    pub fn tooth_force(&mut self, place: usize) -> Option<ToothForce> {
        let System {
            mechanism,
            vector_form: form,
            roles,
            ..
        } = self;
        let teeth = mechanism.forces.teeth.get(place)?;
        let gear = &mechanism.joints[teeth.gear];
        let graph = &mut mechanism.graph;
        let Some(Feature::Wheels(mesh, ratio)) = gear.kind.feature(&gear.operands, graph) else {
            return None;
        };
        let axes = teeth.axes.each_ref().map(|axis| axis.place);
        let [from, to] = axes.map(|it| form.mark_with_arm(&it, &mechanism.bodies, graph).arm);
        let apart = subtract(to, from, graph);
        let across = perpendicular(apart, graph);
        // Both lie on the carrier, so that their distance is that in its frame.
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
        roles
            .write()
            .resize(graph.symbol_count(), SymbolRole::Intermediate);
        Some(ToothForce {
            of_multiplier,
            of_magnitude,
        })
    }

    /// The teeth whose force is part of what a joint passes to its second body: their places, and true if it is the opposite force.
    pub fn teeth_of(&self, joint: usize) -> Vec<(usize, bool)> {
        let mut found = Vec::new();
        for (place, teeth) in self.mechanism.forces.teeth.iter().enumerate() {
            if teeth.gear == joint {
                found.push((place, false));
            }
            for (wheel, axis) in teeth.axes.iter().enumerate() {
                let own = axis.bearings.iter().filter(|it| it.joint == joint);
                // The bearing of the second wheel holds it against the force, that of the first one against the opposite.
                found.extend(own.map(|it| (place, (wheel == 1) == it.is_wheel_second)));
            }
        }
        found
    }
}

impl ToothForce {
    /// The force for a multiplier.
    pub fn at(&self, multiplier: ExprId, graph: &mut Graph) -> Vector {
        let magnitude = graph.magnitude(multiplier);
        [0, 1].map(|axis| {
            let across = graph.multiply(self.of_multiplier[axis], multiplier);
            let along = graph.multiply(self.of_magnitude[axis], magnitude);
            graph.add(across, along)
        })
    }
}
