//! Writes measured and solved columns as a table, and checks their tolerances.

use std::io::{self, Write};

use linkwright_page::motion::Compared;
use linkwright_solver::number::{counted, scientific, time};

use super::aligned::aligned;
use super::measured_data::{taken_for, write_data, write_notes};
use linkwright_solver::data::{Data, Measured, Origin};

/// Decimals of numbers in scientific notation.
const DIGITS: usize = 3;

/// Common units of measured data: name, number per SI unit, powers of m, s, kg and rad.
const HINTS: [(&str, f64, [i32; 4]); 4] = [
    ("mm", 1000.0, [1, 0, 0, 0]),
    ("cm", 100.0, [1, 0, 0, 0]),
    ("in", 10_000.0 / 254.0, [1, 0, 0, 0]),
    ("deg", 180.0 / std::f64::consts::PI, [0, 0, 0, 1]),
];

/// Largest relative difference of a ratio of values from the ratio of two units that is put down to the units.
const RATIO_TOLERANCE: f64 = 0.02;

/// Comparison to report.
pub struct Report<'a> {
    /// Name of the mechanism in messages.
    pub title: String,
    /// Measured values.
    pub data: &'a Data,
    /// Compared columns.
    pub columns: Vec<Column<'a>>,
    /// Reason of an early end; `None` if the motion is complete.
    pub error: Option<&'a str>,
}

/// Compared column.
pub struct Column<'a> {
    /// Measured values.
    pub measured: &'a Measured,
    /// Solved values and differences.
    pub compared: Compared,
    /// Tolerance in SI units; `None` if there is none.
    pub tolerance: Option<f64>,
}

impl Column<'_> {
    /// True if the column is within its tolerance; `None` if it has none.
    pub fn is_within(&self) -> Option<bool> {
        let largest = self.compared.comparison.map(|it| it.largest.abs());
        self.tolerance
            .map(|tolerance| largest.is_some_and(|it| it <= tolerance))
    }
}

impl Report<'_> {
    /// True if every column is within its tolerance.
    pub fn is_within(&self) -> bool {
        self.columns.iter().all(|it| it.is_within() != Some(false))
    }

    /// True if any column has a tolerance.
    pub fn has_tolerances(&self) -> bool {
        self.columns.iter().any(|it| it.tolerance.is_some())
    }

    /// Returns a guess of the unit for each column without one whose values differ by the ratio of two units.
    pub fn hints(&self) -> Vec<String> {
        let mut hints = Vec::new();
        for column in self
            .columns
            .iter()
            .filter(|it| it.measured.scale.origin == Origin::Assumed)
        {
            let pairs = column.measured.values.iter().zip(&column.compared.solved);
            let (mut both, mut square) = (0.0, 0.0);
            for (measured, solved) in pairs.filter_map(|it| Some(((*it.0)?, (*it.1)?))) {
                both += measured * solved;
                square += solved * solved;
            }
            let ratio = both / square;
            let powers = column.measured.quantity.powers;
            let unit = HINTS.iter().find(|(_, factor, own)| {
                own[0] == powers[0]
                    && own[3] == powers[3]
                    && (ratio / factor - 1.0).abs() < RATIO_TOLERANCE
            });
            if let Some((unit, factor, _)) = unit {
                let per = ["", "/s", "/s^2"]
                    .get((-powers[1]).unsigned_abs() as usize)
                    .unwrap_or(&"");
                hints.push(format!(
                    "warning: the values of `{name}` are about {factor:.1} times those of the motion\n  = help: if they are in {unit}{per}, pass `--unit {name}={unit}{per}`",
                    name = column.measured.name,
                ));
            }
        }
        hints
    }
}

/// Writes the table.
///
/// # Errors
/// Errors of `output`.
pub fn write(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    write_data(&report.title, report.data, output)?;
    writeln!(output)?;
    let mut heading: Vec<&str> = vec![
        "column", "quantity", "unit", "values", "rms", "largest", "at t",
    ];
    if report.has_tolerances() {
        heading.extend(["tolerance", ""]);
    }
    let mut rows = vec![heading.into_iter().map(str::to_string).collect::<Vec<_>>()];
    for column in &report.columns {
        let measured = column.measured;
        let [quantity, unit] = taken_for(measured);
        let in_unit = |value: f64| scientific(measured.scale.unit.of_si(value), DIGITS);
        let mut row = vec![measured.name.clone(), quantity, unit];
        match &column.compared.comparison {
            Some(it) => row.extend([
                it.count.to_string(),
                in_unit(it.rms),
                in_unit(it.largest),
                time(it.at),
            ]),
            None => row.extend(["0", "", "", ""].map(str::to_string)),
        }
        if report.has_tolerances() {
            let verdict = match column.is_within() {
                Some(true) => "within",
                Some(false) => "beyond",
                None => "",
            };
            row.extend([
                column.tolerance.map_or(String::new(), in_unit),
                verdict.to_string(),
            ]);
        }
        rows.push(row);
    }
    aligned(&rows, output)?;
    writeln!(output)?;
    write_notes(report.data, output)?;
    if report.has_tolerances() {
        let count = |is| {
            report
                .columns
                .iter()
                .filter(|it| it.is_within() == Some(is))
                .count()
        };
        let (within, beyond) = (count(true), count(false));
        writeln!(
            output,
            "within its tolerance: {within} of {}",
            counted(within + beyond, "column")
        )?;
    }
    Ok(())
}
