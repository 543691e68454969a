//! Lists the functions of a frame that return requested forces.

use super::Module;
use super::accessors::Accessor;
use crate::joint::Quantity;
use crate::program::{Effort, Energy, FreeCoordinate, Reaction, Reduced, Resistance};
use crate::system::Component;

/// Returns all functions, in this order: efforts and powers of drivers, reactions of joints, energies, friction, reduced masses and
/// forces of the free coordinates.
pub(in crate::emit) fn force_functions(module: &Module<'_>) -> Vec<Accessor> {
    let forces = &module.program.forces;
    let efforts = forces.efforts.iter().flat_map(|it| of_effort(it, module));
    let reactions = forces.reactions.iter();
    let reactions = reactions.flat_map(|it| of_reaction(it, module));
    let energy = forces.energy.iter().flat_map(of_energy);
    let resistance = forces.resistance.iter();
    let resistance = resistance.flat_map(|it| of_resistance(it, module));
    let reduced = forces.reduced.iter();
    let reduced = reduced.flat_map(|it| of_reduced(it, module));
    efforts
        .chain(reactions)
        .chain(energy)
        .chain(resistance)
        .chain(reduced)
        .collect()
}

fn of_effort(effort: &Effort, module: &Module<'_>) -> [Accessor; 2] {
    let label = &module.system.mechanism.joints[effort.joint].label;
    let what = match effort.quantity {
        Quantity::Angle => {
            format!("Torque (N·m) that `{label}` applies, positive if it increases the angle.")
        }
        _ => format!(
            "Force (N) that `{label}` applies along the driven quantity, positive if it increases the quantity."
        ),
    };
    let function = |word: &str, field, line| {
        Accessor::of_fields(format!("{word}_{}", effort.name), &[field], line)
    };
    [
        function("effort", effort.effort, what),
        function(
            "power",
            effort.power,
            format!("Power (W) that `{label}` supplies."),
        ),
    ]
}

fn of_reaction(reaction: &Reaction, module: &Module<'_>) -> Vec<Accessor> {
    let joint = &module.system.mechanism.joints[reaction.joint];
    let label = &joint.label;
    let mut functions = Vec::new();
    let mut components = &reaction.components[..];
    if let [(Component::X, x), (Component::Y, y), rest @ ..] = components {
        let line = match joint.pressure_angle {
            Some(_) => format!(
                "Force (N) of the teeth of `{label}` on the second wheel at the pitch point, along x and y."
            ),
            None => format!("Force (N) of `{label}` on its second body, along x and y."),
        };
        let name = format!("reaction_{}", reaction.name);
        functions.push(Accessor::of_fields(name, &[*x, *y], line));
        components = rest;
    }
    for (component, field) in components {
        let line = match (component, joint.pressure_angle) {
            (Component::Moment, Some(_)) => format!(
                "Moment (N·m) of the teeth of `{label}` on the second wheel, about its axis."
            ),
            _ => component_line(*component, label),
        };
        let name = format!("reaction_{}_{}", reaction.name, component.suffix());
        functions.push(Accessor::of_fields(name, &[*field], line));
    }
    functions
}

/// Documentation of a component of a reaction.
fn component_line(component: Component, label: &str) -> String {
    match component {
        Component::X => format!("Force (N) of `{label}` on its second body along x."),
        Component::Y => format!("Force (N) of `{label}` on its second body along y."),
        Component::Normal => {
            format!("Force (N) of `{label}` on its second body to the left of its line.")
        }
        Component::Tension => format!(
            "Force (N) with which `{label}` pulls its points together, negative if it pushes them apart."
        ),
        Component::Tooth => {
            format!("Force (N) of `{label}` on its second body along its line.")
        }
        Component::Pressure => format!(
            "Normal force (N) between the bodies of `{label}`, positive in compression. If it is negative, the bodies separate."
        ),
        Component::Moment => format!(
            "Moment (N·m) of `{label}` on its second body, about the point of the joint on that body."
        ),
        Component::Multiplier => {
            format!("Multiplier of `{label}`: work (J) per unit of its residual.")
        }
    }
}

fn of_reduced(reduced: &Reduced, module: &Module<'_>) -> Vec<Accessor> {
    let label = |it: &FreeCoordinate| &module.system.mechanism.joints[it.joint].label;
    let mut functions = Vec::new();
    for (row, own) in reduced.coordinates.iter().enumerate() {
        for (column, other) in reduced.coordinates[..=row].iter().enumerate() {
            let (name, line) = match row == column {
                true => (
                    format!("reduced_mass_{}", own.name),
                    format!(
                        "Reduced mass of `{}` ({}).",
                        label(own),
                        unit_of_mass([own.quantity, own.quantity])
                    ),
                ),
                false => (
                    format!("reduced_mass_{}_{}", own.name, other.name),
                    format!(
                        "Reduced mass coupling `{}` and `{}` ({}).",
                        label(own),
                        label(other),
                        unit_of_mass([own.quantity, other.quantity])
                    ),
                ),
            };
            let mass = reduced.masses[Reduced::place(row, column)];
            functions.push(Accessor::of_fields(name, &[mass], line));
        }
    }
    functions.extend(reduced.coordinates.iter().map(|own| {
        let unit = match own.quantity {
            Quantity::Angle => "N·m",
            _ => "N",
        };
        let line = format!(
            "Reduced force ({unit}) along `{}`: the reduced mass times the acceleration.",
            label(own)
        );
        Accessor::of_fields(format!("reduced_force_{}", own.name), &[own.force], line)
    }));
    functions
}

/// Unit of the reduced mass of two quantities.
fn unit_of_mass(quantities: [Quantity; 2]) -> &'static str {
    let angles = quantities.iter().filter(|it| **it == Quantity::Angle);
    match angles.count() {
        0 => "kg",
        1 => "kg·m",
        _ => "kg·m²",
    }
}

fn of_energy(energy: &Energy) -> [Accessor; 3] {
    let function = |name: &str, field, line: &str| Accessor::of_fields(name.into(), &[field], line);
    [
        function(
            "kinetic_energy",
            energy.kinetic,
            "Kinetic energy (J) of all bodies.",
        ),
        function(
            "potential_energy",
            energy.potential,
            "Potential energy (J) of gravity and springs, zero with all centers of mass at the origin and all springs unstressed.",
        ),
        function(
            "added_power",
            energy.added,
            "Power (W) that dampers, forces and torques supply, negative if they absorb it.",
        ),
    ]
}

fn of_resistance(resistance: &Resistance, module: &Module<'_>) -> Vec<Accessor> {
    let mechanism = &module.system.mechanism;
    let frictions = mechanism.forces.frictions.iter();
    let joints = resistance.joints.iter().zip(frictions);
    let mut functions: Vec<Accessor> = joints
        .map(|(&(joint, field), friction)| {
            let joint = &mechanism.joints[joint];
            let what = match friction.is_pin() {
                true => "Moment (N·m) of friction",
                false => "Force (N) of friction along the line",
            };
            let line = format!("{what} of `{}` on its second body.", joint.label);
            Accessor::of_fields(format!("friction_{}", joint.slug), &[field], line)
        })
        .collect();
    let powers = [
        (
            "frictionless_power",
            resistance.frictionless_power,
            "Power (W) of all drivers without friction.",
        ),
        (
            "backward_power",
            resistance.backward_power,
            "Power (W) of all drivers with the friction of the motion in reverse. If it is negative while that without friction is positive, the load cannot drive the mechanism backwards.",
        ),
    ];
    let powers = powers.map(|(name, field, line)| Accessor::of_fields(name.into(), &[field], line));
    functions.extend(powers);
    functions
}
