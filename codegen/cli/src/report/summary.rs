//! *A motion* → *what a person reads*: the mechanism, its equations, the start, the motion of the points, the residuals.

use std::io::{self, Write};

use linkwright_codegen::stages::emit::Notation;
use linkwright_codegen::stages::emit::text::{formula, shown_width};
use linkwright_codegen::stages::model::{Body, Role};

use linkwright_solver::check::equation_count;
use linkwright_solver::diagnosis::unit;
use linkwright_solver::number::{counted, fixed, scientific, time};
use linkwright_solver::view::View;

use super::forces;
use super::motion_table::Column;
use super::units::Units;
use super::{first_step, motion_table};
use crate::arguments::{Reported, TurnUnit};
use crate::motion::{Followed, Row};

/// The width that lists are wrapped to, in characters.
const WIDTH: usize = 110;

/// How many lines a list takes at most; the rest of a longer one is left out.
const LINES: usize = 2;

/// How many tables are printed where no points are asked for.
const TABLES: usize = 6;

/// Where the second column begins.
const INDENT: usize = 24;

/// What a summary shows, and how.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// A table of every shown point, and not of the first few that move.
    pub points_chosen: bool,
    /// A table of every shown coordinate, and not all beside one another.
    pub coordinates_chosen: bool,
    /// The unit of angles.
    pub angles: TurnUnit,
    /// The first Newton-Raphson step, too.
    pub first_step: bool,
}

impl Layout {
    /// As what is reported asks, without the first step.
    pub fn of(reported: &Reported) -> Layout {
        Layout {
            points_chosen: !reported.points.is_empty(),
            coordinates_chosen: !reported.show.is_empty(),
            angles: reported.angles,
            first_step: false,
        }
    }
}

/// Writes the summary; without frames only what is known of the mechanism itself.
///
/// # Errors
/// Those of `output`.
pub fn write<V: View>(
    motion: &Followed<V>,
    layout: &Layout,
    output: &mut dyn Write,
) -> io::Result<()> {
    writeln!(output, "{}", motion.title())?;
    start(motion, output)?;
    mechanism(motion, output)?;
    if layout.first_step {
        first_step::write(&motion.view, motion.start, output)?;
    }
    if motion.count == 0 {
        return Ok(());
    }
    motions(motion, layout, output)?;
    forces::write(motion, output)?;
    writeln!(output)?;
    pressure_angles(motion, output)?;
    closest(motion, output)?;
    residuals(motion, output)?;
    integration(motion, output)
}

/// Where blocks are closest to singular, where that is asked for.
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

fn pressure_angles<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
    let found = &motion.pressure.largest;
    if found.is_empty() {
        return Ok(());
    }
    writeln!(output, "largest pressure angles")?;
    for largest in found {
        let text = match largest.angle {
            Some(angle) => format!(
                "{}° at t = {} s",
                fixed(angle.to_degrees(), 2),
                time(largest.t)
            ),
            None => "none, the follower rests".to_string(),
        };
        writeln!(output, "  {}  {text}", largest.joint)?;
    }
    writeln!(output)
}

/// The parameters and inputs with what they are here.
fn given<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
    let system = motion.system();
    let mechanism = &system.mechanism;
    let parameters = mechanism.parameters.iter().map(|own| {
        let value = mechanism.graph.nominal(own.symbol).unwrap_or(f64::NAN);
        format!("{} = {value} {}", own.name, own.dimension.unit())
    });
    if !mechanism.parameters.is_empty() {
        list(output, "parameters", mechanism.parameters.len(), parameters)?;
    }
    let inputs = mechanism.inputs.iter().map(|own| {
        let signal = formula(system, &[], Notation::Ascii, own.signal[0]);
        format!("{} = {signal} {}", own.name, own.dimension.unit())
    });
    if !mechanism.inputs.is_empty() {
        list(output, "inputs", mechanism.inputs.len(), inputs)?;
    }
    Ok(())
}

fn mechanism<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
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
    given(motion, output)?;
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

fn start<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
    let when = match motion.is_assembled {
        true => format!("at t = {} s", time(motion.start)),
        false => "in the drawing".to_string(),
    };
    let text = format!(
        "det Φ_q = {}, reciprocal condition {} (dimensionless: {})",
        scientific(motion.condition.determinant, 6),
        scientific(motion.condition.reciprocal, 2),
        scientific(motion.dimensionless_condition.reciprocal, 2),
    );
    line(output, &when, &text)
}

fn motions<V: View>(
    motion: &Followed<V>,
    layout: &Layout,
    output: &mut dyn Write,
) -> io::Result<()> {
    let size = motion.system().mechanism.characteristic_length;
    let rows = motion.rows.numbered(&motion_table::shown(motion.count));
    let times: Vec<f64> = rows.iter().map(|row| row.t).collect();
    let times = Column::of_times(&times);
    if layout.coordinates_chosen {
        chosen_coordinates(motion, &rows, &times, layout, output)?;
    } else {
        angles(motion, &rows, &times, layout, output)?;
    }
    let (mut tables, mut unprinted, mut resting) = (0, Vec::new(), Vec::new());
    for (position, name) in motion.point_names().enumerate() {
        let motions: Vec<_> = rows.iter().map(|row| row.motions[position]).collect();
        if motion_table::rests(&motions, size) {
            let [x, y] = motions[0].position.map(|it| fixed(it, 6));
            resting.push(format!("{name} stays at ({x}, {y}) m"));
        } else if tables == TABLES && !layout.points_chosen {
            unprinted.push(name);
        } else {
            tables += 1;
            writeln!(
                output,
                "\n{name}: position, velocity, acceleration in m, m/s, m/s²"
            )?;
            let columns = motion_table::of_point(&motions, size);
            let table = motion_table::table([&times].into_iter().chain(&columns));
            write!(output, "{table}")?;
        }
    }
    if !unprinted.is_empty() {
        writeln!(output)?;
    }
    left_out(output, "--points", &unprinted, &resting)
}

/// What has no place in a table: names that an option asks for, and what stays where it is.
fn left_out(
    output: &mut dyn Write,
    option: &str,
    unprinted: &[&str],
    resting: &[String],
) -> io::Result<()> {
    if !unprinted.is_empty() {
        writeln!(output, "more with `{option} {}`", unprinted.join(","))?;
    }
    if !resting.is_empty() {
        writeln!(output, "\n{}", resting.join("\n"))?;
    }
    Ok(())
}

/// All angles beside one another, as many as fit on a line.
fn angles<V: View>(
    motion: &Followed<V>,
    rows: &[&Row],
    times: &Column,
    layout: &Layout,
    output: &mut dyn Write,
) -> io::Result<()> {
    let (mut columns, mut unprinted, mut resting) = (vec![], vec![], vec![]);
    let mut width = 2 + times.width();
    let mut unit = "";
    for (place, &coordinate) in motion.wanted.coordinates.iter().enumerate() {
        let units = Units::of(motion.system(), coordinate, layout.angles);
        let name = motion.system().coordinates[coordinate].name.as_str();
        let values: Vec<[f64; 3]> = rows.iter().map(|row| row.coordinates[place]).collect();
        let angles: Vec<f64> = values.iter().map(|it| it[0] * units.factor).collect();
        unit = units.levels[0];
        if motion_table::stands(&values, 1.0) {
            let value = fixed(angles.first().copied().unwrap_or(0.0), 6);
            resting.push(format!("{name} stays at {value} {unit}"));
            continue;
        }
        let column = Column::new(name, &angles, units.factor);
        match width + 2 + column.width() <= WIDTH {
            true => {
                width += 2 + column.width();
                columns.push(column);
            }
            false => unprinted.push(name),
        }
    }
    if !columns.is_empty() {
        writeln!(output, "\nangles in {unit}")?;
        let table = motion_table::table([times].into_iter().chain(&columns));
        write!(output, "{table}")?;
    }
    left_out(output, "--show", &unprinted, &resting)
}

/// A table of each coordinate that the user has chosen.
fn chosen_coordinates<V: View>(
    motion: &Followed<V>,
    rows: &[&Row],
    times: &Column,
    layout: &Layout,
    output: &mut dyn Write,
) -> io::Result<()> {
    for (place, &coordinate) in motion.wanted.coordinates.iter().enumerate() {
        let units = Units::of(motion.system(), coordinate, layout.angles);
        let name = motion.system().coordinates[coordinate].name.as_str();
        let [value, rate, acceleration] = units.levels;
        writeln!(
            output,
            "\n{name}: value, rate, acceleration in {value}, {rate}, {acceleration}"
        )?;
        let columns = [0, 1, 2].map(|level| {
            let values = rows
                .iter()
                .map(|row| row.coordinates[place][level] * units.factor);
            let values: Vec<f64> = values.collect();
            Column::new(format!("{name}{}", &"''"[..level]), &values, units.size)
        });
        let table = motion_table::table([times].into_iter().chain(&columns));
        write!(output, "{table}")?;
    }
    Ok(())
}

fn residuals<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
    let found = &motion.residuals.largest;
    let system = motion.system();
    let frames = counted(motion.count, "frame");
    writeln!(output, "largest residuals over {frames}")?;
    let joint = system.rows.get(found.row).map(|row| row.joint);
    let place = match joint {
        Some(joint) if found.position > 0.0 => {
            format!(" in {}", system.mechanism.joints[joint].label)
        }
        _ => String::new(),
    };
    let unit = match system.rows.is_empty() {
        true => String::new(),
        false => unit(system, found.row),
    };
    let text = format!(
        "{} {unit}{place}; relative to its terms at most {}",
        scientific(found.position, 1),
        scientific(found.scaled, 1)
    );
    line(output, "|Φ|", &text)?;
    if let Some(most) = found.monitored {
        let row = &system.monitored[found.monitored_row];
        let joint = &system.mechanism.joints[row.joint].label;
        let text = format!("{} in {joint}", scientific(most, 1));
        line(output, "redundant equations", &text)?;
    }
    line(output, "|Φ_q q̇ + Φ_t|", &scientific(found.velocity, 1))?;
    line(output, "|Φ_q q̈ - γ|", &scientific(found.acceleration, 1))?;
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

/// What the integration has taken, and how well it keeps the energy.
fn integration<V: View>(motion: &Followed<V>, output: &mut dyn Write) -> io::Result<()> {
    let Some(found) = &motion.simulated else {
        return Ok(());
    };
    let effort = &found.effort;
    writeln!(output, "\nintegration of the free coordinates")?;
    let steps = format!(
        "{}, {} tried in vain",
        counted(effort.steps as usize, "step"),
        effort.rejected
    );
    line(output, "steps", &steps)?;
    line(output, "evaluations", &effort.evaluations.to_string())?;
    if !found.changes.is_empty() {
        let changes = found.changes.len().to_string();
        line(output, "changes of coordinate", &changes)?;
    }
    let drift = match found.drift {
        Some((drift, t)) => format!(
            "{} J at t = {} s, beside a kinetic energy of up to {} J",
            scientific(drift, 1),
            time(t),
            scientific(found.kinetic, 3)
        ),
        None => "not known, since drivers bring in work".to_string(),
    };
    line(output, "drift of the energy", &drift)
}

/// `  title   text`, the second column aligned.
fn line(output: &mut dyn Write, title: &str, text: &str) -> io::Result<()> {
    let gap = " ".repeat(INDENT.saturating_sub(2 + shown_width(title)).max(1));
    writeln!(output, "  {title}{gap}{text}")
}

/// A count and the names behind it, wrapped.
fn list(
    output: &mut dyn Write,
    title: &str,
    count: usize,
    names: impl Iterator<Item = String>,
) -> io::Result<()> {
    line(output, title, &wrapped(count, names).join("\n"))
}

/// A count and the first names behind it, as many as fit on [`LINES`] lines.
fn shortened(
    output: &mut dyn Write,
    title: &str,
    count: usize,
    names: impl Iterator<Item = String>,
) -> io::Result<()> {
    let mut lines = wrapped(count, names);
    if lines.len() > LINES {
        lines.truncate(LINES);
        if let Some(last) = lines.last_mut() {
            last.push_str(" …");
        }
    }
    line(output, title, &lines.join("\n"))
}

/// The lines of a count and the names behind it; all but the first are indented.
fn wrapped(count: usize, names: impl Iterator<Item = String>) -> Vec<String> {
    let mut lines = vec![count.to_string()];
    let mut column = INDENT + lines[0].len();
    for (index, name) in names.enumerate() {
        let separator = if index == 0 { ":" } else { "," };
        let length = name.chars().count() + 1 + separator.len();
        let breaks = column + length > WIDTH && column > INDENT;
        if let Some(last) = lines.last_mut() {
            last.push_str(separator);
            if !breaks {
                last.push(' ');
                last.push_str(&name);
            }
        }
        column += length;
        if breaks {
            lines.push(format!("{}{name}", " ".repeat(INDENT)));
            column = INDENT + name.chars().count();
        }
    }
    lines
}
