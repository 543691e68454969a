//! Defines what the cells of a table are, whatever its file format.

use std::io;

/// Column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name without a unit.
    pub name: String,
    /// Name of its unit; empty for plain numbers and words.
    pub unit: String,
    /// Kind of its cells.
    pub kind: Kind,
}

/// Kind of the cells of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Whole number, never empty.
    Whole,
    /// Number, never empty.
    Number,
    /// Number or nothing.
    NumberOrNone,
    /// Words or nothing.
    Words,
}

/// Receiver of rows, cell by cell in the order of the columns.
pub trait Cells {
    /// Takes a whole number.
    ///
    /// # Errors
    /// Errors of the output.
    fn whole(&mut self, value: u64) -> io::Result<()>;

    /// Takes a number, or nothing.
    ///
    /// # Errors
    /// Errors of the output.
    fn number(&mut self, value: Option<f64>) -> io::Result<()>;

    /// Takes words; nothing if they are empty.
    ///
    /// # Errors
    /// Errors of the output.
    fn words(&mut self, words: &str) -> io::Result<()>;

    /// Ends a row.
    ///
    /// # Errors
    /// Errors of the output.
    fn end(&mut self) -> io::Result<()>;
}
