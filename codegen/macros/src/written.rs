//! Writes tokens as the text of a description, and maps locations in the text back to tokens.
//!
//! Between consecutive tokens of a file, the text has the blanks and the lines of the file. Other tokens, such as those
//! that a macro has combined, are kept apart.

use std::ops::Range;

use linkwright_codegen::diagnostic;
use proc_macro2::Span;

use crate::tokens::Token;

/// Text of a description, with the locations of its tokens.
pub struct Written {
    /// Text, which begins with the line of the first token.
    pub text: String,
    /// Range of each token in the text, in order.
    places: Vec<(Range<usize>, Span)>,
}

/// Blanks and lines before a token.
#[derive(Clone, Copy)]
struct Gap {
    lines: usize,
    columns: usize,
}

impl Gap {
    const NONE: Gap = Gap::columns(0);
    const LINE: Gap = Gap {
        lines: 1,
        columns: 0,
    };

    const fn columns(columns: usize) -> Gap {
        Gap { lines: 0, columns }
    }
}

impl Written {
    /// Writes these tokens.
    pub fn of(tokens: &[Token]) -> Written {
        let gaps = gaps(tokens);
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

    /// First and last token of a range in the text. Between two tokens it is the one before; in an empty text, the
    /// macro.
    pub fn tokens_at(&self, place: diagnostic::Span) -> [Span; 2] {
        let place = place.range();
        let places = &self.places;
        let first = places.partition_point(|(own, _)| own.end <= place.start);
        let last = places.partition_point(|(own, _)| own.start < place.end.max(place.start + 1));
        let ends = match places.get(first..last) {
            Some([only]) => [only, only],
            Some([first, .., last]) => [first, last],
            _ => match places.get(first.saturating_sub(1)) {
                Some(before) => [before, before],
                None => return [Span::call_site(); 2],
            },
        };
        ends.map(|(_, span)| *span)
    }
}

/// Gap before each token. If all tokens are in one file in order, the lines are those of the file. Otherwise they come
/// from several locations, and the text between those does not belong to the gaps.
fn gaps(tokens: &[Token]) -> Vec<Gap> {
    let written = tokens.windows(2).map(|pair| match pair {
        [token, next] => gap_as_written(token, next),
        _ => None,
    });
    let written: Vec<Option<Gap>> = written.collect();
    let in_order = written.iter().all(Option::is_some);
    let start = tokens.first().and_then(|token| token.extent);
    let indent = start.map_or(0, |[start, _]| start.column);
    let first = tokens.first().map(|_| Gap::columns(indent));
    let others = tokens.windows(2).zip(written);
    let others = others.map(|(pair, written)| match (pair, written) {
        (_, Some(gap)) if in_order || gap.lines == 0 => gap,
        (_, Some(_)) => Gap::LINE,
        ([token, next], None) => gap_between(token, next),
        _ => Gap::NONE,
    });
    first.into_iter().chain(others).collect()
}

/// Gap between two tokens in the source; `None` if they are not consecutive there.
fn gap_as_written(token: &Token, next: &Token) -> Option<Gap> {
    let ([_, end], [start, _]) = (token.extent?, next.extent?);
    if start.line != end.line {
        let lines = start.line.checked_sub(end.line)?;
        let columns = start.column;
        return Some(Gap { lines, columns });
    }
    let columns = start.column.checked_sub(end.column)?;
    let keeps_apart = !token.is_line_comment() && (columns > 0 || !would_merge(token, next));
    keeps_apart.then_some(Gap::columns(columns))
}

/// Gap that keeps two tokens of unknown location apart. No blank surrounds the operator of a factor: a unit behind `*`
/// or `/` must be adjacent to its quantity, and a blank has no meaning for other factors.
fn gap_between(token: &Token, next: &Token) -> Gap {
    let is_factor = |it: &Token| matches!(it.text.as_str(), "*" | "/" | "^");
    if token.is_line_comment() || matches!(token.text.as_str(), ";" | "{" | "}") {
        Gap::LINE
    } else if !would_merge(token, next) && (token.joint || is_factor(token) || is_factor(next)) {
        Gap::NONE
    } else {
        Gap::columns(1)
    }
}

/// True if two tokens without a blank between them would be one token, or begin a comment.
fn would_merge(token: &Token, next: &Token) -> bool {
    let is_of_word = |it: char| it == '_' || it.is_alphanumeric();
    let (last, first) = (token.text.chars().last(), next.text.chars().next());
    match (last, first) {
        (Some('/'), Some('/' | '*')) => true,
        (Some(last), Some(first)) => is_of_word(last) && is_of_word(first),
        _ => false,
    }
}
