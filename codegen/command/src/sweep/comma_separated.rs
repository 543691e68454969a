//! Writes rows as CSV, each number with the fewest digits that restore it exactly.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::cells::Cells;
use linkwright_page::comma_separated::cause;

/// Size of the buffer of a row, in bytes.
const ROW_BYTES: usize = 1 << 10;

/// Writer of rows.
pub struct CsvCells<W: Write> {
    writer: csv::Writer<W>,
    field: String,
}

impl<W: Write> CsvCells<W> {
    /// Creates a writer.
    pub fn new(output: W) -> CsvCells<W> {
        CsvCells {
            writer: csv::WriterBuilder::new()
                .buffer_capacity(ROW_BYTES)
                .from_writer(output),
            field: String::new(),
        }
    }

    /// Writes what is buffered.
    ///
    /// # Errors
    /// Errors of the output.
    pub fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl<W: Write> Cells for CsvCells<W> {
    fn whole(&mut self, value: u64) -> io::Result<()> {
        self.field.clear();
        let _ = write!(self.field, "{value}");
        self.writer.write_field(&self.field).map_err(cause)
    }

    fn number(&mut self, value: Option<f64>) -> io::Result<()> {
        self.field.clear();
        if let Some(value) = value {
            let _ = write!(self.field, "{value:?}");
        }
        self.writer.write_field(&self.field).map_err(cause)
    }

    fn words(&mut self, words: &str) -> io::Result<()> {
        self.writer.write_field(words).map_err(cause)
    }

    fn end(&mut self) -> io::Result<()> {
        self.writer.write_record(None::<&[u8]>).map_err(cause)
    }
}
