//! Determines the usual gap between neighbors on a line: one blank or none.

use super::pieces::{Piece, What};
use crate::syntax::KEYWORDS;

/// Words between two operands.
const CLAUSES: [&str; 19] = [
    "at",
    "turned",
    "facing",
    "along",
    "about",
    "in",
    "on",
    "free",
    "preload",
    "inertia",
    "gear",
    "efficiency",
    "radius",
    "over",
    "from",
    "to",
    "tolerance",
    "sigma",
    "pressure_angle",
];

/// Words in the position of an operand and before another operand.
const OPENINGS: [&str; 3] = ["if", "else", "polar"];

/// Returns the usual gap before the piece at `index`, which is not the first of its line; `first` is the first piece of its
/// statement.
pub(super) fn gap(pieces: &[Piece<'_>], index: usize, first: usize) -> usize {
    let (before, piece) = (&pieces[index - 1], &pieces[index]);
    usize::from(is_apart(pieces, index, first, before, piece))
}

fn is_apart(
    pieces: &[Piece<'_>],
    index: usize,
    first: usize,
    before: &Piece<'_>,
    piece: &Piece<'_>,
) -> bool {
    use What::{Close, Mark, Number, Open, Word};
    let beyond = index.checked_sub(2).map(|at| pieces[at].what);
    let after = pieces.get(index + 1).map(|it| it.what);
    match (before.what, piece.what) {
        (Open(b'{'), Close(b'}')) => false,
        (Open(b'(' | b'['), _) | (_, Close(b')' | b']') | Mark(b',' | b';' | b':')) => false,
        _ if before.is_comment() || piece.is_comment() => true,
        // `1 .5` and `1. 5` differ from `1.5`.
        (Number, Mark(b'.')) if after == Some(Number) => piece.gap > 0,
        (Mark(b'.'), Number) if beyond == Some(Number) => piece.gap > 0,
        (_, Mark(b'.')) | (Mark(b'.'), _) => false,
        (_, Mark(b'^' | b'*' | b'/')) | (Mark(b'^' | b'*' | b'/'), _) => false,
        (Mark(b'+' | b'-'), _) if is_sign(pieces, index - 1, first) => {
            // The formatter must not create an arrow.
            piece.what == Mark(b'>')
        }
        (Word, Open(b'(')) => {
            is_clause(pieces, index - 1) || is_unnamed_joint(pieces, index, first)
        }
        // An index, and the bracket after an indexed name.
        (Word | Close(b']'), Open(b'[')) | (Close(b']'), Open(b'(')) => false,
        (Number, Open(b'(')) => false,
        _ => true,
    }
}

/// True if a plus or minus is a sign, and not an operation between two terms.
pub(super) fn is_sign(pieces: &[Piece<'_>], index: usize, first: usize) -> bool {
    if !matches!(pieces[index].what, What::Mark(b'+' | b'-')) {
        return false;
    }
    let before = (first..index).rev().find(|&it| !pieces[it].is_comment());
    match before {
        None => true,
        Some(before) => {
            before == first || !pieces[before].ends_operand() || is_clause(pieces, before)
        }
    }
}

/// True if an operand follows the word at `index`.
pub(super) fn is_clause(pieces: &[Piece<'_>], index: usize) -> bool {
    let word = &pieces[index];
    let follows_operand = index
        .checked_sub(1)
        .is_some_and(|before| pieces[before].ends_operand());
    word.what == What::Word
        && (OPENINGS.contains(&word.text) || follows_operand && CLAUSES.contains(&word.text))
}

/// True if the parenthesis at `index` follows a keyword, or the kind of a joint without a name and with several operands:
/// `translational (1, 2)`, but `absolute_x(1)`.
fn is_unnamed_joint(pieces: &[Piece<'_>], index: usize, first: usize) -> bool {
    let kind = match pieces[first].is_word("redundant") {
        true => first + 1,
        false => first,
    };
    if index != kind + 1 {
        return false;
    }
    if KEYWORDS.contains(&pieces[kind].text) {
        return true;
    }
    let mut depth = 0_usize;
    for piece in &pieces[index..] {
        match piece.what {
            What::Open(_) => depth += 1,
            What::Close(_) => depth -= 1,
            What::Mark(b',') if depth == 1 => return true,
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    false
}
