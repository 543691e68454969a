//! Adds the forces of teeth to the reactions of gears and their bearings.
//!
//! Each force follows from the reaction of its gear after all multipliers are known; motion and efforts do not depend on it.

use std::collections::BTreeMap;

use super::reaction::Multipliers;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::joint::{Feature, Mesh};
use crate::program::builder::Builder;
use crate::words::{Phrase, Piece, enumerated, phrase};

/// Forces of teeth that joints transmit to their second bodies.
#[derive(Debug, Default)]
pub(super) struct ToothForces {
    /// Force on the second wheel of each gear, by its index among all teeth.
    on_second_wheel: BTreeMap<usize, Vector>,
}

impl ToothForces {
    /// Returns the forces that affect the reactions of these joints, as named values.
    pub(super) fn of_joints(
        joints: &[usize],
        multipliers: &Multipliers,
        builder: &mut Builder<'_>,
    ) -> ToothForces {
        let mut places: Vec<usize> = joints
            .iter()
            .flat_map(|&joint| builder.system.teeth_of(joint))
            .map(|(place, _)| place)
            .collect();
        places.sort_unstable();
        places.dedup();
        let mut forces = ToothForces::default();
        for place in places {
            let gear = builder.system.mechanism.forces.teeth[place].gear;
            let slug = builder.system.mechanism.joints[gear].slug.clone();
            let multiplier = multiplier(gear, multipliers, builder);
            let Some(force) = builder.system.tooth_force(place, builder.pool) else {
                continue;
            };
            say(place, builder);
            let force = force.at(multiplier, builder.graph());
            let force = builder.vector(&format!("teeth_{slug}"), force);
            forces.on_second_wheel.insert(place, force);
        }
        forces
    }

    /// Returns the force of teeth in a joint's reaction on its second body.
    pub(super) fn on(&self, joint: usize, builder: &mut Builder<'_>) -> Vector {
        let zero = builder.graph().zero();
        let mut sum = [zero; 2];
        for (place, is_opposite) in builder.system.teeth_of(joint) {
            let Some(force) = self.on_second_wheel.get(&place) else {
                continue;
            };
            let graph = builder.graph();
            for (sum, &part) in sum.iter_mut().zip(force) {
                *sum = match is_opposite {
                    true => graph.subtract(*sum, part),
                    false => graph.add(*sum, part),
                };
            }
        }
        sum
    }
}

/// Returns the multiplier of a gear's only row, solved or monitored.
fn multiplier(gear: usize, multipliers: &Multipliers, builder: &mut Builder<'_>) -> ExprId {
    let passing = builder.passing(gear);
    let row = passing.rows.first();
    let solved = row.and_then(|(row, _)| multipliers.rows.get(*row));
    let monitored = passing.monitored.first();
    let monitored = monitored.and_then(|(row, _)| multipliers.monitored.get(*row));
    let multiplier = solved.or(monitored).copied();
    multiplier.unwrap_or(builder.graph().zero())
}

/// Describes the force and the bearings that carry the force.
fn say(place: usize, builder: &mut Builder<'_>) {
    builder.say(|builder| {
        let mechanism = &builder.system.mechanism;
        let teeth = &mechanism.forces.teeth[place];
        let gear = &mechanism.joints[teeth.gear];
        let second = gear.operands.marks[1].frame.body.0;
        let second = match second {
            0 => "the ground".into(),
            body => mechanism.bodies[body].name.clone(),
        };
        let feature = gear.kind.feature(&gear.operands, &mut builder.pool.graph);
        let pushed = match feature {
            Some(Feature::Wheels(Mesh::Internal, _)) => {
                "the inner wheel toward the axis of the ring"
            }
            _ => "the wheels apart",
        };
        let bearings = teeth.axes.iter().flat_map(|axis| &axis.bearings);
        let bearings: Vec<Phrase> = bearings
            .map(|it| Piece::Name(mechanism.joints[it.joint].label.clone()).into())
            .collect();
        phrase![
            "The teeth of ",
            Piece::Name(gear.label.clone()),
            " press on ",
            Piece::Name(second),
            " at the pitch point, along the line of action of the loaded flank. Across the line of the axes this is the moment over the pitch radius; along it, times the tangent of the pressure angle ",
            Piece::Formula(teeth.pressure_angle),
            ", it pushes ",
            pushed,
            ". It is carried by ",
            enumerated(&bearings),
            ":"
        ]
    });
}
