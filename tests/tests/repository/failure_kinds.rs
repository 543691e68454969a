//! Checks that each kind of failure has its words and its number in two files, and a place that raises it.

use std::collections::BTreeSet;
use std::fs;

use linkwright_tests::files;

/// Lists of all kinds: with their meaning and words in Rust, and with their numbers and words in C.
const LISTS: [&str; 2] = ["codegen/src/emit/c/statuses.rs", "runtime/src/failure.rs"];

/// Kinds that no code tells from others, and the files that raise them, in Rust and in C.
const RAISED: [(&str, &[&str]); 3] = [
    (
        "Cycling",
        &[
            "codegen/src/emit/c/runtime/newton.c",
            "runtime/src/progress.rs",
        ],
    ),
    (
        "Diverged",
        &[
            "codegen/src/emit/c/runtime/newton.c",
            "runtime/src/progress.rs",
        ],
    ),
    (
        "Stalled",
        &[
            "codegen/src/emit/c/runtime/assembly.c",
            "codegen/src/emit/c/runtime/newton.c",
            "runtime/src/damped.rs",
            "runtime/src/progress.rs",
        ],
    ),
];

/// Files of the product that name a kind, by their paths in the repository.
fn naming(kind: &str) -> BTreeSet<String> {
    let in_c = format!("LINKWRIGHT_{}", kind.to_uppercase());
    let in_rust = [format!("FailureKind::{kind}"), format!("Self::{kind}")];
    let root = files::repository();
    let folders = ["codegen", "runtime", "mechanisms"].map(|it| root.join(it));
    let of = |extension: &str| {
        let skip = ["tests", "target", "node_modules"];
        let folders = folders.iter();
        let paths = folders.flat_map(|it| files::below(it, extension, &skip));
        paths.collect::<Vec<_>>()
    };
    ["rs", "c", "h"]
        .into_iter()
        .flat_map(of)
        .filter(|path| {
            let text = fs::read_to_string(path).expect("a source file");
            text.contains(&in_c) || in_rust.iter().any(|it| text.contains(it.as_str()))
        })
        .map(|path| {
            let path = path.strip_prefix(&root).expect("a path in the repository");
            path.display().to_string()
        })
        .collect()
}

#[test]
fn a_kind_of_failure_is_listed_in_two_files_and_named_where_it_is_raised() {
    for (kind, raised) in RAISED {
        let expected = LISTS.iter().chain(raised).map(|it| it.to_string());
        assert_eq!(naming(kind), expected.collect(), "{kind}");
    }
}

#[test]
fn a_kind_of_failure_has_one_name_in_all_languages() {
    let root = files::repository();
    let read = |path: &str| fs::read_to_string(root.join(path)).expect("a source file");
    let in_rust = read(LISTS[1]);
    let table = in_rust.split("fn spelled(").nth(1).expect("the names");
    let table = table.split("fn ").next().expect("an end");
    // Name and words take turns.
    let names = table.split('"').skip(1).step_by(4);
    let in_rust: BTreeSet<String> = names
        .map(|it| format!("LINKWRIGHT_{}", it.to_uppercase()))
        .collect();
    let in_c = read(LISTS[0]);
    let names = in_c
        .lines()
        .filter_map(|it| it.trim().strip_prefix("name: \""));
    let in_c: BTreeSet<String> = names
        .map(|it| it.trim_end_matches("\",").to_string())
        .collect();
    assert_eq!(in_rust.len(), 14);
    assert_eq!(in_rust, in_c);
}
