//! Writes the bodies, coordinates, parameters, inputs, equations and degrees of freedom of a mechanism.

use std::io::{self, Write};

use linkwright_codegen::stages::emit::Notation;
use linkwright_codegen::stages::emit::text::formula;
use linkwright_codegen::stages::model::{Body, Role};
use linkwright_codegen::stages::units::OutputUnits;
use linkwright_solver::View;
use linkwright_solver::check::equation_count;

use super::listing::{line, list, shortened};
use linkwright_page::motion::Followed;

/// Number of characters of the longest number without an exponent.
const LONGEST_NUMBER: usize = 24;

pub(super) fn mechanism<V: View>(
    motion: &Followed<V>,
    units: &OutputUnits,
    output: &mut dyn Write,
) -> io::Result<()> {
    let system = motion.system();
    let moving = system.mechanism.moving_bodies().iter();
    let (angles, bodies): (Vec<&Body>, Vec<&Body>) = moving.partition(|body| body.is_angle());
    for (title, all) in [("bodies", bodies), ("angles", angles)] {
        if title == "bodies" || !all.is_empty() {
            let names = all.iter().map(|body| body.name.clone());
            list(output, title, all.len(), names)?;
        }
    }
    let names = system.coordinates.iter().map(|it| it.name.clone());
    shortened(output, "coordinates", system.coordinates.len(), names)?;
    given(motion, units, output)?;
    for (title, role) in [
        ("constraint equations", Role::Constraint),
        ("driver equations", Role::Driver),
    ] {
        let joints = system.mechanism.joints.iter().enumerate();
        let labels = joints
            .filter(|(_, joint)| joint.role == role)
            .map(|(index, joint)| {
                match system.rows.iter().filter(|row| row.joint == index).count() {
                    1 => joint.label.clone(),
                    rows => format!("{} [{rows}]", joint.label),
                }
            });
        list(output, title, equation_count(system, role), labels)?;
    }
    let free = system
        .coordinates
        .len()
        .saturating_sub(equation_count(system, Role::Constraint));
    let driven = equation_count(system, Role::Driver);
    let text = format!(
        "{free} without drivers, {} with them",
        free.saturating_sub(driven)
    );
    line(output, "degrees of freedom", &text)
}

/// Writes the parameters and inputs with their values.
fn given<V: View>(
    motion: &Followed<V>,
    units: &OutputUnits,
    output: &mut dyn Write,
) -> io::Result<()> {
    let system = motion.system();
    let pool = motion.view.pool();
    let mechanism = &system.mechanism;
    let parameters = mechanism.parameters.iter().map(|own| {
        let value = pool.graph.nominal(own.symbol).unwrap_or(f64::NAN);
        let unit = units.of(&own.dimension.unit());
        format!("{} = {} {}", own.name, number(unit.of_si(value)), unit.name)
    });
    if !mechanism.parameters.is_empty() {
        list(output, "parameters", mechanism.parameters.len(), parameters)?;
    }
    let inputs = mechanism.inputs.iter().map(|own| {
        let signal = formula(pool, system, &[], Notation::Ascii, own.signal[0]);
        format!("{} = {signal} {}", own.name, own.dimension.unit())
    });
    if !mechanism.inputs.is_empty() {
        list(output, "inputs", mechanism.inputs.len(), inputs)?;
    }
    Ok(())
}

/// Returns a number in plain decimals, or with an exponent if those are too long to read.
fn number(value: f64) -> String {
    let plain = value.to_string();
    match plain.len() > LONGEST_NUMBER {
        true => format!("{value:e}"),
        false => plain,
    }
}
