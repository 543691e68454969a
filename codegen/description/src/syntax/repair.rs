//! Applies edits to a text so that `syn` tokenizes it, and maps locations back.
//!
//! The repaired text is ASCII. Only this module converts its offsets into offsets of the source text.

use super::scan::{Edit, Fill};
use crate::diagnostic::Span;

/// Repaired text with the map to the source text.
pub(super) struct Repaired {
    pub text: String,
    pieces: Vec<Piece>,
    /// Length of the source text.
    length: usize,
}

/// Start of a piece with its own offset, or of inserted text.
struct Piece {
    repaired: usize,
    written: usize,
    inserted: bool,
}

/// Applies edits, which must not overlap, in order of position.
pub(super) fn repair(text: &str, mut edits: Vec<Edit>) -> Repaired {
    // The sort is stable: closing brackets inserted at one offset keep their order.
    edits.sort_by_key(|edit| (edit.start, edit.end));
    let mut repaired = String::with_capacity(text.len() + 16);
    let mut pieces = vec![Piece {
        repaired: 0,
        written: 0,
        inserted: false,
    }];
    let mut at = 0;
    for edit in edits {
        repaired.push_str(&text[at..edit.start]);
        let length = edit.end - edit.start;
        match &edit.fill {
            Fill::Blank => repaired.extend(std::iter::repeat_n(' ', length)),
            Fill::Underscores => repaired.extend(std::iter::repeat_n('_', length)),
            Fill::Zeros => repaired.extend(std::iter::repeat_n('0', length)),
            Fill::Text(text) => {
                pieces.push(Piece {
                    repaired: repaired.len(),
                    written: edit.start,
                    inserted: true,
                });
                repaired.push_str(text);
                pieces.push(Piece {
                    repaired: repaired.len(),
                    written: edit.end,
                    inserted: false,
                });
            }
        }
        at = edit.end;
    }
    repaired.push_str(&text[at..]);
    Repaired {
        text: repaired,
        pieces,
        length: text.len(),
    }
}

impl Repaired {
    /// Returns the source location of a range of the repaired text. Inserted text maps to all of the text that it replaces.
    pub(super) fn span(&self, range: std::ops::Range<usize>) -> Span {
        let start = self.written(range.start);
        let Some(last) = range.end.checked_sub(1).filter(|last| *last >= range.start) else {
            return Span::empty(start.min(self.length));
        };
        // The end belongs to the last byte of the range, which excludes text inserted directly after it.
        let next = self.next_piece(last);
        let end = match self.pieces.get(next) {
            Some(following) if self.pieces[next - 1].inserted => following.written,
            _ => self.written(last) + 1,
        };
        Span::new(
            start.min(self.length),
            end.clamp(start, self.length.max(start)),
        )
    }

    fn written(&self, offset: usize) -> usize {
        let piece = &self.pieces[self.next_piece(offset) - 1];
        if piece.inserted {
            piece.written
        } else {
            piece.written + (offset - piece.repaired)
        }
    }

    /// Returns the index after the piece that contains an offset. A piece always contains it, as the first starts at 0.
    fn next_piece(&self, offset: usize) -> usize {
        self.pieces
            .partition_point(|piece| piece.repaired <= offset)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_find_their_way_back() {
        let text = "a(30°; µ²";
        let edit = |start, end, fill| Edit { start, end, fill };
        let repaired = repair(
            text,
            vec![
                edit(8, 10, Fill::Underscores),
                edit(10, 12, Fill::Text("^2".to_string())),
                edit(4, 6, Fill::Text("deg".to_string())),
                edit(6, 6, Fill::Text(")".to_string())),
            ],
        );
        assert_eq!(repaired.text, "a(30deg); __^2");
        assert_eq!(repaired.span(0..1), Span::new(0, 1));
        assert_eq!(repaired.span(2..7), Span::new(2, 6));
        assert_eq!(repaired.span(0..8), Span::new(0, 6));
        assert_eq!(repaired.span(7..8), Span::new(6, 6));
        assert_eq!(repaired.span(8..9), Span::new(6, 7));
        assert_eq!(repaired.span(10..12), Span::new(8, 10));
        assert_eq!(repaired.span(12..13), Span::new(10, 12));
        assert_eq!(repaired.span(13..14), Span::new(10, 12));
        assert_eq!(repaired.span(14..14), Span::new(12, 12));
    }
}
