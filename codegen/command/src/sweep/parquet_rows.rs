//! Writes rows as Parquet, in row groups of bounded size.
//!
//! Columns have their names without units, which are in the metadata of the file. After each row group, the file is given an end that the next
//! one overwrites, so that an interrupted run leaves a file of the row groups before.

use std::collections::HashMap;
use std::io::{self, Write};
use std::mem;
use std::sync::Arc;

use parquet::basic::{Encoding, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::{FileMetaData, KeyValue, ParquetMetaData, ParquetMetaDataWriter};
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type};

use super::cells::{Cells, Column, Kind};
use crate::output::{Beginning, Record, Signature};

/// Number of cells of a row group: 8 MiB.
const GROUP_CELLS: usize = 1 << 20;

/// Largest list of distinct values of a column, in bytes. Columns with more values have no such list.
const DISTINCT_BYTES: usize = 1 << 16;

/// First bytes of every Parquet file.
const MAGIC: &[u8] = b"PAR1";

/// Bytes behind them, which readers skip.
const MARK: &[u8] = b"linkwright sweep";

/// Key of the units in the metadata of the file.
const UNITS: &str = "units";

/// Signature of such a table.
pub const PARQUET_SIGNATURE: Signature = Signature {
    noun: "a table of sets that this command has written",
    beginning: Beginning::Bytes(|start| {
        let rest = start.strip_prefix(MAGIC);
        rest.is_some_and(|it| it.starts_with(MARK))
    }),
    record: Record::Beside,
};

/// Writer of rows.
pub struct ParquetRows<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    /// Writes an end to the output, which later bytes overwrite.
    end: fn(&mut W, &[u8]) -> io::Result<()>,
    columns: Vec<Values>,
    /// Column of the next cell.
    place: usize,
    /// Rows of the row group.
    rows: usize,
    /// Rows of a full row group.
    most: usize,
    /// Words that have occurred.
    words: HashMap<String, ByteArray>,
}

/// Cells of a column in the row group; a level is 0 for an empty cell, and otherwise 1.
enum Values {
    Whole(Vec<i64>),
    Number(Vec<f64>),
    NumberOrNone(Vec<f64>, Vec<i16>),
    Words(Vec<ByteArray>, Vec<i16>),
}

impl<W: Write + Send> ParquetRows<W> {
    /// Begins a table. `end` writes an end to the output, which later bytes overwrite.
    ///
    /// # Errors
    /// Errors of `output`.
    pub fn new(
        columns: &[Column],
        output: W,
        end: fn(&mut W, &[u8]) -> io::Result<()>,
    ) -> io::Result<ParquetRows<W>> {
        let most = GROUP_CELLS / columns.len().max(1);
        ParquetRows::with_groups(columns, output, end, most.max(1))
    }

    fn with_groups(
        columns: &[Column],
        output: W,
        end: fn(&mut W, &[u8]) -> io::Result<()>,
        most: usize,
    ) -> io::Result<ParquetRows<W>> {
        let names = distinct(columns);
        let mut fields = Vec::with_capacity(columns.len());
        let mut properties = WriterProperties::builder()
            .set_created_by(format!("linkwright version {}", env!("CARGO_PKG_VERSION")))
            .set_dictionary_page_size_limit(DISTINCT_BYTES)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_offset_index_disabled(true);
        for (column, name) in columns.iter().zip(&names) {
            fields.push(Arc::new(field(name, column.kind).map_err(cause)?));
            if column.kind == Kind::Whole {
                // Differences of indices take less than a bit.
                let path = ColumnPath::from(name.as_str());
                properties = properties
                    .set_column_dictionary_enabled(path.clone(), false)
                    .set_column_encoding(path, Encoding::DELTA_BINARY_PACKED);
            }
        }
        let units = columns.iter().zip(&names);
        let units = units.filter(|(column, _)| !column.unit.is_empty());
        let units: serde_json::Map<String, serde_json::Value> = units
            .map(|(column, name)| (name.clone(), column.unit.clone().into()))
            .collect();
        let units = serde_json::Value::Object(units).to_string();
        let units = KeyValue::new(UNITS.to_string(), units);
        let properties = properties.set_key_value_metadata(Some(vec![units])).build();
        let schema = Type::group_type_builder("sweep")
            .with_fields(fields)
            .build();
        let schema = Arc::new(schema.map_err(cause)?);
        let writer = SerializedFileWriter::new(output, schema, Arc::new(properties));
        let mut writer = writer.map_err(cause)?;
        writer.write_all(MARK)?;
        let mut rows = ParquetRows {
            writer,
            end,
            columns: columns.iter().map(|it| Values::new(it.kind)).collect(),
            place: 0,
            rows: 0,
            most,
            words: HashMap::new(),
        };
        rows.end_so_far()?;
        Ok(rows)
    }

    /// Ends the table.
    ///
    /// # Errors
    /// Errors of the output.
    pub fn finish(mut self) -> io::Result<()> {
        self.end_group()?;
        self.writer.close().map(drop).map_err(cause)
    }

    /// Writes the row group.
    fn end_group(&mut self) -> io::Result<()> {
        if self.rows == 0 {
            return Ok(());
        }
        let mut group = self.writer.next_row_group().map_err(cause)?;
        for column in &mut self.columns {
            column.write(&mut group).map_err(cause)?;
        }
        group.close().map_err(cause)?;
        self.rows = 0;
        self.end_so_far()
    }

    /// Writes the end of a file that has the row groups so far.
    fn end_so_far(&mut self) -> io::Result<()> {
        let groups = self.writer.flushed_row_groups().to_vec();
        let properties = self.writer.properties();
        let file = FileMetaData::new(
            properties.writer_version().as_num(),
            groups.iter().map(|it| it.num_rows()).sum(),
            Some(properties.created_by().to_string()),
            properties.key_value_metadata().cloned(),
            Arc::new(self.writer.schema_descr().clone()),
            None,
        );
        let metadata = ParquetMetaData::new(file, groups);
        let mut end = Vec::new();
        let written = ParquetMetaDataWriter::new(&mut end, &metadata).finish();
        written.map_err(cause)?;
        self.writer.flush()?;
        (self.end)(self.writer.inner_mut(), &end)
    }

    /// Returns the next column.
    fn next(&mut self) -> io::Result<&mut Values> {
        let column = self.columns.get_mut(self.place);
        self.place += 1;
        column.ok_or_else(misplaced)
    }
}

impl<W: Write + Send> Cells for ParquetRows<W> {
    fn whole(&mut self, value: u64) -> io::Result<()> {
        match self.next()? {
            Values::Whole(values) => values.push(value as i64),
            _ => return Err(misplaced()),
        }
        Ok(())
    }

    fn number(&mut self, value: Option<f64>) -> io::Result<()> {
        match (self.next()?, value) {
            (Values::Number(values), Some(value)) => values.push(value),
            (Values::NumberOrNone(values, levels), value) => {
                values.extend(value);
                levels.push(i16::from(value.is_some()));
            }
            _ => return Err(misplaced()),
        }
        Ok(())
    }

    fn words(&mut self, words: &str) -> io::Result<()> {
        let known = match (words, self.words.get(words)) {
            ("", _) => None,
            (_, Some(known)) => Some(known.clone()),
            (words, None) => {
                let new = ByteArray::from(words);
                self.words.insert(words.to_string(), new.clone());
                Some(new)
            }
        };
        match self.next()? {
            Values::Words(values, levels) => {
                levels.push(i16::from(known.is_some()));
                values.extend(known);
            }
            _ => return Err(misplaced()),
        }
        Ok(())
    }

    fn end(&mut self) -> io::Result<()> {
        if mem::take(&mut self.place) != self.columns.len() {
            return Err(misplaced());
        }
        self.rows += 1;
        match self.rows < self.most {
            true => Ok(()),
            false => self.end_group(),
        }
    }
}

impl Values {
    fn new(kind: Kind) -> Values {
        match kind {
            Kind::Whole => Values::Whole(Vec::new()),
            Kind::Number => Values::Number(Vec::new()),
            Kind::NumberOrNone => Values::NumberOrNone(Vec::new(), Vec::new()),
            Kind::Words => Values::Words(Vec::new(), Vec::new()),
        }
    }

    /// Writes the cells to a row group, and forgets them.
    fn write<W: Write + Send>(
        &mut self,
        group: &mut SerializedRowGroupWriter<'_, W>,
    ) -> Result<(), ParquetError> {
        let Some(mut column) = group.next_column()? else {
            return Ok(());
        };
        match self {
            Values::Whole(values) => {
                column
                    .typed::<Int64Type>()
                    .write_batch(values, None, None)?;
                values.clear();
            }
            Values::Number(values) => {
                column
                    .typed::<DoubleType>()
                    .write_batch(values, None, None)?;
                values.clear();
            }
            Values::NumberOrNone(values, levels) => {
                let column = column.typed::<DoubleType>();
                column.write_batch(values, Some(levels), None)?;
                values.clear();
                levels.clear();
            }
            Values::Words(values, levels) => {
                let column = column.typed::<ByteArrayType>();
                column.write_batch(values, Some(levels), None)?;
                values.clear();
                levels.clear();
            }
        }
        column.close()
    }
}

/// Returns the names of columns, with a number behind those that repeat others.
fn distinct(columns: &[Column]) -> Vec<String> {
    let mut taken: Vec<String> = Vec::with_capacity(columns.len());
    for column in columns {
        let mut name = column.name.clone();
        let mut number = 2;
        while taken.contains(&name) {
            name = format!("{}_{number}", column.name);
            number += 1;
        }
        taken.push(name);
    }
    taken
}

/// Returns the type of a column.
fn field(name: &str, kind: Kind) -> Result<Type, ParquetError> {
    let (physical, repetition, logical) = match kind {
        Kind::Whole => (Physical::INT64, Repetition::REQUIRED, None),
        Kind::Number => (Physical::DOUBLE, Repetition::REQUIRED, None),
        Kind::NumberOrNone => (Physical::DOUBLE, Repetition::OPTIONAL, None),
        Kind::Words => (
            Physical::BYTE_ARRAY,
            Repetition::OPTIONAL,
            Some(LogicalType::String),
        ),
    };
    Type::primitive_type_builder(name, physical)
        .with_repetition(repetition)
        .with_logical_type(logical)
        .build()
}

/// Returns an error of the output as it was, and others as such.
fn cause(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(error) => io::Error::other(error),
        },
        error => io::Error::other(error),
    }
}

/// Error of a cell that does not belong to its column.
fn misplaced() -> io::Error {
    io::Error::other("a cell does not belong to its column")
}

#[cfg(test)]
mod tests;
