//! *Text → words, numbers, marks and brackets with their places.* What `syn` cannot say: which character stopped it, where a
//! comment or a bracket is left open, and what the documentation comments were.
//!
//! Afterwards every byte of the text belongs to a lexeme, to white space, or to an [`Edit`] that takes it out of `syn`'s sight, and
//! the [findings](Scan::findings) name every character that nobody reads. The scan knows no statement and no expression.

mod comments;
mod lengths;
mod lexemes;

pub(crate) use comments::block_comment_length;

use crate::diagnostic::{Diagnostic, Diagnostics, Span};
use lengths::starts_word;

/// What a lexeme is. Brackets and marks are ASCII characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A name or a keyword.
    Word,
    /// A number with its unit.
    Number,
    /// A text in quotes, with them.
    Text,
    /// An opening bracket.
    Open(u8),
    /// A closing bracket.
    Close(u8),
    /// One character of punctuation.
    Mark(u8),
}

/// One word, number, mark or bracket.
#[derive(Debug, Clone, Copy)]
pub struct Lexeme {
    /// What it is.
    pub kind: Kind,
    /// Offset of its first byte.
    pub start: usize,
    /// Offset after its last byte.
    pub end: usize,
    /// Whether only white space and comments stand before it on its line.
    pub first_on_line: bool,
}

/// A documentation comment.
#[derive(Debug, Clone)]
pub(super) struct Documentation {
    /// Whether it documents what it stands in (`//!`), not what follows (`///`).
    pub inner: bool,
    pub lines: Vec<String>,
    pub span: Span,
    /// Where the next lexeme starts.
    pub before: usize,
}

/// A place where `syn` is to see other text than was written.
#[derive(Debug, Clone)]
pub(super) struct Edit {
    pub start: usize,
    pub end: usize,
    pub fill: Fill,
}

/// What `syn` is to see instead. The first three keep the length in bytes.
#[derive(Debug, Clone)]
pub(super) enum Fill {
    Blank,
    Underscores,
    Zeros,
    Text(String),
}

/// What the scan of a text gives.
#[derive(Debug, Default)]
pub(super) struct Scan {
    pub lexemes: Vec<Lexeme>,
    pub documentation: Vec<Documentation>,
    /// In the order of their places, without overlaps, once [sorted](super::repair).
    pub edits: Vec<Edit>,
    pub findings: Vec<Diagnostic>,
    /// Offsets at which `syn` sees something that does not mean what was written, so that errors nearby say nothing new.
    pub damage: Vec<usize>,
}

impl Scan {
    pub(super) fn report(&mut self, finding: Diagnostic) {
        if self.findings.len() < Diagnostics::MOST {
            self.findings.push(finding);
        }
    }

    pub(super) fn edit(&mut self, start: usize, end: usize, fill: Fill) {
        self.edits.push(Edit { start, end, fill });
    }
}

/// The words, numbers, marks and brackets of a text that is read without an error: between two of them stand white space and comments.
pub fn lexemes(text: &str) -> Vec<Lexeme> {
    scan(text).lexemes
}

/// Scans a whole text.
pub(super) fn scan(text: &str) -> Scan {
    let mut scanner = Scanner {
        text,
        at: 0,
        fresh_line: true,
        pending_documentation: 0,
        scan: Scan::default(),
    };
    scanner.run();
    scanner.scan
}

struct Scanner<'a> {
    text: &'a str,
    at: usize,
    /// Whether only white space and comments have been seen on this line.
    fresh_line: bool,
    /// The first documentation comment whose following lexeme is not known yet.
    pending_documentation: usize,
    scan: Scan,
}

impl Scanner<'_> {
    fn run(&mut self) {
        if self.text.starts_with('\u{feff}') {
            // A byte order mark is no part of the text.
            self.skip(3);
        }
        while let Some(next) = self.rest().chars().next() {
            match next {
                '\n' => {
                    self.fresh_line = true;
                    self.at += 1;
                }
                ' ' | '\t' => self.at += 1,
                white if white.is_whitespace() => self.skip(white.len_utf8()),
                '/' if self.rest().starts_with("//") => self.line_comment(),
                '/' if self.rest().starts_with("/*") => self.block_comment(),
                '0'..='9' => self.number(),
                '"' if self.names_a_file() => self.text(),
                letter if starts_word(letter) => self.word(),
                '(' | '[' | '{' => self.lexeme(Kind::Open(next as u8), 1),
                ')' | ']' | '}' => self.lexeme(Kind::Close(next as u8), 1),
                ';' | ':' | ',' | '.' | '=' | '+' | '-' | '*' | '/' | '^' | '<' | '>' => {
                    self.lexeme(Kind::Mark(next as u8), 1);
                }
                other => self.unreadable(other),
            }
        }
        self.at = self.text.len();
        self.settle_documentation();
    }

    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    /// Takes bytes out of `syn`'s sight.
    fn skip(&mut self, length: usize) {
        self.scan.edit(self.at, self.at + length, Fill::Blank);
        self.at += length;
    }

    fn lexeme(&mut self, kind: Kind, length: usize) {
        self.settle_documentation();
        let (start, end) = (self.at, self.at + length);
        self.scan.lexemes.push(Lexeme {
            kind,
            start,
            end,
            first_on_line: self.fresh_line,
        });
        self.fresh_line = false;
        self.at = end;
    }
}
