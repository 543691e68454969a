//! Computes the forces of `effort`, `reaction` and `energy` statements in a last block.
//!
//! Φ_qᵀ λ = Q − M q̈ is solved block by block in reverse order. Each subsystem of the plan has its own transposed Jacobian. The
//! force of an equation acts on the blocks before it (Haug 1989, section 11.2; the blocks are those of the block triangular form,
//! transposed). Unrequested forces are pruned like all other values.

mod free_bodies;
mod friction;
mod least_norm;
mod reaction;
mod reduced;
mod teeth;
mod unit;
mod virtual_work;

pub use reaction::Reaction;
pub use reduced::{FreeCoordinate, Reduced};

use friction::Resisted;
use reaction::Multipliers;
use teeth::ToothForces;
use unit::Superposed;

use super::block::{Block, Lowering};
use super::builder::Builder;
use super::forms::Transposed;
use super::function::{Level, Statement};
use crate::expr::{ExprId, Number, SymbolId};
use crate::joint::Quantity;
use crate::pool::Pool;
use crate::structure::SolvedPlan;
use crate::system::System;

/// Requested forces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    /// Efforts of all drivers in written order; empty if not requested.
    pub efforts: Vec<Effort>,
    /// Requested reactions, in written order of the joints.
    pub reactions: Vec<Reaction>,
    /// Fields of the energies; `None` if not requested.
    pub energy: Option<Energy>,
    /// Reduced masses and forces of the free coordinates, if any.
    pub reduced: Option<Reduced>,
    /// Friction; `None` without it.
    pub resistance: Option<Resistance>,
}

/// Fields of friction.
#[derive(Clone, Debug, PartialEq)]
pub struct Resistance {
    /// Joints with friction: the index into the mechanism's joints, and the friction on the second body, in N or N·m.
    pub joints: Vec<(usize, SymbolId)>,
    /// Power of all drivers without friction, in W.
    pub frictionless_power: SymbolId,
    /// Power of all drivers with the friction of the motion in reverse, in W.
    pub backward_power: SymbolId,
}

impl Resistance {
    /// Returns all fields.
    pub fn fields(&self) -> impl Iterator<Item = SymbolId> {
        let joints = self.joints.iter().map(|it| it.1);
        joints.chain([self.frictionless_power, self.backward_power])
    }
}

/// Driving force or torque of a driver.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Base of function names: `crank`, `drive_length_n_m`.
    pub name: String,
    /// Quantity that is driven: a force acts along a length, a torque about an angle.
    pub quantity: Quantity,
    /// Effort, in N or N·m.
    pub effort: SymbolId,
    /// Power, in W.
    pub power: SymbolId,
}

/// Energies of the whole mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy {
    /// Kinetic energy, in J.
    pub kinetic: SymbolId,
    /// Potential energy of gravity and springs, in J.
    pub potential: SymbolId,
    /// Power of dampers, forces and torques, in W.
    pub added: SymbolId,
}

impl Forces {
    /// Returns all fields: requested forces, and the reduced masses and forces.
    pub fn fields(&self) -> Vec<SymbolId> {
        let mut fields = self.asked();
        fields.extend(self.reduced.iter().flat_map(Reduced::fields));
        fields
    }

    /// Returns the fields of requested forces.
    pub fn asked(&self) -> Vec<SymbolId> {
        let efforts = self.efforts.iter().flat_map(|it| [it.effort, it.power]);
        let reactions = self.reactions.iter().flat_map(Reaction::fields);
        let energy = self.energy.iter();
        let energy = energy.flat_map(|it| [it.kinetic, it.potential, it.added]);
        let resistance = self.resistance.iter().flat_map(Resistance::fields);
        efforts
            .chain(reactions)
            .chain(energy)
            .chain(resistance)
            .collect()
    }
}

/// Returns the requested forces, and the block that computes them; `None` if there are none. `transposed` has the Jacobians of
/// the subsystems of every block of the plan.
pub(super) fn forces(
    lowering: &mut Lowering<'_>,
    plan: &SolvedPlan,
    transposed: &[Vec<Option<Transposed>>],
) -> Option<(Forces, Block)> {
    let loads = lowering.system.forces.clone()?;
    let shifts = lowering.derivatives.shifts();
    let requested = lowering.system.mechanism.forces.clone();
    let mut builder = Builder::new(lowering, plan.blocks.len());
    builder.section(Level::Forces);
    let scale = characteristic(builder.pool, builder.system);
    for &(symbol, length) in &loads.lengths {
        builder.assign(symbol, length);
        let length = builder.graph().variable(symbol);
        builder.nonzero(length, scale);
    }
    let mut forces = Forces::default();
    let mut lost = None;
    builder.heading(headline(&requested));
    if requested.need_multipliers() {
        builder.say(|_| {
            "What acts on every body beside joints and drivers, less what moves its mass, moments about the origin of its frame:".into()
        });
        let named = named_loads(&loads.loads, &mut builder);
        let carried = virtual_work::sweep(plan, transposed, &named, "", &mut builder);
        let is_shared = requested.least_norm && !builder.system.monitored.is_empty();
        let shared = is_shared.then(|| {
            let alone = alone(plan, &named, &carried, &mut builder);
            least_norm::shared(plan, transposed, alone, &mut builder)
        });
        let resisted = (!requested.frictions.is_empty()).then(|| {
            let alone = alone(plan, &named, &carried, &mut builder);
            Resisted::new(alone, plan, transposed, &mut builder)
        });
        let of_friction = resisted.as_ref().map(|it| &it.superposed);
        let superposed = shared.as_ref().or(of_friction);
        if requested.efforts {
            forces.efforts = efforts(&carried, superposed, &mut builder);
        }
        if !requested.free.is_empty() {
            forces.reduced = Some(reduced::reduced(&carried, &loads.weights, &mut builder));
        }
        if !requested.reactions.is_empty() {
            let multipliers = match superposed {
                Some(superposed) => superposed.multipliers.clone(),
                None => Multipliers {
                    rows: alone(plan, &named, &carried, &mut builder),
                    monitored: Vec::new(),
                },
            };
            let teeth = ToothForces::of_joints(&requested.reactions, &multipliers, &mut builder);
            let joints = requested.reactions.iter();
            let reactions =
                joints.map(|&joint| reaction::reaction(joint, &multipliers, &teeth, &mut builder));
            forces.reactions = reactions.collect();
        }
        if let Some(resisted) = &resisted {
            forces.resistance = Some(resisted.fields(&carried, &mut builder));
            lost = Some(resisted.power(&mut builder));
        }
    }
    if requested.energy {
        builder.say(|_| "The work that is stored, and the power of what else acts:".into());
        let added = match lost {
            Some(lost) => builder.graph().add(loads.added, lost),
            None => loads.added,
        };
        let values = [
            ("kinetic_energy", loads.kinetic),
            ("potential_energy", loads.potential),
            ("added_power", added),
        ];
        let [kinetic, potential, added] = values.map(|(name, value)| {
            let target = builder.pool.intermediate(name);
            builder.assign(target, value);
            target
        });
        forces.energy = Some(Energy {
            kinetic,
            potential,
            added,
        });
    }
    let mut statements = builder.finish().0.statements;
    let mut at_zero = |expr: ExprId| {
        let graph = &mut lowering.pool.graph;
        let zero = graph.zero();
        let replaced: Vec<_> = shifts.iter().map(|&shift| (shift, zero)).collect();
        graph.substitute(expr, &replaced)
    };
    statements
        .iter_mut()
        .for_each(|statement: &mut Statement| statement.change_values(&mut at_zero));
    let title = "What drivers exert, what joints carry, and what is stored.";
    Some((forces, Block::following("forces", title, statements)))
}

/// Describes the results of the block.
fn headline(requested: &crate::model::Forces) -> String {
    let parts = [
        (requested.efforts, "what drivers exert"),
        (
            !requested.free.is_empty(),
            "what moves the free coordinates",
        ),
        (!requested.reactions.is_empty(), "what joints carry"),
        (requested.energy, "what is stored"),
    ];
    let parts = parts.into_iter().filter(|(is_wanted, _)| *is_wanted);
    let parts: Vec<&str> = parts.map(|(_, words)| words).collect();
    parts.join(", ")
}

/// Returns the characteristic length.
fn characteristic(pool: &mut Pool, system: &System) -> ExprId {
    let length = system.mechanism.characteristic_length;
    let graph = &mut pool.graph;
    match Number::parse(&format!("{length:e}")) {
        Some(number) => graph.number(number),
        None => graph.one(),
    }
}

/// Returns Q − M q̈ of every coordinate as named values: `load_x_c1`.
fn named_loads(loads: &[ExprId], builder: &mut Builder<'_>) -> Vec<ExprId> {
    let named = loads.iter().enumerate().map(|(coordinate, &load)| {
        let name = builder.system.unknown_name(coordinate).to_string();
        builder.value(&format!("load_{name}"), load)
    });
    named.collect()
}

/// Returns the multiplier of every row of the vector form.
fn alone(
    plan: &SolvedPlan,
    loads: &[ExprId],
    carried: &virtual_work::Carried,
    builder: &mut Builder<'_>,
) -> Vec<ExprId> {
    builder.say(|_| {
        "One body after the other is cut free: its forces along x and y and its moments add up to nothing, which gives what its other joints carry:".into()
    });
    free_bodies::multipliers(plan, loads, carried, "", builder)
}

/// Returns the effort of every driver: the negative work of all other forces along its value.
fn efforts(
    carried: &virtual_work::Carried,
    superposed: Option<&Superposed>,
    builder: &mut Builder<'_>,
) -> Vec<Effort> {
    let driven: Vec<(usize, usize, Quantity)> = builder.system.driven().collect();
    let mut efforts = Vec::with_capacity(driven.len());
    builder.say(|_| {
        "A driver exerts the opposite of the work that all of this does along its value, and its power is that times the rate of the value:".into()
    });
    for (direction, joint, quantity) in driven {
        let symbol = builder.system.directions[direction].symbol;
        let driver = &builder.system.mechanism.joints[joint];
        let (name, value) = (driver.slug.clone(), driver.operands.value);
        let mut work = carried.along(symbol, builder);
        if let Some(superposed) = superposed {
            let more = superposed.along(symbol, builder);
            work = builder.graph().add(work, more);
        }
        let [effort, power] =
            ["effort", "power"].map(|what| builder.pool.intermediate(&format!("{what}_{name}")));
        let value = value.unwrap_or(builder.graph().zero());
        let opposite = builder.graph().negate(work);
        builder.assign(effort, opposite);
        let rate = match builder.system.mechanism.forces.at_rest {
            true => builder.graph().zero(),
            false => builder.rate(value),
        };
        let exerted = builder.graph().variable(effort);
        let product = builder.graph().multiply(exerted, rate);
        builder.assign(power, product);
        efforts.push(Effort {
            joint,
            name,
            quantity,
            effort,
            power,
        });
    }
    efforts
}
