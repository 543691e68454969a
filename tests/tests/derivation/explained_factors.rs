//! Factors of closed forms in generated code are explained where they are computed, in Rust and in C.

use linkwright_codegen::{Language, Options, generate};
use linkwright_tests::description;

/// Longest line, in characters.
const MAX_LINE_LENGTH: usize = 120;

/// Words of a comment, and the names of the values that it explains.
const EXPLAINED: [(&str, &[&str]); 3] = [
    (": forward along ", &["inverse", "forward", "sideways"]),
    (
        "Cramer's rule for two unknowns: inverse = 1/determinant",
        &["inverse"],
    ),
    ("Inverse of the 2 x 2 matrix of slopes", &["inverse"]),
];

/// Name that a line gives a value, without the number that tells it from others: `forward` of `let forward_2 = …`.
fn named(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let declared = ["let ", "const double ", "const float "];
    let rest = declared.iter().find_map(|it| line.strip_prefix(it))?;
    let name = rest.split(" = ").next()?;
    let end = name.trim_end_matches(|it: char| it.is_ascii_digit());
    Some(end.strip_suffix('_').unwrap_or(name))
}

/// Checks a file; the number of its explained factors.
fn explained(name: &str, text: &str) -> usize {
    let lines: Vec<&str> = text.lines().collect();
    let mut count = 0;
    for (place, line) in lines.iter().enumerate() {
        let comment = EXPLAINED.iter().find(|(words, _)| line.contains(words));
        if let Some((_, names)) = comment {
            assert!(line.chars().count() <= MAX_LINE_LENGTH, "{name}: {line}");
            let next = named(lines[place + 1]).unwrap_or_default();
            assert!(names.contains(&next), "{name}: {line} before {next}");
        }
        if named(line) == Some("forward") {
            count += 1;
            let before = lines[place.saturating_sub(2)..place].iter();
            let is_explained = before.clone().any(|it| it.contains(": forward along "));
            assert!(is_explained, "{name}: no comment before {line}");
        }
    }
    count
}

#[test]
fn components_of_links_are_explained_where_they_are_computed() {
    for language in [Language::Rust, Language::C] {
        let count: usize = description::names()
            .iter()
            .map(|name| {
                let source = description::source(name);
                let options = Options {
                    language,
                    ..Options::default()
                };
                let generated = generate(&source, &options);
                let generated =
                    generated.unwrap_or_else(|found| panic!("{}", found.render(&source)));
                let files = generated.files.iter();
                files.map(|it| explained(name, &it.text)).sum::<usize>()
            })
            .sum();
        // One dyad for each gallery mechanism that has one, at least.
        assert!(count > 10, "{count}");
    }
}
