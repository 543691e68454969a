//! Writes the summary of a motion: the mechanism, its equations, the start, the motion of the points, the residuals.

mod listing;
mod mechanism;
mod motions;

use std::io::{self, Write};

use linkwright_codegen::stages::model::Mechanism;
use linkwright_codegen::stages::units::OutputUnits;
use linkwright_solver::View;
use linkwright_solver::dense::diagnosis::unit;
use linkwright_solver::number::{counted, fixed, scientific, time};

use super::effort::hint;
use super::first_step;
use super::reported;
use crate::arguments::Reported;
use linkwright_page::motion::Followed;
use linkwright_page::units::text_of;
use listing::line;
use mechanism::mechanism;
use motions::motions;

/// Width of lists, in characters.
const WIDTH: usize = 110;

/// Layout of a summary.
#[derive(Clone, Debug)]
pub struct Layout {
    /// True if each selected point has a table; otherwise only the first few that move have one.
    pub points_chosen: bool,
    /// True if each selected coordinate has a table; otherwise all angles share tables.
    pub coordinates_chosen: bool,
    /// Units of tables and pictures.
    pub units: OutputUnits,
    /// Times (s) at which the first Newton-Raphson step is printed.
    pub first_steps: Vec<f64>,
}

impl Layout {
    /// Returns the layout that is requested for a mechanism, without first steps.
    pub fn of(reported: &Reported, mechanism: &Mechanism) -> Layout {
        Layout {
            points_chosen: !(reported.points.is_empty() && reported.show.is_empty()),
            coordinates_chosen: !reported.show.is_empty(),
            units: reported.printed(mechanism.units.of_tables()),
            first_steps: Vec::new(),
        }
    }
}

/// Writes the summary; without frames, only the facts of the mechanism itself.
///
/// # Errors
/// Errors of `output`.
pub fn write<V: View>(
    motion: &Followed<V>,
    layout: &Layout,
    output: &mut dyn Write,
) -> io::Result<()> {
    writeln!(output, "{}", motion.title())?;
    start(motion, output)?;
    mechanism(motion, &layout.units, output)?;
    for t in &layout.first_steps {
        first_step::write(&motion.view, *t, output)?;
    }
    if motion.count == 0 {
        return Ok(());
    }
    motions(motion, layout, output)?;
    reported::write(motion, &layout.units, output)?;
    writeln!(output)?;
    pressure_angles(motion, layout, output)?;
    closest(motion, output)?;
    residuals(motion, &layout.units, output)?;
    integration(motion, output)
}

/// Writes the poses in which blocks are closest to singular, if they are requested.
fn closest<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
    if !motion.wanted.monitor {
        return Ok(());
    }
    match motion.smallest_measure {
        Some((place, t, measure)) => writeln!(
            output,
            "closest to singular\n  {} = {} at t = {} s\n",
            motion.measure_names[place],
            fixed(measure, 6),
            time(t)
        ),
        None => writeln!(output, "closest to singular\n  no block can be\n"),
    }
}

fn pressure_angles<V: View>(
    motion: &Followed<V>,
    layout: &Layout,
    output: &mut dyn Write,
) -> io::Result<()> {
    let pressure_angles = &motion.pressure.largest;
    if pressure_angles.is_empty() {
        return Ok(());
    }
    writeln!(output, "largest pressure angles")?;
    for largest in pressure_angles {
        let text = match largest.angle {
            Some(angle) => format!(
                "{} at t = {} s",
                angle_text(angle, &layout.units),
                time(largest.t)
            ),
            None => "none, the follower rests".to_string(),
        };
        writeln!(output, "  {}  {text}", largest.joint)?;
    }
    writeln!(output)
}

/// Returns an angle in degrees, unless another unit of angles is requested.
fn angle_text(angle: f64, units: &OutputUnits) -> String {
    let unit = units.clone().or("deg").of("rad");
    let decimals = if unit.name == "deg" { 2 } else { 4 };
    text_of(angle, &unit, decimals)
}

fn start<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
    let when = match motion.is_assembled {
        true => format!("at t = {} s", time(motion.start)),
        false => "in the design configuration".to_string(),
    };
    let text = format!(
        "det Φ_q = {}, reciprocal condition {} (dimensionless: {})",
        scientific(motion.condition.determinant, 6),
        scientific(motion.condition.reciprocal, 2),
        scientific(motion.dimensionless_condition.reciprocal, 2),
    );
    line(output, &when, &text)
}

fn residuals<V: View>(
    motion: &Followed<V>,
    units: &OutputUnits,
    output: &mut dyn Write,
) -> io::Result<()> {
    let largest = &motion.residuals.largest;
    let system = motion.system();
    let frames = counted(motion.count, "frame");
    writeln!(output, "largest residuals over {frames}")?;
    let joint = system.rows.get(largest.row).map(|row| row.joint);
    let place = match joint {
        Some(joint) if largest.position > 0.0 => {
            format!(" in {}", system.mechanism.joints[joint].label)
        }
        _ => String::new(),
    };
    let unit = match system.rows.is_empty() {
        true => units.of(""),
        false => units.of(&unit(system, largest.row)),
    };
    let text = format!(
        "{} {}{place}; relative to its terms at most {}",
        scientific(unit.of_si(largest.position), 1),
        unit.name,
        scientific(largest.scaled, 1)
    );
    line(output, "|Φ|", &text)?;
    if let Some(most) = largest.monitored {
        let row = &system.monitored[largest.monitored_row];
        let joint = &system.mechanism.joints[row.joint].label;
        let text = format!("{} in {joint}", scientific(most, 1));
        line(output, "redundant equations", &text)?;
    }
    line(output, "|Φ_q q̇ + Φ_t|", &scientific(largest.velocity, 1))?;
    line(output, "|Φ_q q̈ - γ|", &scientific(largest.acceleration, 1))?;
    if motion.simulated.is_some() {
        // Poses of a simulation come from its integration, which reports its own cost.
        return Ok(());
    }
    let [steps, solves] = motion.view.newton_steps();
    let steps = match solves {
        0 => format!(
            "none in {}: all blocks have closed forms",
            counted(motion.visits, "instant")
        ),
        _ => format!(
            "{steps} in {}, polishing included",
            counted(solves as usize, "solve")
        ),
    };
    line(output, "Newton-Raphson steps", &steps)
}

/// Writes the cost of the integration, and its conservation of energy.
fn integration<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
    let Some(found) = &motion.simulated else {
        return Ok(());
    };
    let effort = &found.effort;
    writeln!(output, "\nintegration of the free coordinates")?;
    let implicit = match effort.implicit {
        0 => String::new(),
        some => format!(", {some} of them implicit"),
    };
    let steps = format!(
        "{}{implicit}, {} rejected",
        counted(effort.steps as usize, "step"),
        effort.rejected
    );
    line(output, "steps", &steps)?;
    line(output, "evaluations", &effort.evaluations.to_string())?;
    if let Some(hint) = hint(&found.effort, found.method) {
        line(output, "hint", hint)?;
    }
    let (drift, t) = found.drift;
    let drift = format!(
        "{} J at t = {} s, beside a kinetic energy of up to {} J",
        scientific(drift, 1),
        time(t),
        scientific(found.kinetic, 3)
    );
    line(output, "drift of the energy", &drift)
}
