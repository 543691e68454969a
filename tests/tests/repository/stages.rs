//! Checks values at stage boundaries: only the pool grows, no stage copies a system in order to change the copy, and one module
//! plans and lowers.

use std::fs;

use linkwright_tests::files;
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Packages whose code takes the values of the stages.
const FOLDERS: [&str; 8] = [
    "codegen/description/src",
    "codegen/program/src",
    "codegen/src",
    "codegen/solver/src",
    "codegen/calibrate/src",
    "codegen/editing/src",
    "codegen/page/src",
    "codegen/command/src",
];

/// The functions at the boundaries, each with its file.
const STAGES: [(&str, &str); 11] = [
    (
        "codegen/program/src/system/assemble.rs",
        "pub fn assemble(pool: &mut Pool, mechanism: Mechanism) -> System",
    ),
    (
        "codegen/program/src/structure/rank/marks.rs",
        "pub fn released(pool: &mut Pool, mut mechanism: Mechanism) -> System",
    ),
    (
        "codegen/program/src/structure/mod.rs",
        "pub fn analyze(pool: &Pool, system: &System) -> Diagnostics",
    ),
    (
        "codegen/program/src/structure/plan.rs",
        "pub fn plan(pool: &mut Pool, system: &System, shift: Shift) -> Result<SolvedPlan, Unplanned>",
    ),
    (
        "codegen/program/src/program/lower/mod.rs",
        "pub fn lower(pool: &mut Pool, system: &System, plan: &SolvedPlan, kept: Kept) -> Program",
    ),
    (
        FREEZE,
        "pub fn of(mut derived: Derived, shift: Shift, kept: Kept) -> Result<Solved, Unplanned>",
    ),
    (
        FREEZE,
        "pub fn of_plan(mut derived: Derived, plan: SolvedPlan, kept: Kept) -> Solved",
    ),
    // Fields that others could write would let the parts differ.
    (
        FREEZE,
        "pub struct Solved { derived: Derived, plan: SolvedPlan, program: Program, }",
    ),
    (
        "codegen/src/checks.rs",
        "pub fn findings_of(solved: &Solved) -> Result<Diagnostics, Diagnostics>",
    ),
    (
        "codegen/src/emit/language.rs",
        "fn(&[Solved], stem: &str, Form<'_>) -> Vec<String>",
    ),
    (
        "codegen/src/emit/derivation.rs",
        "pub fn of(derived: Derived, shift: Shift) -> Result<Derivation, Unplanned>",
    ),
];

/// Module that plans and lowers, and freezes the result.
const FREEZE: &str = "codegen/program/src/solved.rs";

/// Functions of the stages that only one module calls.
const CALLED_ONCE: [&str; 2] = ["plan", "lower"];

/// Tokens that no code may contain: they change a system in place, or copy one.
const FORBIDDEN: [&str; 4] = [
    "& mut System",
    "system . clone ()",
    "system () . clone ()",
    "System :: clone",
];

/// Returns the tokens of a text without comments and lifetimes, separated by spaces.
fn tokens(text: &str) -> String {
    fn write(stream: TokenStream, all: &mut Vec<String>) {
        let mut trees = stream.into_iter().peekable();
        while let Some(tree) = trees.next() {
            match tree {
                TokenTree::Group(group) => {
                    let (open, close) = match group.delimiter() {
                        Delimiter::Parenthesis => ("(", ")"),
                        Delimiter::Brace => ("{", "}"),
                        Delimiter::Bracket => ("[", "]"),
                        Delimiter::None => ("", ""),
                    };
                    if group.stream().is_empty() {
                        all.push(format!("{open}{close}"));
                        continue;
                    }
                    all.push(open.to_string());
                    write(group.stream(), all);
                    all.push(close.to_string());
                }
                TokenTree::Punct(it) if it.as_char() == '\'' => drop(trees.next()),
                TokenTree::Punct(it) if it.as_char() == ':' => {
                    let is_pair = matches!(trees.peek(), Some(TokenTree::Punct(next)) if next.as_char() == ':');
                    if is_pair {
                        trees.next();
                    }
                    all.push(if is_pair { "::" } else { ":" }.to_string());
                }
                other => all.push(other.to_string()),
            }
        }
    }
    let mut all = Vec::new();
    write(text.parse().expect("tokens of Rust"), &mut all);
    all.join(" ")
}

/// Returns the forbidden tokens in a text.
fn violations(text: &str) -> Vec<&'static str> {
    let tokens = format!(" {} ", tokens(text));
    let is_held = |it: &&str| tokens.contains(&format!(" {it} "));
    FORBIDDEN.into_iter().filter(is_held).collect()
}

#[test]
fn no_system_is_changed_or_copied() {
    for folder in FOLDERS {
        for path in files::below(&files::repository().join(folder), "rs", &[]) {
            let text = fs::read_to_string(&path).expect("a source file");
            // Systems of linear equations are other values.
            if !text.contains("System") {
                continue;
            }
            let violations = violations(&text);
            assert!(
                violations.is_empty(),
                "{} contains {violations:?}",
                path.display()
            );
        }
    }
}

/// Returns the functions of stages that a text calls, once for each call.
fn calls(text: &str) -> Vec<&'static str> {
    let tokens = tokens(text);
    let words: Vec<&str> = tokens.split(' ').collect();
    let mut calls = Vec::new();
    for (place, pair) in words.windows(2).enumerate() {
        let before = place.checked_sub(1).map_or("", |it| words[it]);
        // A method of this name is another function, and so is a definition.
        let is_call = pair[1].starts_with('(') && before != "." && before != "fn";
        calls.extend(
            CALLED_ONCE
                .into_iter()
                .filter(|&it| is_call && it == pair[0]),
        );
    }
    calls
}

#[test]
fn one_module_plans_and_lowers() {
    let mut places = Vec::new();
    for folder in FOLDERS {
        for path in files::below(&files::repository().join(folder), "rs", &[]) {
            let text = fs::read_to_string(&path).expect("a source file");
            let calls = calls(&text);
            if path.ends_with(FREEZE) {
                assert_eq!(calls, CALLED_ONCE);
            } else {
                let calls = calls.into_iter();
                places.extend(calls.map(|it| format!("{} calls `{it}`", path.display())));
            }
        }
    }
    assert!(places.is_empty(), "{places:#?}");
}

#[test]
fn calls_of_stages_are_found() {
    assert_eq!(
        calls("fn f() { let it = structure::plan(&mut pool, system); }"),
        ["plan"]
    );
    assert_eq!(
        calls("fn f() { it.map(|plan| lower(pool, plan)).plan(); }"),
        ["lower"]
    );
    assert!(calls("pub fn plan(pool: &mut Pool) {} // plan(pool)").is_empty());
    assert!(calls("fn f(view: &View) { let plan = view.plan(); }").is_empty());
}

#[test]
fn stages_take_a_pool_and_return_a_value() {
    for (file, signature) in STAGES {
        let text = fs::read_to_string(files::repository().join(file)).expect("a source file");
        // The layout of a long signature ends in a comma.
        let text = tokens(&text).replace(", )", ")");
        assert!(
            text.contains(&tokens(signature)),
            "{file} has no `{signature}`"
        );
    }
}

#[test]
fn a_change_and_a_copy_of_a_system_are_found() {
    assert_eq!(violations("fn f(it: &mut System) {}"), ["& mut System"]);
    assert_eq!(
        violations("struct It<'a> { system: &'a mut System }"),
        ["& mut System"]
    );
    assert_eq!(
        violations("let mut own = self.system.clone();"),
        ["system . clone ()"]
    );
    assert_eq!(
        violations("let own = view\n    .system()\n    .clone();"),
        ["system () . clone ()"]
    );
    assert!(violations("fn f(pool: &mut Pool, system: &System) {} // &mut System").is_empty());
}
