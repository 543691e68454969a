//! Writes a motion as CSV: a line per frame, each number with the fewest digits that restore it exactly.
//!
//! The columns are:
//!
//! - `t`;
//! - the coordinates by name (`x1`), their rates (`x1_d`) and accelerations (`x1_dd`);
//! - for each point `K` its position, velocity and acceleration `K_x, K_y, K_vx, K_vy, K_ax, K_ay`;
//! - the derivatives of `transmission` and `sensitivity` statements, `K_x per phi(1)`, empty where Φ_q is singular;
//! - the quantities of `effort`, `reaction`, `energy` and `friction` statements, `effort_crank`;
//! - the measures of `--monitor`, `normalized_determinant_phi2`, dimensionless.
//!
//! Units are m, rad and s unless others are requested. Then each name is followed by its unit, `phi1_d (rad/s)`, unless it is
//! dimensionless.

use std::io::{self, Write};

use linkwright_codegen::stages::units::{OutputUnit, Unit};
use linkwright_solver::View;

use crate::motion::{Columns, Followed, OF_POINT, RATES, Shown, Sink};

/// Approximate number of bytes of a number and its separator.
const BYTES: u64 = 20;

/// Beginnings of the names of columns after those of coordinates and points.
const OTHERS: [&str; 10] = [
    "normalized_determinant_",
    "effort_",
    "power_",
    "reaction_",
    "kinetic_energy",
    "potential_energy",
    "added_power",
    "friction_",
    "frictionless_power",
    "backward_power",
];

/// Table of a motion, written frame by frame.
pub struct Table<'a> {
    writer: csv::Writer<&'a mut dyn Write>,
    fields: Vec<String>,
    columns: Columns,
    units: Vec<OutputUnit>,
}

impl<'a> Table<'a> {
    /// Begins a table with its header.
    ///
    /// # Errors
    /// Errors of `output`.
    pub fn new<V: View>(
        motion: &Followed<V>,
        has_units: bool,
        output: &'a mut dyn Write,
    ) -> io::Result<Table<'a>> {
        let mut writer = csv::Writer::from_writer(output);
        let columns = Columns::of(motion);
        let units = &motion.system().mechanism.units;
        let is_named = has_units || units.requested.is_some();
        let units = units.of_tables();
        let units: Vec<OutputUnit> = columns
            .columns
            .iter()
            .map(|it| units.of(&it.unit))
            .collect();
        let named = columns.columns.iter().zip(&units);
        let named = named.map(|(column, unit)| (column.name.as_str(), unit.name.as_str()));
        let header = [("t", "s")].into_iter().chain(named);
        let header = header.map(|(name, unit)| match is_named && !unit.is_empty() {
            true => format!("{name} ({unit})"),
            false => name.to_string(),
        });
        writer.write_record(header).map_err(cause)?;
        Ok(Table {
            writer,
            fields: Vec::new(),
            columns,
            units,
        })
    }

    /// Ends the table.
    ///
    /// # Errors
    /// Errors of the output.
    pub fn finish(mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Sink for Table<'_> {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        let fields = &mut self.fields;
        fields.clear();
        fields.push(number(shown.instant.t()));
        let values = self.columns.values(shown).zip(&self.units);
        fields.extend(values.map(|(value, unit)| match value {
            Some(value) => number(unit.of_si(value)),
            None => String::new(),
        }));
        self.writer.write_record(fields).map_err(cause)
    }
}

/// Returns the approximate number of bytes of a table of `frames` frames.
pub fn size<V: View>(motion: &Followed<V>, frames: usize) -> u64 {
    ((1 + Columns::of(motion).columns.len()) * frames) as u64 * BYTES
}

/// True if these are names of columns of such a table, also of another mechanism, in their order.
pub fn is_header(line: &str) -> bool {
    let mut table = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(line.as_bytes());
    let Some(Ok(names)) = table.records().next() else {
        return false;
    };
    let names: Vec<&str> = names.iter().collect();
    let Some((&("t" | "t (s)"), names)) = names.split_first() else {
        return false;
    };
    let names: Vec<&str> = names.iter().map(|it| without_unit(it)).collect();
    let names = names.as_slice();
    // The rate of the first coordinate follows the coordinates.
    let is_first_rate = |name: &&str| name.strip_suffix(RATES[1]) == names.first().copied();
    let Some(count) = names.iter().position(is_first_rate) else {
        return false;
    };
    let (coordinates, names) = names.split_at(count);
    let (rates, names) = names.split_at(names.len().min(2 * count));
    let of = |suffix| coordinates.iter().map(move |it| format!("{it}{suffix}"));
    if !of(RATES[1]).chain(of(RATES[2])).eq(rates.iter().copied()) {
        return false;
    }
    let points = names.chunks(OF_POINT.len()).take_while(|columns| {
        let name = columns[0].strip_suffix(OF_POINT[0]);
        name.is_some_and(|name| {
            let expected = OF_POINT.map(|suffix| format!("{name}{suffix}"));
            expected == *columns
        })
    });
    let others = &names[OF_POINT.len() * points.count()..];
    others
        .iter()
        .all(|name| name.contains(" per ") || OTHERS.iter().any(|begin| name.starts_with(begin)))
}

/// Removes the unit of a column: `phi1_d` of `phi1_d (rad/s)`.
fn without_unit(column: &str) -> &str {
    let name = column.strip_suffix(')').and_then(|it| it.rsplit_once(" ("));
    match name {
        Some((name, unit)) if Unit::parse(unit).is_some() => name,
        _ => column,
    }
}

/// Returns the error of the output itself; the conversion of the standard library would hide its kind.
pub fn cause(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(cause) => cause,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// Returns the shortest text that restores a number exactly.
fn number(value: f64) -> String {
    format!("{value:?}")
}

#[cfg(test)]
mod tests {
    use super::is_header;

    #[test]
    fn a_header_is_known_by_all_of_its_columns() {
        let crank = "t,x1,y1,phi1,x1_d,y1_d,phi1_d,x1_dd,y1_dd,phi1_dd";
        let point = ",P_x,P_y,P_vx,P_vy,P_ax,P_ay";
        for rest in [
            "",
            point,
            &point.repeat(2),
            ",P_x (m),P_y (m),P_vx (m/s),P_vy (m/s),P_ax (m/s²),P_ay (m/s²)",
            &format!("{point},\"P_x per distance(A, B)\",normalized_determinant_phi1"),
        ] {
            assert!(is_header(&format!("{crank}{rest}")), "{rest}");
        }
        assert!(is_header("t (s),x1 (m),x1_d (m/s),x1_dd (m/s²)"));
        for other in [
            "",
            "t",
            "t (min),x1,x1_d,x1_dd",
            "t,x,y",
            "0,0,0,0",
            "time,x1,x1_d,x1_dd",
            "t,x1,x1_d",
            "t,x1_d,x1_dd",
            "t,x1,x1_d,y1_dd",
            &format!("{crank},mark"),
            &format!("{crank},P_x,P_y"),
            &format!("{crank}{point},P"),
        ] {
            assert!(!is_header(other), "{other}");
        }
    }
}
