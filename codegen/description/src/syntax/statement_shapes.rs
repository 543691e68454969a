//! Recognizes starts of statements and of formulas in braces, before brackets are balanced.

use super::KEYWORDS;
use super::scan::{Kind, Lexeme};

/// Words that continue the head of a body or a table on a new line.
const CONTINUATIONS: [&str; 5] = ["at", "facing", "turned", "along", "clamped"];

/// Returns, for every lexeme and the end, the number of closing minus opening braces from there on.
pub(super) fn excess_of_closing_braces(lexemes: &[Lexeme]) -> Vec<isize> {
    let mut excess = vec![0; lexemes.len() + 1];
    for (index, lexeme) in lexemes.iter().enumerate().rev() {
        let change = match lexeme.kind {
            Kind::Open(b'{') => -1,
            Kind::Close(b'}') => 1,
            _ => 0,
        };
        excess[index] = excess[index + 1] + change;
    }
    excess
}

/// Returns the text of a lexeme that is a word; `None` for other kinds.
pub(super) fn word<'a>(text: &'a str, lexeme: &Lexeme) -> Option<&'a str> {
    (lexeme.kind == Kind::Word).then(|| &text[lexeme.start..lexeme.end])
}

/// True if a brace after these lexemes opens a motion or a repetition. It does after `motion NAME`, after `motion` without a
/// name, and in a statement that begins with one of these words.
pub(super) fn opens_statements(text: &str, before: &[Lexeme]) -> bool {
    let mut last = before.iter().rev().take(2);
    let is_motion = last.any(|lexeme| word(text, lexeme) == Some("motion"));
    let statement = before.iter().rev().take_while(|it| !ends_piece(it.kind));
    let first = statement.last().and_then(|lexeme| word(text, lexeme));
    is_motion || matches!(first, Some("motion" | "repeat"))
}

/// True if this lexeme delimits a statement or the contents of braces.
fn ends_piece(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::Open(b'{') | Kind::Close(b'}') | Kind::Mark(b';')
    )
}

/// True if a brace after these lexemes opens a piece of a formula: after `else`, or after `if` and a condition.
pub(super) fn opens_piece(text: &str, before: &[Lexeme]) -> bool {
    let mut condition = before.iter().rev().take_while(|it| !ends_piece(it.kind));
    condition.any(|lexeme| matches!(word(text, lexeme), Some("if" | "else")))
}

/// True if a line that looks like a statement starts here: a keyword and a name, or `word name? (`.
pub(super) fn looks_like_statement(text: &str, lexemes: &[Lexeme]) -> bool {
    let [first, second, rest @ ..] = lexemes else {
        return false;
    };
    let Some(name) = word(text, first) else {
        return false;
    };
    if !first.first_on_line || second.first_on_line || CONTINUATIONS.contains(&name) {
        return false;
    }
    let is_name = |it: &Lexeme| matches!(it.kind, Kind::Word | Kind::Number);
    let opens = |it: &Lexeme| it.kind == Kind::Open(b'(') && !it.first_on_line;
    KEYWORDS.contains(&name) && is_name(second)
        || opens(second)
        || is_name(second) && behind_indices(rest).first().is_some_and(opens)
}

/// Returns the lexemes after the indices of a name.
fn behind_indices(mut lexemes: &[Lexeme]) -> &[Lexeme] {
    while let [
        Lexeme {
            kind: Kind::Open(b'['),
            ..
        },
        inside @ ..,
    ] = lexemes
        && let Some(end) = inside.iter().position(|it| it.kind == Kind::Close(b']'))
    {
        lexemes = &inside[end + 1..];
    }
    lexemes
}

/// True if a line after this lexeme continues the previous line.
pub(super) fn continues_after(kind: Kind) -> bool {
    match kind {
        Kind::Open(bracket) => bracket != b'{',
        Kind::Mark(mark) => mark != b';',
        Kind::Word | Kind::Number | Kind::Text | Kind::Close(_) => false,
    }
}
