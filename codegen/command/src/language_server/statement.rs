//! *An offset → what is being written there:* the statement that has begun, and the brackets that are open. From the tokens alone,
//! so that it is known also of a statement that cannot be read yet.

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::{Kind, Lexeme};

use super::description::Description;

/// A bracket that is open.
#[derive(Clone, Copy, Debug)]
pub struct Open {
    /// The bracket.
    pub bracket: u8,
    /// Where the statement begins that it is part of: the place of a lexeme.
    pub statement: Option<usize>,
    /// How many commas stand in it so far.
    pub commas: usize,
    /// Whether it belongs to a formula, as those of a choice do.
    pub is_formula: bool,
}

/// What is being written at an offset.
pub struct Statement<'a> {
    description: &'a Description,
    /// The lexemes before the one that is being written.
    pub before: &'a [Lexeme],
    /// Where the statement begins; nothing where none has begun.
    pub first: Option<usize>,
    /// The brackets that are open.
    pub open: Vec<Open>,
}

impl<'a> Statement<'a> {
    /// What is being written where a word begins.
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
                // The braces of a choice stand in a formula.
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

    /// The word at a place.
    pub fn word(&self, place: usize) -> Option<&'a str> {
        let lexeme = self.before.get(place)?;
        (lexeme.kind == Kind::Word).then(|| self.description.written(*lexeme))
    }

    /// The word that the statement begins with.
    pub fn opening(&self) -> Option<&'a str> {
        self.word(self.first?)
    }

    /// The last lexeme, as it is written.
    pub fn last(&self) -> Option<(Kind, &'a str)> {
        let last = self.before.last()?;
        Some((last.kind, self.description.written(*last)))
    }

    /// What stands before the `.` that comes last: a name with its indices, perhaps of a part.
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

    /// Whether this stands in the braces of a statement.
    pub fn is_inside(&self, statement: Span) -> bool {
        let opened = self.open.iter().filter_map(|it| it.statement);
        let mut starts = opened.map(|it| self.before[it].start);
        starts.any(|it| it == statement.start as usize)
    }

    /// The statement in whose braces another would stand here.
    pub fn around(&self) -> Option<&'a str> {
        let braces = self.open.iter().rev().find(|it| it.bracket == b'{')?;
        self.word(braces.statement?)
    }
}
