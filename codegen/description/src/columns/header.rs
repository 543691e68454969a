//! Determines names and units of columns from the lines up to the first row.
//!
//! Names are in the line before the first row, or in the last comment before it. A line of units may be between them. Lines
//! above the names are not part of the table. A unit may also follow a name, in parentheses or brackets.

use super::cells::{Cell, Line};
use super::dialect::is_word;
use super::{Column, Columns, Dialect, Encoding, Fault, Unit};

/// Location of the names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Header {
    /// Line number, counted from 1.
    Line(usize),
    /// Number of a comment line, counted from 1.
    Comment(usize),
    /// No names.
    None,
}

/// Header of a table and its empty columns.
pub(super) struct Beginning {
    header: Header,
    unit_line: Option<usize>,
    skipped: usize,
    columns: Vec<Column>,
}

impl Beginning {
    /// Returns the table without rows.
    pub fn columns(&self, dialect: Dialect) -> Columns {
        Columns {
            text: String::new(),
            encoding: Encoding::Utf8,
            dialect,
            header: self.header,
            unit_line: self.unit_line,
            skipped: self.skipped,
            columns: self.columns.clone(),
            rows: 0,
            lines: Vec::new(),
        }
    }
}

/// Usual name of a column of times, which is also the unit of tonnes.
const TIME: &str = "t";

/// Brackets around units.
const BRACKETS: [[char; 2]; 3] = [['(', ')'], ['[', ']'], ['{', '}']];

/// Splits `x (mm)` into `x` and `mm`.
fn parted(name: &str) -> (String, Option<String>) {
    for [open, close] in BRACKETS {
        let parts = name.strip_suffix(close).and_then(|it| it.rsplit_once(open));
        if let Some((before, unit)) = parts
            && !before.trim().is_empty()
            && Unit::parse(unit).is_some()
        {
            return (before.trim().to_string(), Some(unit.trim().to_string()));
        }
    }
    // `x / mm` is the notation of ISO 80000-1.
    match name.split_once('/') {
        Some((before, unit)) if !before.trim().is_empty() && Unit::parse(unit).is_some() => {
            (before.trim().to_string(), Some(unit.trim().to_string()))
        }
        _ => (name.to_string(), None),
    }
}

/// Returns the unit if the cell contains nothing else.
fn alone(cell: &Cell<'_>) -> Option<String> {
    let text = cell.text.trim();
    let inner = BRACKETS
        .iter()
        .find_map(|[open, close]| text.strip_prefix(*open)?.strip_suffix(*close));
    let unit = inner.unwrap_or(text).trim();
    Unit::parse(unit).map(|_| unit.to_string())
}

/// True if a line contains only units. A bare `t` names a column of times; tonnes must be in brackets or beside a name.
fn are_units(line: &Line<'_>) -> bool {
    let mut filled = line
        .cells
        .iter()
        .filter(|it| !it.text.is_empty())
        .peekable();
    filled.peek().is_some() && filled.all(|it| it.text.trim() != TIME && alone(it).is_some())
}

/// Returns a fault for the first unit that contradicts the unit beside the name above it.
fn contradiction(names: &Line<'_>, units: &Line<'_>) -> Option<Fault> {
    let mut cells = names.cells.iter().zip(&units.cells);
    cells.find_map(|(name, cell)| {
        let (name, above) = parted(name.text.trim());
        let (above, below) = (above?, alone(cell)?);
        if Unit::parse(&above)?.is_same(&Unit::parse(&below)?) {
            return None;
        }
        Some(Fault::new(
            cell.span,
            format!("the column `{name}` is in {below} here, and in {above} beside its name"),
            "write the unit of a column once, or twice alike",
        ))
    })
}

/// Reads the header from lines of which the last is the first row.
pub(super) fn beginning(head: &[Line<'_>], dialect: Dialect) -> Result<Beginning, Fault> {
    let Some((first, above)) = head.split_last() else {
        return Ok(Beginning {
            header: Header::None,
            unit_line: None,
            skipped: 0,
            columns: Vec::new(),
        });
    };
    let width = first.cells.len();
    let suits = |line: &&Line<'_>| line.cells.len() == width;
    let plain: Vec<&Line<'_>> = above.iter().filter(|it| !it.is_comment).collect();
    let comment = above.iter().rev().find(|it| it.is_comment && suits(it));
    let (names, units, skipped) = match plain.as_slice() {
        [before @ .., names, units] if are_units(units) && suits(names) && suits(units) => {
            (Some(*names), Some(*units), before.len())
        }
        [before @ .., names] if suits(names) => (Some(*names), None, before.len()),
        [.., other] if comment.is_none_or(|it| it.number < other.number) => {
            let count = other.cells.len();
            let cells = if count == 1 { "cell" } else { "cells" };
            return Err(Fault::new(
                other.span(),
                format!(
                    "{count} {cells} above rows of {width}: the line before the first row names the columns"
                ),
                "name every column, or put `#` before this line",
            ));
        }
        others => (comment, None, others.len()),
    };
    let header = match names {
        Some(line) if line.is_comment => Header::Comment(line.number),
        Some(line) => Header::Line(line.number),
        None => Header::None,
    };
    if let Some(fault) = names
        .zip(units)
        .and_then(|lines| contradiction(lines.0, lines.1))
    {
        return Err(fault);
    }
    let columns = (0..width).map(|place| {
        let name = names.map(|line| &line.cells[place]);
        let unit_below = units.and_then(|line| alone(&line.cells[place]));
        let (text, unit) = name.map_or((String::new(), None), |it| parted(it.text.trim()));
        Column {
            name: match text.is_empty() {
                true => (place + 1).to_string(),
                false => text.split_whitespace().collect::<Vec<_>>().join(" "),
            },
            unit: unit_below.or(unit),
            span: name.map_or(first.cells[place].span, |it| it.span),
            values: Vec::new(),
            spans: Vec::new(),
            is_text: is_word(&first.cells[place], dialect.decimal),
        }
    });
    Ok(Beginning {
        header,
        unit_line: units.map(|line| line.number),
        skipped,
        columns: columns.collect(),
    })
}
