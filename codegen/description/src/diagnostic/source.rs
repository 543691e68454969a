//! Represents source text and locations in it. A [`Span`] is only two offsets, so code that prints it clamps it to the text.

use super::{Code, Diagnostic, Diagnostics};
use crate::units::OutputUnits;

/// A range of bytes of the source, which includes `start` and excludes `end`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// Offset of the first byte.
    pub start: u32,
    /// Offset after the last byte.
    pub end: u32,
}

impl Span {
    /// Creates the span from `start` to `end`, exclusive. Offsets beyond 4 GiB become the largest offset.
    pub fn new(start: usize, end: usize) -> Self {
        let offset = |value| u32::try_from(value).unwrap_or(u32::MAX);
        Self {
            start: offset(start),
            end: offset(end),
        }
    }

    /// Creates an empty span before the byte at `at`.
    pub fn empty(at: usize) -> Self {
        Self::new(at, at)
    }

    /// Returns the smallest span that covers both.
    pub fn to(self, other: Span) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// Converts the span into a range for slices.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..(self.end as usize).max(self.start as usize)
    }
}

/// A line and a column, counted from 1; columns count characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Position {
    /// Line number, counted from 1.
    pub line: usize,
    /// Number of the character in its line, counted from 1.
    pub column: usize,
}

/// A file that a description names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attachment {
    /// Path as the description writes it.
    pub path: String,
    /// Contents, or the reason why they could not be read.
    pub bytes: Result<Vec<u8>, String>,
}

/// Text of a description with its name in reports.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// Name as given by the user; printed, never opened.
    pub name: String,
    /// Whole text.
    pub text: String,
    /// Files that the text names.
    #[doc(hidden)]
    pub attachments: Vec<Attachment>,
    /// Units of reported values, which override the text; `None` if the text decides.
    #[doc(hidden)]
    pub units: Option<OutputUnits>,
}

impl Source {
    /// Maximum size of a text, in bytes: a mechanism of ten thousand bodies is far smaller.
    pub const MAX_BYTES: usize = 4 << 20;

    /// Creates a source from text.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
            attachments: Vec::new(),
            units: None,
        }
    }

    /// Returns the source with these units for reported values.
    #[doc(hidden)]
    pub fn reported_in(mut self, units: Option<OutputUnits>) -> Source {
        self.units = units;
        self
    }

    /// Returns the source with the bytes of a file that the text names, or the reason why they are missing.
    pub fn with_attachment(
        mut self,
        path: impl Into<String>,
        bytes: Result<Vec<u8>, String>,
    ) -> Source {
        let bytes = bytes.and_then(|bytes| match bytes.len() > Source::MAX_BYTES {
            true => Err(format!("it is larger than {} MiB", Source::MAX_BYTES >> 20)),
            false => Ok(bytes),
        });
        let path = path.into();
        self.attachments.push(Attachment { path, bytes });
        self
    }

    /// Creates a source from the bytes of a file.
    ///
    /// # Errors
    /// Returns [`Code::UnreadableFile`] if the bytes are not UTF-8. The source beside the finding has the invalid bytes
    /// replaced, so that the finding can be printed.
    pub fn from_bytes(
        name: impl Into<String>,
        bytes: &[u8],
    ) -> Result<Source, Box<(Source, Diagnostics)>> {
        let error = match std::str::from_utf8(bytes) {
            Ok(text) => return Ok(Source::new(name, text)),
            // The file was read only until its size exceeded the limit, which is reported later.
            Err(error) if error.error_len().is_none() && bytes.len() > Source::MAX_BYTES => {
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
        // Replacement leaves the text before the first invalid byte unchanged, so the offset is valid in both.
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
        let mut findings = Diagnostics::new();
        findings.push(diagnostic);
        Err(Box::new((source, findings)))
    }

    /// Returns the line and column of a byte offset; an offset beyond the end is clamped.
    #[doc(hidden)]
    pub fn position(&self, offset: u32) -> Position {
        Lines::of(self).position(offset as usize)
    }
}

/// Line starts of a source, computed once for many queries.
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

    /// Returns the text of a line, counted from 1, without its line break.
    pub(super) fn text(&self, line: usize) -> &'a str {
        let range = self.range(line);
        &self.source.text[range]
    }

    /// Returns the bytes of a line, counted from 1, without its line break. Lines beyond the last are clamped.
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

    /// Returns the line and column of an offset. An offset within a character or a line break moves to its start, one beyond
    /// the text to the end.
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
