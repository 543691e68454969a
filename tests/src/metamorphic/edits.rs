//! Edits of a text by position.

use linkwright_codegen::diagnostic::Span;

/// Insertions and replacements in one text.
#[derive(Clone, Debug, Default)]
pub struct Edits {
    /// From where to where, and what instead.
    edits: Vec<(usize, usize, String)>,
}

impl Edits {
    /// Writes `text` instead of what stands at `span`.
    pub fn replace(&mut self, span: Span, text: impl Into<String>) {
        let range = span.range();
        self.edits.push((range.start, range.end, text.into()));
    }

    /// Writes `text` after what stands at `span`.
    pub fn append(&mut self, span: Span, text: impl Into<String>) {
        self.replace(Span::empty(span.range().end), text);
    }

    /// Puts what stands at `span` into parentheses, with `after` behind them. Parts are enclosed before the whole.
    pub fn enclose(&mut self, span: Span, after: &str) {
        self.replace(Span::empty(span.range().start), "(");
        self.append(span, format!("){after}"));
    }

    /// The text after all edits.
    ///
    /// # Panics
    /// Where two replacements overlap.
    pub fn apply(mut self, text: &str) -> String {
        // Stable: what was said first about one place comes first; an insertion comes before what is replaced there.
        self.edits.sort_by_key(|(start, end, _)| (*start, *end));
        let mut written = String::new();
        let mut done = 0;
        for (start, end, instead) in self.edits {
            assert!(start >= done, "two edits of one place");
            written.push_str(&text[done..start]);
            written.push_str(&instead);
            done = end;
        }
        written.push_str(&text[done..]);
        written
    }
}
