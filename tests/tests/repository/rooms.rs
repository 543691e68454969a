//! Order of the generator's modules, and of the packages: each imports only modules named before it.

use std::fs;

use linkwright_tests::files;
use linkwright_tests::prose::lines;

/// Folders of the generator's packages, each with its modules, in the order of the pipeline.
pub(super) const ORDER: [(&str, &[&str]); 3] = [
    (
        "codegen/description/src",
        &[
            "units",
            "diagnostic",
            "columns",
            "syntax",
            "format",
            "consequences",
            "expr",
            "joint",
            "force",
            "pool",
            "model",
        ],
    ),
    (
        "codegen/program/src",
        &[
            "system",
            "structure",
            "words",
            "program",
            "solved",
            "assemblies",
            "closing",
            "finiteness",
            "modes",
        ],
    ),
    (
        "codegen/src",
        &[
            "emit", "checks", "lanes", "read", "files", "stages", "cargo", "lib",
        ],
    ),
];

/// Folder of the solver with its modules; each imports only modules named before it.
const SOLVER: (&str, &[&str]) = (
    "codegen/solver/src",
    &[
        "comparison",
        "condition",
        "number",
        "product",
        "operation",
        "ranges",
        "newton",
        "rates",
        "schedule",
        "sets",
        "singular_participants",
        "supplied",
        "instant",
        "emitted",
        "derivatives",
        "reader",
        "friction",
        "forces",
        "reported",
        "measures",
        "pressure",
        "residuals",
        "textbook",
        "first_step",
        "tolerances",
        "dormand_prince",
        "radau",
        "view",
        "approach",
        "losses",
        "motors",
        "measure_watch",
        "checked_part",
        "dense",
        "drawn",
        "observable",
        "data",
        "interpreted",
        "not_finite",
        "batch",
        "open_loop",
        "opened",
        "stack_up",
        "proof",
        "search",
        "every_pose",
        "known_poses",
        "assemblies",
        "explained",
        "mode_selection",
        "trajectory",
        "moved",
        "simulation",
        "equilibrium",
        "warnings",
        "check",
        "travel",
        "full_turn",
        "lib",
    ],
);

/// Folders of the packages that are published, each with our packages from which it is built.
const PACKAGES: [(&str, &[&str]); 13] = [
    ("runtime/math", &[]),
    ("runtime", &["linkwright-math"]),
    ("codegen/description", &["linkwright-math"]),
    (
        "codegen/program",
        &["linkwright-description", "linkwright-math"],
    ),
    ("codegen", &["linkwright-description", "linkwright-program"]),
    (
        "codegen/solver",
        &["linkwright", "linkwright-codegen", "linkwright-math"],
    ),
    (
        "codegen/calibrate",
        &["linkwright", "linkwright-codegen", "linkwright-solver"],
    ),
    ("codegen/editing", &["linkwright-codegen"]),
    (
        "codegen/page",
        &["linkwright", "linkwright-codegen", "linkwright-solver"],
    ),
    (
        "codegen/command",
        &[
            "linkwright",
            "linkwright-calibrate",
            "linkwright-codegen",
            "linkwright-editing",
            "linkwright-page",
            "linkwright-solver",
        ],
    ),
    ("codegen/cli", &["linkwright-command"]),
    ("codegen/macros", &["linkwright-codegen"]),
    ("mechanisms", &["linkwright", "linkwright-codegen"]),
];

/// Modules of the generator in one order.
fn generator() -> Vec<&'static str> {
    ORDER
        .iter()
        .flat_map(|(_, rooms)| *rooms)
        .copied()
        .collect()
}

fn rank(rooms: &[&str], room: &str) -> Option<usize> {
    rooms.iter().position(|it| *it == room)
}

/// Names after `crate::`: one, or several in braces, which may stand on several lines. Exports of `lib.rs` itself
/// count as `lib`.
fn imported(rooms: &[&str], text: &str) -> Vec<String> {
    let code: String = lines(text).into_iter().map(|it| it.code + "\n").collect();
    let mut names = Vec::new();
    for (at, path) in code.match_indices("crate::") {
        let rest = &code[at + path.len()..];
        let items = match rest.strip_prefix('{') {
            Some(list) => items(list),
            None => vec![rest],
        };
        for item in items {
            let name: String = item
                .trim()
                .chars()
                .take_while(|it| it.is_alphanumeric() || *it == '_')
                .collect();
            if !name.is_empty() {
                names.push(if rank(rooms, &name).is_some() {
                    name
                } else {
                    "lib".to_string()
                });
            }
        }
    }
    names
}

/// Items of a list up to its closing brace, with nested lists inside them.
fn items(list: &str) -> Vec<&str> {
    let (mut depth, mut start, mut found) = (0, 0, Vec::new());
    for (at, it) in list.char_indices() {
        match it {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            '}' => {
                found.push(&list[start..at]);
                break;
            }
            ',' if depth == 0 => {
                found.push(&list[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    found
}

/// Imports of `text` in the module `room` that are against the order of `rooms`.
fn violations(rooms: &[&str], room: &str, text: &str) -> Vec<String> {
    let room_rank =
        rank(rooms, room).unwrap_or_else(|| panic!("the room {room} has no place in the order"));
    // The build script's front end calls `generate`: the only one that looks up to `lib.rs`.
    let allowed = |name: &str| {
        rank(rooms, name) < Some(room_rank) || name == room || (room == "cargo" && name == "lib")
    };
    imported(rooms, text)
        .into_iter()
        .filter(|name| !allowed(name))
        .collect()
}

/// Our packages in those tables of a manifest that a user's build compiles.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut counts = false;
    let mut names = Vec::new();
    for line in manifest.lines() {
        if let Some(table) = line.strip_prefix('[') {
            counts = table.starts_with("dependencies") || table.starts_with("build-dependencies");
        } else if counts && line.starts_with("linkwright") {
            let name = line.split(['.', ' ', '=']).next().unwrap_or(line);
            names.push(name.to_string());
        }
    }
    names.sort();
    names
}

#[test]
fn a_room_imports_only_rooms_named_before_it() {
    let mut folders = ORDER
        .map(|(folder, own)| (folder, own, generator()))
        .to_vec();
    folders.push((SOLVER.0, SOLVER.1, SOLVER.1.to_vec()));
    for (folder, order, rooms_of_all) in folders {
        let root = files::repository().join(folder);
        let mut rooms = Vec::new();
        for path in files::below(&root, "rs", &[]) {
            let relative = path.strip_prefix(&root).expect("a path in the folder");
            let first = relative
                .components()
                .next()
                .and_then(|it| it.as_os_str().to_str())
                .expect("a name");
            let room = first.trim_end_matches(".rs").to_string();
            // Every package has a `lib.rs`.
            assert!(
                room == "lib" || order.contains(&room.as_str()),
                "{folder} has no place for the room {room}"
            );
            let text = fs::read_to_string(&path).expect("a source file");
            let wrong_imports = violations(&rooms_of_all, &room, &text);
            assert!(
                wrong_imports.is_empty(),
                "{} imports {wrong_imports:?}",
                path.display()
            );
            rooms.push(room);
        }
        for room in order {
            assert!(
                rooms.iter().any(|it| it == room),
                "the room {room} does not exist in {folder}"
            );
        }
    }
}

#[test]
fn a_package_is_built_only_from_those_below_it() {
    for (folder, expected) in PACKAGES {
        let manifest = files::repository().join(folder).join("Cargo.toml");
        let text = fs::read_to_string(&manifest).expect("a manifest");
        assert_eq!(dependencies(&text), expected, "{folder}");
    }
}

#[test]
fn an_import_against_the_order_is_found() {
    let violations = |room: &str, text: &str| violations(&generator(), room, text);
    assert_eq!(
        violations("expr", "use crate::{diagnostic::Span, model};"),
        ["model"]
    );
    assert_eq!(
        violations(
            "words",
            "use crate::{\n    expr::{Graph, ExprId},\n    program::{self, forms},\n    emit,\n};"
        ),
        ["program", "emit"]
    );
    assert_eq!(
        violations("syntax", "    let it = crate::emit::text::formula();"),
        ["emit"]
    );
    assert_eq!(violations("model", "use crate::generate;"), ["lib"]);
    assert!(violations("model", "use crate::expr::Graph; // not crate::emit").is_empty());
}
