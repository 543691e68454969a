//! Finds the unfinished statement at an offset and its open brackets.
//!
//! Only tokens are used, so that statements with errors are found as well.

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::{Kind, Lexeme};

use crate::description::Description;

/// Open bracket.
#[derive(Clone, Copy, Debug)]
pub struct Open {
    /// Bracket.
    pub bracket: u8,
    /// Index of the first lexeme of its statement; `None` if no statement has begun.
    pub statement: Option<usize>,
    /// Number of commas behind the bracket.
    pub commas: usize,
    /// True if the bracket belongs to a formula, as the braces of a choice do.
    pub is_formula: bool,
}

/// Unfinished statement at an offset.
pub struct Statement<'a> {
    description: &'a Description,
    /// Lexemes before the unfinished one.
    pub before: &'a [Lexeme],
    /// Index of the first lexeme; `None` if no statement has begun.
    pub first: Option<usize>,
    /// Open brackets.
    pub open: Vec<Open>,
}

impl<'a> Statement<'a> {
    /// Finds the unfinished statement at the beginning of a word.
    pub fn before(description: &'a Description, offset: usize) -> Statement<'a> {
        let end = description.lexemes.partition_point(|it| it.end <= offset);
        let mut statement = Statement {
            description,
            before: &description.lexemes[..end],
            first: None,
            open: Vec::new(),
        };
        for place in 0..end {
            statement.pass(place);
        }
        statement
    }

    fn pass(&mut self, place: usize) {
        match self.before[place].kind {
            Kind::Open(bracket) => {
                // The braces of a choice belong to a formula.
                let is_formula = bracket == b'{' && self.has_choice(place);
                self.open.push(Open {
                    bracket,
                    statement: self.first,
                    commas: 0,
                    is_formula,
                });
                if bracket == b'{' && !is_formula {
                    self.first = None;
                }
            }
            Kind::Close(bracket) => {
                let closed = self.open.pop();
                self.first = match closed {
                    Some(closed) if bracket != b'}' || closed.is_formula => closed.statement,
                    _ => None,
                };
            }
            Kind::Mark(b';') => self.first = None,
            Kind::Mark(b',') => {
                if let Some(open) = self.open.last_mut() {
                    open.commas += 1;
                }
            }
            Kind::Mark(_) | Kind::Text => {}
            Kind::Word | Kind::Number => {
                self.first.get_or_insert(place);
            }
        }
    }

    fn has_choice(&self, place: usize) -> bool {
        let start = self.first.unwrap_or(place);
        (start..place).any(|it| self.word(it) == Some("if"))
    }

    /// Returns the word at an index; `None` if there is none.
    pub fn word(&self, place: usize) -> Option<&'a str> {
        let lexeme = self.before.get(place)?;
        (lexeme.kind == Kind::Word).then(|| self.description.written(*lexeme))
    }

    /// Returns the first word of the statement; `None` if there is none.
    pub fn opening(&self) -> Option<&'a str> {
        self.word(self.first?)
    }

    /// Returns the last lexeme with its text; `None` if there is none.
    pub fn last(&self) -> Option<(Kind, &'a str)> {
        let last = self.before.last()?;
        Some((last.kind, self.description.written(*last)))
    }

    /// Returns the name before the last `.`, with its indices and its part.
    pub fn owner(&self) -> String {
        let mut depth = 0_usize;
        let mut parts = Vec::new();
        let mut is_name_wanted = true;
        for lexeme in self.before.iter().rev().skip(1) {
            match lexeme.kind {
                Kind::Close(b']') => depth += 1,
                Kind::Open(b'[') => depth = depth.saturating_sub(1),
                _ if depth > 0 => {}
                Kind::Word | Kind::Number if is_name_wanted => is_name_wanted = false,
                Kind::Mark(b'.') if !is_name_wanted => is_name_wanted = true,
                _ => break,
            }
            parts.push(self.description.written(*lexeme));
        }
        parts.reverse();
        parts.concat()
    }

    /// True if the offset is in the braces of a statement.
    pub fn is_inside(&self, statement: Span) -> bool {
        let opened = self.open.iter().filter_map(|it| it.statement);
        let mut starts = opened.map(|it| self.before[it].start);
        starts.any(|it| it == statement.start as usize)
    }

    /// Returns the first word of the statement around a new statement at the offset; `None` outside of braces.
    pub fn around(&self) -> Option<&'a str> {
        let braces = self.open.iter().rev().find(|it| it.bracket == b'{')?;
        self.word(braces.statement?)
    }
}
