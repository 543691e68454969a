//! *Measured and solved columns* → *a table, or one JSON object*, and what is within its tolerance.
//!
//! | key | value |
//! |---|---|
//! | `mechanism`, `data` | the name of the mechanism, and the file |
//! | `read` | how the file was read, in words |
//! | `rows`, `from`, `to` | how many rows there are, and their first and last time (s) |
//! | `columns` | `{column, quantity, how, doubt, unit, unit_from, count, rms, largest, t, tolerance, within}` each, in the unit of the column; `how` is `name`, `option` or `guess`, `unit_from` is `header`, `option` or `assumed` |
//! | `left_out` | `{column, why}` each |
//! | `within` | whether all differences are within their tolerances; absent where there are none |
//! | `error` | why the motion ends early, where it does |

use std::io::{self, Write};

use linkwright_codegen::stages::emit::text::shown_width;
use linkwright_solver::comparison::Comparison;
use linkwright_solver::number::{counted, scientific, time};
use serde::Serialize;

use crate::data::{Data, How, Measured, Origin, unit_of};

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

    fn has_tolerances(&self) -> bool {
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

/// What an option such as `--tolerance` says of each measured column, in SI units.
///
/// # Errors
/// One cannot be read, or belongs to no column.
pub fn sizes(option: &str, asked: &[String], data: &Data) -> Result<Vec<Option<f64>>, String> {
    let mut sizes = vec![None; data.measured.len()];
    let mut own = vec![false; data.measured.len()];
    for text in asked {
        let (name, value) = match text.rsplit_once('=') {
            Some((name, value)) => (Some(name.trim()), value.trim()),
            None => (None, text.trim()),
        };
        // The longest beginning that is a number, so that `1e-3mm` and `2 deg` are read.
        let cut = (1..=value.len())
            .rev()
            .filter(|&it| value.is_char_boundary(it))
            .find_map(|it| Some((value[..it].trim().parse::<f64>().ok()?, value[it..].trim())));
        let (number, unit) = match cut {
            Some((number, "")) => (number, None),
            Some((number, unit)) => match unit_of(unit) {
                Some(unit) => (number, Some(unit)),
                None => {
                    return Err(format!("error: `{unit}` in `{option} {text}` is no unit"));
                }
            },
            None => {
                return Err(format!(
                    "error: `{option} {text}` is no number\n  = help: write `1e-6`, `0.5mm` or `COLUMN=0.5mm`"
                ));
            }
        };
        if !(number.is_finite() && number >= 0.0) {
            return Err(format!("error: `{option} {text}` is not a size"));
        }
        let mut is_used = false;
        for (place, measured) in data.measured.iter().enumerate() {
            let is_meant = match name {
                Some(name) => name == measured.name,
                None => !own[place] && unit.is_none_or(|it| it.powers == measured.quantity.powers),
            };
            if !is_meant {
                continue;
            }
            if unit.is_some_and(|it| !it.measures(measured.quantity.powers)) {
                return Err(format!(
                    "error: the unit in `{option} {text}` does not measure `{}`",
                    measured.quantity.name
                ));
            }
            is_used = true;
            own[place] |= name.is_some();
            sizes[place] = Some(unit.map_or(number, |it| it.si(number)));
        }
        if !is_used {
            let names: Vec<&str> = data.measured.iter().map(|it| it.name.as_str()).collect();
            return Err(format!(
                "error: `{option} {text}` is about none of the compared columns\n  = help: they are: {}",
                names.join(", ")
            ));
        }
    }
    Ok(sizes)
}

/// Rows of cells as a table whose columns begin with their names.
pub fn aligned(rows: &[Vec<String>], output: &mut dyn Write) -> io::Result<()> {
    let count = rows.first().map_or(0, Vec::len);
    let width = |column: usize| {
        rows.iter()
            .map(|row| shown_width(&row[column]))
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths) {
            line += cell;
            line += &" ".repeat(width - shown_width(cell) + 2);
        }
        writeln!(output, "  {}", line.trim_end())?;
    }
    Ok(())
}

/// How a table of data was read, and what its columns are: the first lines of what is printed.
///
/// # Errors
/// Those of `output`.
pub fn write_data(title: &str, data: &Data, output: &mut dyn Write) -> io::Result<()> {
    let (first, last) = (data.times.first(), data.times.last());
    let [first, last] = [first, last].map(|it| time(it.copied().unwrap_or(f64::NAN)));
    writeln!(
        output,
        "{title} and {}: {} from t = {first} s to {last} s",
        data.name,
        counted(data.times.len(), "row")
    )?;
    writeln!(output, "read as {}", data.columns.reading())?;
    let (column, scale) = &data.time;
    let assumed = match scale.origin {
        Origin::Assumed => ", as no unit is given",
        _ => "",
    };
    writeln!(
        output,
        "times are `{}` in {}{assumed}",
        data.columns.columns[*column].name, scale.text
    )?;
    Ok(())
}

/// What a column was taken for, and how; and its unit.
pub fn taken_for(measured: &Measured) -> [String; 2] {
    let quantity = &measured.quantity.name;
    let taken = match &measured.how {
        How::Named | How::Chosen => quantity.clone(),
        How::Guessed(_) => format!("{quantity} (guessed)"),
    };
    let unit = match measured.scale.origin {
        Origin::Assumed if !measured.scale.text.is_empty() => {
            format!("{} (assumed)", measured.scale.text)
        }
        _ => measured.scale.text.clone(),
    };
    [taken, unit]
}

/// What is to be said of guesses, and of columns that are left out.
///
/// # Errors
/// Those of `output`.
pub fn write_notes(data: &Data, output: &mut dyn Write) -> io::Result<()> {
    for measured in &data.measured {
        if let How::Guessed(doubt) = &measured.how
            && !doubt.is_empty()
        {
            writeln!(output, "guessed for `{}`: {doubt}", measured.name)?;
        }
    }
    for (name, why) in &data.left_out {
        writeln!(output, "left out: `{name}`, {why}")?;
    }
    Ok(())
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

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    data: &'a str,
    read: String,
    rows: usize,
    from: f64,
    to: f64,
    columns: Vec<Entry<'a>>,
    left_out: Vec<LeftOut<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    within: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
}

#[derive(Serialize)]
struct Entry<'a> {
    column: &'a str,
    quantity: &'a str,
    how: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    doubt: &'a str,
    unit: &'a str,
    unit_from: &'a str,
    count: usize,
    rms: Option<f64>,
    largest: Option<f64>,
    t: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    within: Option<bool>,
}

#[derive(Serialize)]
struct LeftOut<'a> {
    column: &'a str,
    why: &'a str,
}

/// Writes the object and a line break.
///
/// # Errors
/// Those of `output`.
pub fn write_json(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let data = report.data;
    let columns = report.columns.iter().map(|column| {
        let comparison = column.comparison;
        let own = column.measured;
        let shown = |value: f64| own.scale.unit.of_si(value);
        let (how, doubt) = match &own.how {
            How::Named => ("name", ""),
            How::Chosen => ("option", ""),
            How::Guessed(doubt) => ("guess", doubt.as_str()),
        };
        Entry {
            column: &own.name,
            quantity: &own.quantity.name,
            unit: &own.scale.text,
            unit_from: match own.scale.origin {
                Origin::Header => "header",
                Origin::Option => "option",
                Origin::Assumed => "assumed",
            },
            count: comparison.map_or(0, |it| it.count),
            rms: comparison.map(|it| shown(it.rms)),
            largest: comparison.map(|it| shown(it.largest)),
            t: comparison.map(|it| it.at),
            tolerance: column.tolerance.map(shown),
            within: column.is_within(),
            how,
            doubt,
        }
    });
    let left_out = data
        .left_out
        .iter()
        .map(|(column, why)| LeftOut { column, why });
    let object = Object {
        mechanism: &report.title,
        data: &data.name,
        read: data.columns.reading(),
        rows: data.times.len(),
        from: data.times.first().copied().unwrap_or(f64::NAN),
        to: data.times.last().copied().unwrap_or(f64::NAN),
        columns: columns.collect(),
        left_out: left_out.collect(),
        within: report.has_tolerances().then(|| report.is_within()),
        error: report.error,
    };
    serde_json::to_writer_pretty(&mut *output, &object)?;
    writeln!(output)
}
