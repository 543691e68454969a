//! The words of the grammar with which editors color descriptions are those of the language.
//!
//! `GRAMMAR_UPDATE=1` writes the lists; their patterns are written by hand, and tested beside the grammar.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use linkwright_codegen::stages::joint::{CONSTRAINTS, DRIVERS};
use linkwright_codegen::stages::model::{
    ENDS_OF_TABLES, FUNCTIONS, LAWS, MEASURE_FUNCTIONS, UNITS,
};
use linkwright_codegen::stages::syntax::{AXES, BUILT_IN, CLAUSES, KEYWORDS, LEVELS};
use serde_json::Value;

use crate::client::repository;

fn path() -> PathBuf {
    repository().join("codegen/editors/vscode/syntaxes/mech.tmLanguage.json")
}

/// Rules of the grammar whose words are a list of the language, with that list.
fn lists() -> Vec<(&'static str, Vec<&'static str>)> {
    let keyword = |it: &&'static linkwright_codegen::stages::joint::Kind| it.keyword;
    vec![
        ("statements", KEYWORDS.to_vec()),
        ("joints", CONSTRAINTS.iter().map(keyword).collect()),
        ("drivers", DRIVERS.iter().map(keyword).collect()),
        ("quantities", UNITS.to_vec()),
        ("functions", [FUNCTIONS, MEASURE_FUNCTIONS].concat()),
        ("laws", LAWS.to_vec()),
        ("coordinates", AXES.to_vec()),
        ("clauses", CLAUSES.to_vec()),
        ("levels", LEVELS.to_vec()),
        ("ends", ENDS_OF_TABLES.to_vec()),
        ("constants", BUILT_IN.to_vec()),
    ]
}

/// Pattern with another list in each of its groups of words, `(?:one|two)`.
fn with_words(pattern: &str, words: &str) -> String {
    let mut parts = pattern.split("(?:");
    let mut written = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let (inside, rest) = part.split_once(')').unwrap_or((part, ""));
        let is_list = inside.len() > 2
            && inside.split('|').all(|word| {
                !word.is_empty()
                    && word
                        .bytes()
                        .all(|it| it.is_ascii_alphanumeric() || it == b'_')
            });
        match is_list {
            true => written.push_str(&format!("(?:{words}){rest}")),
            false => written.push_str(&format!("(?:{part}")),
        }
    }
    written
}

#[test]
fn the_words_of_the_grammar_are_those_of_the_language() {
    let text = std::fs::read_to_string(path()).expect("the grammar");
    let mut grammar: Value = serde_json::from_str(&text).expect("JSON");
    for (rule, words) in lists() {
        let pattern = &mut grammar["repository"][rule]["match"];
        let written = pattern.as_str().expect(rule).to_string();
        let words = words.join("|");
        let expected = with_words(&written, &words);
        assert!(expected.contains(&words), "{rule} has no list of words");
        *pattern = expected.into();
    }
    let expected = serde_json::to_string_pretty(&grammar).expect("JSON") + "\n";
    if std::env::var_os("GRAMMAR_UPDATE").is_some() {
        std::fs::write(path(), &expected).expect("the grammar can be written");
    } else {
        assert_eq!(text, expected, "GRAMMAR_UPDATE=1 writes the lists");
    }
}

/// Files in a folder and in all its folders.
fn texts(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|it| it.expect("it can be read").path());
    let of = |path: PathBuf| match path.is_dir() {
        true => texts(&path),
        false => std::fs::read_to_string(&path).into_iter().collect(),
    };
    paths.flat_map(of).collect()
}

/// The list of keywords contains every keyword that the parser expects.
#[test]
fn every_word_of_a_clause_is_listed() {
    let folder = repository().join("codegen/description/src/syntax");
    let mut words = BTreeSet::new();
    for text in texts(&folder) {
        let keywords = text.split("keyword(\"").skip(1);
        words.extend(keywords.filter_map(|it| Some(it.split_once('"')?.0.to_string())));
    }
    words.remove("mechanism");
    let listed: BTreeSet<String> = CLAUSES.iter().map(ToString::to_string).collect();
    assert!(
        words.is_subset(&listed),
        "{words:?} are not all in {listed:?}"
    );
    // The parser reads those of springs, masses, teeth, motors and friction in another way.
    let others = &listed - &words;
    let others: Vec<&str> = others.iter().map(String::as_str).collect();
    let expected = [
        "efficiency",
        "free",
        "gear",
        "inertia",
        "over",
        "preload",
        "pressure_angle",
        "radius",
    ];
    assert_eq!(others, expected);
}
