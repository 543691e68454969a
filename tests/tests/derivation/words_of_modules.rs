//! Reads every generated module: words that the glossary replaced do not come back, and C is ASCII.

use linkwright_codegen::{Language, Options, generate};
use linkwright_tests::description;

/// Identifiers that have other names now.
const REPLACED: [&str; 16] = [
    "Tube",
    "Tubes",
    "tubes",
    "sag",
    "Span",
    "bend",
    "ways",
    "keeps_to_path",
    "stays_regular",
    "spans",
    "no_span",
    "isolation_asks",
    "DRAWN",
    "Explained",
    "assemble_from_afar",
    "room",
];

/// Parts of identifiers, between underscores, that have other names now.
const REPLACED_PARTS: [&str; 8] = [
    "sag", "bow", "way", "strayed", "stray", "stretch", "pull", "DRAWN",
];

/// Identifiers of code, without comments and strings.
fn identifiers(code: &str) -> Vec<String> {
    let lines = linkwright_tests::prose::lines(code);
    let words = lines.iter().flat_map(|line| {
        let is_word = |it: char| it.is_alphanumeric() || it == '_';
        line.code.split(move |it| !is_word(it)).map(str::to_string)
    });
    words.filter(|it| !it.is_empty()).collect()
}

/// Identifiers of a module that have other names now, but for those that the description itself writes.
fn replaced(code: &str, described: &[String]) -> Vec<String> {
    let mut replaced = identifiers(code);
    replaced.retain(|word| {
        let is_part = |part: &str| REPLACED_PARTS.contains(&part);
        let is_replaced = REPLACED.contains(&word.as_str()) || word.split('_').any(is_part);
        is_replaced && !described.iter().any(|own| word.contains(own.as_str()))
    });
    replaced.sort_unstable();
    replaced.dedup();
    replaced
}

#[test]
fn modules_have_the_words_of_the_glossary() {
    for name in description::whole() {
        let source = description::source(&name);
        let described: Vec<String> = identifiers(&source.text)
            .into_iter()
            .filter(|it| it.split('_').any(|part| REPLACED_PARTS.contains(&part)))
            .collect();
        for language in [Language::Rust, Language::C] {
            let options = Options {
                language,
                ..Options::default()
            };
            let files = generate(&source, &options);
            let files = files.unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
            for file in files.files {
                let is_ascii = language == Language::Rust || file.text.is_ascii();
                assert!(is_ascii, "{name}, {}", file.name);
                // The runtime is the same for all.
                if !file.name.starts_with("linkwright.") {
                    let words = replaced(&file.text, &described);
                    assert!(words.is_empty(), "{name}, {}: {words:?}", file.name);
                }
            }
        }
    }
}

#[test]
fn replaced_words_are_found() {
    let code = "let phi_sag = 1.0; // sag\nfn keeps_to_path() {}\nlet sagging = way_out;";
    assert_eq!(replaced(code, &[]), ["keeps_to_path", "phi_sag", "way_out"]);
    assert!(replaced("let way_out = 1.0;", &["way_out".to_string()]).is_empty());
}
