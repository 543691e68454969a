//! Reads columns of numbers, with names and units, from the bytes of a file.
//!
//! Files are exports of other programs. Cells stand between commas, semicolons, tabs, bars or spaces, with decimal points or
//! commas. The encoding is UTF-8, UTF-16 or Windows-1252. Quotes, comments, missing cells, lines before the header and a line
//! of units below it are accepted.
//!
//! The dialect is chosen so that all cells below the header are numbers; [`Columns::reading`] describes the choice. Nothing is
//! repaired: a cell that is neither a number nor missing is a [`Fault`].

mod cells;
mod dialect;
mod encoding;
mod header;
mod number;

pub use dialect::{Decimal, Delimiter, Dialect};
pub use encoding::Encoding;
pub use header::Header;

pub use crate::units::Unit;

use crate::diagnostic::Span;
use cells::{Cells, Line};
use header::beginning;
use number::{Content, content};

/// Size limit of a file, in bytes.
pub const MAX_BYTES: usize = 256 << 20;

/// Maximum number of faults reported for one file.
const MAX_FAULTS: usize = 10;

/// Dialect given by the caller; missing fields are detected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Known {
    /// Cell separator.
    pub delimiter: Option<Delimiter>,
    /// Decimal mark.
    pub decimal: Option<Decimal>,
    /// True if the table may have a single column.
    pub may_be_single: bool,
}

/// A table of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    /// Text of the file, to which all locations refer.
    pub text: String,
    /// Encoding of the file.
    pub encoding: Encoding,
    /// Cell separator and decimal mark.
    pub dialect: Dialect,
    /// Location of the names.
    pub header: Header,
    /// Line number of the units; `None` without a line of units.
    pub unit_line: Option<usize>,
    /// Number of text lines before the names.
    pub skipped: usize,
    /// Columns in the order of the file.
    pub columns: Vec<Column>,
    /// Number of rows.
    pub rows: usize,
    /// Line number of each row, counted from 1.
    pub lines: Vec<usize>,
}

/// One column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name in the header without its unit; without a name, the number of the column, counted from 1.
    pub name: String,
    /// Unit as written; `None` if there is none.
    pub unit: Option<String>,
    /// Location of the name; without one, of the first cell.
    pub span: Span,
    /// Number in each row; `None` if it is missing.
    pub values: Vec<Option<f64>>,
    /// Location of each cell.
    pub spans: Vec<Span>,
    /// True if the cells are words, which are not stored.
    pub is_text: bool,
}

/// A fault at a location of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Location of the fault.
    pub span: Span,
    /// Message in lower case, without a full stop.
    pub message: String,
    /// Suggested remedy.
    pub help: String,
}

/// Faults of a file that is not a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// Text to which the locations refer.
    pub text: String,
    /// Faults; at least one.
    pub faults: Vec<Fault>,
}

impl Fault {
    fn new(span: Span, message: impl Into<String>, help: impl Into<String>) -> Fault {
        Fault {
            span,
            message: message.into(),
            help: help.into(),
        }
    }
}

impl Columns {
    /// Reads the table of a file.
    ///
    /// # Errors
    /// Returns the first faults if the file is not a table.
    pub fn read(bytes: &[u8], known: Known) -> Result<Columns, Unreadable> {
        let (text, encoding) = encoding::decoded(bytes)?;
        match table(&text, known) {
            Ok(table) => Ok(Columns {
                text,
                encoding,
                ..table
            }),
            Err(faults) => Err(Unreadable { text, faults }),
        }
    }

    /// Describes the detected encoding, dialect and header.
    pub fn reading(&self) -> String {
        let names = match self.header {
            Header::Line(line) => format!("names in line {line}"),
            Header::Comment(line) => format!("names in the comment in line {line}"),
            Header::None => "no names, so that columns are called 1, 2, …".to_string(),
        };
        let units = match self.unit_line {
            Some(line) => format!(", units in line {line}"),
            None => String::new(),
        };
        let skipped = match self.skipped {
            0 => String::new(),
            1 => "; one line before them is not part of the table".to_string(),
            count => format!("; {count} lines before them are not part of the table"),
        };
        let (encoding, dialect) = (self.encoding.name(), self.dialect);
        format!("{encoding}, {dialect}, {names}{units}{skipped}")
    }

    /// Returns the indices of the columns with this name.
    pub fn named(&self, name: &str) -> impl Iterator<Item = usize> {
        let places = self.columns.iter().enumerate();
        places
            .filter(move |(_, it)| it.name == name)
            .map(|(place, _)| place)
    }

    /// Returns the text of a number with a decimal point, as descriptions write it; `None` if the cell is not a number.
    pub fn written(&self, span: Span) -> Option<String> {
        let cell = self.text.get(span.range())?;
        match content(cell, self.dialect.decimal) {
            Content::Number(written, _) => Some(written),
            _ => None,
        }
    }
}

/// Reads a table and leaves its `text` empty.
fn table(text: &str, known: Known) -> Result<Columns, Vec<Fault>> {
    let detected = match dialect::of(text, known) {
        Ok(detected) => detected,
        // Most files with a fault have several.
        Err((fault, Some(detected))) => {
            let faults = in_dialect(text, detected).err();
            return Err(faults.unwrap_or_else(|| vec![fault]));
        }
        Err((fault, None)) => return Err(vec![fault]),
    };
    in_dialect(text, detected)
}

fn in_dialect(text: &str, (dialect, least): dialect::Detected) -> Result<Columns, Vec<Fault>> {
    let lines = Cells::new(text, dialect.delimiter);
    let mut head: Vec<Line<'_>> = Vec::new();
    let mut begun: Option<Columns> = None;
    let mut faults = Vec::new();
    for line in lines {
        let line = line.map_err(|fault| vec![fault])?;
        let Some(columns) = &mut begun else {
            let is_data = dialect::is_data(&line, dialect.decimal, least);
            head.push(line);
            if is_data {
                let beginning_of_table = beginning(&head, dialect).map_err(|fault| vec![fault])?;
                let mut columns = beginning_of_table.columns(dialect);
                if let Some(first) = head.last() {
                    take(&mut columns, first, &mut faults);
                }
                begun = Some(columns);
            }
            continue;
        };
        take(columns, &line, &mut faults);
        if faults.len() >= MAX_FAULTS {
            break;
        }
    }
    let Some(mut columns) = begun else {
        return Err(vec![dialect::no_rows(text, least)]);
    };
    if !faults.is_empty() {
        return Err(faults);
    }
    // A separator at the end of every line begins no column.
    let is_nothing = |it: &Column| {
        !it.is_text && it.values.iter().all(Option::is_none) && it.span.start == it.span.end
    };
    while columns.columns.len() > 1 && columns.columns.last().is_some_and(is_nothing) {
        columns.columns.pop();
    }
    Ok(columns)
}

fn take(columns: &mut Columns, line: &Line<'_>, faults: &mut Vec<Fault>) {
    if line.is_comment {
        return;
    }
    let width = columns.columns.len();
    if line.cells.len() != width {
        faults.push(dialect::wrong_length(line, width));
        return;
    }
    let decimal = columns.dialect.decimal;
    let contents: Vec<Content> = line
        .cells
        .iter()
        .map(|it| content(&it.text, decimal))
        .collect();
    if contents.iter().all(|it| *it == Content::Missing) {
        return;
    }
    let cells = line.cells.iter().zip(contents);
    for (column, (cell, content)) in columns.columns.iter_mut().zip(cells) {
        let value = match content {
            _ if column.is_text => None,
            Content::Number(_, value) => Some(value),
            Content::Missing => None,
            Content::Words(why) => {
                faults.push(Fault::new(cell.span, why.message(&cell.text), why.help()));
                None
            }
        };
        column.values.push(value);
        column.spans.push(cell.span);
    }
    columns.rows += 1;
    columns.lines.push(line.number);
}
