//! Reads tables of measured values: times, and quantities of a system, in SI units.
//!
//! Afterwards times never decrease. Every measured column has a quantity and a unit, and the source of both: its name, an option or a
//! guess. Columns without a quantity of the system are listed.

mod argument_names;
mod driving;
mod mapping;
mod range_ends;
mod scale;
mod sizes;

use std::path::Path;

use linkwright_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Source, Span};
use linkwright_codegen::stages::columns::{Columns, Fault, Known, MAX_BYTES, Unit};
use linkwright_codegen::stages::files;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;

use crate::observable::Named;
pub use argument_names::ArgumentNames;
pub use driving::{MeasuredInput, powers};
pub use mapping::How;
pub use range_ends::{ROUNDED_END, on_end};
pub use scale::{Origin, Scale};
pub use sizes::{number_and_unit, sizes};

/// Largest number of decimals of a rounded value.
const MOST_DECIMALS: i32 = 12;

/// Relative distance of a rounded value from a whole number of steps: the rounding of doubles.
const ROUNDED: f64 = 1e-15;

/// Reading of a table where its names do not say everything.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Quantities of columns, `COLUMN=QUANTITY`.
    pub column: Vec<String>,
    /// Names of columns that are left out.
    pub skip: Vec<String>,
    /// Name of the column of times; `None` for the only one that is named so.
    pub time: Option<String>,
    /// True if a table without times is an error; false if its rows may have an order only.
    pub needs_times: bool,
    /// Time added to all times (s).
    pub shift: f64,
    /// Units, `COLUMN=UNIT` of one column, `UNIT` of all without a unit in the header.
    pub unit: Vec<String>,
    /// Dialect.
    pub dialect: Known,
    /// Names of these fields in messages.
    pub names: ArgumentNames,
}

/// Table of measured values.
#[derive(Clone, Debug)]
pub struct Data {
    /// Path as the user named the file.
    pub name: String,
    /// Contents.
    pub columns: Columns,
    /// Index of the column of times, and its unit; `None` if the rows have an order only.
    pub time: Option<(usize, Scale)>,
    /// Time of each row (s); empty if the rows have an order only.
    pub times: Vec<f64>,
    /// Measured quantities.
    pub measured: Vec<Measured>,
    /// Columns that drive inputs.
    pub inputs: Vec<MeasuredInput>,
    /// Names of arguments in messages.
    pub names: ArgumentNames,
    /// Names of the other columns, each with the reason that it is left out.
    pub left_out: Vec<(String, String)>,
}

/// Column that measures a quantity.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Name in the table.
    pub name: String,
    /// Measured quantity.
    pub quantity: Named,
    /// Source of the quantity.
    pub how: How,
    /// Unit of the column.
    pub scale: Scale,
    /// Number of decimals, in the unit of the column, that write all its values; `None` if the values are not rounded.
    pub decimals: Option<i32>,
    /// Values in SI units, row by row; `None` if missing.
    pub values: Vec<Option<f64>>,
}

impl Measured {
    /// Returns the rounding step of the table in SI units: the largest power of ten that divides all values; `None` if there is none.
    pub fn rounding(&self) -> Option<f64> {
        let decimals = self.decimals?;
        Some(self.scale.unit.si(10.0_f64.powi(-decimals)))
    }
}

impl Data {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        let columns = self.columns.columns.iter();
        columns.map(|it| it.values.len()).max().unwrap_or(0)
    }

    /// Reads a table of this name from its bytes.
    ///
    /// # Errors
    /// The printed message: the bytes are not a table, a field of the reading cannot be used, or no column measures a quantity of the
    /// system.
    pub fn read(
        name: &str,
        bytes: &[u8],
        reading: &Reading,
        pool: &Pool,
        system: &System,
    ) -> Result<Data, String> {
        let ArgumentNames {
            column: column_name,
            unit,
            skip,
            time,
            ..
        } = reading.names;
        let columns = Columns::read(bytes, reading.dialect)
            .map_err(|refused| rendered(name, &refused.text, &refused.faults))?;
        let mapped = mapping::mapped(reading, name, &columns, pool, system)?;
        let units = scale::Units::read(reading, name, &columns)?;
        let at = |column: usize, message: String, help: &str| {
            let fault = Fault {
                span: columns.columns[column].span,
                message,
                help: help.to_string(),
            };
            rendered(name, &columns.text, &[fault])
        };
        let time_column = mapped.time.map(|column| {
            let scale = units.of(&columns, column, [0, 1, 0, 0], "s");
            let scale = scale.map_err(|message| {
                let help = format!(
                    "give the unit of a column with `{unit}`, and the column of times with `{time}`"
                );
                at(column, message, &help)
            });
            Ok::<_, String>((column, scale?))
        });
        let time_column = time_column.transpose()?;
        let times = match &time_column {
            Some((column, scale)) => times(name, &columns, *column, scale, reading)?,
            None => Vec::new(),
        };
        let mut measured = Vec::with_capacity(mapped.measured.len());
        for (column, quantity, how) in mapped.measured {
            let source = &columns.columns[column];
            let scale = units.of(&columns, column, quantity.powers, &quantity.unit);
            let scale = scale.map_err(|message| {
                at(column, format!("{message}: it measures `{}`", quantity.name), &format!("give its unit with `{unit}` and its quantity with `{column_name}`, or leave it out with `{skip}`"))
            })?;
            measured.push(Measured {
                values: in_si(&source.values, &scale),
                decimals: decimals(&source.values),
                name: source.name.clone(),
                quantity,
                how,
                scale,
            });
        }
        let mut inputs = Vec::with_capacity(mapped.inputs.len());
        for (column, input) in mapped.inputs {
            let source = &columns.columns[column];
            let dimension = system.mechanism.inputs[input].dimension;
            let written = source.unit.as_deref().and_then(Unit::parse);
            let powers = powers(dimension, written.map(|it| it.powers));
            let scale = units.of(&columns, column, powers, &dimension.unit());
            let scale = scale.map_err(|message| {
                at(
                    column,
                    message,
                    &format!("give its unit with `{unit}`, or leave it out with `{skip}`"),
                )
            })?;
            inputs.push(MeasuredInput {
                values: in_si(&source.values, &scale),
                name: source.name.clone(),
                input,
                scale,
            });
        }
        Ok(Data {
            inputs,
            time: time_column,
            left_out: mapped.left_out,
            names: reading.names,
            name: name.to_string(),
            columns,
            times,
            measured,
        })
    }
}

/// Returns the contents of a table.
///
/// # Errors
/// The printed message: the file cannot be read, or is too large.
pub fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    let name = path.display();
    let refused = |reason: String| format!("error: cannot read `{name}`: {reason}");
    let bytes = files::read(path, MAX_BYTES).map_err(|error| refused(files::reason(&error)))?;
    match bytes.len() > MAX_BYTES {
        true => Err(refused(format!(
            "it is larger than {} MiB",
            MAX_BYTES >> 20
        ))),
        false => Ok(bytes),
    }
}

/// Renders faults of a table.
pub fn rendered(name: &str, text: &str, faults: &[Fault]) -> String {
    let mut diagnostics = Diagnostics::new();
    for fault in faults {
        let diagnostic = Diagnostic::error(Code::UnreadableTable, fault.span, &fault.message);
        diagnostics.push(diagnostic.help(&fault.help));
    }
    diagnostics.render(&Source::new(name, text))
}

/// Returns the time of each row (s).
fn times(
    name: &str,
    columns: &Columns,
    column: usize,
    scale: &Scale,
    reading: &Reading,
) -> Result<Vec<f64>, String> {
    let source = &columns.columns[column];
    let refused = |span: Span, message: String, help: &str| {
        let fault = Fault {
            span,
            message,
            help: help.to_string(),
        };
        rendered(name, &columns.text, &[fault])
    };
    if source.is_text {
        let message = format!("the cells of `{}` are words, not times", source.name);
        return Err(refused(
            source.span,
            message,
            &format!(
                "export times as numbers, such as seconds from the start, or name another column with `{}`",
                reading.names.time
            ),
        ));
    }
    let mut times: Vec<f64> = Vec::with_capacity(source.values.len());
    for (value, span) in source.values.iter().zip(&source.spans) {
        let Some(value) = value else {
            return Err(refused(
                *span,
                "a row without a time".to_string(),
                "leave out the row, or give it a time",
            ));
        };
        let t = scale.unit.si(*value) + reading.shift;
        if times.last().is_some_and(|last| t < *last) {
            return Err(refused(
                *span,
                "the time decreases".to_string(),
                &format!(
                    "sort the rows by time, or name another column with `{}`",
                    reading.names.time
                ),
            ));
        }
        times.push(t);
    }
    match times.is_empty() {
        true => Err(format!("error: `{name}` has no rows")),
        false => Ok(times),
    }
}

/// Returns the values of a column in SI units.
fn in_si(values: &[Option<f64>], scale: &Scale) -> Vec<Option<f64>> {
    let values = values.iter();
    values
        .map(|it| it.map(|value| scale.unit.si(value)))
        .collect()
}

/// Number of decimals of the values; `None` if they are not rounded.
fn decimals(values: &[Option<f64>]) -> Option<i32> {
    let filled = || values.iter().flatten();
    (0..=MOST_DECIMALS).find(|decimals| {
        let scale = 10.0_f64.powi(*decimals);
        filled().all(|it| (it * scale - (it * scale).round()).abs() <= ROUNDED * (it * scale).abs())
    })
}
