//! Counts what the prose of each source file should not have. Counts may only fall, and are zero for new files.
//!
//! The rules are those of `codegen/CONTRIBUTING.md`. `ENGLISH_UPDATE=1` writes counts that have fallen to `tests/english.txt`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;

use linkwright_tests::files;
use linkwright_tests::prose::{Line, lines};

/// Words that no doc comment begins with.
const OPENINGS: [&str; 8] = [
    "What", "How", "Whether", "Where", "Who", "Why", "Which", "The same",
];

/// Phrases that comments and texts do without.
const PHRASES: [&str; 9] = [
    "whoever",
    "nobody",
    "somebody",
    "a person",
    "as long as",
    "does not know",
    "Deliberately unknown",
    "is no",
    "are no",
];

/// Names of values that say nothing of their contents.
const VALUES: [&str; 7] = ["found", "own", "wanted", "asked", "given", "said", "shown"];

/// Constants named by adjectives.
const ADJECTIVES: [&str; 24] = [
    "ALIKE",
    "APART",
    "CLOSE",
    "EXACT",
    "FAR",
    "FEWEST",
    "FLAT",
    "FREE",
    "KEPT",
    "LARGE",
    "LARGEST",
    "LISTED",
    "LONGEST",
    "MOST",
    "NARROW",
    "NEAR",
    "NEGLIGIBLE",
    "PLAIN",
    "SAME",
    "SHORT",
    "SHOWN",
    "SMALLEST",
    "STILL",
    "VANISHED",
];

/// Words of a sentence at most.
const LONGEST_SENTENCE: usize = 35;

/// Folders without sources of ours.
const SKIPPED: [&str; 4] = ["target", "node_modules", "snapshots", "corpus"];

/// Positions at which a phrase stands as whole words.
fn whole_words<'a>(text: &'a str, phrase: &'a str) -> impl Iterator<Item = usize> + 'a {
    let is_word = |it: char| it.is_alphanumeric() || it == '_';
    text.match_indices(phrase).filter_map(move |(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + phrase.len()..].chars().next();
        let is_whole = !before.is_some_and(is_word) && !after.is_some_and(is_word);
        is_whole.then_some(at)
    })
}

fn phrases(text: &str) -> usize {
    let count = |phrase: &&str| {
        let places = whole_words(text, phrase);
        places
            .filter(|at| !text[at + phrase.len()..].trim_start().starts_with("longer"))
            .count()
    };
    PHRASES.iter().map(count).sum()
}

fn starts_with_words(text: &str, words: &str) -> bool {
    whole_words(text, words).next() == Some(0)
}

/// Doc blocks that begin with a question word.
fn openings(lines: &[Line]) -> usize {
    let is_doc = |it: &Line| matches!(it.marks, "///" | "//!");
    let begins = |at: &usize| {
        at.checked_sub(1)
            .is_none_or(|at| lines[at].marks != lines[at + 1].marks)
    };
    (0..lines.len())
        .filter(|at| is_doc(&lines[*at]) && begins(at))
        .filter(|at| {
            let text = lines[*at].comment.trim_start_matches([' ', '*']);
            OPENINGS.iter().any(|it| starts_with_words(text, it))
        })
        .count()
}

/// Arrows in the head of a module, but for those of a diagram.
fn arrows(lines: &[Line]) -> usize {
    let head = lines.iter().take_while(|it| it.marks == "//!");
    let mut is_diagram = false;
    head.filter(|it| {
        is_diagram ^= it.comment.trim_start().starts_with("```");
        !is_diagram && it.comment.contains('→')
    })
    .count()
}

/// Names in code that say nothing.
fn names(code: &str) -> usize {
    let of_value = |name: &str| {
        ["let ", "let mut "]
            .into_iter()
            .any(|it| whole_words(code, &format!("{it}{name}")).next().is_some())
    };
    let of_constant = |name: &str| whole_words(code, &format!("const {name}")).next().is_some();
    let is_question = ["fn what_", "fn how_"].iter().any(|it| code.contains(it));
    VALUES.iter().filter(|it| of_value(it)).count()
        + ADJECTIVES.iter().filter(|it| of_constant(it)).count()
        + usize::from(is_question)
}

/// Sentences of comments that are too long; those with code, tables and lists do not count.
fn long_sentences(lines: &[Line]) -> usize {
    let mut blocks: Vec<String> = vec![String::new()];
    let mut marks = "";
    for line in lines {
        let text = line.comment.trim();
        let is_apart = line.marks != marks || text.is_empty();
        if is_apart || text.starts_with(['|', '-', '*', '#', '`']) {
            blocks.push(String::new());
        }
        marks = line.marks;
        if let Some(block) = blocks.last_mut() {
            block.push_str(text);
            block.push(' ');
        }
    }
    let sentences = blocks
        .iter()
        .flat_map(|it| it.split(['.', ':', ';', '!', '?']).map(str::trim));
    sentences
        .filter(|it| !it.contains(['`', '|', '=']))
        .filter(|it| it.split_whitespace().count() > LONGEST_SENTENCE)
        .count()
}

fn faults(source: &str) -> usize {
    let lines = lines(source);
    let in_lines = lines
        .iter()
        .map(|it| phrases(&it.comment) + phrases(&it.strings) + names(&it.code));
    in_lines.sum::<usize>() + openings(&lines) + arrows(&lines) + long_sentences(&lines)
}

/// Files with faults, by their paths in the repository.
fn counted() -> BTreeMap<String, usize> {
    let root = files::repository();
    let folders = ["codegen", "runtime", "mechanisms", "tests"];
    let paths = folders.iter().flat_map(|folder| {
        let extensions = ["rs", "h", "c"].into_iter();
        let folder = root.join(folder);
        extensions.flat_map(move |it| files::below(&folder, it, &SKIPPED))
    });
    let own = |path: &std::path::Path| path.ends_with("tests/tests/repository/english.rs");
    paths
        .filter(|path| !own(path))
        .map(|path| {
            let text = fs::read_to_string(&path).expect("a source file");
            let relative = path.strip_prefix(&root).expect("a file of the repository");
            let name = relative.to_string_lossy().replace('\\', "/");
            (name, faults(&text))
        })
        .filter(|(_, count)| *count > 0)
        .collect()
}

#[test]
fn faults_only_become_fewer() {
    let path = files::package("english.txt");
    let written = fs::read_to_string(&path).unwrap_or_default();
    let known: BTreeMap<&str, usize> = written
        .lines()
        .filter_map(|line| line.split_once(' '))
        .filter_map(|(count, name)| Some((name, count.parse().ok()?)))
        .collect();
    let now = counted();
    let more: Vec<String> = now
        .iter()
        .filter_map(|(name, count)| {
            let before = known.get(name.as_str()).copied().unwrap_or(0);
            (*count > before).then(|| format!("{name}: {count} faults, {before} before"))
        })
        .collect();
    assert!(more.is_empty(), "{}", more.join("\n"));
    let mut text = String::new();
    for (name, count) in &now {
        let _ = writeln!(text, "{count} {name}");
    }
    if std::env::var_os("ENGLISH_UPDATE").is_some() {
        fs::write(&path, text).expect("the counts are written");
    } else {
        assert_eq!(text, written, "`ENGLISH_UPDATE=1` writes the new counts");
    }
}

#[test]
fn each_fault_is_found() {
    for (source, count) in [
        ("/// What it is.\n/// How it is.\n", 1),
        ("//! *Text* → *numbers*.\n//! ```\n//! a → b\n//! ```\n", 1),
        ("// There is no room for nobody.\n", 2),
        ("// It is no longer used.\n", 0),
        ("let found = \"as long as\";\n", 2),
        ("fn what_moves() {}\nconst LARGE: f64 = 1.0;\n", 2),
        ("let founded = owner;\n/// Whatever.\n", 0),
    ] {
        assert_eq!(faults(source), count, "{source}");
    }
    let long = format!("// {}\n", "word ".repeat(LONGEST_SENTENCE + 1));
    assert_eq!(faults(&long), 1);
}

#[test]
fn comments_and_strings_are_apart_from_code() {
    let source = "let a = \"not // one\"; // but \"this\"\n/// `'` in a doc\nlet b: &'a str = r#\"x \"y\"\"#;\n\
                  let c = '\"'; /* one\n two */ let d = '\\'';";
    let found = lines(source);
    let code: Vec<&str> = found.iter().map(|it| it.code.trim()).collect();
    assert_eq!(
        code,
        [
            "let a = \"\";",
            "",
            "let b: &'a str = \"\";",
            "let c = ' ';",
            "let d = ' ';"
        ]
    );
    let comments: Vec<&str> = found.iter().map(|it| it.comment.trim()).collect();
    assert_eq!(comments, ["but \"this\"", "`'` in a doc", "", "one", "two"]);
    assert_eq!(found[0].strings, "not // one\n");
    assert_eq!(found[2].strings, "x \"y\"\n");
    assert_eq!(
        [found[0].marks, found[1].marks, found[4].marks],
        ["//", "///", "/*"]
    );
}
