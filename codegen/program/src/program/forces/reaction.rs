//! Converts the multipliers of a joint's equations to the force and the moment on its second body.

use super::teeth::ToothForces;
use crate::expr::{ExprId, SymbolId};
use crate::force::moment;
use crate::joint::geometry::dot;
use crate::program::builder::Builder;
use crate::system::{Carried, Component};

/// Reaction of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Base of function names: `p`.
    pub name: String,
    /// Components, each with its field.
    pub components: Vec<(Component, SymbolId)>,
}

impl Reaction {
    /// Returns the fields of all components.
    pub fn fields(&self) -> impl Iterator<Item = SymbolId> {
        self.components.iter().map(|(_, field)| *field)
    }
}

/// Multipliers of the rows of joints.
#[derive(Clone, Debug, Default)]
pub(super) struct Multipliers {
    /// Multipliers of the rows of the vector form.
    pub rows: Vec<ExprId>,
    /// Multipliers of the monitored rows: zero, unless the distribution among redundant joints is defined.
    pub monitored: Vec<ExprId>,
}

/// Returns the reaction of a joint on its second body, from the multipliers of all rows and the forces of teeth.
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
        let target = builder.pool.intermediate(&what);
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

/// Returns the components of a joint's reaction on its second body, without the forces of teeth.
pub(super) fn components(
    joint: usize,
    multipliers: &Multipliers,
    builder: &mut Builder<'_>,
) -> Vec<(Component, ExprId)> {
    let passing = builder.passing(joint);
    let zero = builder.graph().zero();
    let solved = passing.rows.iter();
    let solved = solved.map(|(row, columns)| (multipliers.rows[*row], columns));
    let monitored = passing.monitored.iter();
    let monitored = monitored.filter_map(|(row, columns)| {
        let multiplier = multipliers.monitored.get(*row)?;
        Some((*multiplier, columns))
    });
    let rows: Vec<_> = solved.chain(monitored).collect();
    // The joint applies −λ ∂Φ/∂q to a body, and transmits the opposite through that body.
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
    let multiplier = rows.first().map(|(multiplier, _)| *multiplier);
    let along = match passing.carried {
        Carried::Rod(per_multiplier) => {
            multiplier.map(|multiplier| graph.multiply(per_multiplier, multiplier))
        }
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
                // The row of wheels has the slope 1 in the angle of the second wheel, which may be fixed to the ground.
                Component::Moment if passing.carried.turns_wheel() => {
                    multiplier.map_or(zero, |multiplier| graph.negate(multiplier))
                }
                Component::Moment => about_place,
                Component::Multiplier => multiplier.unwrap_or(zero),
                Component::Normal | Component::Tension | Component::Tooth | Component::Pressure => {
                    along.unwrap_or(zero)
                }
            };
            (component, value)
        })
        .collect()
}
