//! *A table and a system* → *times, and what is measured of the motion at them*, in SI units.
//!
//! Afterwards times never go back, every measured column has a quantity and a unit, and it is known of each how it came to them: by its
//! name, by an option or by a guess. Columns that measure nothing known are listed. The module does not know what the values are for.

mod driving;
mod mapping;
mod scale;
mod sizes;

use std::path::Path;

use linkwright_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Source, Span};
use linkwright_codegen::stages::columns::{
    Columns, Decimal, Delimiter, Fault, Known, LARGEST, Unit,
};
use linkwright_codegen::stages::files;
use linkwright_codegen::stages::system::System;
use linkwright_solver::observable::Named;

use crate::arguments::{Mark, Separator, Table};
pub use driving::MeasuredInput;
pub use mapping::How;
pub use scale::{Origin, Scale};
pub use sizes::{number_and_unit, sizes};

/// The most decimals of a value that counts as rounded.
const MOST_DECIMALS: i32 = 12;

/// How far a number of so many decimals may be from a whole number of steps, as a share of it: the rounding of doubles.
const ROUNDED: f64 = 1e-15;

/// A table of measured values.
#[derive(Clone, Debug)]
pub struct Data {
    /// The file as it was named.
    pub name: String,
    /// What stands in it.
    pub columns: Columns,
    /// Which column holds times, and their unit.
    pub time: (usize, Scale),
    /// The time of each row (s).
    pub times: Vec<f64>,
    /// What is measured.
    pub measured: Vec<Measured>,
    /// What drives inputs.
    pub inputs: Vec<MeasuredInput>,
    /// The other columns, each with why it is left out.
    pub left_out: Vec<(String, String)>,
}

/// A column that measures something.
#[derive(Clone, Debug)]
pub struct Measured {
    /// What the table calls it.
    pub name: String,
    /// What it measures.
    pub quantity: Named,
    /// How that is known.
    pub how: How,
    /// Its unit.
    pub scale: Scale,
    /// Digits behind the decimal point, in the unit of the column, that write all its values; `None` if they are not rounded.
    pub decimals: Option<i32>,
    /// In SI units, row by row; `None` where it is missing.
    pub values: Vec<Option<f64>>,
}

impl Measured {
    /// The step in SI units to which the values are rounded in the table: the largest power of ten that all are multiples of.
    pub fn rounding(&self) -> Option<f64> {
        let decimals = self.decimals?;
        Some(self.scale.unit.si(10.0_f64.powi(-decimals)))
    }
}

impl Data {
    /// The table that is asked for.
    ///
    /// # Errors
    /// It cannot be read or is no table, an option cannot be used, or no column measures anything of the system; as it is printed.
    pub fn read(asked: &Table, system: &System) -> Result<Data, String> {
        let name = asked.data.display().to_string();
        let bytes = bytes(&asked.data)?;
        let known = Known {
            delimiter: asked.delimiter.map(|it| match it {
                Separator::Comma => Delimiter::Comma,
                Separator::Semicolon => Delimiter::Semicolon,
                Separator::Tab => Delimiter::Tab,
                Separator::Bar => Delimiter::Bar,
                Separator::Spaces => Delimiter::Spaces,
            }),
            decimal: asked.decimal.map(|it| match it {
                Mark::Point => Decimal::Point,
                Mark::Comma => Decimal::Comma,
            }),
        };
        let columns = Columns::read(&bytes, known)
            .map_err(|refused| rendered(&name, &refused.text, &refused.faults))?;
        let mapped = mapping::mapped(asked, &name, &columns, system)?;
        let units = scale::Units::read(asked, &name, &columns)?;
        let at = |column: usize, message: String, help: &str| {
            let fault = Fault {
                span: columns.columns[column].span,
                message,
                help: help.to_string(),
            };
            rendered(&name, &columns.text, &[fault])
        };
        let time_scale = units.of(&columns, mapped.time, [0, 1, 0, 0], "s");
        let time_scale = time_scale.map_err(|message| {
            at(
                mapped.time,
                message,
                "`--unit` says in which unit a column is, `--time` which column holds times",
            )
        })?;
        let times = times(&name, &columns, mapped.time, &time_scale, asked.shift)?;
        let mut measured = Vec::with_capacity(mapped.measured.len());
        for (column, quantity, how) in mapped.measured {
            let own = &columns.columns[column];
            let scale = units.of(&columns, column, quantity.powers, quantity.unit);
            let scale = scale.map_err(|message| {
                at(column, format!("{message}: it measures `{}`", quantity.name), "`--unit` says in which unit a column is, `--column` what it measures, and `--skip` leaves it out")
            })?;
            measured.push(Measured {
                values: in_si(&own.values, &scale),
                decimals: decimals(&own.values),
                name: own.name.clone(),
                quantity,
                how,
                scale,
            });
        }
        let mut inputs = Vec::with_capacity(mapped.inputs.len());
        for (column, input) in mapped.inputs {
            let own = &columns.columns[column];
            let dimension = system.mechanism.inputs[input].dimension;
            let written = own.unit.as_deref().and_then(Unit::parse);
            let powers = driving::powers(dimension, written.map(|it| it.powers));
            let scale = units.of(&columns, column, powers, &dimension.unit());
            let scale = scale.map_err(|message| {
                at(
                    column,
                    message,
                    "`--unit` says in which unit a column is, and `--skip` leaves it out",
                )
            })?;
            inputs.push(MeasuredInput {
                values: in_si(&own.values, &scale),
                name: own.name.clone(),
                input,
                scale,
            });
        }
        Ok(Data {
            inputs,
            time: (mapped.time, time_scale),
            left_out: mapped.left_out,
            name,
            columns,
            times,
            measured,
        })
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    let shown = path.display();
    let refused = |reason: String| format!("error: cannot read `{shown}`: {reason}");
    let bytes = files::read(path, LARGEST).map_err(|error| refused(files::reason(&error)))?;
    match bytes.len() > LARGEST {
        true => Err(refused(format!("it is larger than {} MiB", LARGEST >> 20))),
        false => Ok(bytes),
    }
}

/// Faults of a table as they are printed.
fn rendered(name: &str, text: &str, faults: &[Fault]) -> String {
    let mut found = Diagnostics::new();
    for fault in faults {
        let diagnostic = Diagnostic::error(Code::UnreadableTable, fault.span, &fault.message);
        found.push(diagnostic.help(&fault.help));
    }
    found.render(&Source::new(name, text))
}

/// The time of each row (s).
fn times(
    name: &str,
    columns: &Columns,
    column: usize,
    scale: &Scale,
    shift: f64,
) -> Result<Vec<f64>, String> {
    let own = &columns.columns[column];
    let refused = |span: Span, message: String, help: &str| {
        let fault = Fault {
            span,
            message,
            help: help.to_string(),
        };
        rendered(name, &columns.text, &[fault])
    };
    if own.is_text {
        let message = format!("the cells of `{}` are words, not times", own.name);
        return Err(refused(
            own.span,
            message,
            "export times as numbers, such as seconds from the start; `--time` names another column",
        ));
    }
    let mut times: Vec<f64> = Vec::with_capacity(own.values.len());
    for (value, span) in own.values.iter().zip(&own.spans) {
        let Some(value) = value else {
            return Err(refused(
                *span,
                "a row without a time".to_string(),
                "leave out the row, or give it a time",
            ));
        };
        let t = scale.unit.si(*value) + shift;
        if times.last().is_some_and(|last| t < *last) {
            return Err(refused(
                *span,
                "the time goes back".to_string(),
                "sort the rows by time; `--time` names another column",
            ));
        }
        times.push(t);
    }
    match times.is_empty() {
        true => Err(format!("error: `{name}` has no rows")),
        false => Ok(times),
    }
}

/// The values of a column in SI units.
fn in_si(values: &[Option<f64>], scale: &Scale) -> Vec<Option<f64>> {
    let values = values.iter();
    values
        .map(|it| it.map(|value| scale.unit.si(value)))
        .collect()
}

/// Decimals with which values are written, if all are rounded to them.
fn decimals(values: &[Option<f64>]) -> Option<i32> {
    let filled = || values.iter().flatten();
    (0..=MOST_DECIMALS).find(|decimals| {
        let scale = 10.0_f64.powi(*decimals);
        filled().all(|it| (it * scale - (it * scale).round()).abs() <= ROUNDED * (it * scale).abs())
    })
}
