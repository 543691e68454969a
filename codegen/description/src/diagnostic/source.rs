//! *Bytes of a file → text with a name, and places in it.* A [`Span`] is only two offsets: whoever prints it clamps it to the text.

use super::{Code, Diagnostic, Diagnostics};
use crate::units::OutputUnits;

/// A range of bytes of the source, `start` included, `end` not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// Offset of the first byte.
    pub start: u32,
    /// Offset after the last byte.
    pub end: u32,
}

impl Span {
    /// The bytes from `start` up to, but not including, `end`. Offsets beyond 4 GiB become the largest offset.
    pub fn new(start: usize, end: usize) -> Self {
        let offset = |value| u32::try_from(value).unwrap_or(u32::MAX);
        Self {
            start: offset(start),
            end: offset(end),
        }
    }

    /// The place between two bytes.
    pub fn empty(at: usize) -> Self {
        Self::new(at, at)
    }

    /// The smallest span that covers both.
    pub fn to(self, other: Span) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// The same span as a range, as slices want it.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..(self.end as usize).max(self.start as usize)
    }
}

/// A line and a column, both counted from 1; the column counts characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Position {
    /// Number of the line, from 1.
    pub line: usize,
    /// Number of the character in its line, from 1.
    pub column: usize,
}

/// A file that a description names, as far as it could be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attachment {
    /// The path as the description writes it.
    pub path: String,
    /// What it holds, or why that is not known.
    pub bytes: Result<Vec<u8>, String>,
}

/// The text of a description and the name it is reported under.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// The name as the user gave it; printed, never opened.
    pub name: String,
    /// The whole text.
    pub text: String,
    /// The files that the text names.
    pub attachments: Vec<Attachment>,
    /// Units in which values are reported, whatever the text says of them; `None` if the text decides.
    pub units: Option<OutputUnits>,
}

impl Source {
    /// The largest text that is read, in bytes: a mechanism of ten thousand bodies is far smaller.
    pub const LARGEST: usize = 4 << 20;

    /// A source from text.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
            attachments: Vec::new(),
            units: None,
        }
    }

    /// Returns the source, reported in these units.
    pub fn reported_in(mut self, units: Option<OutputUnits>) -> Source {
        self.units = units;
        self
    }

    /// The same with the bytes of a file that the text names, or with the reason why there are none.
    pub fn with_attachment(
        mut self,
        path: impl Into<String>,
        bytes: Result<Vec<u8>, String>,
    ) -> Source {
        let bytes = bytes.and_then(|bytes| match bytes.len() > Source::LARGEST {
            true => Err(format!("it is larger than {} MiB", Source::LARGEST >> 20)),
            false => Ok(bytes),
        });
        let path = path.into();
        self.attachments.push(Attachment { path, bytes });
        self
    }

    /// A source from the bytes of a file.
    ///
    /// # Errors
    /// [`Code::UnreadableFile`] when the bytes are not UTF-8; the source that comes with it has the unreadable bytes replaced,
    /// so that the finding can be printed.
    pub fn from_bytes(
        name: impl Into<String>,
        bytes: &[u8],
    ) -> Result<Source, Box<(Source, Diagnostics)>> {
        let error = match std::str::from_utf8(bytes) {
            Ok(text) => return Ok(Source::new(name, text)),
            // It was read no further than is needed to know that it is too large, which is what will be reported.
            Err(error) if error.error_len().is_none() && bytes.len() > Source::LARGEST => {
                return Ok(Source::new(name, String::from_utf8_lossy(bytes)));
            }
            Err(error) => error,
        };
        let start = error.valid_up_to();
        let width = error.error_len().unwrap_or(bytes.len() - start).max(1);
        let values: Vec<String> = bytes[start..]
            .iter()
            .take(width)
            .map(|byte| format!("0x{byte:02x}"))
            .collect();
        // The text before the first bad byte is unchanged by the replacement, so the offset is good in both.
        let source = Source::new(name, String::from_utf8_lossy(bytes));
        let replaced = Span::new(start, start + char::REPLACEMENT_CHARACTER.len_utf8());
        let diagnostic =
            Diagnostic::error(Code::UnreadableFile, replaced, "the file is not UTF-8 text")
                .label(format!(
                    "the first bad byte{}: {}",
                    if width == 1 { "" } else { "s" },
                    values.join(" ")
                ))
                .help("save the file as UTF-8");
        let mut found = Diagnostics::new();
        found.push(diagnostic);
        Err(Box::new((source, found)))
    }

    /// The line and column of a byte offset; an offset beyond the end is the end.
    pub fn position(&self, offset: u32) -> Position {
        Lines::of(self).position(offset as usize)
    }
}

/// The lines of a source, found once and asked often.
pub(super) struct Lines<'a> {
    source: &'a Source,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    pub(super) fn of(source: &'a Source) -> Self {
        let breaks = source
            .text
            .bytes()
            .enumerate()
            .filter(|&(_, byte)| byte == b'\n');
        let starts = std::iter::once(0)
            .chain(breaks.map(|(offset, _)| offset + 1))
            .collect();
        Self { source, starts }
    }

    pub(super) fn name(&self) -> &'a str {
        &self.source.name
    }

    /// The text of a line, counted from 1, without its line break.
    pub(super) fn text(&self, line: usize) -> &'a str {
        let range = self.range(line);
        &self.source.text[range]
    }

    /// The bytes of a line, counted from 1, without its line break. Lines beyond the last are the last.
    fn range(&self, line: usize) -> std::ops::Range<usize> {
        let index = line.clamp(1, self.starts.len()) - 1;
        let start = self.starts[index];
        let end = self
            .starts
            .get(index + 1)
            .map_or(self.source.text.len(), |next| next - 1);
        let text = &self.source.text[start..end];
        start..start + text.strip_suffix('\r').unwrap_or(text).len()
    }

    /// The line and column of an offset. Inside a character or a line break it is the start of it; beyond the text, the end.
    pub(super) fn position(&self, offset: usize) -> Position {
        let mut offset = offset.min(self.source.text.len());
        while !self.source.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.starts.partition_point(|&start| start <= offset);
        let range = self.range(line);
        let before = &self.source.text[range.start..offset.min(range.end)];
        Position {
            line,
            column: before.chars().count() + 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_and_offsets_are_clamped() {
        let source = Source::new("a", "äb\r\nc\n");
        let at = |offset| {
            let position = source.position(offset);
            (position.line, position.column)
        };
        assert_eq!(at(0), (1, 1));
        assert_eq!(at(1), (1, 1));
        assert_eq!(at(2), (1, 2));
        assert_eq!(at(3), (1, 3));
        assert_eq!(at(4), (1, 3));
        assert_eq!(at(5), (2, 1));
        assert_eq!(at(7), (3, 1));
        assert_eq!(at(u32::MAX), (3, 1));
    }

    #[test]
    fn spans_join() {
        assert_eq!(Span::new(4, 6).to(Span::new(1, 2)), Span::new(1, 6));
        assert_eq!(Span::new(usize::MAX, 0).start, u32::MAX);
    }

    #[test]
    fn bytes_that_are_not_utf8_are_shown() {
        assert_eq!(
            Source::from_bytes("a", b"ok").map(|source| source.text),
            Ok("ok".to_string())
        );
        let (source, found) =
            *Source::from_bytes("bad.mech", b"one\ntwo \xff three\n").unwrap_err();
        let expected = "\
error[K00]: the file is not UTF-8 text
 --> bad.mech:2:5
  |
2 | two \u{fffd} three
  |     ^ the first bad byte: 0xff
  |
  = help: save the file as UTF-8

error: 1 error in bad.mech
";
        assert_eq!(found.render(&source), expected);
        assert!(Source::from_bytes("cut", b"\xe2\x82").is_err());
    }
}
