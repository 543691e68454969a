//! Wraps tokens of `syn` as names, marks, numbers and groups with [`Span`]s.
//!
//! Only this module handles spans of `syn`, which are bound to the thread, and are empty and at offset 0 at the end of the
//! input. Here the end of a group is its closing bracket.

use proc_macro2::Delimiter;
use syn::buffer::Cursor;

use super::files::unquoted;
use super::formula::Name;
use super::part::Part;
use super::reader::Reader;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Maximum number of characters that a message quotes.
const MAX_QUOTED_CHARACTERS: usize = 40;

/// A position between two tokens of one group. Copies are cheap, so look-ahead works on a copy.
#[derive(Clone, Copy)]
pub(super) struct Tokens<'a> {
    pub reader: &'a Reader<'a>,
    /// Mechanisms that may be used as parts here.
    pub parts: &'a [Part<'a>],
    cursor: Cursor<'a>,
    /// Closing bracket of the group, or the end of the file.
    close: Span,
    /// Token before this position, or the opening bracket.
    previous: Span,
}

impl<'a> Tokens<'a> {
    /// Returns all tokens of a file.
    pub(super) fn all(reader: &'a Reader<'a>, cursor: Cursor<'a>) -> Self {
        Self {
            reader,
            parts: &[],
            cursor,
            close: reader.end_of_text(),
            previous: Span::empty(0),
        }
    }

    /// Returns this position with other mechanisms as parts.
    pub(super) fn with_parts<'b>(self, parts: &'b [Part<'b>]) -> Tokens<'b>
    where
        'a: 'b,
    {
        Tokens { parts, ..self }
    }

    pub(super) fn at_end(&self) -> bool {
        self.cursor.eof()
    }

    /// Returns the location of the next token, of the next opening bracket, or of the end of this group.
    pub(super) fn next_span(&self) -> Span {
        if self.at_end() {
            return self.close;
        }
        match self.cursor.any_group() {
            Some((_, _, span, _)) => self.span(span.open()),
            None => self.span(self.cursor.span()),
        }
    }

    pub(super) fn previous(&self) -> Span {
        self.previous
    }

    /// True if the next token is on a new line, or there is none.
    pub(super) fn at_line_start(&self) -> bool {
        let between = Span {
            start: self.previous.end,
            end: self.next_span().start,
        };
        self.at_end() || self.reader.written(between).contains('\n')
    }

    /// True if a statement starts here, judged by the shape of the line.
    pub(super) fn at_statement(&self) -> bool {
        !self.at_end() && self.reader.starts.contains(self.next_span().start as usize)
    }

    pub(super) fn peek_word(&self) -> Option<&'a str> {
        let (ident, _) = self.cursor.ident()?;
        Some(self.reader.written(self.span(ident.span())))
    }

    /// Consumes the next word if it is this one.
    pub(super) fn keyword(&mut self, word: &str) -> Option<Span> {
        if self.peek_word() != Some(word) {
            return None;
        }
        self.word().map(|name| name.span)
    }

    pub(super) fn word(&mut self) -> Option<Name> {
        let (ident, rest) = self.cursor.ident()?;
        let span = self.span(ident.span());
        self.advance(span, rest);
        Some(Name {
            text: self.reader.written(span).to_string(),
            span,
        })
    }

    /// Consumes a number with its unit, as written, or as repaired if the written form is invalid.
    pub(super) fn number(&mut self) -> Option<Name> {
        let (literal, rest) = self.cursor.literal()?;
        let text = literal.to_string();
        if text.starts_with('"') {
            return None;
        }
        let span = self.span(literal.span());
        self.advance(span, rest);
        Some(Name { text, span })
    }

    /// Consumes quoted text, as written; its location includes the quotes.
    pub(super) fn text(&mut self) -> Option<Name> {
        let (literal, rest) = self.cursor.literal()?;
        let span = self.span(literal.span());
        let written = self.reader.written(span);
        if !(written.starts_with('"') && written.ends_with('"')) {
            return None;
        }
        self.advance(span, rest);
        let text = unquoted(written).to_string();
        Some(Name { text, span })
    }

    pub(super) fn peek_number(&self) -> bool {
        let literal = self.cursor.literal();
        literal.is_some_and(|(literal, _)| !literal.to_string().starts_with('"'))
    }

    pub(super) fn peek_mark(&self, mark: char) -> bool {
        self.cursor
            .punct()
            .is_some_and(|(punct, _)| punct.as_char() == mark)
    }

    pub(super) fn mark(&mut self, mark: char) -> Option<Span> {
        let (punct, rest) = self
            .cursor
            .punct()
            .filter(|(punct, _)| punct.as_char() == mark)?;
        let span = self.span(punct.span());
        self.advance(span, rest);
        Some(span)
    }

    /// Consumes `->`.
    pub(super) fn arrow(&mut self) -> Option<Span> {
        let mut ahead = *self;
        let minus = ahead.mark('-')?;
        let greater = ahead
            .mark('>')
            .filter(|greater| greater.start == minus.end)?;
        *self = ahead;
        Some(minus.to(greater))
    }

    pub(super) fn peek_group(&self, delimiter: Delimiter) -> bool {
        self.cursor.group(delimiter).is_some()
    }

    /// Consumes a group; returns its inside and its location with the brackets.
    pub(super) fn group(&mut self, delimiter: Delimiter) -> Option<(Tokens<'a>, Span)> {
        let (inside, brackets, rest) = self.cursor.group(delimiter)?;
        let (open, close) = (self.span(brackets.open()), self.span(brackets.close()));
        let inner = Tokens {
            reader: self.reader,
            parts: self.parts,
            cursor: inside,
            close,
            previous: open,
        };
        self.advance(open.to(close), rest);
        Some((inner, open.to(close)))
    }

    /// Skips the indices of a name.
    pub(super) fn skip_indices(&mut self) {
        while self.peek_group(Delimiter::Bracket) {
            self.skip();
        }
    }

    /// Skips one token or group.
    pub(super) fn skip(&mut self) {
        if let Some((tree, rest)) = self.cursor.token_tree() {
            let span = self.span(tree.span());
            self.advance(span, rest);
        }
    }

    /// Converts a span of `syn`.
    fn span(&self, span: proc_macro2::Span) -> Span {
        // Brackets missing at the end of the file are inserted after the last line break.
        let (span, end) = (
            self.reader.repaired.span(span.byte_range()),
            self.reader.end_of_text(),
        );
        if span.start >= end.start { end } else { span }
    }

    fn advance(&mut self, span: Span, rest: Cursor<'a>) {
        self.previous = span;
        self.cursor = rest;
    }

    /// Describes the next token for a message.
    pub(super) fn found(&self) -> String {
        let span = self.next_span();
        match self.reader.written(span) {
            "" => "the end of the file".to_string(),
            written if written.chars().count() > MAX_QUOTED_CHARACTERS => "this".to_string(),
            written => format!("`{written}`"),
        }
    }

    /// Returns the finding for an unexpected token, with help.
    pub(super) fn unexpected(&self, wanted: &str, help: &str) -> Box<Diagnostic> {
        self.unexpected_with_code(Code::UnexpectedToken, wanted, help)
    }

    pub(super) fn unexpected_with_code(
        &self,
        code: Code,
        wanted: &str,
        help: &str,
    ) -> Box<Diagnostic> {
        let span = self.next_span();
        let code = if span == self.reader.end_of_text() {
            Code::UnexpectedEnd
        } else {
            code
        };
        let message = format!("expected {wanted}, found {}", self.found());
        let finding = Diagnostic::error(code, span, message).label(format!("expected {wanted}"));
        Box::new(finding.help(help))
    }
}
