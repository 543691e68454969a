//! Writes the sets of a sweep as CSV: one row with extremes for each set, or one row for each instant.
//!
//! A row begins with the index of its set and the values of what is varied, and ends with the failure of the set, if it has one. A failed set
//! has no extremes; its instants end with a row of its failure.

use std::fmt::Write as _;
use std::io::{self, Write};

use linkwright::{Blocks as _, Failure};
use linkwright_solver::Interpreted;

use super::extremes::Extremes;
use super::run::Solved;
use super::shown::Quantity;
use super::varied::Varied;
use crate::output::{Beginning, Record, Signature};
use crate::report::comma_separated::cause;

/// Size of the buffer of a row, in bytes.
const ROW_BYTES: usize = 1 << 10;

/// Name of the first column.
const SET: &str = "set";

/// Names of the last columns.
const FAILURE: [&str; 3] = ["failure", "failure_block", "failure_t (s)"];

/// Endings of the columns of extremes, and true for those of times.
const EXTREMES: [(&str, bool); 4] = [
    ("_min", false),
    ("_min_t", true),
    ("_max", false),
    ("_max_t", true),
];

/// Signature of such a table.
pub const SIGNATURE: Signature = Signature {
    noun: "a table of sets that this command has written",
    beginning: Beginning::Line(|line| {
        let names = line.strip_prefix(SET).and_then(|it| it.strip_prefix(','));
        names.is_some_and(|it| it.ends_with(&FAILURE.join(",")))
    }),
    record: Record::Beside,
};

/// Writer of rows.
pub struct Table<'a> {
    varied: &'a [Varied],
    quantities: &'a [Quantity],
    times: &'a [f64],
    blocks: &'a Interpreted,
    /// True if a row is written for each instant.
    has_instants: bool,
    field: String,
}

impl<'a> Table<'a> {
    /// Creates the writer of these columns.
    pub fn new(
        varied: &'a [Varied],
        quantities: &'a [Quantity],
        times: &'a [f64],
        blocks: &'a Interpreted,
        has_instants: bool,
    ) -> Table<'a> {
        Table {
            varied,
            quantities,
            times,
            blocks,
            has_instants,
            field: String::new(),
        }
    }

    /// Returns the first line, with its line break.
    ///
    /// # Errors
    /// A name cannot be written.
    pub fn header(&self) -> io::Result<Vec<u8>> {
        let mut names = vec![SET.to_string()];
        names.extend(self.varied.iter().map(Varied::header));
        let mut columns: Vec<String> = Vec::new();
        if self.has_instants {
            columns.push("t (s)".to_string());
            columns.extend(self.quantities.iter().map(|it| it.header("")));
        } else {
            for quantity in self.quantities {
                columns.extend(EXTREMES.iter().map(|(ending, is_time)| match is_time {
                    true => format!("{}{ending} (s)", quantity.name),
                    false => quantity.header(ending),
                }));
            }
        }
        names.append(&mut columns);
        names.extend(FAILURE.map(String::from));
        let mut bytes = Vec::new();
        let mut writer = csv::Writer::from_writer(&mut bytes);
        writer.write_record(&names).map_err(cause)?;
        writer.flush()?;
        drop(writer);
        Ok(bytes)
    }

    /// Returns the extremes of each quantity, in its unit; `None` for a failed set, and for values that are not finite.
    pub fn extremes(&self, solved: &Solved<'_>) -> Vec<Option<Extremes>> {
        let width = self.quantities.len();
        let quantities = self.quantities.iter().enumerate();
        let extremes = quantities.map(|(place, quantity)| {
            if solved.outcome.failure.is_some() {
                return None;
            }
            let values = solved.values[place..].iter().step_by(width).copied();
            let Extremes { minimum, maximum } = Extremes::of(self.times, values)?;
            let in_unit = |[value, t]: [f64; 2]| [quantity.unit.of_si(value), t];
            Some(Extremes {
                minimum: in_unit(minimum),
                maximum: in_unit(maximum),
            })
        });
        extremes.collect()
    }

    /// Appends the rows of a set.
    ///
    /// # Errors
    /// Errors of `output`.
    pub fn write(
        &mut self,
        solved: &Solved<'_>,
        extremes: &[Option<Extremes>],
        output: &mut dyn Write,
    ) -> io::Result<()> {
        let mut writer = csv::WriterBuilder::new()
            .buffer_capacity(ROW_BYTES)
            .from_writer(output);
        let failure = solved.outcome.failure;
        if self.has_instants {
            let rows = solved.values.chunks_exact(self.quantities.len());
            let rows = self.times.iter().zip(rows).take(solved.outcome.solved);
            for (t, row) in rows {
                self.begin(solved, &mut writer)?;
                self.number(Some(*t), &mut writer)?;
                for (value, quantity) in row.iter().zip(self.quantities) {
                    let value = Some(quantity.unit.of_si(*value)).filter(|it| it.is_finite());
                    self.number(value, &mut writer)?;
                }
                self.end(None, &mut writer)?;
            }
            if failure.is_some() {
                self.begin(solved, &mut writer)?;
                for _ in 0..=self.quantities.len() {
                    self.number(None, &mut writer)?;
                }
                self.end(failure, &mut writer)?;
            }
        } else {
            self.begin(solved, &mut writer)?;
            for extremes in extremes {
                let pairs = extremes.map(|it| [it.minimum, it.maximum]);
                for place in 0..EXTREMES.len() {
                    let value = pairs.map(|it| it[place / 2][place % 2]);
                    self.number(value, &mut writer)?;
                }
            }
            self.end(failure, &mut writer)?;
        }
        writer.flush()
    }

    fn begin<W: Write>(
        &mut self,
        solved: &Solved<'_>,
        writer: &mut csv::Writer<W>,
    ) -> io::Result<()> {
        self.field.clear();
        let _ = write!(self.field, "{}", solved.set);
        writer.write_field(&self.field).map_err(cause)?;
        for (varied, given) in self.varied.iter().zip(solved.given) {
            self.number(Some(varied.written(*given)), writer)?;
        }
        Ok(())
    }

    /// Writes the shortest text that restores a number exactly, or an empty cell.
    fn number<W: Write>(
        &mut self,
        value: Option<f64>,
        writer: &mut csv::Writer<W>,
    ) -> io::Result<()> {
        self.field.clear();
        if let Some(value) = value {
            let _ = write!(self.field, "{value:?}");
        }
        writer.write_field(&self.field).map_err(cause)
    }

    fn end<W: Write>(
        &mut self,
        failure: Option<Failure>,
        writer: &mut csv::Writer<W>,
    ) -> io::Result<()> {
        match failure {
            None => {
                for _ in FAILURE {
                    writer.write_field("").map_err(cause)?;
                }
            }
            Some(failure) => {
                let explained = self.blocks.explained(&failure);
                let block = explained.block.map_or("", |it| it.name);
                writer.write_field(words(&failure)).map_err(cause)?;
                writer.write_field(block).map_err(cause)?;
                self.number(Some(failure.time), writer)?;
            }
        }
        writer.write_record(None::<&[u8]>).map_err(cause)
    }
}

/// Words for the kind of a failure.
pub fn words(failure: &Failure) -> &'static str {
    match failure.input {
        Some(_) => "an input is not finite",
        None => failure.kind.words(),
    }
}
