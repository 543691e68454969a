//! Writes driving forces and reactions along a motion as tables, with the largest magnitude of each.

use std::io::{self, Write};

use linkwright_codegen::stages::units::OutputUnits;
use linkwright_solver::View;
use linkwright_solver::number::time;

use super::motion_table::{self, Column};
use linkwright_page::motion::Followed;

/// Width of a table in characters.
const WIDEST: usize = 100;

/// Largest number of forces that are printed as tables; of more, only the largest values are printed.
const TABLED: usize = 12;

/// Writes the requested forces, if any.
///
/// # Errors
/// Errors of `output`.
pub fn write<V: View>(
    motion: &Followed<V>,
    units: &OutputUnits,
    output: &mut dyn Write,
) -> io::Result<()> {
    if motion.force_names.is_empty() {
        return Ok(());
    }
    if motion.force_names.len() <= TABLED {
        tables(motion, units, output)?;
    }
    writeln!(output, "\nlargest forces")?;
    let width = motion.force_names.iter().map(|(name, _)| name.len()).max();
    let width = width.unwrap_or(0);
    for ((name, si), (value, t)) in motion.force_names.iter().zip(&motion.largest_forces) {
        let (t, unit) = (time(*t), units.of(si));
        writeln!(
            output,
            "  {name:width$}  {} {} at t = {t} s",
            short(unit.of_si(*value)),
            unit.name
        )?;
    }
    Ok(())
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
        .force_names
        .iter()
        .enumerate()
        .map(|(place, (name, si))| {
            let unit = units.of(si);
            let values = rows.iter().map(|row| unit.of_si(row.forces[place]));
            let values: Vec<f64> = values.collect();
            let (largest, _) = motion.largest_forces[place];
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
