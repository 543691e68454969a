//! Writes equilibria as text.

use std::io::{self, Write};

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::{OutputUnit, OutputUnits};
use linkwright_solver::equilibrium::{
    Coverage, CurveEnd, Equilibria, Equilibrium, SmallMotion, Stability,
};
use linkwright_solver::number::{counted, time};

use super::aligned::aligned;

/// Significant digits of values, and of rates of small motions.
const DIGITS: usize = 10;
const RATE_DIGITS: usize = 6;

/// Magnitude below which a value is zero, relative to that of its column.
const ZERO: f64 = 1e-12;

/// Largest number of small motions of an equilibrium that are printed.
const PRINTED_MOTIONS: usize = 4;

/// Column of values.
pub(super) struct Column {
    pub name: String,
    pub unit: OutputUnit,
    /// Magnitude relative to which a value may be zero, in SI units: 1 rad, or a length.
    pub scale: f64,
    /// True for a free angle.
    pub is_angle: bool,
}

impl Column {
    pub fn text(&self, si: f64) -> String {
        let value = if si.abs() < ZERO * self.scale {
            0.0
        } else {
            si
        };
        self.unit.labeled(self.unit.rounded(value, DIGITS))
    }
}

/// Returns the columns of the free coordinates.
pub(super) fn free_columns(system: &System) -> Vec<Column> {
    let mechanism = &system.mechanism;
    let units = mechanism.units.of_messages();
    let free = mechanism.forces.free.iter();
    let columns = free.map(|it| {
        let quantity = mechanism.joints[it.joint].kind.value.quantity();
        let (si, length) = match quantity {
            Some(Quantity::Angle) | None => ("rad", 1.0),
            Some(_) => ("m", mechanism.characteristic_length),
        };
        Column {
            name: mechanism.inputs[it.input].name.clone(),
            unit: units.of(si),
            scale: length,
            is_angle: si == "rad",
        }
    });
    columns.collect()
}

/// Returns the columns of measures.
pub(super) fn measure_columns(system: &System) -> Vec<Column> {
    let mechanism = &system.mechanism;
    let units = mechanism.units.of_messages();
    let measurements = mechanism.measurements.iter();
    let columns = measurements.map(|it| Column {
        name: it.name.clone(),
        unit: units.of(&it.unit()),
        scale: match it.unit().as_str() {
            "m" => mechanism.characteristic_length,
            "rad" => 1.0,
            _ => 0.0,
        },
        is_angle: false,
    });
    columns.collect()
}

/// Returns the measures of an equilibrium; `None` where they are undetermined.
pub(super) fn measured<'a>(equilibrium: &'a Equilibrium, system: &System) -> Option<&'a [f64]> {
    let count = system.mechanism.measurements.len();
    let reported = equilibrium.reported.as_ref()?;
    reported.get(reported.len() - count..)
}

/// Returns the measures of an equilibrium in words.
pub(super) fn measure_cells(
    equilibrium: &Equilibrium,
    measures: &[Column],
    system: &System,
) -> Vec<String> {
    let values = measured(equilibrium, system);
    let cells = measures.iter().enumerate();
    let cells = cells.map(|(place, column)| match values.map(|it| it[place]) {
        Some(value) if value.is_finite() => column.text(value),
        _ => "undetermined".to_string(),
    });
    cells.collect()
}

/// Writes the equilibria, and what was searched with drivers and inputs at `t` (s).
///
/// # Errors
/// Errors of `output`.
pub fn write(
    equilibria: &Equilibria,
    system: &System,
    t: f64,
    output: &mut dyn Write,
) -> io::Result<()> {
    let mechanism = &system.mechanism;
    let columns = free_columns(system);
    let names: Vec<&str> = columns.iter().map(|it| it.name.as_str()).collect();
    writeln!(output, "{}", mechanism.title())?;
    writeln!(
        output,
        "equilibria of {} at rest, with all else as at t = {} s",
        names.join(", "),
        time(t)
    )?;
    if equilibria.is_everywhere {
        writeln!(
            output,
            "every pose is in equilibrium: gravity, springs and loads do no virtual work in any pose that was reached"
        )?;
        return searched(&equilibria.coverage, system, output);
    }
    if equilibria.all.is_empty() {
        writeln!(output, "no equilibrium was found")?;
    } else {
        table(equilibria, system, output)?;
        remarks(equilibria, system, output)?;
    }
    if equilibria.is_interrupted {
        writeln!(output, "interrupted: there may be more")?;
    }
    if equilibria.refused > 0 {
        writeln!(
            output,
            "left out: {} with an input outside of its range",
            counted(equilibria.refused, "equilibrium").replace("equilibriums", "equilibria")
        )?;
    }
    searched(&equilibria.coverage, system, output)
}

fn table(equilibria: &Equilibria, system: &System, output: &mut dyn Write) -> io::Result<()> {
    let (free, measures) = (free_columns(system), measure_columns(system));
    let mut header = vec![String::new()];
    header.extend(free.iter().map(|it| it.name.clone()));
    header.extend(["stability", "small motions", "energy"].map(String::from));
    header.extend(measures.iter().map(|it| it.name.clone()));
    let energy = system.mechanism.units.of_messages().of("J");
    let largest = equilibria.all.iter().map(|it| it.energy_unit);
    let energies = Column {
        name: "energy".to_string(),
        unit: energy,
        scale: largest.fold(0.0, f64::max),
        is_angle: false,
    };
    let mut rows = vec![header];
    for (place, equilibrium) in equilibria.all.iter().enumerate() {
        let mut cells = vec![(place + 1).to_string()];
        let values = free.iter().zip(&equilibrium.free);
        cells.extend(values.map(|(column, value)| column.text(*value)));
        cells.push(equilibrium.verdict.stability.name().to_string());
        cells.push(motions(&equilibrium.verdict.motions));
        cells.push(energies.text(equilibrium.potential));
        cells.extend(measure_cells(equilibrium, &measures, system));
        rows.push(cells);
    }
    aligned(&rows, output)
}

/// Returns the small motions in words.
fn motions(motions: &[SmallMotion]) -> String {
    let plain = OutputUnits::default().of("");
    let rounded = |value: f64| plain.rounded(value, RATE_DIGITS);
    let words = motions.iter().take(PRINTED_MOTIONS).map(|it| {
        let (frequency, growth) = (rounded(it.frequency), rounded(it.growth));
        match (it.frequency > 0.0, it.growth > 0.0) {
            (_, false) => format!("{frequency} Hz"),
            (false, true) => format!("grows by {growth}/s"),
            (true, true) => format!("{frequency} Hz, grows by {growth}/s"),
        }
    });
    let mut words: Vec<String> = words.collect();
    if motions.len() > PRINTED_MOTIONS {
        words.push(format!("{} more", motions.len() - PRINTED_MOTIONS));
    }
    match words.is_empty() {
        true => "no mass moves".to_string(),
        false => words.join(", "),
    }
}

/// Writes what the table does not show.
fn remarks(equilibria: &Equilibria, system: &System, output: &mut dyn Write) -> io::Result<()> {
    let mechanism = &system.mechanism;
    let mut remarks: Vec<(String, Vec<String>)> = Vec::new();
    let mut add = |place: usize, words: String| {
        let number = (place + 1).to_string();
        match remarks.iter_mut().find(|it| it.0 == words) {
            Some((_, numbers)) => numbers.push(number),
            None => remarks.push((words, vec![number])),
        }
    };
    for (place, equilibrium) in equilibria.all.iter().enumerate() {
        for &limit in &equilibrium.broken {
            let limit = &mechanism.limits[limit];
            let name = &mechanism.measurements[limit.measurement].name;
            let text = limit.text(mechanism.units.of_messages());
            add(place, format!("beyond the limit of `{name}`, {text}"));
        }
        let verdict = &equilibrium.verdict;
        let is_indifferent = verdict.stability == Stability::Indifferent;
        let is_elsewhere = equilibrium.is_connected.is_none() && !equilibrium.has_design_modes;
        let words = [
            (
                !verdict.is_conservative,
                "loads without an energy, so that a Hessian does not exist; small motions decide",
            ),
            (
                equilibrium.is_of_family,
                "one of a family of equilibria of equal energy, next to one another without a gap",
            ),
            (
                is_indifferent && !equilibrium.is_of_family,
                "a stiffness that vanishes in a direction within its error, so that it does not decide",
            ),
            (
                equilibrium.is_connected == Some(false),
                "an assembly that the mechanism does not reach from its design configuration",
            ),
            (
                is_elsewhere,
                "another assembly mode than that of the design configuration",
            ),
        ];
        for (_, words) in words.into_iter().filter(|it| it.0) {
            add(place, words.to_string());
        }
    }
    for (words, numbers) in remarks {
        writeln!(output, "{}: {words}", numbers.join(", "))?;
    }
    Ok(())
}

/// Writes the extent of the search.
fn searched(coverage: &Coverage, system: &System, output: &mut dyn Write) -> io::Result<()> {
    match coverage {
        Coverage::Starts([tried, settled]) => writeln!(
            output,
            "searched from {}, of which {settled} led to an equilibrium; there may be more",
            counted(*tried as usize, "pose")
        ),
        Coverage::Curves(curves) => {
            let is_turning = free_columns(system).iter().any(|it| it.is_angle);
            let words = |end: CurveEnd| match end {
                CurveEnd::Closed => "all poses of a closed curve",
                CurveEnd::Window if is_turning => "up to a full turn from the design configuration",
                CurveEnd::Window => {
                    "up to twenty characteristic lengths from the design configuration"
                }
                CurveEnd::Singular => "up to a pose in which the constraints lose rank",
            };
            for (place, [down, up]) in curves.iter().enumerate() {
                let which = match place {
                    0 => "searched from the design configuration".to_string(),
                    _ => format!("searched in assembly {}", place + 1),
                };
                let ends = match down == up {
                    true => words(*down).to_string(),
                    false => format!("one way {}, the other way {}", words(*down), words(*up)),
                };
                writeln!(output, "{which}: {ends}")?;
            }
            Ok(())
        }
    }
}
