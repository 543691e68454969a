//! Splits a long row of MathML into elements `math` between which a browser may begin a new line.
//!
//! Browsers do not break formulas. A sum is split into pieces, each of which begins with its sign.

use super::spelling::{FIXED_PARENTHESES, GROWING_PARENTHESES};

/// Number of visible characters from which on a piece is broken inside its parentheses as well.
const MAX_PIECE_LENGTH: usize = 60;

/// Row as one piece, or as several if it is a sum or an equation.
pub fn lines(row: &str) -> String {
    let pieces =
        pieces(row, 0)
            .into_iter()
            .flat_map(|piece| match shown(piece) > MAX_PIECE_LENGTH {
                true => pieces_inside(piece),
                false => vec![piece],
            });
    let pieces: Vec<String> = pieces
        .enumerate()
        .map(|(place, piece)| wrapped(piece.trim(), place == 0))
        .collect();
    pieces.join(" ")
}

/// Pieces of the text inside parentheses.
fn pieces_inside(piece: &str) -> Vec<&str> {
    pieces(piece, usize::MAX)
}

/// Piece as an element. The sign of a later one has space on both sides although it is the first there.
fn wrapped(piece: &str, is_first: bool) -> String {
    let rest = piece.strip_prefix("<mo>").filter(|_| !is_first);
    match rest {
        Some(rest) => format!("<math><mo form=\"infix\">{rest}</math>"),
        None => format!("<math>{piece}</math>"),
    }
}

/// Row before signs outside of elements and in at most this number of parentheses.
fn pieces(row: &str, depth: usize) -> Vec<&str> {
    let mut pieces = Vec::new();
    let (mut start, mut elements, mut brackets) = (0, 0_usize, 0_usize);
    for (at, _) in row.match_indices('<') {
        let rest = &row[at..];
        if elements == 0 {
            let is = |place: usize| {
                [FIXED_PARENTHESES, GROWING_PARENTHESES]
                    .iter()
                    .any(|it| rest.starts_with(it[place]))
            };
            if is(0) {
                brackets += 1;
            } else if is(1) {
                brackets = brackets.saturating_sub(1);
            }
            let is_sign = ["<mo>+</mo>", "<mo>−</mo>", "<mo>=</mo>"]
                .iter()
                .any(|sign| rest.starts_with(sign));
            let before = row[start..at].trim_end();
            // A sign after an opening parenthesis or another sign belongs to the term that follows.
            let is_first = before.is_empty()
                || [
                    FIXED_PARENTHESES[0],
                    GROWING_PARENTHESES[0],
                    "<mo>=</mo>",
                    "<mo>,</mo>",
                    "<mo>·</mo>",
                ]
                .iter()
                .any(|it| before.ends_with(it));
            if is_sign && !is_first && brackets <= depth {
                pieces.push(&row[start..at]);
                start = at;
            }
        }
        let end = rest.find('>').unwrap_or(rest.len());
        if rest.starts_with("</") {
            elements = elements.saturating_sub(1);
        } else if !rest[..end].ends_with('/') {
            elements += 1;
        }
    }
    pieces.push(&row[start..]);
    pieces
}

/// Number of visible characters.
pub(crate) fn shown(row: &str) -> usize {
    let mut is_tag = false;
    let seen = row.chars().filter(|letter| {
        let is_seen = !is_tag && *letter != '<' && !letter.is_whitespace();
        is_tag = (is_tag || *letter == '<') && *letter != '>';
        is_seen
    });
    seen.count()
}

#[cfg(test)]
mod tests {
    use super::{lines, shown};

    #[test]
    fn sums_are_broken_before_their_signs() {
        let row = "<mi>x</mi><mo>=</mo><mo>−</mo><mi>a</mi> <mo>+</mo> <mrow><mi>b</mi><mo>−</mo><mi>c</mi></mrow>";
        assert_eq!(
            lines(row),
            "<math><mi>x</mi></math> <math><mo form=\"infix\">=</mo><mo>−</mo><mi>a</mi></math> \
             <math><mo form=\"infix\">+</mo> <mrow><mi>b</mi><mo>−</mo><mi>c</mi></mrow></math>"
        );
        assert_eq!(
            lines("<mo>−</mo><mi>a</mi>"),
            "<math><mo>−</mo><mi>a</mi></math>"
        );
    }

    #[test]
    fn only_what_is_seen_is_counted() {
        assert_eq!(
            shown("<mi data-q=\"1\">x</mi><mspace width=\"1em\"/><mo>+</mo>"),
            2
        );
    }

    #[test]
    fn long_pieces_are_broken_inside_their_parentheses() {
        let long = "<mn>1234567890</mn>".repeat(4);
        let row = format!("<mi>k</mi><mo>(</mo>{long}<mo>+</mo>{long}<mo>)</mo>");
        assert_eq!(lines(&row).matches("<math>").count(), 2);
        let short = "<mi>k</mi><mo>(</mo><mi>a</mi><mo>+</mo><mi>b</mi><mo>)</mo>";
        assert_eq!(lines(short).matches("<math>").count(), 1);
    }
}
