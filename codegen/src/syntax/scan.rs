//! *Text → words, numbers, marks and brackets with their places.* What `syn` cannot say: which character stopped it, where a
//! comment or a bracket is left open, and what the documentation comments were.
//!
//! Afterwards every byte of the text belongs to a lexeme, to white space, or to an [`Edit`] that takes it out of `syn`'s sight, and
//! the [findings](Scan::findings) name every character that nobody reads. The scan knows no statement and no expression.

use super::unreadable;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};

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

    fn settle_documentation(&mut self) {
        for comment in &mut self.scan.documentation[self.pending_documentation..] {
            comment.before = self.at;
        }
        self.pending_documentation = self.scan.documentation.len();
    }

    fn line_comment(&mut self) {
        let length = self.rest().find('\n').unwrap_or(self.rest().len());
        let comment = &self.rest()[..length];
        let inner = comment.starts_with("//!");
        if inner || comment.starts_with("///") && !comment.starts_with("////") {
            let lines = vec![documentation_line(&comment[3..])];
            self.document(inner, lines, length);
        }
        self.skip(length);
    }

    fn block_comment(&mut self) {
        let start = self.at;
        let Some(length) = block_comment_length(self.rest()) else {
            let end = self.text.trim_end().len();
            let finding = Diagnostic::error(
                Code::UnexpectedEnd,
                Span::empty(end),
                "the file ends inside a comment",
            )
            .label("expected `*/`")
            .also(Span::new(start, start + 2), "the comment starts here")
            .help("close the comment with `*/`, or start it with `//`");
            self.scan.report(finding);
            self.scan.damage.push(start);
            self.skip(self.rest().len());
            return;
        };
        let comment = &self.rest()[..length];
        let inner = comment.starts_with("/*!");
        if inner || comment.starts_with("/**") && !comment.starts_with("/***") && length > 4 {
            let content = comment[3..length - 2].trim();
            let lines = content.lines().map(|line| {
                let line = line.trim_start();
                documentation_line(line.strip_prefix('*').unwrap_or(line))
            });
            let lines = lines.collect();
            self.document(inner, lines, length);
        }
        self.skip(length);
    }

    fn document(&mut self, inner: bool, lines: Vec<String>, length: usize) {
        let span = Span::new(self.at, self.at + length);
        self.scan.documentation.push(Documentation {
            inner,
            lines,
            span,
            before: self.at,
        });
    }

    fn word(&mut self) {
        let length = word_length(self.rest());
        let (start, end) = (self.at, self.at + length);
        if !self.rest()[..length].is_ascii() {
            let word = &self.text[start..end];
            let finding = Diagnostic::error(
                Code::NameNotAllowed,
                Span::new(start, end),
                format!("the name `{word}` is not ASCII"),
            )
            .label("names are made of `a` to `z`, `A` to `Z`, `0` to `9` and `_`");
            self.scan.report(finding.help(spelling(word)));
            self.scan.edit(start, end, Fill::Underscores);
        }
        self.lexeme(Kind::Word, length);
    }

    /// Whether `table NAME =` stands before: nothing else is written with a text.
    fn names_a_file(&self) -> bool {
        let [.., table, name, equals] = &self.scan.lexemes[..] else {
            return false;
        };
        table.kind == Kind::Word
            && &self.text[table.start..table.end] == "table"
            && name.kind == Kind::Word
            && equals.kind == Kind::Mark(b'=')
    }

    fn text(&mut self) {
        let inside = &self.rest()[1..];
        let length = inside.find(|it: char| it == '"' || it.is_control());
        let start = self.at;
        let Some(length) = length.filter(|&length| inside[length..].starts_with('"')) else {
            let end = start + 1 + inside.find(['\n', '\r']).unwrap_or(inside.len());
            let span = Span::new(start, end);
            let finding =
                Diagnostic::error(Code::UnreadableCharacter, span, "a text without its end")
                    .label("expected `\"` on this line")
                    .help("write the path between quotes: `table lift = \"lift.csv\";`");
            self.scan.report(finding);
            self.scan.damage.push(start);
            self.scan.edit(start, end, Fill::Blank);
            self.fresh_line = false;
            self.at = end;
            return;
        };
        let end = start + length + 2;
        if inside[..length].contains('\\') {
            // Rust's lexer would read an escape; the path is refused where the table is resolved.
            self.scan.edit(start + 1, end - 1, Fill::Underscores);
        }
        self.lexeme(Kind::Text, length + 2);
    }

    fn number(&mut self) {
        let length = number_length(self.rest());
        let (start, end) = (self.at, self.at + length);
        let number = &self.text[start..end];
        let base = match number.as_bytes() {
            [b'0', b'x' | b'X', ..] => Some("hexadecimal"),
            [b'0', b'o' | b'O', ..] => Some("octal"),
            [b'0', b'b' | b'B', ..] => Some("binary"),
            _ => None,
        };
        if let Some(base) = base {
            let message = format!("`{number}` is no number of this language");
            let finding = Diagnostic::error(Code::OutsideGrammar, Span::new(start, end), message)
                .label(format!("`{}` starts a {base} number", &number[..2]))
                .help("write the number in decimal digits");
            self.scan.report(finding);
            self.scan.damage.push(start);
            self.scan.edit(start, end, Fill::Zeros);
        } else if !number.is_ascii() {
            let unit =
                number.trim_start_matches(|it: char| it.is_ascii_digit() || it == '.' || it == '_');
            let message = format!("the unit `{unit}` is not ASCII");
            let finding = Diagnostic::error(
                Code::NameNotAllowed,
                Span::new(end - unit.len(), end),
                message,
            );
            self.scan.report(finding.help(spelling(unit)));
            self.scan.edit(end - unit.len(), end, Fill::Underscores);
        }
        self.lexeme(Kind::Number, length);
    }

    fn unreadable(&mut self, character: char) {
        let previous = self
            .scan
            .lexemes
            .last()
            .filter(|it| it.end == self.at && it.kind == Kind::Number);
        let number = previous.map(|it| &self.text[it.start..it.end]);
        let reading = unreadable::read(self.rest(), character, number);
        let (start, end) = (self.at, self.at + reading.length);
        let span = Span::new(start, end);
        let finding = Diagnostic::error(Code::UnreadableCharacter, span, reading.message);
        let help = reading.help.unwrap_or_else(|| "remove it".to_string());
        self.scan.report(finding.help(help));
        match reading.meant {
            Some(meant) => self.scan.edit(start, end, Fill::Text(meant)),
            None => {
                self.scan.damage.push(start);
                self.scan.edit(start, end, Fill::Blank);
            }
        }
        self.fresh_line = false;
        self.at = end;
    }
}

/// Letters, with two exceptions that look like a degree sign or a power.
fn starts_word(character: char) -> bool {
    character == '_' || character.is_alphabetic() && !matches!(character, 'º' | 'ª')
}

fn continues_word(character: char) -> bool {
    starts_word(character) || character.is_ascii_digit()
}

fn word_length(text: &str) -> usize {
    text.find(|it| !continues_word(it)).unwrap_or(text.len())
}

/// The length of a number with its unit, as Rust's lexer would cut it: `1.P` is the number `1`, `1e-3mm` is one number.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .position(|it| !it.is_ascii_digit() && *it != b'_')
            .map_or(bytes.len(), |it| from + it)
    };
    let mut at = digits(0);
    if bytes.get(at) == Some(&b'.') {
        let next = text[at + 1..].chars().next();
        if !next.is_some_and(|it| it == '.' || starts_word(it)) {
            at = digits(at + 1);
        }
    }
    if let (Some(b'e' | b'E'), Some(b'+' | b'-'), Some(b'0'..=b'9')) =
        (bytes.get(at), bytes.get(at + 1), bytes.get(at + 2))
    {
        at = digits(at + 2);
    }
    at + word_length(&text[at..])
}

/// The length of a block comment with the comments nested in it; `None` when it is not closed.
pub(crate) fn block_comment_length(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut depth = 0_usize;
    let mut at = 0;
    while at + 1 < bytes.len() {
        match (bytes[at], bytes[at + 1]) {
            (b'/', b'*') => {
                depth += 1;
                at += 2;
            }
            (b'*', b'/') => {
                depth -= 1;
                at += 2;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ => at += 1,
        }
    }
    None
}

/// How to write a name or unit that is not ASCII.
fn spelling(word: &str) -> String {
    match unreadable::ascii_spelling(word) {
        Some(spelled) => format!("write `{spelled}`"),
        None => "write it with other letters".to_string(),
    }
}

fn documentation_line(line: &str) -> String {
    line.strip_prefix(' ')
        .unwrap_or(line)
        .trim_end()
        .to_string()
}
