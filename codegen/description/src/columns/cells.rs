//! Splits a text into lines of cells.
//!
//! A quoted cell may contain separators, doubled quotes and line breaks. `#` begins a comment; at the beginning of a line, so
//! do `%`, `!`, `//` and `*`. All line endings are accepted. Empty lines are skipped.

use std::borrow::Cow;

use super::{Delimiter, Fault};
use crate::diagnostic::Span;

/// Signs that begin a comment line.
const COMMENTS: [&str; 5] = ["#", "%", "//", "!", "*"];

/// Error values of spreadsheets, which begin with the sign of a comment.
const ERRORS: [&str; 7] = [
    "#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!",
];

/// First line with which a file announces its separator to a spreadsheet.
pub(super) const ANNOUNCEMENT: &str = "sep=";

/// A cell without surrounding spaces.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cell<'a> {
    pub text: Cow<'a, str>,
    pub span: Span,
}

/// A line that is not empty.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Line<'a> {
    /// Line number, counted from 1.
    pub number: usize,
    pub cells: Vec<Cell<'a>>,
    /// True if the cells are those of a comment.
    pub is_comment: bool,
}

impl Line<'_> {
    /// Location from the first cell to the last.
    pub fn span(&self) -> Span {
        match (self.cells.first(), self.cells.last()) {
            (Some(first), Some(last)) => first.span.to(last.span),
            _ => Span::default(),
        }
    }
}

/// Iterator over the lines of a text.
pub(super) struct Cells<'a> {
    text: &'a str,
    at: usize,
    number: usize,
    delimiter: Delimiter,
}

impl<'a> Cells<'a> {
    pub fn new(text: &'a str, delimiter: Delimiter) -> Cells<'a> {
        Cells {
            text,
            at: 0,
            number: 0,
            delimiter,
        }
    }

    /// Skips the line ending.
    fn end_line(&mut self) {
        self.number += 1;
        let rest = &self.text.as_bytes()[self.at..];
        self.at += match rest {
            [b'\r', b'\n', ..] => 2,
            [_, ..] => 1,
            [] => 0,
        };
    }

    fn end_of_line(&self) -> usize {
        let rest = &self.text[self.at..];
        self.at + rest.find(['\r', '\n']).unwrap_or(rest.len())
    }

    fn is_space(&self, character: char) -> bool {
        let is_space = character.is_whitespace() || character == '\u{feff}';
        is_space
            && !matches!(character, '\r' | '\n')
            && !(character == '\t' && self.delimiter == Delimiter::Tab)
    }

    fn skip_spaces(&mut self) {
        let rest = &self.text[self.at..];
        let spaces = rest.find(|it| !self.is_space(it)).unwrap_or(rest.len());
        self.at += spaces;
    }

    /// Returns the remaining cells of a line and moves to the next line.
    fn cells(&mut self) -> Result<Vec<Cell<'a>>, Fault> {
        let mut cells = Vec::new();
        loop {
            self.skip_spaces();
            let rest = &self.text[self.at..];
            let cell = match rest.starts_with('"') {
                true => self.quoted()?,
                false => self.plain(),
            };
            cells.push(cell);
            self.skip_spaces();
            let rest = &self.text[self.at..];
            let next = rest.chars().next();
            match next {
                None | Some('\r' | '\n') => break,
                Some('#') => {
                    self.at = self.end_of_line();
                    break;
                }
                Some(it) if Some(it) == self.delimiter.character() => self.at += it.len_utf8(),
                Some(_) if self.delimiter == Delimiter::Spaces => {}
                Some(_) => {
                    let end = self.end_of_line();
                    return Err(Fault::new(
                        Span::new(self.at, end),
                        "text after a closing quote",
                        "write a quote inside of quotes twice: `\"\"`",
                    ));
                }
            }
        }
        Ok(cells)
    }

    fn plain(&mut self) -> Cell<'a> {
        let start = self.at;
        let rest = &self.text[start..];
        let separator = self.delimiter.character();
        let is_error = ERRORS.iter().any(|it| rest.starts_with(it));
        let ends = |(place, it): (usize, char)| match separator {
            _ if matches!(it, '\r' | '\n') => true,
            _ if it == '#' => !(is_error && place == 0),
            Some(separator) => it == separator,
            None => it.is_whitespace(),
        };
        let length = rest
            .char_indices()
            .find(|it| ends(*it))
            .map_or(rest.len(), |it| it.0);
        let text = rest[..length].trim_end();
        self.at += length;
        Cell {
            text: Cow::Borrowed(text),
            span: Span::new(start, start + text.len()),
        }
    }

    fn quoted(&mut self) -> Result<Cell<'a>, Fault> {
        let start = self.at;
        let inside = start + 1;
        let bytes = self.text.as_bytes();
        let mut end = inside;
        let mut lines = 0;
        loop {
            match bytes.get(end..) {
                Some([b'"', b'"', ..]) => end += 2,
                Some([b'"', ..]) => break,
                Some([byte, ..]) => {
                    lines += usize::from(*byte == b'\n');
                    end += 1;
                }
                _ => {
                    return Err(Fault::new(
                        Span::new(start, start + 1),
                        "a quote that is never closed",
                        "close it, or leave it out",
                    ));
                }
            }
        }
        self.number += lines;
        self.at = end + 1;
        let text = &self.text[inside..end];
        let text = match text.contains("\"\"") {
            true => Cow::Owned(text.replace("\"\"", "\"").trim().to_string()),
            false => Cow::Borrowed(text.trim()),
        };
        Ok(Cell {
            text,
            span: Span::new(start, end + 1),
        })
    }
}

impl<'a> Iterator for Cells<'a> {
    type Item = Result<Line<'a>, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            self.skip_spaces();
            let rest = &self.text[self.at..];
            match rest.as_bytes().first() {
                None => return None,
                Some(b'\r' | b'\n') => {
                    self.end_line();
                    continue;
                }
                Some(_) => {}
            }
            if self.at == 0 && rest.starts_with(ANNOUNCEMENT) {
                self.at = self.end_of_line();
                continue;
            }
            let number = self.number + 1;
            let sign = COMMENTS.iter().find(|it| rest.starts_with(**it));
            let sign = sign.filter(|_| !ERRORS.iter().any(|it| rest.starts_with(it)));
            if let Some(sign) = sign {
                self.at += sign.len();
                let end = self.end_of_line();
                // The text of a comment need not be cells.
                let mut comment_cells = Cells::new(&self.text[..end], self.delimiter);
                comment_cells.at = self.at;
                let cells = comment_cells.cells().unwrap_or_default();
                self.at = end;
                return Some(Ok(Line {
                    number,
                    cells,
                    is_comment: true,
                }));
            }
            return Some(self.cells().map(|cells| Line {
                number,
                cells,
                is_comment: false,
            }));
        }
    }
}
