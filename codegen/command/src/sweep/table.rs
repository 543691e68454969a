//! Divides the sets of a sweep into rows: one with extremes for each set, or one for each instant.
//!
//! A row begins with the index of its set and the values of what is varied, and ends with the failure of the set, if it has one. A failed set
//! has no extremes; its instants end with a row of its failure.

use std::io;

use linkwright::{Blocks as _, Failure, FailureKind};
use linkwright_solver::Interpreted;
use linkwright_solver::sets::Extremes;

use super::cells::{Cells, Column, Kind};
use super::run::Solved;
use super::shown::Quantity;
use super::varied::{Varied, named};
use crate::output::{Beginning, Record, Signature};
use linkwright_page::comma_separated::cause;

/// Name of the first column.
const SET: &str = "set";

/// Unit of times.
const SECONDS: &str = "s";

/// Last columns: names, units and kinds.
const FAILURE: [(&str, &str, Kind); 4] = [
    ("failure", "", Kind::Words),
    ("failure_kind", "", Kind::Words),
    ("failure_block", "", Kind::Words),
    ("failure_t", SECONDS, Kind::NumberOrNone),
];

/// End of the first line of a table.
const LAST_NAMES: &str = ",failure,failure_kind,failure_block,failure_t (s)";

/// Endings of the columns of extremes, and true for those of times.
const EXTREMES: [(&str, bool); 4] = [
    ("_min", false),
    ("_min_t", true),
    ("_max", false),
    ("_max_t", true),
];

/// Signature of such a table as CSV.
pub const SIGNATURE: Signature = Signature {
    noun: "a table of sets that this command has written",
    beginning: Beginning::Line(|line| {
        let names = line.strip_prefix(SET).and_then(|it| it.strip_prefix(','));
        names.is_some_and(|it| it.ends_with(LAST_NAMES))
    }),
    record: Record::Beside,
};

/// Columns of a table, and what its rows follow from.
pub struct Table<'a> {
    varied: &'a [Varied],
    quantities: &'a [Quantity],
    times: &'a [f64],
    blocks: &'a Interpreted,
    /// True if a row is written for each instant.
    has_instants: bool,
}

impl<'a> Table<'a> {
    /// Creates the table of these quantities.
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
        }
    }

    /// Returns the columns in their order.
    pub fn columns(&self) -> Vec<Column> {
        let column = |name: String, unit: &str, kind| Column {
            name,
            unit: unit.to_string(),
            kind,
        };
        let mut columns = vec![column(SET.to_string(), "", Kind::Whole)];
        let varied = self.varied.iter();
        columns.extend(varied.map(|it| column(it.name.clone(), &it.unit, Kind::Number)));
        if self.has_instants {
            columns.push(column("t".to_string(), SECONDS, Kind::NumberOrNone));
        }
        for Quantity { name, unit, .. } in self.quantities {
            let of_quantity = |ending: &str, unit: &str| {
                column(format!("{name}{ending}"), unit, Kind::NumberOrNone)
            };
            match self.has_instants {
                true => columns.push(of_quantity("", &unit.name)),
                false => columns.extend(EXTREMES.iter().map(|(ending, is_time)| match is_time {
                    true => of_quantity(ending, SECONDS),
                    false => of_quantity(ending, &unit.name),
                })),
            }
        }
        let last = FAILURE.map(|(name, unit, kind)| column(name.to_string(), unit, kind));
        columns.extend(last);
        columns
    }

    /// Returns the first line of CSV, with its line break.
    ///
    /// # Errors
    /// A name cannot be written.
    pub fn header(&self) -> io::Result<Vec<u8>> {
        let columns = self.columns();
        let names = columns.iter().map(|it| named(&it.name, &it.unit));
        let mut bytes = Vec::new();
        let mut writer = csv::Writer::from_writer(&mut bytes);
        writer
            .write_record(names.map(String::into_bytes))
            .map_err(cause)?;
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

    /// Passes on the rows of a set.
    ///
    /// # Errors
    /// Errors of `cells`.
    pub fn write(
        &self,
        solved: &Solved<'_>,
        extremes: &[Option<Extremes>],
        cells: &mut dyn Cells,
    ) -> io::Result<()> {
        let failure = solved.outcome.failure;
        if self.has_instants {
            let rows = solved.values.chunks_exact(self.quantities.len());
            let rows = self.times.iter().zip(rows).take(solved.outcome.solved);
            for (t, row) in rows {
                self.begin(solved, cells)?;
                cells.number(Some(*t))?;
                for (value, quantity) in row.iter().zip(self.quantities) {
                    let value = Some(quantity.unit.of_si(*value)).filter(|it| it.is_finite());
                    cells.number(value)?;
                }
                self.end(None, cells)?;
            }
            if failure.is_some() {
                self.begin(solved, cells)?;
                for _ in 0..=self.quantities.len() {
                    cells.number(None)?;
                }
                self.end(failure, cells)?;
            }
        } else {
            self.begin(solved, cells)?;
            for extremes in extremes {
                let pairs = extremes.map(|it| [it.minimum, it.maximum]);
                for place in 0..EXTREMES.len() {
                    cells.number(pairs.map(|it| it[place / 2][place % 2]))?;
                }
            }
            self.end(failure, cells)?;
        }
        Ok(())
    }

    fn begin(&self, solved: &Solved<'_>, cells: &mut dyn Cells) -> io::Result<()> {
        cells.whole(solved.set)?;
        for (varied, given) in self.varied.iter().zip(solved.given) {
            cells.number(Some(varied.written(*given)))?;
        }
        Ok(())
    }

    fn end(&self, failure: Option<Failure>, cells: &mut dyn Cells) -> io::Result<()> {
        let (texts, t) = match &failure {
            None => ([""; 3], None),
            Some(failure) => {
                let block = self.blocks.explained(failure).block;
                let block = block.map_or("", |it| it.name);
                let texts = [words(failure), failure.kind.name(), block];
                (texts, Some(failure.time))
            }
        };
        for text in texts {
            cells.words(text)?;
        }
        cells.number(t)?;
        cells.end()
    }
}

/// Words for the kind of a failure.
pub fn words(failure: &Failure) -> &'static str {
    match (failure.input, failure.kind) {
        (Some(_), FailureKind::NotFinite) => "an input is not finite",
        _ => failure.kind.words(),
    }
}
