//! The multipliers of a joint's equations → the force and the moment that it passes to its second body.

use super::teeth::ToothForces;
use crate::expr::{ExprId, SymbolId};
use crate::force::moment;
use crate::joint::geometry::dot;
use crate::program::builder::Builder;
use crate::system::{Carried, Component};

/// What a joint carries.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// An index into the mechanism's joints.
    pub joint: usize,
    /// What its functions are named after: `p`.
    pub name: String,
    /// What is said of it, each with its field.
    pub components: Vec<(Component, SymbolId)>,
}

impl Reaction {
    /// The fields of all components.
    pub fn fields(&self) -> impl Iterator<Item = SymbolId> {
        self.components.iter().map(|(_, field)| *field)
    }
}

/// What the rows of joints carry, each by its multiplier.
#[derive(Clone, Debug, Default)]
pub(super) struct Multipliers {
    /// Of the rows of the vector form.
    pub rows: Vec<ExprId>,
    /// Of the rows that are monitored: zero, unless somebody says how joints share what they carry.
    pub monitored: Vec<ExprId>,
}

/// Load that a joint passes to its second body, with the multipliers of all rows and the forces of teeth.
pub(super) fn reaction(
    joint: usize,
    multipliers: &Multipliers,
    teeth: &ToothForces,
    builder: &mut Builder<'_>,
) -> Reaction {
    let name = builder.system.mechanism.joints[joint].slug.clone();
    let of_teeth = teeth.on(joint, builder);
    let components = components(joint, multipliers, builder).into_iter();
    let components = components.map(|(component, value)| {
        let value = match component {
            Component::X => builder.graph().add(value, of_teeth[0]),
            Component::Y => builder.graph().add(value, of_teeth[1]),
            _ => value,
        };
        let what = format!("reaction_{name}_{}", component.suffix());
        let target = builder.system.intermediate(&what);
        builder.assign(target, value);
        (component, target)
    });
    let components = components.collect();
    Reaction {
        joint,
        name,
        components,
    }
}

/// The components of what a joint passes to its second body, without the forces of teeth.
pub(super) fn components(
    joint: usize,
    multipliers: &Multipliers,
    builder: &mut Builder<'_>,
) -> Vec<(Component, ExprId)> {
    let passing = builder.system.passing(joint);
    let zero = builder.graph().zero();
    let own = passing.rows.iter();
    let own = own.map(|(row, columns)| (multipliers.rows[*row], columns));
    let monitored = passing.monitored.iter();
    let monitored = monitored.filter_map(|(row, columns)| {
        let multiplier = multipliers.monitored.get(*row)?;
        Some((*multiplier, columns))
    });
    let rows: Vec<_> = own.chain(monitored).collect();
    // −λ ∂Φ/∂q is what the joint exerts on a body, and the opposite what it passes on through it.
    let mut wrench = [zero; 3];
    if passing.body.0 != 0 {
        let coordinates = builder.system.mechanism.bodies[passing.body.0].coordinates;
        for (coordinate, part) in coordinates.iter().zip(&mut wrench) {
            let Some(unknown) = coordinate.map(|it| it.place) else {
                continue;
            };
            let graph = builder.graph();
            let terms = rows.iter().filter_map(|(multiplier, columns)| {
                let factor = *columns.get(&unknown)?;
                Some(graph.multiply(factor, *multiplier))
            });
            let terms: Vec<ExprId> = terms.collect();
            let sum = graph.sum(&terms);
            *part = match passing.is_opposite {
                true => sum,
                false => graph.negate(sum),
            };
        }
    }
    let force = [wrench[0], wrench[1]];
    let graph = builder.graph();
    let about_origin = moment(passing.arm, force, graph);
    let about_place = graph.subtract(wrench[2], about_origin);
    let zero = graph.zero();
    let own = rows.first().map(|(multiplier, _)| *multiplier);
    let along = match passing.carried {
        Carried::Rod(per_multiplier) => own.map(|own| graph.multiply(per_multiplier, own)),
        carried => {
            let direction = carried.direction();
            direction.map(|direction| dot(force, direction, graph))
        }
    };
    let components = passing.carried.components().iter();
    components
        .map(|&component| {
            let value = match component {
                Component::X => force[0],
                Component::Y => force[1],
                // The row of wheels has the slope 1 in the angle of the second one, which may be held by the ground.
                Component::Moment if passing.carried.turns_wheel() => {
                    own.map_or(zero, |own| graph.negate(own))
                }
                Component::Moment => about_place,
                Component::Multiplier => own.unwrap_or(zero),
                Component::Normal | Component::Tension | Component::Tooth | Component::Pressure => {
                    along.unwrap_or(zero)
                }
            };
            (component, value)
        })
        .collect()
}
