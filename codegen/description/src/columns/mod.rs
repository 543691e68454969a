//! *The bytes of a file* → *its columns of numbers, each with a name and perhaps a unit*, or *what is wrong in which line and column*.
//!
//! Files are those that programs export: cells between commas, semicolons, tabs, bars or spaces; decimal points or commas; UTF-8, UTF-16
//! or Windows-1252; quotes, comments, missing cells, lines before the header, a line of units below it. What separates cells is
//! chosen so that everything below the header is a number; [`Columns::reading`] says what was chosen. Nothing is repaired: what
//! is neither a number nor missing is a [`Fault`]. Deliberately unknown here: mechanisms, and what a column is wanted for.

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

/// The largest file that is read, in bytes.
pub const LARGEST: usize = 256 << 20;

/// Nobody reads more faults of one file than these.
const MOST_FAULTS: usize = 10;

/// What is known about a file beforehand; what is not is found out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Known {
    /// What separates cells.
    pub delimiter: Option<Delimiter>,
    /// What separates decimals.
    pub decimal: Option<Decimal>,
}

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    /// The text of the file, which all places are in.
    pub text: String,
    /// How it was encoded.
    pub encoding: Encoding,
    /// What separates cells and decimals.
    pub dialect: Dialect,
    /// Where the names stand.
    pub header: Header,
    /// The number of the line of units, where there is one.
    pub unit_line: Option<usize>,
    /// How many lines with text stand before the names.
    pub skipped: usize,
    /// In the order of the file.
    pub columns: Vec<Column>,
    /// How many rows there are.
    pub rows: usize,
    /// The number of the line of each row, counted from 1.
    pub lines: Vec<usize>,
}

/// One column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name in the header without its unit; the number of the column, from 1, where there is none.
    pub name: String,
    /// The unit as written.
    pub unit: Option<String>,
    /// Where the name stands; of a column without one, its first cell.
    pub span: Span,
    /// The number in each row; `None` where it is missing.
    pub values: Vec<Option<f64>>,
    /// Where each cell stands.
    pub spans: Vec<Span>,
    /// Whether its cells are words, which are not kept.
    pub is_text: bool,
}

/// What is wrong at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Where.
    pub span: Span,
    /// What is wrong: lower case, without a full stop.
    pub message: String,
    /// What to do about it.
    pub help: String,
}

/// A file that is no table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// The text that the places are in.
    pub text: String,
    /// At least one.
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
    /// The table in a file.
    ///
    /// # Errors
    /// The first places at which it is none.
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

    /// How the file was understood, in words.
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
            1 => "; one line before them is no part of the table".to_string(),
            count => format!("; {count} lines before them are no part of the table"),
        };
        let (encoding, dialect) = (self.encoding.name(), self.dialect);
        format!("{encoding}, {dialect}, {names}{units}{skipped}")
    }

    /// The columns of this name.
    pub fn named(&self, name: &str) -> impl Iterator<Item = usize> {
        let places = self.columns.iter().enumerate();
        places
            .filter(move |(_, it)| it.name == name)
            .map(|(place, _)| place)
    }

    /// The text of a cell's number as the language of descriptions writes it: with a point before decimals.
    pub fn written(&self, span: Span) -> Option<String> {
        let cell = self.text.get(span.range())?;
        match content(cell, self.dialect.decimal) {
            Content::Number(written, _) => Some(written),
            _ => None,
        }
    }
}

/// The table in a text, whose text is left empty.
fn table(text: &str, known: Known) -> Result<Columns, Vec<Fault>> {
    let dialect = match dialect::of(text, known) {
        Ok(dialect) => dialect,
        // Most files with a fault have several.
        Err((fault, Some(dialect))) => {
            let faults = in_dialect(text, dialect).err();
            return Err(faults.unwrap_or_else(|| vec![fault]));
        }
        Err((fault, None)) => return Err(vec![fault]),
    };
    in_dialect(text, dialect)
}

/// The same where it is known what separates cells and decimals.
fn in_dialect(text: &str, dialect: Dialect) -> Result<Columns, Vec<Fault>> {
    let lines = Cells::new(text, dialect.delimiter);
    let mut head: Vec<Line<'_>> = Vec::new();
    let mut begun: Option<Columns> = None;
    let mut faults = Vec::new();
    for line in lines {
        let line = line.map_err(|fault| vec![fault])?;
        let Some(columns) = &mut begun else {
            let is_data = dialect::is_data(&line, dialect.decimal);
            head.push(line);
            if is_data {
                let found = beginning(&head, dialect).map_err(|fault| vec![fault])?;
                let mut columns = found.columns(dialect);
                if let Some(first) = head.last() {
                    take(&mut columns, first, &mut faults);
                }
                begun = Some(columns);
            }
            continue;
        };
        take(columns, &line, &mut faults);
        if faults.len() >= MOST_FAULTS {
            break;
        }
    }
    let Some(mut columns) = begun else {
        return Err(vec![dialect::no_rows(text)]);
    };
    if !faults.is_empty() {
        return Err(faults);
    }
    // What ends every line is no column.
    let is_nothing = |it: &Column| {
        !it.is_text && it.values.iter().all(Option::is_none) && it.span.start == it.span.end
    };
    while columns.columns.len() > 1 && columns.columns.last().is_some_and(is_nothing) {
        columns.columns.pop();
    }
    Ok(columns)
}

/// Adds a row.
fn take(columns: &mut Columns, line: &Line<'_>, faults: &mut Vec<Fault>) {
    if line.is_comment {
        return;
    }
    let wanted = columns.columns.len();
    if line.cells.len() != wanted {
        faults.push(dialect::wrong_length(line, wanted));
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
