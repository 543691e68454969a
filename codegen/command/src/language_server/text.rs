//! Converts between offsets in the text of an open description and positions of the protocol.
//!
//! Lines end with `\n`, `\r\n` or `\r`, as in the protocol. Every position of a client becomes a valid offset: beyond a line its end,
//! beyond the text the end of the text, inside a character its beginning.

use linkwright_codegen::diagnostic::Span;
use lsp_types::{Position, PositionEncodingKind, Range};

/// Unit of columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Bytes.
    Utf8,
    /// Units of 16 bits, which every client supports.
    #[default]
    Utf16,
}

impl Encoding {
    /// Selects bytes if the client offers them.
    pub fn agreed(offered: Option<&[PositionEncodingKind]>) -> Encoding {
        match offered.is_some_and(|it| it.contains(&PositionEncodingKind::UTF8)) {
            true => Encoding::Utf8,
            false => Encoding::Utf16,
        }
    }

    /// Name in the protocol.
    pub fn kind(self) -> PositionEncodingKind {
        match self {
            Encoding::Utf8 => PositionEncodingKind::UTF8,
            Encoding::Utf16 => PositionEncodingKind::UTF16,
        }
    }

    fn width(self, character: char) -> usize {
        match self {
            Encoding::Utf8 => character.len_utf8(),
            Encoding::Utf16 => character.len_utf16(),
        }
    }
}

/// Text and the beginnings of its lines.
#[derive(Clone, Debug)]
pub struct Text {
    text: String,
    starts: Vec<usize>,
    encoding: Encoding,
}

impl Text {
    /// Creates a text whose positions are counted in `encoding`.
    pub fn new(text: String, encoding: Encoding) -> Text {
        let starts = starts(&text);
        Text {
            text,
            starts,
            encoding,
        }
    }

    /// Returns the text.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Returns the byte offset of a position.
    pub fn offset(&self, position: Position) -> usize {
        let line = usize::try_from(position.line).unwrap_or(usize::MAX);
        let Some(&start) = self.starts.get(line) else {
            return self.text.len();
        };
        let next = self.starts.get(line + 1).copied();
        let whole = &self.text[start..next.unwrap_or(self.text.len())];
        let line = whole.trim_end_matches(['\n', '\r']);
        let mut left = usize::try_from(position.character).unwrap_or(usize::MAX);
        for (at, character) in line.char_indices() {
            let width = self.encoding.width(character);
            if left < width {
                return start + at;
            }
            left -= width;
        }
        start + line.len()
    }

    /// Returns the position of a byte; inside a character, that of the character, beyond the text, the end.
    pub fn position(&self, offset: usize) -> Position {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.starts.partition_point(|start| *start <= offset) - 1;
        let before = &self.text[self.starts[line]..offset];
        let widths = before.chars().map(|it| self.encoding.width(it));
        let count = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        Position::new(count(line), count(widths.sum()))
    }

    /// Returns the range of a span.
    pub fn range(&self, span: Span) -> Range {
        let bytes = span.range();
        Range::new(self.position(bytes.start), self.position(bytes.end))
    }

    /// Replaces a range; without a range, the whole text.
    pub fn replace(&mut self, range: Option<Range>, by: &str) {
        match range {
            None => self.text = by.to_string(),
            Some(range) => {
                let [start, end] = [range.start, range.end].map(|it| self.offset(it));
                self.text.replace_range(start..end.max(start), by);
            }
        }
        self.starts = starts(&self.text);
    }
}

fn starts(text: &str) -> Vec<usize> {
    let bytes = text.as_bytes();
    let ends = bytes.iter().enumerate().filter(|&(at, byte)| match byte {
        b'\n' => true,
        b'\r' => bytes.get(at + 1) != Some(&b'\n'),
        _ => false,
    });
    std::iter::once(0)
        .chain(ends.map(|(at, _)| at + 1))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLE: &str = "a\u{e4}b\r\n\u{1d54f}\u{20ac}c\rd\n";

    #[test]
    fn every_byte_has_a_position_and_comes_back() {
        for encoding in [Encoding::Utf8, Encoding::Utf16] {
            let text = Text::new(SAMPLE.to_string(), encoding);
            for (at, _) in SAMPLE.char_indices().chain([(SAMPLE.len(), ' ')]) {
                let back = text.offset(text.position(at));
                // A line break of two characters has no position inside.
                let expected = if &SAMPLE[..at] == "a\u{e4}b\r" {
                    at - 1
                } else {
                    at
                };
                assert_eq!(back, expected, "{encoding:?}");
            }
        }
    }

    #[test]
    fn columns_are_counted_as_agreed() {
        let utf16 = Text::new(SAMPLE.to_string(), Encoding::Utf16);
        let utf8 = Text::new(SAMPLE.to_string(), Encoding::Utf8);
        let at = SAMPLE.find('c').expect("it is there");
        assert_eq!(utf16.position(at), Position::new(1, 3));
        assert_eq!(utf8.position(at), Position::new(1, 7));
        let at = SAMPLE.find('d').expect("it is there");
        assert_eq!(utf16.position(at), Position::new(2, 0));
    }

    #[test]
    fn any_position_is_a_place() {
        let text = Text::new(SAMPLE.to_string(), Encoding::Utf16);
        assert_eq!(text.offset(Position::new(0, 99)), 4);
        assert_eq!(text.offset(Position::new(99, 0)), SAMPLE.len());
        // The position is inside a character of two units.
        assert_eq!(text.offset(Position::new(1, 1)), 6);
        let most = Position::new(u32::MAX, u32::MAX);
        assert_eq!(text.offset(most), SAMPLE.len());
    }

    #[test]
    fn ranges_are_replaced() {
        let mut text = Text::new("one\ntwo\n".to_string(), Encoding::Utf16);
        let range = Range::new(Position::new(1, 0), Position::new(1, 3));
        text.replace(Some(range), "2\n3");
        assert_eq!(text.as_str(), "one\n2\n3\n");
        assert_eq!(text.position(6), Position::new(2, 0));
        let backwards = Range::new(Position::new(1, 0), Position::new(0, 0));
        text.replace(Some(backwards), "x");
        assert_eq!(text.as_str(), "one\nx2\n3\n");
        text.replace(None, "");
        assert_eq!(text.position(7), Position::new(0, 0));
    }
}
