//! *Tokens → the text of a description, and the way back from its places to tokens.* Where the tokens stand as they were written, the
//! text has their columns and the distances of their lines; otherwise it has blanks between them, and means the same.

use std::ops::Range;

use linkwright_codegen::diagnostic;
use proc_macro2::Span;

use crate::tokens::Token;

/// The text of a description.
pub struct Written {
    /// The text, which begins with the line of the first token.
    pub text: String,
    /// Where each token stands in the text, in order.
    places: Vec<(Range<usize>, Span)>,
}

/// What stands before a token.
#[derive(Clone, Copy)]
struct Gap {
    lines: usize,
    columns: usize,
}

impl Written {
    /// What these tokens say.
    pub fn of(tokens: &[Token]) -> Written {
        let gaps = gaps_as_written(tokens).unwrap_or_else(|| gaps_by_blanks(tokens));
        let mut written = Written {
            text: String::new(),
            places: Vec::with_capacity(tokens.len()),
        };
        for (token, gap) in tokens.iter().zip(gaps) {
            let text = &mut written.text;
            text.extend(std::iter::repeat_n('\n', gap.lines));
            text.extend(std::iter::repeat_n(' ', gap.columns));
            let start = text.len();
            text.push_str(&token.text);
            written.places.push((start..text.len(), token.span));
        }
        written
    }

    /// The first and the last token at a place in the text. Between two tokens it is the one before; of no text at all, the macro.
    pub fn tokens_at(&self, place: diagnostic::Span) -> [Span; 2] {
        let place = place.range();
        let places = &self.places;
        let first = places.partition_point(|(own, _)| own.end <= place.start);
        let last = places.partition_point(|(own, _)| own.start < place.end.max(place.start + 1));
        let found = match places.get(first..last) {
            Some([only]) => [only, only],
            Some([first, .., last]) => [first, last],
            _ => match places.get(first.saturating_sub(1)) {
                Some(before) => [before, before],
                None => return [Span::call_site(); 2],
            },
        };
        found.map(|(_, span)| *span)
    }
}

/// The gaps that are written, if the tokens are written one after another.
fn gaps_as_written(tokens: &[Token]) -> Option<Vec<Gap>> {
    let indent = |token: &Token| token.extent.map(|[start, _]| start.column);
    let first = tokens.first().map(|token| {
        let columns = indent(token)?;
        Some(Gap { lines: 0, columns })
    });
    let others = tokens.windows(2).map(|pair| {
        let [token, next] = pair else { return None };
        let ([_, end], [start, _]) = (token.extent?, next.extent?);
        let gap = if start.line == end.line {
            let columns = start.column.checked_sub(end.column)?;
            Gap { lines: 0, columns }
        } else {
            let lines = start.line.checked_sub(end.line)?;
            let columns = start.column;
            Gap { lines, columns }
        };
        let keeps_apart = gap.lines > 0
            || !token.is_line_comment() && (gap.columns > 0 || !would_merge(token, next));
        keeps_apart.then_some(gap)
    });
    first.into_iter().chain(others).collect()
}

/// Gaps that keep tokens apart, wherever they come from.
fn gaps_by_blanks(tokens: &[Token]) -> Vec<Gap> {
    let none = Gap {
        lines: 0,
        columns: 0,
    };
    let others = tokens.windows(2).map(|pair| match pair {
        [token, next] if token.joint && !would_merge(token, next) => none,
        [token, _] if token.is_line_comment() || matches!(token.text.as_str(), ";" | "{" | "}") => {
            Gap { lines: 1, ..none }
        }
        _ => Gap { columns: 1, ..none },
    });
    std::iter::once(none).chain(others).collect()
}

/// Whether two tokens without a blank between them would be one, or begin a comment.
fn would_merge(token: &Token, next: &Token) -> bool {
    let is_of_word = |it: char| it == '_' || it.is_alphanumeric();
    let (last, first) = (token.text.chars().last(), next.text.chars().next());
    match (last, first) {
        (Some('/'), Some('/' | '*')) => true,
        (Some(last), Some(first)) => is_of_word(last) && is_of_word(first),
        _ => false,
    }
}
