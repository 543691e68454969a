//! Checks that the page of thresholds names every number by which the product decides something, with its value, and
//! no other.
//!
//! A threshold is a constant of a number type, or of a list of numbers, or a duration, in the sources of the
//! packages. Other values of the following would not change a decision:
//! - a constant of mathematics, which is one of `core::f64::consts` or is written with ten or more digits;
//! - a mark for nothing, the largest number of its type;
//! - the length of a list;
//! - sizes in pictures, in pixels;
//! - numbers in tests.
//!
//! A number with an exponent must be a constant: elsewhere a reader would miss it.

use std::collections::BTreeMap;
use std::fs;
use std::str::FromStr;

use linkwright_tests::files;
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Folders with the sources of the packages that are published.
const SOURCES: [&str; 10] = [
    "runtime/src",
    "codegen/description/src",
    "codegen/program/src",
    "codegen/src",
    "codegen/solver/src",
    "codegen/calibrate/src",
    "codegen/editing/src",
    "codegen/macros/src",
    "codegen/page/src",
    "codegen/command/src",
];

/// Page of thresholds, part of the documentation of the runtime.
const PAGE: &str = "runtime/src/thresholds.md";

/// Folder whose fractions are sizes in pixels.
const DRAWING: &str = "codegen/src/emit/drawing/";

const NUMBERS: [&str; 13] = [
    "f32", "f64", "i8", "i16", "i32", "i64", "i128", "u8", "u16", "u32", "u64", "u128", "usize",
];

/// Numbers in a file.
#[derive(Debug, Default)]
struct Found {
    /// Names and values of constants, in their order.
    thresholds: Vec<(String, String)>,
    /// Numbers with an exponent outside constants, with their lines.
    unnamed: Vec<(usize, String)>,
}

/// Tokens as text, regardless of spacing and of a trailing comma in a list on several lines.
fn spelled(tokens: &[TokenTree]) -> String {
    let text: TokenStream = tokens.iter().cloned().collect();
    text.to_string().replace(" ,]", "]")
}

fn is_mark(token: &TokenTree, mark: char) -> bool {
    matches!(token, TokenTree::Punct(it) if it.as_char() == mark)
}

/// True if a type is made of numbers, or is a duration.
fn is_numeric(kind: &[TokenTree]) -> bool {
    match kind {
        [TokenTree::Ident(name)] => {
            NUMBERS.contains(&name.to_string().as_str()) || name == "Duration"
        }
        [TokenTree::Group(group)] => {
            let inner: Vec<TokenTree> = group.stream().into_iter().collect();
            match group.delimiter() {
                Delimiter::Bracket => inner
                    .split(|it| is_mark(it, ';'))
                    .next()
                    .is_some_and(is_numeric),
                Delimiter::Parenthesis => inner.split(|it| is_mark(it, ',')).all(is_numeric),
                _ => false,
            }
        }
        _ => false,
    }
}

/// True if another value would not change a decision.
fn decides_nothing(value: &[TokenTree]) -> bool {
    let text = spelled(value).replace(' ', "");
    let digits = |word: &str| {
        let number = word.split(['e', 'E']).next().unwrap_or(word);
        number.chars().filter(char::is_ascii_digit).count()
    };
    text.contains("consts::")
        || text.ends_with("::MAX")
        || text.ends_with(".len()")
        || literals(value)
            .iter()
            .any(|(_, number)| digits(number) >= 10)
}

/// Numbers among tokens, with their lines.
fn literals(tokens: &[TokenTree]) -> Vec<(usize, String)> {
    let mut numbers = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Literal(literal) => {
                let text = literal.to_string();
                if text.starts_with(|it: char| it.is_ascii_digit()) {
                    numbers.push((literal.span().start().line, text));
                }
            }
            TokenTree::Group(group) => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                numbers.extend(literals(&inner));
            }
            _ => {}
        }
    }
    numbers
}

fn has_exponent(number: &str) -> bool {
    !number.starts_with("0x") && number.contains(['e', 'E']) && !number.ends_with("size")
}

/// Reads the tokens of a file, or of a group in it.
fn read(tokens: TokenStream, found: &mut Found) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut rest = &tokens[..];
    while let Some((first, after)) = rest.split_first() {
        rest = after;
        match first {
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                let is_test = after
                    .first()
                    .is_some_and(|it| it.to_string().replace(' ', "") == "[cfg(test)]");
                if is_test {
                    // The item ends with the first semicolon or block.
                    let end = after.iter().position(|it| {
                        is_mark(it, ';')
                            || matches!(it, TokenTree::Group(it) if it.delimiter() == Delimiter::Brace)
                    });
                    rest = &after[end.map_or(after.len(), |end| end + 1)..];
                }
            }
            TokenTree::Ident(word) if word == "const" || word == "static" => {
                let end = after.iter().position(|it| is_mark(it, ';'));
                let item = &after[..end.unwrap_or(0)];
                let [TokenTree::Ident(name), colon, item @ ..] = item else {
                    continue;
                };
                let Some(equals) = item.iter().position(|it| is_mark(it, '=')) else {
                    continue;
                };
                let (kind, value) = (&item[..equals], &item[equals + 1..]);
                if is_mark(colon, ':') && is_numeric(kind) {
                    rest = &after[end.unwrap_or(0)..];
                    if !decides_nothing(value) {
                        found.thresholds.push((name.to_string(), spelled(value)));
                    }
                }
            }
            TokenTree::Group(group) => read(group.stream(), found),
            TokenTree::Literal(_) => {
                let numbers = literals(std::slice::from_ref(first));
                found
                    .unnamed
                    .extend(numbers.into_iter().filter(|(_, it)| has_exponent(it)));
            }
            _ => {}
        }
    }
}

fn tokens(text: &str) -> TokenStream {
    TokenStream::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// Numbers of all sources, by their paths in the repository.
fn scanned() -> BTreeMap<String, Found> {
    let root = files::repository();
    let paths = SOURCES
        .iter()
        // The files that `new` writes belong to the user.
        .flat_map(|folder| files::below(&root.join(folder), "rs", &["tests", "template"]))
        .filter(|path| files::stem(path) != "tests");
    paths
        .map(|path| {
            let mut numbers = Found::default();
            read(
                tokens(&fs::read_to_string(&path).expect("a source file")),
                &mut numbers,
            );
            let relative = path.strip_prefix(&root).expect("a path in the repository");
            (
                relative.to_str().expect("UTF-8").replace('\\', "/"),
                numbers,
            )
        })
        .collect()
}

/// Rows of the page: name, value, decision, reason, and file.
fn rows(page: &str) -> Vec<[String; 5]> {
    let lines = page.lines().filter(|line| line.starts_with("| `"));
    lines
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
            let cells: [&str; 5] = cells
                .try_into()
                .unwrap_or_else(|_| panic!("not five cells: {line}"));
            cells.map(|cell| cell.trim_matches('`').to_string())
        })
        .collect()
}

fn page() -> String {
    fs::read_to_string(files::repository().join(PAGE)).expect("the page")
}

#[test]
fn the_page_names_every_threshold_with_its_value_and_no_other() {
    let mut expected = Vec::new();
    for (file, found) in scanned() {
        let is_drawing = file.starts_with(DRAWING);
        let thresholds = found.thresholds.into_iter();
        // Counts there are whole numbers; the widths of letters are sizes, too.
        let is_size = |value: &str| value.contains('.') || file.ends_with("letters.rs");
        let thresholds = thresholds.filter(|(_, value)| !(is_drawing && is_size(value)));
        expected.extend(thresholds.map(|(name, value)| format!("{file}: {name} = {value}")));
    }
    let mut listed: Vec<String> = rows(&page())
        .iter()
        .map(|[name, value, _, _, file]| format!("{file}: {name} = {}", tokens(value)))
        .collect();
    expected.sort();
    listed.sort();
    let only = |these: &[String], those: &[String]| -> String {
        let missing = these.iter().filter(|it| !those.contains(it));
        missing.map(|it| format!("\n  {it}")).collect()
    };
    assert!(
        expected == listed,
        "{PAGE} lacks{}\nand lists without reason{}",
        only(&expected, &listed),
        only(&listed, &expected)
    );
}

#[test]
fn every_row_says_what_is_decided_and_why() {
    let rows = rows(&page());
    assert!(rows.len() >= 100, "only {} rows were read", rows.len());
    for [name, _, decides, why, file] in rows {
        let words = |text: &str| text.split_whitespace().count();
        assert!(words(&decides) >= 3, "{file}: what does {name} decide?");
        assert!(words(&why) >= 3, "{file}: why has {name} this value?");
    }
}

#[test]
fn numbers_with_an_exponent_are_constants() {
    for (file, found) in scanned() {
        assert!(found.unnamed.is_empty(), "{file}: {:?}", found.unnamed);
    }
}

#[test]
fn thresholds_are_told_from_other_constants() {
    let mut numbers = Found::default();
    read(
        tokens(
            "
            /// Documentation with 1e-3.
            pub(crate) const SMALL: f64 = 1e-9;
            impl Here { const PAIR: [(f64, u32); 2] = [(1.5, 2), (0.1, 3)]; }
            fn here() { const SHOWN: usize = LARGEST / 4; say(\"1e-3\", 0x1e5, 1usize); }
            const WAIT: Duration = Duration::from_secs(1);
            const TAN: f64 = 0.414_213_562_373_095_03;
            const HALF: f64 = core::f64::consts::FRAC_1_SQRT_2;
            const NOWHERE: u32 = u32::MAX;
            const COUNT: usize = NAMES.len();
            const NAME: &str = \"name\";
            fn there(x: f64) -> bool { x < 2e-3 }
            #[cfg(test)]
            use here::LARGE;
            const AFTER: u8 = 3;
            #[cfg(test)]
            mod tests { const SEED: u64 = 5; fn it() -> f64 { 1e-3 } }
            ",
        ),
        &mut numbers,
    );
    let names: Vec<&str> = numbers
        .thresholds
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    assert_eq!(names, ["SMALL", "PAIR", "SHOWN", "WAIT", "AFTER"]);
    assert_eq!(numbers.thresholds[0].1, "1e-9");
    let unnamed: Vec<&str> = numbers
        .unnamed
        .iter()
        .map(|(_, number)| number.as_str())
        .collect();
    assert_eq!(unnamed, ["2e-3"]);
}
