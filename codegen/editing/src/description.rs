//! Reads a text without deriving equations: its tokens, statements and names.
//!
//! An incomplete description is read as well. A statement that cannot be read is left out, the others keep their names.

use linkwright_codegen::diagnostic::{Diagnostics, Source, Span};
use linkwright_codegen::stages::syntax::{self, Document, Kind, Lexeme, Statement};

use crate::names::Names;

/// Description that has been read.
pub struct Description {
    /// Text with the files that it names.
    pub source: Source,
    /// Words, numbers, marks and brackets.
    pub(crate) lexemes: Vec<Lexeme>,
    /// Statements; `None` if the text has no mechanism.
    pub document: Option<Document>,
    /// True if every statement could be read.
    pub(crate) is_whole: bool,
    /// Names.
    pub names: Names,
}

impl Description {
    /// Reads a text.
    pub fn of(source: Source) -> Description {
        let mut diagnostics = Diagnostics::new();
        let document = syntax::parse(&source, &mut diagnostics);
        let lexemes = syntax::lexemes(&source.text);
        let names = document.as_ref().map(|it| Names::of(it, &source.text));
        Description {
            lexemes,
            names: names.unwrap_or_default(),
            is_whole: document.is_some() && !diagnostics.has_errors(),
            document,
            source,
        }
    }

    /// Returns all statements, each motion before its own.
    pub(crate) fn statements(&self) -> impl Iterator<Item = &Statement> {
        let document = self.document.as_ref();
        let outer = document.map_or(&[][..], |it| &it.mechanism.statements);
        outer.iter().flat_map(|statement| {
            let inner = match statement {
                Statement::Motion(motion) => &motion.statements[..],
                _ => &[],
            };
            std::iter::once(statement).chain(inner)
        })
    }

    /// Returns the innermost statement around a place; `None` if there is none.
    pub(crate) fn statement_around(&self, place: Span) -> Option<Span> {
        let spans = self.statements().map(Statement::span);
        let around = spans.filter(|it| it.start <= place.start && place.end <= it.end);
        around.min_by_key(|it| it.end - it.start)
    }

    /// Returns the lexeme that contains an offset or ends there; `None` if there is none.
    pub(crate) fn lexeme_at(&self, offset: usize) -> Option<Lexeme> {
        let after = self.lexemes.partition_point(|it| it.start <= offset);
        let reaching = self.lexemes[..after].iter().rev().take(2);
        let mut touching = reaching.filter(|it| offset <= it.end).copied();
        let last = touching.next()?;
        // Between a word and a mark, the word is preferred.
        let is_name = |it: &Lexeme| matches!(it.kind, Kind::Word | Kind::Number);
        match is_name(&last) {
            true => Some(last),
            false => touching.find(is_name).or(Some(last)),
        }
    }

    /// Returns the text of a lexeme.
    pub(crate) fn written(&self, lexeme: Lexeme) -> &str {
        &self.source.text[lexeme.start..lexeme.end]
    }

    /// True if an offset is inside a comment, which is behind the last lexeme before the offset.
    pub(crate) fn is_in_comment(&self, offset: usize) -> bool {
        let after = self.lexemes.partition_point(|it| it.end <= offset);
        let start = after.checked_sub(1).map_or(0, |it| self.lexemes[it].end);
        let mut rest = &self.source.text[start..offset.max(start)];
        while let Some(at) = rest.find('/') {
            rest = &rest[at..];
            let end = match rest.as_bytes().get(1) {
                Some(b'/') => rest.find('\n'),
                Some(b'*') => rest.find("*/").map(|it| it + 1),
                _ => Some(0),
            };
            match end {
                Some(end) => rest = &rest[end + 1..],
                None => return true,
            }
        }
        false
    }
}
