//! Which lints an item of generated code must allow, so that it is clean wherever it is included.

use super::code::{Code, Piece, decoded};
use super::module::only;
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;
use std::f64::consts;

/// How close a literal is to a constant of the standard library, relative to it, where clippy may object.
const CLOSE: f64 = 1e-3;

/// The constants of the standard library that clippy looks for among literals.
const KNOWN: [f64; 19] = [
    consts::E,
    consts::FRAC_1_PI,
    consts::FRAC_1_SQRT_2,
    consts::FRAC_2_PI,
    consts::FRAC_2_SQRT_PI,
    consts::FRAC_PI_2,
    consts::FRAC_PI_3,
    consts::FRAC_PI_4,
    consts::FRAC_PI_6,
    consts::FRAC_PI_8,
    consts::LN_2,
    consts::LN_10,
    consts::LOG10_2,
    consts::LOG10_E,
    consts::LOG2_10,
    consts::LOG2_E,
    consts::PI,
    consts::SQRT_2,
    consts::TAU,
];

/// What a module of this name must allow.
pub(super) fn of_module(name: &str) -> TokenStream {
    let is_snake = name == name.to_lowercase() && !name.trim_matches('_').contains("__");
    only(!is_snake, quote!(#[allow(non_snake_case)]))
}

/// What an item that a user may leave unused must allow; `tokens` is what it is made of.
pub(super) fn unused_item(tokens: &TokenStream) -> TokenStream {
    let (capitals, approximate) = both(tokens);
    quote!(#capitals #[allow(dead_code)] #approximate)
}

/// What is needed where a name has capitals or double underscores, and what [`approximate`] says.
pub(super) fn both(tokens: &TokenStream) -> (TokenStream, TokenStream) {
    let (mut has_capitals, mut is_approximate) = (false, false);
    any(tokens, &mut |tree| {
        has_capitals = has_capitals || is_in_capitals(tree);
        is_approximate = is_approximate || is_known(tree);
        has_capitals && is_approximate
    });
    (
        only(has_capitals, quote!(#[allow(non_snake_case)])),
        only(is_approximate, quote!(#[allow(clippy::approx_constant)])),
    )
}

/// An attribute where a literal is close to a constant of the standard library: it is an exact value of the mechanism.
pub(super) fn approximate(tokens: &TokenStream) -> TokenStream {
    let is_approximate = any(tokens, &mut is_known);
    only(is_approximate, quote!(#[allow(clippy::approx_constant)]))
}

/// The attributes of code: what [`both`] says.
pub(super) fn of_code(code: &Code) -> Vec<&'static str> {
    let is = |is_word: fn(&str) -> bool, is_tree: fn(&TokenTree) -> bool| {
        code.pieces().iter().any(|piece| match piece {
            Piece::Lines(lines) => any_word(lines, is_word),
            Piece::Syntax(tokens) => any(tokens, &mut |tree| is_tree(tree)),
        })
    };
    let mut needed = Vec::new();
    if is(is_path_in_capitals, is_in_capitals) {
        needed.push("#[allow(non_snake_case)]");
    }
    if is(is_close, is_known) {
        needed.push("#[allow(clippy::approx_constant)]");
    }
    needed
}

/// Whether a literal is close to a constant, or one in lines of code.
fn is_known(tree: &TokenTree) -> bool {
    let TokenTree::Literal(literal) = tree else {
        return false;
    };
    let text = literal.to_string();
    match decoded(&text) {
        Some(lines) => any_word(&lines, is_close),
        None => is_close(&text),
    }
}

/// Whether a literal is close to a known constant.
fn is_close(literal: &str) -> bool {
    let is_number = literal.as_bytes().first().is_some_and(u8::is_ascii_digit);
    is_number
        && literal.parse::<f64>().is_ok_and(|value| {
            KNOWN
                .iter()
                .any(|known| (value - known).abs() < CLOSE * known)
        })
}

/// True for a name of a value or a function that is made of one in the description and keeps its capitals or its double underscores.
/// Types and constants have no capitals and small letters around an underscore.
fn has_capitals(name: &str) -> bool {
    let name = name.trim_matches('_');
    let has = |is_so: fn(&u8) -> bool| name.bytes().any(|byte| is_so(&byte));
    name.contains("__")
        || name.contains('_') && has(u8::is_ascii_uppercase) && has(u8::is_ascii_lowercase)
}

/// Whether a token is such a name, or one in lines of code.
fn is_in_capitals(tree: &TokenTree) -> bool {
    match tree {
        TokenTree::Ident(name) => has_capitals(&name.to_string()),
        TokenTree::Literal(literal) => {
            decoded(&literal.to_string()).is_some_and(|lines| any_word(&lines, is_path_in_capitals))
        }
        _ => false,
    }
}

fn is_path_in_capitals(path: &str) -> bool {
    path.split('.').any(has_capitals)
}

/// Whether some number or path in these lines is suspect; comments are neither.
fn any_word(lines: &[String], is_suspect: fn(&str) -> bool) -> bool {
    let is_of_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'.';
    let mut code = lines
        .iter()
        .filter(|line| !line.trim_start().starts_with("//"));
    code.any(|line| {
        let mut start = None;
        let ends = line.bytes().chain([b' ']).enumerate();
        let mut words = ends.filter_map(|(place, byte)| match (is_of_word(byte), start) {
            (true, None) => {
                start = Some(place);
                None
            }
            (false, Some(_)) => start.take().map(|start| &line[start..place]),
            _ => None,
        });
        words.any(is_suspect)
    })
}

fn any(tokens: &TokenStream, suspect: &mut dyn FnMut(&TokenTree) -> bool) -> bool {
    tokens.clone().into_iter().any(|tree| match &tree {
        TokenTree::Group(group) => any(&group.stream(), suspect),
        other => suspect(other),
    })
}
