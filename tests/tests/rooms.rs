//! The order of the generator's rooms: a room imports only rooms named before it.

use std::fs;
use std::path::{Path, PathBuf};

use linkwright_tests::files;

/// The rooms in the order of the pipeline.
const ORDER: [&str; 12] = [
    "diagnostic",
    "syntax",
    "consequences",
    "expr",
    "joint",
    "model",
    "system",
    "structure",
    "program",
    "emit",
    "cargo",
    "lib",
];

fn rank(room: &str) -> Option<usize> {
    ORDER.iter().position(|it| *it == room)
}

/// The Rust files of a folder and all folders in it.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    found.extend(files::with_extension(folder, "rs"));
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("a listed file").path();
        if path.is_dir() {
            sources(&path, found);
        }
    }
}

/// The names after `crate::` in a line: one, or several in braces. What is exported by `lib.rs` itself counts as `lib`.
fn imported(line: &str) -> Vec<String> {
    let code = line.split("//").next().unwrap_or(line);
    let mut names = Vec::new();
    for (at, path) in code.match_indices("crate::") {
        let rest = &code[at + path.len()..];
        let listed = rest
            .strip_prefix('{')
            .map(|list| list.split('}').next().unwrap_or(list));
        for item in listed.unwrap_or(rest).split(',') {
            let name: String = item
                .trim()
                .chars()
                .take_while(|it| it.is_alphanumeric() || *it == '_')
                .collect();
            if !name.is_empty() {
                names.push(if rank(&name).is_some() {
                    name
                } else {
                    "lib".to_string()
                });
            }
            if listed.is_none() {
                break;
            }
        }
    }
    names
}

/// What `text` of the room `room` imports against the order.
fn violations(room: &str, text: &str) -> Vec<String> {
    let own = rank(room).unwrap_or_else(|| panic!("the room {room} has no place in the order"));
    // The build script's front end calls `generate`: the only one that looks up to `lib.rs`.
    let allowed =
        |name: &str| rank(name) < Some(own) || name == room || (room == "cargo" && name == "lib");
    text.lines()
        .flat_map(imported)
        .filter(|name| !allowed(name))
        .collect()
}

#[test]
fn a_room_imports_only_rooms_named_before_it() {
    let folder = files::repository().join("codegen/src");
    let mut paths = Vec::new();
    sources(&folder, &mut paths);
    let mut rooms = Vec::new();
    for path in &paths {
        let relative = path.strip_prefix(&folder).expect("a path in the folder");
        let first = relative
            .components()
            .next()
            .and_then(|it| it.as_os_str().to_str())
            .expect("a name");
        let room = first.trim_end_matches(".rs").to_string();
        let text = fs::read_to_string(path).expect("a source file");
        let found = violations(&room, &text);
        assert!(found.is_empty(), "{} imports {found:?}", relative.display());
        rooms.push(room);
    }
    for room in ORDER {
        assert!(
            rooms.iter().any(|it| it == room),
            "the room {room} does not exist"
        );
    }
}

#[test]
fn an_import_against_the_order_is_found() {
    assert_eq!(
        violations("expr", "use crate::{diagnostic::Span, model};"),
        ["model"]
    );
    assert_eq!(
        violations("syntax", "    let it = crate::emit::text::formula();"),
        ["emit"]
    );
    assert_eq!(violations("model", "use crate::generate;"), ["lib"]);
    assert!(violations("model", "use crate::expr::Graph; // not crate::emit").is_empty());
}
