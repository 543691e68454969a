//! Arranges pieces in lines, with indentation and blank lines.

use std::ops::Range;

use super::pieces::{Piece, What};

/// Statements with statements in their braces.
const HOLDING: [&str; 3] = ["mechanism", "motion", "repeat"];

/// Indentation of nested statements, in blanks.
const STEP: usize = 4;

/// One line.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub pieces: Range<usize>,
    /// Index of the first piece of the statement to which the row's first piece belongs.
    pub statement: usize,
    /// True if the row continues a statement.
    pub goes_on: bool,
    /// Indentation, in blanks.
    pub indent: usize,
    pub blank_before: bool,
}

/// A bracket that is open.
struct Opened {
    /// True if the bracket contains statements.
    holds_statements: bool,
    /// Row of the bracket.
    row: usize,
}

struct Walk<'a> {
    pieces: &'a [Piece<'a>],
    rows: Vec<Row>,
    open: Vec<Opened>,
    /// First piece of the current statement, and the number of brackets open there; `None` between statements.
    statement: Option<(usize, usize)>,
    /// True if the last row contains more than comments.
    has_words: bool,
    /// True directly after opening braces that contain statements.
    just_opened: bool,
}

/// Returns the lines of a text.
pub(super) fn rows(pieces: &[Piece<'_>]) -> Vec<Row> {
    let mut walk = Walk {
        pieces,
        rows: Vec::new(),
        open: Vec::new(),
        statement: None,
        has_words: false,
        just_opened: false,
    };
    for (index, piece) in pieces.iter().enumerate() {
        walk.place(index);
        if !piece.is_comment() {
            walk.read(index);
        }
    }
    walk.rows
}

impl Walk<'_> {
    /// Adds a piece to the last row or to a new one.
    fn place(&mut self, index: usize) {
        let piece = &self.pieces[index];
        let closes_statements = self.closes_statements(piece);
        let is_empty_braces = closes_statements && index > 0 && {
            matches!(self.pieces[index - 1].what, What::Open(_))
        };
        let starts = self.statement.is_none() && !piece.is_comment() && self.has_words;
        let is_new = match self.rows.is_empty() {
            true => true,
            false if is_empty_braces => false,
            false => piece.breaks > 0 || starts,
        };
        if !is_new {
            if let Some(row) = self.rows.last_mut() {
                row.pieces.end = index + 1;
            }
            self.has_words |= !piece.is_comment();
            return;
        }
        let is_first_inside = self.just_opened || closes_statements;
        let indent = self.indent(piece);
        self.rows.push(Row {
            pieces: index..index + 1,
            statement: self.statement.map_or(index, |it| it.0),
            goes_on: self.statement.is_some(),
            indent,
            blank_before: piece.breaks > 1 && !self.rows.is_empty() && !is_first_inside,
        });
        self.has_words = !piece.is_comment();
        self.just_opened = false;
    }

    fn closes_statements(&self, piece: &Piece<'_>) -> bool {
        let closes = matches!(piece.what, What::Close(_));
        closes && self.open.last().is_some_and(|it| it.holds_statements)
    }

    /// Returns the indentation of a row that starts with this piece.
    fn indent(&self, piece: &Piece<'_>) -> usize {
        let around = self.open.iter().filter(|it| it.holds_statements).count();
        let Some((_, depth)) = self.statement else {
            let around = around - usize::from(self.closes_statements(piece));
            return STEP * around;
        };
        match self.open.last() {
            Some(opened) if self.open.len() > depth => {
                let outside = self.rows[opened.row].indent;
                let inside = usize::from(!matches!(piece.what, What::Close(_)));
                outside + STEP * inside
            }
            _ => STEP * (around + 1),
        }
    }

    /// Updates the current statement.
    fn read(&mut self, index: usize) {
        let piece = &self.pieces[index];
        let row = self.rows.len().saturating_sub(1);
        if self.closes_statements(piece) {
            self.open.pop();
            self.statement = None;
            return;
        }
        let (first, depth) = *self.statement.get_or_insert((index, self.open.len()));
        match piece.what {
            What::Open(bracket) => {
                let word = &self.pieces[first];
                let is_outer = self.open.len() == depth;
                let holds_statements =
                    bracket == b'{' && is_outer && HOLDING.iter().any(|it| word.is_word(it));
                self.open.push(Opened {
                    holds_statements,
                    row,
                });
                if holds_statements {
                    (self.statement, self.just_opened) = (None, true);
                }
            }
            What::Close(bracket) => {
                self.open.pop();
                let ends_body = bracket == b'}'
                    && self.open.len() == depth
                    && self.pieces[first].is_word("body");
                let mut after = self.pieces[index + 1..].iter();
                let next = after.find(|it| !it.is_comment());
                if ends_body && next.is_none_or(|it| it.what != What::Mark(b';')) {
                    self.statement = None;
                }
            }
            What::Mark(b';') if self.open.len() == depth => self.statement = None,
            _ => {}
        }
    }
}
