//! Splits a text into words, marks and comments in source order, each with the gap before it. Only white space is omitted.

use crate::syntax::{self, Kind, block_comment_length};

/// Distance of tab stops, in columns.
const TAB: usize = 4;

/// Pairs of marks that are one piece.
const PAIRS: [&str; 3] = ["->", "<=", ">="];

/// Kind of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum What {
    Word,
    Number,
    /// A text in quotes.
    Text,
    Open(u8),
    Close(u8),
    Mark(u8),
    /// An arrow or a comparison.
    Pair,
    LineComment,
    BlockComment,
}

/// One word, number, mark, bracket or comment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece<'a> {
    pub what: What,
    /// Text without surrounding white space.
    pub text: &'a str,
    /// Number of line breaks before the piece.
    pub breaks: usize,
    /// Number of columns between the previous piece on the line and this one.
    pub gap: usize,
    /// Column of the first character, counted from 0.
    pub column: usize,
}

impl Piece<'_> {
    pub fn is_comment(&self) -> bool {
        matches!(self.what, What::LineComment | What::BlockComment)
    }

    pub fn is_word(&self, word: &str) -> bool {
        self.what == What::Word && self.text == word
    }

    /// True if an operand ends with this piece.
    pub fn ends_operand(&self) -> bool {
        matches!(
            self.what,
            What::Word | What::Number | What::Text | What::Close(_)
        )
    }

    /// Returns the number of columns on one line.
    pub fn width(&self) -> usize {
        self.text.chars().count()
    }

    /// True if the piece extends over several lines.
    pub fn is_tall(&self) -> bool {
        self.text.contains('\n')
    }
}

/// Splits a text without errors into pieces.
pub(super) fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut cutter = Cutter {
        text,
        at: 0,
        breaks: 0,
        column: 0,
        gap: 0,
        pieces: Vec::new(),
    };
    let mut lexemes = syntax::lexemes(text).into_iter().peekable();
    while let Some(lexeme) = lexemes.next() {
        cutter.between(lexeme.start);
        let what = match lexeme.kind {
            Kind::Word => What::Word,
            Kind::Number => What::Number,
            Kind::Text => What::Text,
            Kind::Open(bracket) => What::Open(bracket),
            Kind::Close(bracket) => What::Close(bracket),
            Kind::Mark(mark) => What::Mark(mark),
        };
        let second = lexemes.next_if(|next| {
            let pair = text.get(lexeme.start..next.end);
            next.start == lexeme.end && pair.is_some_and(|it| PAIRS.contains(&it))
        });
        match second {
            Some(second) => cutter.piece(What::Pair, second.end),
            None => cutter.piece(what, lexeme.end),
        }
    }
    cutter.between(text.len());
    cutter.pieces
}

struct Cutter<'a> {
    text: &'a str,
    at: usize,
    breaks: usize,
    column: usize,
    gap: usize,
    pieces: Vec<Piece<'a>>,
}

impl Cutter<'_> {
    /// Adds white space and comments up to the next lexeme.
    fn between(&mut self, end: usize) {
        while let Some(next) = self.text[self.at..end].chars().next() {
            let rest = &self.text[self.at..end];
            if rest.starts_with("//") {
                let length = rest.find('\n').unwrap_or(rest.len());
                self.piece(What::LineComment, self.at + length);
            } else if rest.starts_with("/*") {
                let length = block_comment_length(rest).unwrap_or(rest.len());
                self.piece(What::BlockComment, self.at + length);
            } else {
                self.white(next);
                self.at += next.len_utf8();
            }
        }
    }

    fn white(&mut self, character: char) {
        let width = match character {
            '\n' => {
                (self.breaks, self.column, self.gap) = (self.breaks + 1, 0, 0);
                return;
            }
            '\t' => TAB - self.column % TAB,
            '\u{feff}' | '\r' => 0,
            _ => 1,
        };
        self.column += width;
        self.gap += width;
    }

    fn piece(&mut self, what: What, end: usize) {
        let text = self.text[self.at..end].trim_end();
        let piece = Piece {
            what,
            text,
            breaks: self.breaks,
            gap: self.gap,
            column: self.column,
        };
        self.column = match text.rsplit_once('\n') {
            Some((_, last)) => last.chars().count(),
            None => self.column + piece.width(),
        };
        (self.at, self.breaks, self.gap) = (end, 0, 0);
        self.pieces.push(piece);
    }
}
