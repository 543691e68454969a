//! *Tokens → the text of a description, and the way back from its places to tokens.* Where tokens stand one after another, the text
//! has the blanks and the lines that are written between them; other tokens, such as those that a macro has put together, it keeps apart.

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
    /// What these tokens say.
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

/// What stands before each token. Lines are as many as are written where all tokens stand one after another; otherwise they come from
/// several places, and what lies between those is nothing that is written between tokens.
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

/// What is written between two tokens, if they are written one after the other.
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

/// What keeps two tokens apart of which nobody knows where they are written. No blank separates a quantity from a unit behind `*` or
/// `/`: of any other factor it says nothing.
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
