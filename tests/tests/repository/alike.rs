//! Functions of the product that differ in names and literals alone: one idea that is written twice.

use std::fs;

use linkwright_tests::files;
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Number of tokens from which on a function is compared, about 15 lines.
const MIN_TOKENS: usize = 110;

/// Share of equal tokens at both ends, in percent, from which on two functions are alike.
const MIN_EQUAL_SHARE: usize = 97;

/// Pairs that are kept, by file and name.
const EXCEPTIONS: [[&str; 2]; 1] = [
    // Both are in the loop of every block; a closure between the scalings would depend on inlining.
    [
        "runtime/src/linear.rs solve",
        "runtime/src/linear/condition.rs solve_transposed",
    ],
];

/// A function with its tokens; names and literals are one token each.
struct Function {
    name: String,
    shape: Vec<String>,
}

/// Words that are tokens of their own.
const WORDS: [&str; 26] = [
    "as", "break", "const", "continue", "else", "false", "fn", "for", "if", "impl", "in", "let",
    "loop", "match", "move", "mut", "pub", "ref", "return", "self", "static", "true", "unsafe",
    "use", "where", "while",
];

fn add_shape(stream: &TokenStream, shape: &mut Vec<String>) {
    for token in stream.clone() {
        match token {
            TokenTree::Group(group) => {
                let ends = match group.delimiter() {
                    Delimiter::Parenthesis => ["(", ")"],
                    Delimiter::Brace => ["{", "}"],
                    Delimiter::Bracket => ["[", "]"],
                    Delimiter::None => ["", ""],
                };
                shape.push(ends[0].to_string());
                add_shape(&group.stream(), shape);
                shape.push(ends[1].to_string());
            }
            TokenTree::Ident(word) => {
                let word = word.to_string();
                let is_kept = WORDS.contains(&word.as_str());
                shape.push(if is_kept { word } else { "name".to_string() });
            }
            TokenTree::Punct(mark) => shape.push(mark.as_char().to_string()),
            TokenTree::Literal(_) => shape.push("literal".to_string()),
        }
    }
}

/// Adds the functions of a stream, except for those of modules of tests.
fn add_functions(stream: &TokenStream, file: &str, functions: &mut Vec<Function>) {
    let tokens: Vec<TokenTree> = stream.clone().into_iter().collect();
    let mut start = 0;
    while start < tokens.len() {
        let is_word = |at: usize, word: &str| matches!(tokens.get(at), Some(TokenTree::Ident(it)) if it == word);
        let body = |from: usize| {
            tokens[from..].iter().position(|it| {
                matches!(it, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace)
                    || matches!(it, TokenTree::Punct(mark) if mark.as_char() == ';')
            })
        };
        if is_word(start, "mod") && is_word(start + 1, "tests") {
            start += 3;
            continue;
        }
        if let (true, Some(TokenTree::Ident(name)), Some(length)) =
            (is_word(start, "fn"), tokens.get(start + 1), body(start))
        {
            let mut shape = Vec::new();
            let whole = tokens[start..=start + length].iter().cloned().collect();
            add_shape(&whole, &mut shape);
            if shape.len() >= MIN_TOKENS {
                let name = format!("{file} {name}");
                functions.push(Function { name, shape });
            }
            start += length;
        }
        if let Some(TokenTree::Group(group)) = tokens.get(start) {
            add_functions(&group.stream(), file, functions);
        }
        start += 1;
    }
}

/// True if most tokens at both ends are equal.
fn are_alike(one: &[String], other: &[String]) -> bool {
    let equal = |pair: &(&String, &String)| pair.0 == pair.1;
    let before = one.iter().zip(other).take_while(equal).count();
    let rest = one.len().min(other.len()) - before;
    let behind = one.iter().rev().zip(other.iter().rev()).take(rest);
    let behind = behind.take_while(equal).count();
    100 * (before + behind) >= MIN_EQUAL_SHARE * one.len().max(other.len())
}

/// Returns the pairs of functions that are alike.
fn alike(functions: &[Function]) -> Vec<[&str; 2]> {
    let mut pairs = Vec::new();
    for (at, one) in functions.iter().enumerate() {
        let others = functions[at + 1..].iter();
        let like = others.filter(|other| are_alike(&one.shape, &other.shape));
        pairs.extend(like.map(|other| [one.name.as_str(), other.name.as_str()]));
    }
    pairs
}

fn functions_of(text: &str, file: &str) -> Vec<Function> {
    let mut functions = Vec::new();
    let stream = text
        .parse()
        .unwrap_or_else(|error| panic!("{file}: {error}"));
    add_functions(&stream, file, &mut functions);
    functions
}

#[test]
fn no_two_functions_differ_in_names_alone() {
    let root = files::repository();
    let mut functions = Vec::new();
    for folder in ["codegen", "runtime"] {
        for path in files::below(
            &root.join(folder),
            "rs",
            &["tests", "target", "node_modules"],
        ) {
            let text = fs::read_to_string(&path).expect("a source file");
            let file = path.strip_prefix(&root).expect("a file of the repository");
            functions.extend(functions_of(&text, &file.display().to_string()));
        }
    }
    assert!(functions.len() > 1000, "{} functions", functions.len());
    let mut pairs = alike(&functions);
    pairs.retain(|pair| !EXCEPTIONS.contains(pair));
    assert!(pairs.is_empty(), "merge {pairs:#?}");
}

#[test]
fn functions_that_differ_in_names_are_found() {
    let function = |name: &str, sum: &str, last: &str| {
        let terms = format!("{sum} += {name}(1) * 2.5; ").repeat(10);
        format!("fn {name}({sum}: f64) -> f64 {{ let mut {sum} = {sum}; {terms}{last} }}\n")
    };
    let is_found = |one: String, other: String| {
        let functions = functions_of(&(one + &other), "file.rs");
        assert_eq!(functions.len(), 2);
        !alike(&functions).is_empty()
    };
    assert!(is_found(
        function("first", "a", "a"),
        function("second", "b", "b")
    ));
    let other = "if b > 0.0 { b } else { -b * second(b) }";
    assert!(!is_found(
        function("first", "a", "a"),
        function("second", "b", other)
    ));
}
