//! Detects the cell separator and the decimal mark of a text.
//!
//! Every pair is tried: its lines must have equal length, with numbers as cells. If two pairs fit and read different numbers,
//! the file is ambiguous, which is a fault.

use std::fmt;

use super::cells::{ANNOUNCEMENT, Cell, Cells, Line};
use super::header::beginning;
use super::number::{Content, Why, content};
use super::{Fault, Known};
use crate::diagnostic::Span;

/// Number of lines that determine the dialect.
const LINES: usize = 200;

/// Cell separator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delimiter {
    /// Semicolon: `;`.
    Semicolon,
    /// Tab.
    Tab,
    /// Bar: `|`.
    Bar,
    /// Comma: `,`.
    Comma,
    /// Any number of spaces or tabs.
    Spaces,
}

/// Decimal mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decimal {
    /// Point: `0.5`.
    Point,
    /// Comma: `0,5`.
    Comma,
}

/// Cell separator and decimal mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dialect {
    /// Cell separator.
    pub delimiter: Delimiter,
    /// Decimal mark.
    pub decimal: Decimal,
}

impl Delimiter {
    const ALL: [Delimiter; 5] = [
        Delimiter::Semicolon,
        Delimiter::Tab,
        Delimiter::Bar,
        Delimiter::Comma,
        Delimiter::Spaces,
    ];

    /// Returns the separator; `None` for any number of spaces.
    pub fn character(self) -> Option<char> {
        match self {
            Delimiter::Semicolon => Some(';'),
            Delimiter::Tab => Some('\t'),
            Delimiter::Bar => Some('|'),
            Delimiter::Comma => Some(','),
            Delimiter::Spaces => None,
        }
    }
}

impl Decimal {
    /// Returns the character of the mark.
    pub fn mark(self) -> char {
        match self {
            Decimal::Point => '.',
            Decimal::Comma => ',',
        }
    }
}

impl fmt::Display for Dialect {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let delimiter = match self.delimiter {
            Delimiter::Semicolon => "`;`",
            Delimiter::Tab => "tabs",
            Delimiter::Bar => "`|`",
            Delimiter::Comma => "`,`",
            Delimiter::Spaces => "spaces",
        };
        let decimal = match self.decimal {
            Decimal::Point => "points",
            Decimal::Comma => "commas",
        };
        write!(formatter, "{delimiter} between cells, decimal {decimal}")
    }
}

/// True if a cell is a word rather than a malformed number.
pub(super) fn is_word(cell: &Cell<'_>, decimal: Decimal) -> bool {
    content(&cell.text, decimal) == Content::Words(Why::NoNumber)
}

/// True if a line is a row: at least `least` cells, one of them a number, and fewer words than other cells.
pub(super) fn is_data(line: &Line<'_>, decimal: Decimal, least: usize) -> bool {
    let words = line.cells.iter().filter(|it| is_word(it, decimal)).count();
    let missing = line
        .cells
        .iter()
        .filter(|it| content(&it.text, decimal) == Content::Missing);
    let missing = missing.count();
    let others = line.cells.len() - words;
    !line.is_comment && line.cells.len() >= least && others > missing && words < others
}

/// A dialect that fits, with the figures that rank it.
struct Suited {
    dialect: Dialect,
    /// Number of columns of words.
    words: usize,
    /// Line number of the first row.
    line: usize,
    /// Numbers of the first row.
    first: Vec<Option<f64>>,
}

/// A dialect that does not fit, with its first fault.
struct Unsuited {
    dialect: Dialect,
    cells: usize,
    fault: Fault,
}

/// Detects the dialect, and the smallest number of cells of a row: two, or one if no line has more and the table may be single. An error
/// has the first fault and the dialect that fits best, if any.
pub(super) fn of(text: &str, known: Known) -> Result<Detected, (Fault, Option<Detected>)> {
    match with_least(text, known, 2) {
        Err((_, None)) if known.may_be_single && !has_rows(text, known) => {
            with_least(text, known, 1)
        }
        found => found,
    }
}

/// Dialect, and the smallest number of cells of a row.
pub(super) type Detected = (Dialect, usize);

/// True if a line is a row of several cells in some dialect.
fn has_rows(text: &str, known: Known) -> bool {
    dialects(text, known).any(|dialect| {
        let mut lines = Cells::new(text, dialect.delimiter).take(LINES).flatten();
        lines.any(|line| is_data(&line, dialect.decimal, 2))
    })
}

/// Returns the dialects that options and the file allow.
fn dialects(text: &str, known: Known) -> impl Iterator<Item = Dialect> + use<> {
    let announced = text
        .strip_prefix(ANNOUNCEMENT)
        .and_then(|rest| rest.chars().next());
    let announced = Delimiter::ALL
        .into_iter()
        .find(|it| announced.is_some() && it.character() == announced);
    let delimiter = known.delimiter.or(announced);
    let delimiters = Delimiter::ALL
        .into_iter()
        .filter(move |it| delimiter.is_none_or(|known| known == *it));
    let decimals = |it| {
        [Decimal::Point, Decimal::Comma].map(|decimal| Dialect {
            delimiter: it,
            decimal,
        })
    };
    let dialects = delimiters.flat_map(decimals);
    dialects.filter(move |it| known.decimal.is_none_or(|known| known == it.decimal))
}

fn with_least(
    text: &str,
    known: Known,
    least: usize,
) -> Result<Detected, (Fault, Option<Detected>)> {
    let (mut suited, mut unsuited): (Vec<Suited>, Option<Unsuited>) = (Vec::new(), None);
    for dialect in dialects(text, known) {
        match suits(text, dialect, least) {
            Ok(found) => suited.push(found),
            Err(found)
                if unsuited
                    .as_ref()
                    .is_none_or(|best| best.cells < found.cells) =>
            {
                unsuited = Some(found)
            }
            Err(_) => {}
        }
    }
    // Names above rows contain no numbers, so an earlier first row fits better. Among equals, the first and most specific
    // separator wins.
    let key = |it: &Suited| (it.words, it.line);
    let Some(best) = (0..suited.len()).min_by_key(|&it| key(&suited[it])) else {
        return Err(unsuited.filter(|it| it.cells > 0).map_or_else(
            || (no_rows(text, least), None),
            |it| (it.fault, Some((it.dialect, least))),
        ));
    };
    let best = &suited[best];
    let rival = suited
        .iter()
        .find(|it| key(it) == key(best) && it.first != best.first);
    match rival {
        None => Ok((best.dialect, least)),
        Some(rival) => Err((
            Fault::new(
                Span::new(0, 0),
                format!(
                    "this can be read in two ways: {}, or {}",
                    best.dialect, rival.dialect
                ),
                "choose the delimiter and the decimal sign",
            ),
            None,
        )),
    }
}

fn suits(text: &str, dialect: Dialect, least: usize) -> Result<Suited, Unsuited> {
    let mut head = Vec::new();
    let (mut first, mut cells): (Option<Line<'_>>, usize) = (None, 0);
    let unsuited = |cells, fault| Unsuited {
        dialect,
        cells,
        fault,
    };
    for line in Cells::new(text, dialect.delimiter).take(LINES) {
        let line = line.map_err(|fault| unsuited(cells, fault))?;
        let Some(first) = &first else {
            if is_data(&line, dialect.decimal, least) {
                cells += line.cells.len();
                for cell in &line.cells {
                    if let Content::Words(why) = content(&cell.text, dialect.decimal)
                        && why != Why::NoNumber
                    {
                        let fault = Fault::new(cell.span, why.message(&cell.text), why.help());
                        return Err(unsuited(cells, fault));
                    }
                }
                first = Some(line.clone());
            }
            head.push(line);
            continue;
        };
        if line.is_comment {
            continue;
        }
        let width = first.cells.len();
        if line.cells.len() != width {
            return Err(unsuited(cells, wrong_length(&line, width)));
        }
        for (cell, above) in line.cells.iter().zip(&first.cells) {
            let is_text = is_word(above, dialect.decimal);
            match content(&cell.text, dialect.decimal) {
                Content::Words(why) if !is_text => {
                    let fault = Fault::new(cell.span, why.message(&cell.text), why.help());
                    return Err(unsuited(cells, fault));
                }
                Content::Number(..) => cells += 1,
                _ => {}
            }
        }
    }
    let Some(first) = first else {
        return Err(unsuited(0, no_rows(text, least)));
    };
    beginning(&head, dialect).map_err(|fault| unsuited(cells, fault))?;
    let contents = || {
        first
            .cells
            .iter()
            .map(|it| content(&it.text, dialect.decimal))
    };
    Ok(Suited {
        dialect,
        line: first.number,
        words: contents()
            .filter(|it| matches!(it, Content::Words(_)))
            .count(),
        first: contents()
            .map(|it| match it {
                Content::Number(_, value) => Some(value),
                _ => None,
            })
            .collect(),
    })
}

/// Returns the fault of a line with more or fewer cells than the first row.
pub(super) fn wrong_length(line: &Line<'_>, wanted: usize) -> Fault {
    let count = line.cells.len();
    let cells = if count == 1 { "cell" } else { "cells" };
    Fault::new(
        line.span(),
        format!("{count} {cells} where the lines above have {wanted}"),
        "complete the line, or make it a comment with `#`; decimal commas need another separator than `,`",
    )
}

/// Returns the fault of a text without a row of numbers.
pub(super) fn no_rows(text: &str, least: usize) -> Fault {
    let end = text.find(['\r', '\n']).unwrap_or(text.len());
    match text.trim().is_empty() {
        true => Fault::new(
            Span::new(0, 0),
            "the file is empty",
            "export the table again",
        ),
        false if least == 1 => Fault::new(
            Span::new(0, end),
            "no line of this file is a row of numbers",
            "a table has a line of names, and below it lines of numbers, for example `x,y` and `0.1,2.5`",
        ),
        false => Fault::new(
            Span::new(0, end),
            "no line of this file is a row of at least two numbers",
            "a table has a line of names, and below it lines of numbers, for example `t,x` and `0.1,2.5`",
        ),
    }
}
