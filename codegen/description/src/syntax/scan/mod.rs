//! Scans a text into words, numbers, marks and brackets with their locations.
//!
//! The scan finds what `syn` does not report: unreadable characters, unclosed comments and brackets, and documentation
//! comments. Every byte of the text belongs to a lexeme, to white space, or to an [`Edit`] that hides it from `syn`. The
//! [findings](Scan::findings) name every unreadable character. Statements and expressions are not recognized here.

mod comments;
mod lengths;
mod lexemes;

pub(crate) use comments::block_comment_length;

use crate::diagnostic::{Diagnostic, Diagnostics, Span};
use lengths::starts_word;

/// Kind of a lexeme. Brackets and marks are ASCII characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A name or a keyword.
    Word,
    /// A number with its unit.
    Number,
    /// A text with its quotes.
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
    /// Kind of the lexeme.
    pub kind: Kind,
    /// Offset of the first byte.
    pub start: usize,
    /// Offset after the last byte.
    pub end: usize,
    /// True if only white space and comments precede it on its line.
    pub first_on_line: bool,
}

/// A comment with its slashes. One that is not closed reaches to the end of the text.
#[derive(Debug, Clone, Copy)]
pub struct Comment {
    /// Source location.
    pub span: Span,
    /// True for documentation.
    pub is_documentation: bool,
}

/// A documentation comment.
#[derive(Debug, Clone)]
pub(super) struct Documentation {
    /// True for documentation of the enclosing item (`//!`), false for that of the next one (`///`).
    pub inner: bool,
    pub lines: Vec<String>,
    pub span: Span,
    /// Offset of the next lexeme.
    pub before: usize,
}

/// A range of the text that `syn` sees differently.
#[derive(Debug, Clone)]
pub(super) struct Edit {
    pub start: usize,
    pub end: usize,
    pub fill: Fill,
}

/// Replacement seen by `syn`. The first three keep the length in bytes.
#[derive(Debug, Clone)]
pub(super) enum Fill {
    Blank,
    Underscores,
    Zeros,
    Text(String),
}

/// Result of a scan.
#[derive(Debug, Default)]
pub(super) struct Scan {
    pub lexemes: Vec<Lexeme>,
    pub comments: Vec<Comment>,
    pub documentation: Vec<Documentation>,
    /// Edits by position, without overlaps, once [sorted](super::repair).
    pub edits: Vec<Edit>,
    pub findings: Vec<Diagnostic>,
    /// Offsets at which an edit changes the meaning, so that errors nearby follow from it.
    pub damage: Vec<usize>,
}

impl Scan {
    pub(super) fn report(&mut self, finding: Diagnostic) {
        if self.findings.len() < Diagnostics::MAX_FINDINGS {
            self.findings.push(finding);
        }
    }

    pub(super) fn edit(&mut self, start: usize, end: usize, fill: Fill) {
        self.edits.push(Edit { start, end, fill });
    }
}

/// Returns the words, numbers, marks and brackets of a text without errors. Only white space and comments separate them.
pub fn lexemes(text: &str) -> Vec<Lexeme> {
    scan(text).lexemes
}

/// Returns the lexemes of a text, and its comments.
pub fn lexemes_and_comments(text: &str) -> (Vec<Lexeme>, Vec<Comment>) {
    let scan = scan(text);
    (scan.lexemes, scan.comments)
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
    /// True if only white space and comments were scanned on this line.
    fresh_line: bool,
    /// Index of the first documentation comment without a following lexeme.
    pending_documentation: usize,
    scan: Scan,
}

impl Scanner<'_> {
    fn run(&mut self) {
        if self.text.starts_with('\u{feff}') {
            // A byte order mark is not part of the text.
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

    /// Hides bytes from `syn`.
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
