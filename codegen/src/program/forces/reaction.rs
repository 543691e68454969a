//! The multipliers of a joint's equations → the force and the moment that it passes to its second body.

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

/// What a joint passes to its second body, with the multipliers of all rows.
pub(super) fn reaction(
    joint: usize,
    multipliers: &[ExprId],
    builder: &mut Builder<'_>,
) -> Reaction {
    let passing = builder.system.passing(joint);
    let name = builder.system.mechanism.joints[joint].slug.clone();
    let zero = builder.graph().zero();
    // −λ ∂Φ/∂q is what the joint exerts on a body, and the opposite what it passes on through it.
    let mut wrench = [zero; 3];
    if passing.body.0 != 0 {
        let coordinates = builder.system.mechanism.bodies[passing.body.0].coordinates;
        for (coordinate, part) in coordinates.iter().zip(&mut wrench) {
            let Some(unknown) = coordinate.map(|it| it.place) else {
                continue;
            };
            let graph = builder.graph();
            let terms = passing.rows.iter().filter_map(|(row, columns)| {
                let factor = *columns.get(&unknown)?;
                Some(graph.multiply(factor, multipliers[*row]))
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
    let own = passing.rows.first().map(|(row, _)| multipliers[*row]);
    let along = match passing.carried {
        Carried::Rod(per_multiplier) => own.map(|own| graph.multiply(per_multiplier, own)),
        carried => {
            let direction = carried.direction();
            direction.map(|direction| dot(force, direction, graph))
        }
    };
    let components = passing.carried.components().iter();
    let components: Vec<(Component, SymbolId)> = components
        .map(|&component| {
            let value = match component {
                Component::X => force[0],
                Component::Y => force[1],
                Component::Moment => about_place,
                Component::Multiplier => own.unwrap_or(zero),
                Component::Normal | Component::Tension | Component::Tooth | Component::Pressure => {
                    along.unwrap_or(zero)
                }
            };
            let what = format!("reaction_{name}_{}", component.suffix());
            let target = builder.system.intermediate(&what);
            builder.assign(target, value);
            (component, target)
        })
        .collect();
    Reaction {
        joint,
        name,
        components,
    }
}
