//! Writes forces and measures along a motion as tables, with the largest magnitude of each force and the range of each measure.

use std::io::{self, Write};

use linkwright_codegen::stages::units::OutputUnits;
use linkwright_solver::View;
use linkwright_solver::number::time;

use super::motion_table::{self, Column};
use linkwright_page::measured::is_constant;
use linkwright_page::motion::Followed;
use linkwright_page::{losses, motors};

/// Width of a table in characters.
const WIDEST: usize = 100;

/// Largest number of columns that are printed as tables; of more, only the extreme values are printed.
const TABLED: usize = 12;

/// Writes the requested forces and the measures, if any.
///
/// # Errors
/// Errors of `output`.
pub fn write<V: View>(
    motion: &Followed<V>,
    units: &OutputUnits,
    output: &mut dyn Write,
) -> io::Result<()> {
    if motion.reported_names.is_empty() {
        return Ok(());
    }
    if motion.reported_names.len() <= TABLED {
        tables(motion, units, output)?;
    }
    let width = motion.reported_names.iter().map(|(name, _)| name.len());
    let width = width.max().unwrap_or(0);
    let forces = motion.force_count();
    if forces > 0 {
        writeln!(output, "\nlargest forces")?;
    }
    let names = motion.reported_names.iter().take(forces);
    for ((name, si), (value, t)) in names.zip(&motion.largest_reported) {
        let (t, unit) = (time(*t), units.of(si));
        let value = short(unit.of_si(*value));
        writeln!(
            output,
            "  {name:width$}  {value} {} at t = {t} s",
            unit.name
        )?;
    }
    if motion.reported_names.len() > forces {
        writeln!(output, "\nmeasures")?;
    }
    let measures = motion.reported_names.iter().zip(&motion.extremes);
    for (((name, si), extremes), square) in measures.zip(&motion.squares).skip(forces) {
        let unit = units.of(si);
        let text = |si: f64| unit.labeled(short(unit.of_si(si)));
        if is_constant(extremes[0].0, extremes[1].0) {
            writeln!(output, "  {name:width$}  always {}", text(extremes[0].0))?;
            continue;
        }
        let [low, high] =
            extremes.map(|(value, t)| format!("{} at t = {} s", text(value), time(t)));
        let rms = text(square.root());
        writeln!(output, "  {name:width$}  from {low} to {high}, rms {rms}")?;
    }
    motors::write(&motion.motors, |it| motion.rms_torque(it), units, output)?;
    losses::write(motion.losses.as_ref(), output)
}

/// Writes as many columns side by side as fit on a line.
fn tables<V: View>(
    motion: &Followed<V>,
    units: &OutputUnits,
    output: &mut dyn Write,
) -> io::Result<()> {
    let rows = motion.rows.numbered(&motion_table::shown(motion.count));
    let times: Vec<f64> = rows.iter().map(|row| row.t).collect();
    let times = Column::of_times(&times);
    let columns = motion
        .reported_names
        .iter()
        .enumerate()
        .map(|(place, (name, si))| {
            let unit = units.of(si);
            let values = rows.iter().map(|row| unit.of_si(row.reported[place]));
            let values: Vec<f64> = values.collect();
            let (largest, _) = motion.largest_reported[place];
            let largest = unit.of_si(largest.abs());
            Column::new(format!("{name} ({})", unit.name), &values, largest)
        });
    let columns: Vec<Column> = columns.collect();
    let mut rest = &columns[..];
    while !rest.is_empty() {
        let mut width = 2 + times.width();
        let fitting = rest.iter().take_while(|column| {
            width += 2 + column.width();
            width <= WIDEST
        });
        let fitting = fitting.count().max(1);
        let (own, others) = rest.split_at(fitting);
        let table = motion_table::table([&times].into_iter().chain(own));
        write!(output, "\n{table}")?;
        rest = others;
    }
    Ok(())
}

/// Returns a value with five digits.
fn short(value: f64) -> String {
    match value == 0.0 {
        true => "0".to_string(),
        false => format!("{value:.4e}"),
    }
}
