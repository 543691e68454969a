//! Tokens of every description of the repository, whole and damaged: in order, without overlaps, between whole letters, and around
//! everything that is a word or a number.

use std::fs;

use linkwright_editing::{TokenKind, tokens};
use linkwright_tests::files;
use linkwright_tests::random::Random;

/// Seed of the damages.
const SEED: u64 = 0x636f_6c6f;

/// Number of damages of each text.
const DAMAGES: usize = 20;

/// Pieces that damage a text.
const PIECES: [&str; 12] = [
    "\"", "/*", "*/", "//", "///", "{", ")", "°", "€", "1e", "0x", "\r",
];

/// Number of words and numbers of ASCII that belong to no token.
fn uncovered(text: &str) -> usize {
    let all = tokens(text);
    let mut end = 0;
    let mut count = 0;
    let is_word = |it: u8| it.is_ascii_alphanumeric();
    for token in &all {
        let range = token.span.range();
        assert!(end <= range.start && range.start < range.end, "{text}");
        assert!(text.get(range.clone()).is_some(), "{text}");
        count += text[end..range.start]
            .bytes()
            .filter(|it| is_word(*it))
            .count();
        end = range.end;
    }
    count + text[end..].bytes().filter(|it| is_word(*it)).count()
}

#[test]
fn every_text_has_tokens() {
    let mut random = Random::new(SEED);
    let mut texts = 0;
    for path in files::below(&files::repository(), "mech", &["target", ".git"]) {
        let text = fs::read_to_string(&path).unwrap_or_default();
        let boundaries = text.char_indices().map(|(at, _)| at);
        let boundaries: Vec<usize> = boundaries.chain([text.len()]).collect();
        assert_eq!(uncovered(&text), 0, "{}", path.display());
        texts += 1;
        for _ in 0..DAMAGES {
            let mut at = || boundaries[(random.bits() % boundaries.len() as u64) as usize];
            let mut places = [at(), at()];
            places.sort_unstable();
            let [start, end] = places;
            let piece = PIECES[(random.bits() % PIECES.len() as u64) as usize];
            let cut = format!("{}{piece}{}", &text[..start], &text[end..]);
            let inserted = format!("{}{piece}{}", &text[..start], &text[start..]);
            for damaged in [cut, inserted] {
                assert_eq!(uncovered(&damaged), 0, "{damaged}");
                texts += 1;
            }
        }
    }
    println!("{texts} texts");
    assert!(texts > 10_000);
}

/// The first word of every statement of a description without errors is a keyword, and no unit is anything else.
#[test]
fn statements_begin_with_keywords() {
    for path in files::with_extension(&files::package("../mechanisms"), "mech") {
        let text = fs::read_to_string(&path).expect("a description");
        let all = tokens(&text);
        let code = |kind: TokenKind| !matches!(kind, TokenKind::Comment | TokenKind::Documentation);
        let all: Vec<_> = all.into_iter().filter(|it| code(it.kind)).collect();
        for pair in all.windows(2) {
            let [before, token] = [&pair[0], &pair[1]].map(|it| &text[it.span.range()]);
            if before == ";" && token != "}" {
                assert_eq!(
                    pair[1].kind,
                    TokenKind::Keyword,
                    "{token} in {}",
                    path.display()
                );
            }
        }
    }
}
