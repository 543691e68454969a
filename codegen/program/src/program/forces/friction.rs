//! Adds Coulomb friction to the reactions and efforts of a mechanism.
//!
//! A unit of friction in each joint is transmitted like a load. The forces of friction are found from the reactions to them and those
//! without friction; then all are superposed. Friction of the motion in reverse has the same units with opposite signs.

use super::Resistance;
use super::reaction::{Multipliers, components};
use super::unit::{Superposed, transmitted};
use super::virtual_work::Carried;
use crate::expr::{ExprId, SymbolId};
use crate::model::{Friction, Surfaces};
use crate::program::builder::Builder;
use crate::program::forms::Transposed;
use crate::program::function::Statement;
use crate::structure::SolvedPlan;
use crate::system::{Component, Resisting};
use crate::words::Piece;

/// Friction of all joints.
pub(super) struct Resisted {
    /// Reactions with friction.
    pub superposed: Superposed,
    /// Friction of each joint in the order of the statements, with that of the motion in reverse.
    forces: Vec<[ExprId; 2]>,
    /// Velocities of sliding, in the same order.
    rates: Vec<ExprId>,
    /// Friction on the second body of each joint to 1 N, in the same order.
    levers: Vec<ExprId>,
}

impl Resisted {
    /// Returns the reactions with friction, from those without.
    pub fn new(
        alone: Vec<ExprId>,
        plan: &SolvedPlan,
        transposed: &[Vec<Option<Transposed>>],
        builder: &mut Builder<'_>,
    ) -> Resisted {
        let frictions = builder.system.mechanism.forces.frictions.clone();
        let system = builder.system;
        let pool = &mut *builder.pool;
        let resisting = frictions.iter();
        let resisting = resisting.filter_map(|it| Some((*it, system.resisting(it, pool)?)));
        let resisting: Vec<(Friction, Resisting)> = resisting.collect();
        let alone = Multipliers {
            rows: alone,
            monitored: Vec::new(),
        };
        let mut units = Vec::with_capacity(resisting.len());
        for (friction, resisting) in &resisting {
            let joint = &builder.system.mechanism.joints[friction.joint];
            let (label, prefix) = (joint.label.clone(), format!("unit_{}_", joint.slug));
            builder.say(|_| format!("A unit of friction in {label} is balanced by these:").into());
            let zero = builder.graph().zero();
            let mut load = vec![zero; builder.system.vector_form.unknowns.len()];
            for &(coordinate, value) in &resisting.load {
                load[coordinate] = builder.graph().add(load[coordinate], value);
            }
            let (carried, rows) = transmitted(load, &prefix, plan, transposed, builder);
            let multipliers = Multipliers {
                rows,
                monitored: Vec::new(),
            };
            units.push((carried, multipliers));
        }
        let forces = forces(&resisting, &alone, &units, builder);
        let forward: Vec<ExprId> = forces.iter().map(|[forward, _]| *forward).collect();
        builder.say(|_| "With friction, the joints carry:".into());
        let superposed = Superposed::new(&alone, units, &forward, "resisted", builder);
        Resisted {
            superposed,
            forces,
            rates: resisting.iter().map(|(_, it)| it.rate).collect(),
            levers: resisting.iter().map(|(_, it)| it.lever).collect(),
        }
    }

    /// Assigns the fields of friction: of each joint, and of the powers of all drivers without friction and in reverse.
    pub fn fields(&self, carried: &Carried, builder: &mut Builder<'_>) -> Resistance {
        let frictions = builder.system.mechanism.forces.frictions.clone();
        let joints = frictions.iter().zip(&self.forces).zip(&self.levers);
        let joints = joints.map(|((friction, [forward, _]), lever)| {
            let slug = &builder.system.mechanism.joints[friction.joint].slug;
            let target = builder.pool.intermediate(&format!("friction_{slug}"));
            let on_body = builder.graph().multiply(*lever, *forward);
            builder.assign(target, on_body);
            (friction.joint, target)
        });
        let joints = joints.collect();
        builder.say(|_| {
            "The power of all drivers without friction, and while the motion runs backwards with the friction of that direction:".into()
        });
        let backward: Vec<ExprId> = self.forces.iter().map(|[_, it]| *it).collect();
        let mut powers = [Vec::new(), Vec::new()];
        for (direction, joint, _) in builder.system.driven().collect::<Vec<_>>() {
            let symbol = builder.system.directions[direction].symbol;
            let value = builder.system.mechanism.joints[joint].operands.value;
            let zero = builder.graph().zero();
            let rate = match (builder.system.mechanism.forces.at_rest, value) {
                (false, Some(value)) => builder.rate(value),
                _ => zero,
            };
            let without = carried.along(symbol, builder);
            let resisting = self.superposed.along_with(&backward, symbol, builder);
            let graph = builder.graph();
            let reverse = graph.add(without, resisting);
            for (terms, work) in powers.iter_mut().zip([without, reverse]) {
                let power = graph.multiply(work, rate);
                terms.push(graph.negate(power));
            }
        }
        let names = ["frictionless_power", "backward_power"];
        let [frictionless_power, backward_power] = [0, 1].map(|place| {
            let power = builder.graph().sum(&powers[place]);
            let target = builder.pool.intermediate(names[place]);
            builder.assign(target, power);
            target
        });
        Resistance {
            joints,
            frictionless_power,
            backward_power,
        }
    }

    /// Returns the power of friction, which is never positive.
    pub fn power(&self, builder: &mut Builder<'_>) -> ExprId {
        let forces = self.forces.iter().zip(&self.rates);
        let terms = forces.map(|([forward, _], rate)| builder.graph().multiply(*forward, *rate));
        let terms: Vec<ExprId> = terms.collect();
        builder.graph().sum(&terms)
    }
}

/// Returns the friction of each joint, with that of the motion in reverse.
fn forces(
    resisting: &[(Friction, Resisting)],
    alone: &Multipliers,
    units: &[(Carried, Multipliers)],
    builder: &mut Builder<'_>,
) -> Vec<[ExprId; 2]> {
    let frictions: Vec<Friction> = resisting.iter().map(|(friction, _)| *friction).collect();
    let without: Vec<[ExprId; 2]> = frictions
        .iter()
        .map(|friction| reaction(friction, alone, "frictionless", builder))
        .collect();
    let mut to_units = Vec::with_capacity(frictions.len() * units.len());
    for friction in &frictions {
        for ((_, unit), other) in units.iter().zip(&frictions) {
            let slug = &builder.system.mechanism.joints[other.joint].slug;
            let name = format!("unit_{slug}");
            to_units.push(reaction(friction, unit, &name, builder));
        }
    }
    builder.say(|_| {
        "The second body of each joint slides at a rate. A rate that is rounding of the rates of both bodies does not slide:".into()
    });
    let coefficients: Vec<ExprId> = resisting
        .iter()
        .map(|(friction, it)| {
            let slug = &builder.system.mechanism.joints[friction.joint].slug;
            let names = ["sliding", "moving", "resisting"].map(|what| format!("{what}_{slug}"));
            let named = Resisting {
                rate: builder.value(&names[0], it.rate),
                scale: builder.value(&names[1], it.scale),
                ..it.clone()
            };
            let coefficient = named.coefficient(builder.graph());
            builder.value(&names[2], coefficient)
        })
        .collect();
    builder.say(|_| {
        "Friction is a multiple of the magnitude of each reaction against sliding, and the reactions follow from it in turn:".into()
    });
    let pins = frictions.iter().filter(|it| it.is_pin()).count();
    let all = ["resistance", "backward_resistance"].map(|what| {
        let targets: Vec<SymbolId> = frictions
            .iter()
            .map(|friction| {
                let slug = &builder.system.mechanism.joints[friction.joint].slug;
                let name = format!("{what}_{slug}");
                builder.pool.intermediate(&name)
            })
            .collect();
        let coefficients = coefficients.iter().map(|&it| match what {
            "resistance" => it,
            _ => builder.graph().negate(it),
        });
        let coefficients: Vec<ExprId> = coefficients.collect();
        show(&targets, &coefficients, &without, &to_units, pins, builder);
        builder.state(Statement::Friction {
            pins,
            targets: targets.iter().copied().map(Some).collect(),
            coefficients,
            alone: without.clone(),
            units: to_units.clone(),
        });
        let graph = builder.graph();
        let forces = targets.into_iter().map(|it| graph.variable(it));
        forces.collect::<Vec<ExprId>>()
    });
    let [forward, backward] = all;
    let pairs = forward.into_iter().zip(backward);
    pairs
        .map(|(forward, backward)| [forward, backward])
        .collect()
}

/// Prints the equations of the forces of friction.
fn show(
    targets: &[SymbolId],
    coefficients: &[ExprId],
    alone: &[[ExprId; 2]],
    units: &[[ExprId; 2]],
    pins: usize,
    builder: &mut Builder<'_>,
) {
    builder.show(|builder| {
        let rows = units.chunks(targets.len().max(1));
        let joints = coefficients.iter().zip(alone).zip(rows).zip(targets);
        let equations =
            joints
                .enumerate()
                .map(|(place, (((coefficient, alone), row), &target))| {
                    let graph = builder.graph();
                    let [first, second] = [0, 1].map(|component| {
                        let mut terms = vec![alone[component]];
                        for (unit, &force) in row.iter().zip(targets) {
                            let force = graph.variable(force);
                            terms.push(graph.multiply(unit[component], force));
                        }
                        graph.sum(&terms)
                    });
                    let magnitude = match place < pins {
                        true => {
                            let squares = [first, second].map(|it| graph.multiply(it, it));
                            let square = graph.sum(&squares);
                            graph.sqrt(square)
                        }
                        false => {
                            let magnitudes = [first, second].map(|it| graph.magnitude(it));
                            graph.sum(&magnitudes)
                        }
                    };
                    let force = graph.multiply(*coefficient, magnitude);
                    let target = graph.variable(target);
                    [
                        Piece::Formula(target).into(),
                        Piece::Formula(force).into(),
                        "".into(),
                    ]
                });
        equations.collect()
    });
}

/// Returns both components of a reaction of which friction is a multiple: along x and y of a pin, at both ends of a slide with a length.
fn reaction(
    friction: &Friction,
    multipliers: &Multipliers,
    name: &str,
    builder: &mut Builder<'_>,
) -> [ExprId; 2] {
    let slug = builder.system.mechanism.joints[friction.joint].slug.clone();
    let carried = components(friction.joint, multipliers, builder);
    let zero = builder.graph().zero();
    let component = |wanted: Component| {
        let mut carried = carried.iter();
        carried.find(|it| it.0 == wanted).map_or(zero, |it| it.1)
    };
    let (values, names) = match friction.surfaces {
        Surfaces::Pin(_) => ([Component::X, Component::Y].map(component), ["x", "y"]),
        Surfaces::Slide(None) => ([component(Component::Normal), zero], ["normal", ""]),
        Surfaces::Slide(Some(length)) => {
            let [normal, moment] = [Component::Normal, Component::Moment].map(component);
            let graph = builder.graph();
            let half = graph.rational(1, 2);
            let half = graph.multiply(half, normal);
            let couple = graph.divide(moment, length);
            let ends = [graph.add(half, couple), graph.subtract(half, couple)];
            (ends, ["front", "back"])
        }
    };
    [0, 1].map(|place| builder.value(&format!("{name}_{slug}_{}", names[place]), values[place]))
}
