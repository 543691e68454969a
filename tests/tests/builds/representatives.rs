//! Selects descriptions whose modules contain all that the modules of the others contain.
//!
//! Short sequences of tokens show how an emitter writes: the functions of the runtime that it calls, their operands, and the parts of its
//! statements. Of every description that is left out, each sequence of three tokens of its module in C is in the module of a
//! representative. Names of the mechanism, numbers and texts count as equal to one another. Rust is emitted from the same programs.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use linkwright_codegen::{Language, Options, generate};
use linkwright_tests::description;

/// Environment variable with which all descriptions are selected.
const ALL: &str = "LINKWRIGHT_ALL_MODULES";

/// Number of tokens in a sequence.
const LENGTH: usize = 3;

/// Descriptions with failures that come from their numbers, not from their statements: a pose that the guard cannot decide, and lengths
/// that are not positive.
const UNUSUAL: [&str; 5] = [
    "hauled",
    "parallelogram",
    "sliders_given",
    "weighed_given",
    "winch",
];

/// Words of C that generated code contains; all other words but those of the runtime name something of the mechanism.
const WORDS: [&str; 17] = [
    "bool", "break", "case", "const", "default", "double", "else", "fabs", "for", "if", "int",
    "return", "sizeof", "sqrt", "static", "switch", "while",
];

/// Names of all descriptions of the repository and of the tests that stand for the others, sorted in either group; with lanes, those with
/// closed forms. They are selected once in a process.
pub(super) fn representatives(lanes: bool) -> Vec<String> {
    static SELECTED: [OnceLock<Vec<String>>; 2] = [const { OnceLock::new() }; 2];
    let names = SELECTED[usize::from(lanes)].get_or_init(|| selected(lanes));
    names.clone()
}

fn selected(lanes: bool) -> Vec<String> {
    let names = [description::names(), description::of_tests()].concat();
    let module = |name: String| {
        let options = Options {
            language: Language::C,
            lanes,
            ..Options::default()
        };
        // Some descriptions have blocks of Newton-Raphson, which no lanes are written for.
        let generated = generate(&description::source(&name), &options).ok()?;
        Some((name, sequences(generated.code())))
    };
    let modules: Vec<_> = names.into_iter().filter_map(module).collect();
    let all = modules.len();
    let selected = match std::env::var_os(ALL) {
        Some(_) => modules.into_iter().map(|(name, _)| name).collect(),
        None => covering(modules),
    };
    println!("{} of {all} modules", selected.len());
    selected
}

/// Folder in which cargo builds packages of selected modules, which share the runtime with those of users.
pub(super) fn target_of_modules() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("built")
}

/// Names of modules that have all sequences of all modules, in the order of the modules. The last ones go first that others make
/// superfluous.
fn covering(modules: Vec<(String, HashSet<String>)>) -> Vec<String> {
    let mut counts = HashMap::<String, usize>::new();
    for sequence in modules.iter().flat_map(|(_, sequences)| sequences) {
        *counts.entry(sequence.clone()).or_default() += 1;
    }
    let mut names = Vec::new();
    for (name, sequences) in modules.into_iter().rev() {
        let is_alone = sequences.iter().any(|it| counts[it] == 1);
        if is_alone || UNUSUAL.contains(&name.as_str()) {
            names.push(name);
            continue;
        }
        for sequence in sequences {
            *counts.entry(sequence).or_default() -= 1;
        }
    }
    names.reverse();
    names
}

/// Sequences of tokens of a text in C.
fn sequences(text: &str) -> HashSet<String> {
    let tokens = tokens(text);
    tokens.windows(LENGTH).map(|it| it.join(" ")).collect()
}

/// Tokens of a text in C without its comments: a name of the mechanism is `x`, a number `0`.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let is_word = |it: char| it.is_alphanumeric() || it == '_';
        let (length, token) = if rest.starts_with("/*") {
            (rest.find("*/").map_or(rest.len(), |it| it + 2), None)
        } else if first.is_ascii_digit() {
            (number_length(rest), Some("0"))
        } else if is_word(first) {
            let end = rest.find(|it| !is_word(it)).unwrap_or(rest.len());
            let word = &rest[..end];
            let is_of_runtime = word.starts_with("linkwright") || word.starts_with("LINKWRIGHT");
            let is_kept = is_of_runtime || WORDS.contains(&word);
            (end, Some(if is_kept { word } else { "x" }))
        } else if first == '"' {
            let end = rest[1..].find('"').map_or(rest.len(), |it| it + 2);
            (end, Some("\"\""))
        } else {
            let end = first.len_utf8();
            (end, Some(&rest[..end]))
        };
        tokens.extend(token);
        rest = rest[length..].trim_start();
    }
    tokens
}

/// Number of bytes of the number at the beginning of a text; a sign after the letter of an exponent belongs to it.
fn number_length(text: &str) -> usize {
    let mut before = ' ';
    let end = text.find(|it: char| {
        let is_sign = matches!(it, '+' | '-') && matches!(before, 'e' | 'E' | 'p');
        before = it;
        !is_sign && !it.is_ascii_alphanumeric() && it != '.'
    });
    end.unwrap_or(text.len())
}

#[test]
fn tokens_tell_shapes_apart_and_not_names() {
    let text = "/* sine */ const double a_1 = linkwright_sine(phi, 1.5e-3) - 2;";
    assert_eq!(
        tokens(text).concat(),
        "constdoublex=linkwright_sine(x,0)-0;"
    );
    assert_eq!(tokens("b = 7 - c;"), tokens("crank = 0x1p-4 - d;"));
    assert_ne!(sequences("x = a + b;"), sequences("x = a - b;"));
}

#[test]
fn a_module_is_left_out_only_if_others_have_its_sequences() {
    let module = |name: &str, text: &str| (name.to_string(), sequences(text));
    let modules = vec![
        module("sum", "x = a + b;"),
        module("other_sum", "y = c + 2;"),
        module("same_sum", "z = e + f;"),
        module("product", "y = c * d;"),
    ];
    assert_eq!(covering(modules), ["sum", "other_sum", "product"]);
    let twice = vec![module("one", "x = 1;"), module("same", "y = 2;")];
    assert_eq!(covering(twice), ["one"]);
}
