//! Measures the word or number at the start of a text, by the rules of Rust's lexer.

/// True for letters, with two exceptions that look like a degree sign or a power.
pub(super) fn starts_word(character: char) -> bool {
    character == '_' || character.is_alphabetic() && !matches!(character, 'º' | 'ª')
}

fn continues_word(character: char) -> bool {
    starts_word(character) || character.is_ascii_digit()
}

pub(super) fn word_length(text: &str) -> usize {
    text.find(|it| !continues_word(it)).unwrap_or(text.len())
}

/// Returns the length of a number with its unit by the rules of Rust's lexer: `1.P` is the number `1`, `1e-3mm` one number.
pub(super) fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .position(|it| !it.is_ascii_digit() && *it != b'_')
            .map_or(bytes.len(), |it| from + it)
    };
    let mut at = digits(0);
    if bytes.get(at) == Some(&b'.') {
        let next = text[at + 1..].chars().next();
        if !next.is_some_and(|it| it == '.' || starts_word(it)) {
            at = digits(at + 1);
        }
    }
    if let (Some(b'e' | b'E'), Some(b'+' | b'-'), Some(b'0'..=b'9')) =
        (bytes.get(at), bytes.get(at + 1), bytes.get(at + 2))
    {
        at = digits(at + 2);
    }
    at + word_length(&text[at..])
}
