//! Reads tables of measured values as the command does.

use std::path::Path;

use linkwright_codegen::stages::columns::{Decimal, Delimiter, Known};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::data::{ArgumentNames, Data, How, Reading, bytes};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

use crate::findings::refused;

/// Arguments of `compare` and `calibrate` in Python.
const NAMES: ArgumentNames = ArgumentNames {
    column: "columns",
    quantity: "columns={\"COLUMN\": \"QUANTITY\"}",
    unit: "units",
    skip: "skip",
    time: "time",
};

/// Table with its reading.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Table {
    /// Path of the file, or name of the contents in messages.
    name: String,
    /// Contents; `None` to read the file.
    contents: Option<Vec<u8>>,
    columns: Vec<String>,
    skip: Vec<String>,
    time: Option<String>,
    shift: f64,
    units: Vec<String>,
    delimiter: Option<char>,
    decimal: Option<char>,
}

impl Table {
    /// Reads the columns that measure quantities of a motion.
    ///
    /// # Errors
    /// The file cannot be read, it is not a table, or an argument cannot be used.
    pub fn read(self, derived: &Derived) -> PyResult<Data> {
        let reading = Reading {
            column: self.columns,
            skip: self.skip,
            time: self.time,
            needs_times: true,
            shift: self.shift,
            unit: self.units,
            dialect: Known {
                delimiter: self.delimiter.map(delimiter).transpose()?,
                decimal: self.decimal.map(decimal).transpose()?,
                may_be_single: false,
            },
            names: NAMES,
        };
        let contents = match self.contents {
            Some(contents) => contents,
            None => bytes(Path::new(&self.name)).map_err(unread)?,
        };
        let Derived { pool, system } = derived;
        Data::read(&self.name, &contents, &reading, pool, system).map_err(refused)
    }
}

fn delimiter(sign: char) -> PyResult<Delimiter> {
    match sign {
        ',' => Ok(Delimiter::Comma),
        ';' => Ok(Delimiter::Semicolon),
        '\t' => Ok(Delimiter::Tab),
        '|' => Ok(Delimiter::Bar),
        ' ' => Ok(Delimiter::Spaces),
        _ => Err(refused(format!(
            "expected a delimiter of `,;|`, a tab or a space, found `{sign}`"
        ))),
    }
}

fn decimal(sign: char) -> PyResult<Decimal> {
    match sign {
        '.' => Ok(Decimal::Point),
        ',' => Ok(Decimal::Comma),
        _ => Err(refused(format!(
            "expected the decimal mark `.` or `,`, found `{sign}`"
        ))),
    }
}

fn unread(text: String) -> PyErr {
    PyOSError::new_err(text.trim_start_matches("error: ").to_string())
}

/// Notes on the reading of a table.
#[derive(Debug, IntoPyObject)]
pub struct Notes {
    /// Names of columns that are left out, each with the reason.
    left_out: Vec<(String, String)>,
    /// Names of columns whose quantity is one of several guesses, with the quantity and the others in words.
    guesses: Vec<(String, String, String)>,
}

impl Notes {
    /// Returns the notes on these data.
    pub fn of(data: &Data) -> Notes {
        let guesses = data.measured.iter().filter_map(|it| match &it.how {
            How::Guessed(doubt) if !doubt.is_empty() => {
                Some((it.name.clone(), it.quantity.name.clone(), doubt.clone()))
            }
            _ => None,
        });
        Notes {
            left_out: data.left_out.clone(),
            guesses: guesses.collect(),
        }
    }
}
