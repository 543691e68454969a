//! Reads every generated module as an engineer does: constants are named after quantities, lines are short, values are used.
//!
//! Counts of `tests/faces.txt` may only fall; a module without a line there has none. `FACES_UPDATE=1` writes counts that have
//! fallen.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Language, Options, generate};
use linkwright_tests::{description, files};
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Longest line, in characters.
const WIDTH: usize = 120;

/// Words that name a quantity of a mechanism or of a derivation.
const WORDS: [&str; 60] = [
    "ACCELERATION",
    "AMPLITUDE",
    "AND",
    "ANGLE",
    "ARM",
    "BODY",
    "DEGREES",
    "DIRECTION",
    "DISTANCE",
    "DRIVE",
    "FREQUENCY",
    "HALF",
    "INVERSE",
    "LARGEST",
    "LENGTH",
    "LIMIT",
    "LINK",
    "LONGEST",
    "LOOP",
    "OFFSET",
    "OVER",
    "PHASE",
    "PHI",
    "PI",
    "POSITION",
    "PRODUCT",
    "RATE",
    "REACH",
    "SHORTEST",
    "SIZE",
    "SLOPE",
    "SQRT",
    "SQUARED",
    "SQUARES",
    "START",
    "TIMES",
    "TURN",
    "VALUE",
    "X",
    "Y",
    "ABSOLUTE",
    "ORIGIN",
    "PSI",
    "S",
    "EQUATION",
    "TRANSLATIONAL",
    "GEAR",
    "RACK",
    "BELT",
    "DISTANCES",
    "CAM",
    "FOLLOWER",
    "POINT",
    "LINE",
    "LATERAL",
    "ALONG",
    "PAIR",
    "SLIDE",
    "DESIGN",
    "POINTS",
];

/// Beginnings of names that say only digits.
const NUMERIC: [&str; 3] = ["CONSTANT_", "RATIO_", "PI_TIMES_"];

/// Counts of a module's faults, by kind.
type Faults = BTreeMap<&'static str, Vec<String>>;

/// Constants of a generated file with their remarks.
fn constants(code: &str) -> Vec<String> {
    let lines = code.lines().filter_map(|line| {
        let line = line.trim().trim_start_matches("static const double ");
        let (name, value) = line.split_once(" = ")?;
        let is_name = |it: char| it.is_ascii_uppercase() || it.is_ascii_digit() || it == '_';
        let is_number = value.starts_with(|it: char| it.is_ascii_digit() || it == '-');
        (is_number && name.chars().all(is_name)).then(|| name.to_string())
    });
    lines.collect()
}

/// Identifiers of a description, in upper case and split at underscores.
fn described(source: &str) -> BTreeSet<String> {
    let is_word = |it: char| it.is_alphanumeric();
    let words = source.split(|it| !is_word(it));
    words
        .filter(|it| !it.is_empty())
        .map(str::to_uppercase)
        .collect()
}

/// True if each part of a name is a word of mechanics, a number, or one or two names of the description.
fn has_meaning(name: &str, described: &BTreeSet<String>) -> bool {
    name.split('_').all(|part| {
        let is_number = part.chars().all(|it| it.is_ascii_digit());
        let is_pair = (1..part.len()).any(|at| {
            let (first, second) = part.split_at(at);
            described.contains(first) && described.contains(second)
        });
        let word = part.trim_end_matches(|it: char| it.is_ascii_digit());
        is_number || is_pair || WORDS.contains(&word) || described.contains(part)
    })
}

/// Names that `let` binds in a group of tokens and that no later token of the group mentions.
fn unused(tokens: TokenStream, found: &mut Vec<String>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (place, token) in tokens.iter().enumerate() {
        if let TokenTree::Group(group) = token {
            unused(group.stream(), found);
        }
        let is_let = matches!(token, TokenTree::Ident(it) if it == "let");
        if !is_let {
            continue;
        }
        let is_equal = |it: &TokenTree| matches!(it, TokenTree::Punct(it) if it.as_char() == '=');
        let Some(end) = tokens[place..].iter().position(is_equal) else {
            continue;
        };
        let mut names = Vec::new();
        bound(&tokens[place + 1..place + end], &mut names);
        let rest = &tokens[place + end..];
        names.retain(|name| !rest.iter().any(|it| mentions(it, name)));
        found.extend(names);
    }
}

/// Names in a pattern.
fn bound(pattern: &[TokenTree], names: &mut Vec<String>) {
    for token in pattern {
        match token {
            TokenTree::Ident(name) => {
                let name = name.to_string();
                let is_value = name.starts_with(|it: char| it.is_lowercase());
                if is_value && !["mut", "ref"].contains(&name.as_str()) {
                    names.push(name);
                }
            }
            // What follows a colon is a type.
            TokenTree::Punct(it) if it.as_char() == ':' => return,
            TokenTree::Group(group) if group.delimiter() != Delimiter::Bracket => {
                bound(&group.stream().into_iter().collect::<Vec<_>>(), names);
            }
            _ => {}
        }
    }
}

fn mentions(token: &TokenTree, name: &str) -> bool {
    match token {
        TokenTree::Ident(it) => it == name,
        TokenTree::Group(group) => group.stream().into_iter().any(|it| mentions(&it, name)),
        _ => false,
    }
}

/// Local constants of C that no later line of their function mentions.
fn unused_in_c(code: &str) -> Vec<String> {
    let mut unused = Vec::new();
    for function in code.split("\n}\n") {
        let is_word = |it: char| it.is_alphanumeric() || it == '_';
        let words: Vec<&str> = function.split(|it| !is_word(it)).collect();
        for line in function.lines().filter(|line| line.starts_with(' ')) {
            let declared = line.trim().strip_prefix("const double ");
            let name = declared.and_then(|it| it.split([' ', '[']).next());
            if let Some(name) = name
                && words.iter().filter(|it| **it == name).count() < 2
            {
                unused.push(name.to_string());
            }
        }
    }
    unused
}

fn faults(name: &str, source: &Source) -> Faults {
    let described = described(&source.text);
    let mut faults = Faults::new();
    for language in [Language::Rust, Language::C] {
        let options = Options {
            language,
            stem: Some(name.to_string()),
            ..Options::default()
        };
        let generated = generate(source, &options);
        let generated = generated.unwrap_or_else(|errors| panic!("{}", errors.render(source)));
        for file in generated.files {
            let text = &file.text;
            let long = text.lines().filter(|line| line.chars().count() > WIDTH);
            faults
                .entry("long lines")
                .or_default()
                .extend(long.map(str::to_string));
            if file.name.starts_with("linkwright.") {
                continue;
            }
            for name in constants(text) {
                if NUMERIC.iter().any(|start| name.starts_with(start)) {
                    faults.entry("numeric names").or_default().push(name);
                } else if !has_meaning(&name, &described) {
                    faults
                        .entry("names without meaning")
                        .or_default()
                        .push(name);
                }
            }
            let unused = match language {
                Language::C => unused_in_c(text),
                _ => {
                    let tokens: TokenStream = text.parse().expect("tokens of Rust");
                    let mut names = Vec::new();
                    unused(tokens, &mut names);
                    names
                }
            };
            faults.entry("unused values").or_default().extend(unused);
            if language == Language::C && !text.is_ascii() {
                faults
                    .entry("letters beyond ASCII")
                    .or_default()
                    .push(file.name.clone());
            }
        }
    }
    faults.retain(|_, list| !list.is_empty());
    faults
}

#[test]
fn modules_are_written_as_by_hand() {
    let path = files::package("faces.txt");
    let text = fs::read_to_string(&path).unwrap_or_default();
    let allowed: BTreeMap<(&str, &str), usize> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .filter_map(|line| {
            let (count, rest) = line.split_once(' ')?;
            let (name, kind) = rest.split_once(' ')?;
            Some(((name, kind), count.parse().ok()?))
        })
        .collect();
    let mut counts = String::from("# Faults of generated modules; counts may only fall.\n");
    let mut worse = String::new();
    for name in description::names().into_iter().chain(description::small()) {
        for (kind, list) in faults(&name, &description::source(&name)) {
            let limit = allowed.get(&(name.as_str(), kind)).copied().unwrap_or(0);
            let count = list.len().min(limit);
            if count > 0 {
                let _ = writeln!(counts, "{count} {name} {kind}");
            }
            if list.len() > limit {
                let _ = writeln!(
                    worse,
                    "{name}: {kind}: {} instead of {limit}: {list:#?}",
                    list.len()
                );
            }
        }
    }
    if std::env::var_os("FACES_UPDATE").is_some() {
        fs::write(&path, &counts).expect("a file that can be written");
    }
    assert!(worse.is_empty(), "{worse}");
}

#[test]
fn faults_are_found() {
    let code = "constants! {\n    CONSTANT_1 = 0.5, // x\n    COUPLER_LENGTH = 0.12,\n}\nstatic const double RATIO_1_OVER_3 = 0.3;";
    assert_eq!(
        constants(code),
        ["CONSTANT_1", "COUPLER_LENGTH", "RATIO_1_OVER_3"]
    );
    let names = described("body coupler { B 0, 0; C 12 cm, 0 }");
    assert!(has_meaning("INVERSE_COUPLER_LENGTH", &names) && has_meaning("BC_LENGTH", &names));
    assert!(!has_meaning("BQ_LENGTH", &names) && !has_meaning("FANCY_LENGTH", &names));
    let mut names = Vec::new();
    unused(
        "fn f() { let a = 1; let (b, c) = g(a); h(c) }"
            .parse()
            .expect("tokens"),
        &mut names,
    );
    assert_eq!(names, ["b"]);
    let code = "static void f(void)\n{\n    const double x = 1.0;\n    const double y = x;\n}\n";
    assert_eq!(unused_in_c(code), ["y"]);
}
