//! *`syn`'s tokens → names, marks, numbers and groups with our spans.* The only place that touches a span of `syn`: those are bound
//! to the thread, and at the end of the input they are empty and at offset 0. Here the end of a group is its closing bracket.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

use proc_macro2::Delimiter;
use syn::buffer::Cursor;

use super::brackets::StatementStarts;
use super::files::unquoted;
use super::formula::Name;
use super::part::Part;
use super::repair::Repaired;
use super::scan::Documentation;
use super::scope::{Scope, Spellings};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};

/// The most characters of a text that a message repeats.
const LONGEST_REPEATED: usize = 40;

/// What a rule gives: its node, or the one finding that stopped it.
pub(super) type Outcome<T> = Result<T, Box<Diagnostic>>;

/// What every rule may ask about the text.
pub(super) struct Reader<'a> {
    pub text: &'a str,
    pub repaired: &'a Repaired,
    pub starts: &'a StatementStarts,
    pub documentation: &'a [Documentation],
    /// Offsets near which errors say nothing new, ascending.
    pub damage: &'a [usize],
    /// The place after the last thing written.
    end: Span,
    findings: RefCell<Vec<Diagnostic>>,
    /// Whether what is read has been read before, and its findings are known.
    is_muted: Cell<bool>,
    /// Where documentation has been taken from.
    documented: RefCell<BTreeSet<u32>>,
    scope: RefCell<Scope>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(
        text: &'a str,
        repaired: &'a Repaired,
        starts: &'a StatementStarts,
        documentation: &'a [Documentation],
        damage: &'a [usize],
    ) -> Self {
        Self {
            text,
            repaired,
            starts,
            documentation,
            damage,
            end: Span::empty(text.trim_end().len()),
            findings: RefCell::default(),
            is_muted: Cell::new(false),
            documented: RefCell::default(),
            scope: RefCell::new(Scope::new()),
        }
    }

    /// Keeps a finding, unless what was found by the scan explains it.
    pub(super) fn report(&self, finding: Diagnostic, from: u32, to: u32) {
        let first = self.damage.partition_point(|place| *place < from as usize);
        let damaged = self
            .damage
            .get(first)
            .is_some_and(|place| *place <= to as usize);
        let mut findings = self.findings.borrow_mut();
        if !damaged && !self.is_muted.get() && findings.len() < Diagnostics::MOST {
            findings.push(finding);
        }
    }

    /// Whether so much was found that going on is pointless.
    pub(super) fn is_full(&self) -> bool {
        self.findings.borrow().len() >= Diagnostics::MOST
    }

    /// Reads something again whose findings are known, where that is so.
    pub(super) fn again<T>(&self, is_known: bool, read: impl FnOnce() -> T) -> T {
        let before = self.is_muted.replace(is_known || self.is_muted.get());
        let read = read();
        self.is_muted.set(before);
        read
    }

    pub(super) fn count_of_findings(&self) -> usize {
        self.findings.borrow().len()
    }

    /// The findings, and how names are written.
    pub(super) fn into_parts(self) -> (Vec<Diagnostic>, Spellings) {
        (
            self.findings.into_inner(),
            self.scope.into_inner().spellings,
        )
    }

    /// Asks what is known by name. The question reads nothing.
    pub(super) fn known<T>(&self, ask: impl FnOnce(&Scope) -> T) -> T {
        ask(&self.scope.borrow())
    }

    /// Changes what is known by name, in the same manner.
    pub(super) fn learn<T>(&self, change: impl FnOnce(&mut Scope) -> T) -> T {
        change(&mut self.scope.borrow_mut())
    }

    /// How a name is written.
    pub(super) fn spelled(&self, name: &str) -> String {
        self.known(|scope| scope.spelled(name).to_string())
    }

    /// Keeps how a name is written.
    ///
    /// # Errors
    /// Another one is called so.
    pub(super) fn spell(&self, name: &Name, written: String) -> Outcome<()> {
        let known = self.learn(|scope| {
            let known = scope.spellings.entry(name.text.clone());
            known.or_insert_with(|| written.clone()).clone()
        });
        if known == written {
            return Ok(());
        }
        let message = format!("`{written}` and `{known}` are one name");
        let finding = Diagnostic::error(Code::DuplicateName, name.span, message)
            .label(format!("both would be called {}", name.text));
        Err(Box::new(
            finding.help("choose another name for one of them"),
        ))
    }

    /// The text of a span.
    pub(super) fn written(&self, span: Span) -> &'a str {
        self.text.get(span.range()).unwrap_or("")
    }

    /// The end of the last thing written.
    pub(super) fn end_of_text(&self) -> Span {
        self.end
    }

    /// The lines of the documentation directly before an offset.
    pub(super) fn docs(&self, offset: u32, inner: bool) -> Vec<String> {
        let first = self
            .documentation
            .partition_point(|it| it.before < offset as usize);
        let mut lines = Vec::new();
        for comment in self.documentation[first..]
            .iter()
            .take_while(|it| it.before == offset as usize)
        {
            if comment.inner == inner {
                self.documented.borrow_mut().insert(comment.span.start);
                lines.extend(comment.lines.iter().cloned());
            }
        }
        if lines.iter().all(String::is_empty) {
            // Nothing is said.
            lines.clear();
        }
        lines
    }

    /// Documentation that no rule has asked for.
    pub(super) fn idle_documentation(&self) -> Vec<Span> {
        let documented = self.documented.borrow();
        let spans = self.documentation.iter().map(|it| it.span);
        spans
            .filter(|span| !documented.contains(&span.start))
            .collect()
    }

    fn span(&self, span: proc_macro2::Span) -> Span {
        // Brackets that are missing at the end of the file are inserted behind the last line break.
        let (span, end) = (self.repaired.span(span.byte_range()), self.end_of_text());
        if span.start >= end.start { end } else { span }
    }
}

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
            Some((_, _, span, _)) => self.reader.span(span.open()),
            None => self.reader.span(self.cursor.span()),
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
        Some(self.reader.written(self.reader.span(ident.span())))
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
        let span = self.reader.span(ident.span());
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
        let span = self.reader.span(literal.span());
        self.advance(span, rest);
        Some(Name { text, span })
    }

    /// What stands between quotes, as written; its place is that of the quotes.
    pub(super) fn text(&mut self) -> Option<Name> {
        let (literal, rest) = self.cursor.literal()?;
        let span = self.reader.span(literal.span());
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
        let span = self.reader.span(punct.span());
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
        let (open, close) = (
            self.reader.span(brackets.open()),
            self.reader.span(brackets.close()),
        );
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
            let span = self.reader.span(tree.span());
            self.advance(span, rest);
        }
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
