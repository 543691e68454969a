//! *Measured and solved columns* → *a table*, and what is within its tolerance.

use std::io::{self, Write};

use linkwright_solver::comparison::Comparison;
use linkwright_solver::number::{counted, scientific, time};

use super::aligned::aligned;
use super::measured_data::{taken_for, write_data, write_notes};
use crate::data::{Data, Measured, Origin};

/// Decimals of what is printed in scientific notation.
const DIGITS: usize = 3;

/// Units that people measure in, and how many of them the unit of SI has.
const HINTS: [(&str, f64, [i32; 4]); 4] = [
    ("mm", 1000.0, [1, 0, 0, 0]),
    ("cm", 100.0, [1, 0, 0, 0]),
    ("in", 10_000.0 / 254.0, [1, 0, 0, 0]),
    ("deg", 180.0 / std::f64::consts::PI, [0, 0, 0, 1]),
];

/// How near a ratio of values must be to that of units to be put down to them.
const ALIKE: f64 = 0.02;

/// What was compared.
pub struct Report<'a> {
    /// What messages call the mechanism.
    pub title: String,
    /// The measured values.
    pub data: &'a Data,
    /// What was compared.
    pub columns: Vec<Column<'a>>,
    /// Why the motion ends early, if it does.
    pub error: Option<&'a str>,
}

/// One column.
pub struct Column<'a> {
    /// What was measured.
    pub measured: &'a Measured,
    /// In SI units, row by row.
    pub solved: Vec<Option<f64>>,
    /// Whether whole turns are no difference.
    pub is_angle: bool,
    /// In SI units; `None` where no row has both.
    pub comparison: Option<Comparison>,
    /// In SI units.
    pub tolerance: Option<f64>,
}

impl Column<'_> {
    /// Whether it is within its tolerance, where it has one.
    pub fn is_within(&self) -> Option<bool> {
        let largest = self.comparison.map(|it| it.largest.abs());
        self.tolerance
            .map(|tolerance| largest.is_some_and(|it| it <= tolerance))
    }
}

impl Report<'_> {
    /// Whether every column is within its tolerance.
    pub fn is_within(&self) -> bool {
        self.columns.iter().all(|it| it.is_within() != Some(false))
    }

    /// Whether any has one.
    pub fn has_tolerances(&self) -> bool {
        self.columns.iter().any(|it| it.tolerance.is_some())
    }

    /// Units that columns without one seem to have.
    pub fn hints(&self) -> Vec<String> {
        let mut hints = Vec::new();
        for column in self
            .columns
            .iter()
            .filter(|it| it.measured.scale.origin == Origin::Assumed)
        {
            let pairs = column.measured.values.iter().zip(&column.solved);
            let (mut both, mut square) = (0.0, 0.0);
            for (measured, solved) in pairs.filter_map(|it| Some(((*it.0)?, (*it.1)?))) {
                both += measured * solved;
                square += solved * solved;
            }
            let ratio = both / square;
            let powers = column.measured.quantity.powers;
            let unit = HINTS.iter().find(|(_, factor, own)| {
                own[0] == powers[0] && own[3] == powers[3] && (ratio / factor - 1.0).abs() < ALIKE
            });
            if let Some((unit, factor, _)) = unit {
                let per = ["", "/s", "/s^2"]
                    .get((-powers[1]).unsigned_abs() as usize)
                    .unwrap_or(&"");
                hints.push(format!(
                    "warning: the values of `{name}` are about {factor:.1} times those of the motion\n  = help: are they in {unit}{per}? `--unit {name}={unit}{per}` says so",
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
/// Those of `output`.
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
        let own = column.measured;
        let [quantity, unit] = taken_for(own);
        let shown = |value: f64| scientific(own.scale.unit.of_si(value), DIGITS);
        let mut row = vec![own.name.clone(), quantity, unit];
        match &column.comparison {
            Some(it) => row.extend([
                it.count.to_string(),
                shown(it.rms),
                shown(it.largest),
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
                column.tolerance.map_or(String::new(), shown),
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
