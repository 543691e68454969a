//! *`syn`'s tokens → names, marks, numbers and groups with our spans.* The only place that touches a span of `syn`: those are bound
//! to the thread, and at the end of the input they are empty and at offset 0. Here the end of a group is its closing bracket.

use proc_macro2::Delimiter;
use syn::buffer::Cursor;

use super::files::unquoted;
use super::formula::Name;
use super::part::Part;
use super::reader::Reader;
use crate::diagnostic::{Code, Diagnostic, Span};

/// The most characters of a text that a message repeats.
const LONGEST_REPEATED: usize = 40;

/// A place between two tokens of one group. Copies are cheap: a rule that looks ahead works on a copy.
#[derive(Clone, Copy)]
pub(super) struct Tokens<'a> {
    pub reader: &'a Reader<'a>,
    /// The mechanisms that may be parts here.
    pub parts: &'a [Part<'a>],
    cursor: Cursor<'a>,
    /// The bracket that closes the group, or the end of the file.
    close: Span,
    /// The token before this place, or the opening bracket.
    previous: Span,
}

impl<'a> Tokens<'a> {
    /// All tokens of a file.
    pub(super) fn all(reader: &'a Reader<'a>, cursor: Cursor<'a>) -> Self {
        Self {
            reader,
            parts: &[],
            cursor,
            close: reader.end_of_text(),
            previous: Span::empty(0),
        }
    }

    /// The same place where these mechanisms may be parts.
    pub(super) fn with_parts<'b>(self, parts: &'b [Part<'b>]) -> Tokens<'b>
    where
        'a: 'b,
    {
        Tokens { parts, ..self }
    }

    pub(super) fn at_end(&self) -> bool {
        self.cursor.eof()
    }

    /// The next token, the opening bracket of the next group, or what closes this group.
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

    /// Whether the next token is on another line than the previous one, or there is none.
    pub(super) fn at_line_start(&self) -> bool {
        let between = Span {
            start: self.previous.end,
            end: self.next_span().start,
        };
        self.at_end() || self.reader.written(between).contains('\n')
    }

    /// Whether a statement starts here, judged by the shape of the line.
    pub(super) fn at_statement(&self) -> bool {
        !self.at_end() && self.reader.starts.contains(self.next_span().start as usize)
    }

    pub(super) fn peek_word(&self) -> Option<&'a str> {
        let (ident, _) = self.cursor.ident()?;
        Some(self.reader.written(self.span(ident.span())))
    }

    /// The word, if it is this one.
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

    /// A number with its unit, as written or, where that is no number of this language, as it was repaired.
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

    /// What stands between quotes, as written; its place is that of the quotes.
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

    /// `->`
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

    /// The inside of a group, and its span with the brackets.
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

    /// Passes the indices of a name.
    pub(super) fn skip_indices(&mut self) {
        while self.peek_group(Delimiter::Bracket) {
            self.skip();
        }
    }

    /// Passes one token or group.
    pub(super) fn skip(&mut self) {
        if let Some((tree, rest)) = self.cursor.token_tree() {
            let span = self.span(tree.span());
            self.advance(span, rest);
        }
    }

    /// Our span.
    fn span(&self, span: proc_macro2::Span) -> Span {
        // Brackets that are missing at the end of the file are inserted behind the last line break.
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

    /// What stands here, for a message.
    pub(super) fn found(&self) -> String {
        let span = self.next_span();
        match self.reader.written(span) {
            "" => "the end of the file".to_string(),
            written if written.chars().count() > LONGEST_REPEATED => "this".to_string(),
            written => format!("`{written}`"),
        }
    }

    /// The finding that something else is wanted here, and what to do about it.
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
