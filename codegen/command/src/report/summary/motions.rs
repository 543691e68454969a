//! Writes tables of coordinates and points of a motion, and a line for each that rests.

use std::io::{self, Write};

use linkwright_solver::View;
use linkwright_solver::number::fixed;

use super::{Layout, WIDTH};
use crate::report::motion_table;
use crate::report::motion_table::Column;
use linkwright_page::motion::{Followed, Row};
use linkwright_page::units::{LENGTHS, Units};

/// Largest number of tables if no points are selected.
const TABLES: usize = 6;

pub(super) fn motions<V: View>(
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
    let units = LENGTHS.map(|it| layout.units.of(it));
    let (mut tables, mut unprinted, mut resting) = (0, Vec::new(), Vec::new());
    for (position, name) in motion.point_names().enumerate() {
        let motions: Vec<_> = rows.iter().map(|row| row.motions[position]).collect();
        if motion_table::rests(&motions, size) {
            let [x, y] = motions[0].position.map(|it| fixed(units[0].of_si(it), 6));
            resting.push(format!("{name} stays at ({x}, {y}) {}", units[0].name));
        } else if tables == TABLES && !layout.points_chosen {
            unprinted.push(name);
        } else {
            tables += 1;
            writeln!(
                output,
                "\n{name}: position, velocity, acceleration in {}, {}, {}",
                units[0].name, units[1].name, units[2].name
            )?;
            let columns = motion_table::of_point(&motions, &units, size);
            let table = motion_table::table([&times].into_iter().chain(&columns));
            write!(output, "{table}")?;
        }
    }
    if !unprinted.is_empty() {
        writeln!(output)?;
    }
    left_out(output, "--points", &unprinted, &resting)
}

/// Writes all angles side by side, as many as fit on a line.
fn angles<V: View>(
    motion: &Followed<V>,
    rows: &[&Row],
    times: &Column,
    layout: &Layout,
    output: &mut dyn Write,
) -> io::Result<()> {
    let (mut columns, mut unprinted, mut resting) = (vec![], vec![], vec![]);
    let mut width = 2 + times.width();
    let mut unit = String::new();
    for (place, &coordinate) in motion.wanted.coordinates.iter().enumerate() {
        let units = Units::of(motion.system(), coordinate, &layout.units);
        let name = motion.system().coordinates[coordinate].name.as_str();
        let values: Vec<[f64; 3]> = rows.iter().map(|row| row.coordinates[place]).collect();
        let angles: Vec<f64> = values
            .iter()
            .map(|it| units.levels[0].of_si(it[0]))
            .collect();
        unit.clone_from(&units.levels[0].name);
        if motion_table::stands(&values, 1.0) {
            let value = fixed(angles.first().copied().unwrap_or(0.0), 6);
            resting.push(format!("{name} stays at {value} {unit}"));
            continue;
        }
        let column = Column::new(name, &angles, units.size);
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

/// Writes a table of each coordinate that the user has selected.
fn chosen_coordinates<V: View>(
    motion: &Followed<V>,
    rows: &[&Row],
    times: &Column,
    layout: &Layout,
    output: &mut dyn Write,
) -> io::Result<()> {
    for (place, &coordinate) in motion.wanted.coordinates.iter().enumerate() {
        let units = Units::of(motion.system(), coordinate, &layout.units);
        let name = motion.system().coordinates[coordinate].name.as_str();
        let [value, rate, acceleration] = units.levels.each_ref().map(|it| it.name.as_str());
        writeln!(
            output,
            "\n{name}: value, rate, acceleration in {value}, {rate}, {acceleration}"
        )?;
        let columns = [0, 1, 2].map(|level| {
            let values = rows
                .iter()
                .map(|row| units.levels[level].of_si(row.coordinates[place][level]));
            let values: Vec<f64> = values.collect();
            Column::new(format!("{name}{}", &"''"[..level]), &values, units.size)
        });
        let table = motion_table::table([times].into_iter().chain(&columns));
        write!(output, "{table}")?;
    }
    Ok(())
}

/// Writes the points and coordinates without a table: the names for an option, and those that rest.
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
