//! Writes the path of an equilibrium as text: its events, and some of its points.

use std::io::{self, Write};

use linkwright_codegen::stages::system::System;
use linkwright_solver::equilibrium::{
    EquilibriumPath, PathEnd, PathEvent, PathEventKind, PathRow, Stability,
};
use linkwright_solver::number::counted;

use super::aligned::aligned;
use super::equilibrium_text::{Column, free_columns, measure_cells, measure_columns};

/// Number of rows of a path that are printed besides events.
const PRINTED: usize = 20;

/// Path of an equilibrium over a parameter or an input.
pub struct Followed {
    /// Name of the parameter.
    pub name: String,
    /// SI unit of its values.
    pub unit: String,
    /// Index of the equilibrium.
    pub of: usize,
    /// First and last value in SI units.
    pub ends: [f64; 2],
    /// Path.
    pub path: EquilibriumPath,
}

/// Writes the path of an equilibrium: its events, and some of its points.
///
/// # Errors
/// Errors of `output`.
pub fn write(followed: &Followed, system: &System, output: &mut dyn Write) -> io::Result<()> {
    let units = system.mechanism.units.of_messages();
    let varied = Column {
        name: followed.name.clone(),
        unit: units.of(&followed.unit),
        scale: (followed.ends[1] - followed.ends[0]).abs(),
        is_angle: false,
    };
    let [first, last] = followed.ends.map(|it| varied.text(it));
    let path = &followed.path;
    writeln!(
        output,
        "\npath of equilibrium {} over {} from {first} to {last}, {}",
        followed.of + 1,
        followed.name,
        counted(path.rows.len(), "point")
    )?;
    let (free, measures) = (free_columns(system), measure_columns(system));
    let mut header = vec![followed.name.clone()];
    let columns = free.iter().chain(&measures);
    header.extend(columns.map(|it| it.name.clone()));
    header.extend(["stability", ""].map(String::from));
    let mut rows = vec![header];
    let mut add = |row: &PathRow, words: [String; 2]| {
        let mut cells = vec![varied.text(row.value)];
        let values = free.iter().zip(&row.equilibrium.free);
        cells.extend(values.map(|(column, value)| column.text(*value)));
        cells.extend(measure_cells(&row.equilibrium, &measures, system));
        cells.extend(words);
        rows.push(cells);
    };
    let count = path.rows.len();
    let step = count.div_ceil(PRINTED).max(1);
    for (place, row) in path.rows.iter().enumerate() {
        for event in path.events.iter().filter(|it| it.place == place) {
            add(&event.row, event_words(event));
        }
        if place % step == 0 || place + 1 == count {
            let name = row.equilibrium.verdict.stability.name();
            add(row, [name.to_string(), String::new()]);
        }
    }
    aligned(&rows, output)?;
    let end = match path.end {
        PathEnd::Last => format!("ends at {} = {last}", followed.name),
        PathEnd::First => format!("ends at {} = {first}, to which it returns", followed.name),
        PathEnd::Closed => "returns to its first point".to_string(),
        PathEnd::Lost => {
            "is lost: no equilibrium continues, or the mechanism becomes singular".to_string()
        }
        PathEnd::Interrupted => "is interrupted".to_string(),
        PathEnd::Long => "is not followed further after so many points".to_string(),
    };
    writeln!(output, "the path {end}")
}

/// Returns the stability at an event, and its kind in words.
fn event_words(event: &PathEvent) -> [String; 2] {
    let [before, behind] = event.stability.map(Stability::name);
    let stability = match before == behind {
        true => before.to_string(),
        false => format!("{before} -> {behind}"),
    };
    let kind = match event.kind {
        PathEventKind::Fold => "fold",
        PathEventKind::ChangeOfStability => "change of stability",
    };
    [stability, kind.to_string()]
}
