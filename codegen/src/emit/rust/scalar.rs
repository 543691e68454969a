//! A module in f64 → the same module in another scalar.
//!
//! The rest of the room writes f64. For single precision the type's name is exchanged, literals are written in the fewest digits
//! that single precision needs, and the runtime's types, which default to f64, are named with their scalar.

use proc_macro2::{Group, Ident, Literal, TokenStream, TokenTree};
use quote::quote;

/// The scalar of the generated code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scalar {
    /// Double precision.
    #[default]
    F64,
    /// Single precision, for processors without hardware for more.
    F32,
}

/// The runtime's types that have the scalar as a parameter with a default.
const WITH_DEFAULT: [&str; 7] = [
    "Closeness",
    "Explained",
    "Failure",
    "Measure",
    "Motion",
    "Settings",
    "Signal",
];

/// The tokens with the scalar put in.
pub(super) fn in_scalar(tokens: TokenStream, scalar: Scalar) -> TokenStream {
    match scalar {
        Scalar::F64 => tokens,
        Scalar::F32 => single(tokens),
    }
}

fn single(tokens: TokenStream) -> TokenStream {
    let mut out = TokenStream::new();
    let mut trees = tokens.into_iter().peekable();
    while let Some(tree) = trees.next() {
        match tree {
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), single(group.stream()));
                inner.set_span(group.span());
                out.extend([TokenTree::Group(inner)]);
            }
            TokenTree::Ident(name) if name == "f64" => {
                out.extend([TokenTree::Ident(Ident::new("f32", name.span()))])
            }
            TokenTree::Ident(name) if name == "use" => {
                // An import names the type itself, without its scalar.
                out.extend([TokenTree::Ident(name)]);
                for imported in trees.by_ref() {
                    let ends = matches!(&imported, TokenTree::Punct(mark) if mark.as_char() == ';');
                    out.extend([imported]);
                    if ends {
                        break;
                    }
                }
            }
            TokenTree::Ident(name) if WITH_DEFAULT.iter().any(|known| name == known) => {
                let has_parameter =
                    matches!(trees.peek(), Some(TokenTree::Punct(mark)) if mark.as_char() == '<');
                let is_path =
                    matches!(trees.peek(), Some(TokenTree::Punct(mark)) if mark.as_char() == ':');
                let is_value = matches!(trees.peek(), Some(TokenTree::Group(group)) if group.delimiter() == proc_macro2::Delimiter::Brace);
                out.extend(match (has_parameter, is_path) {
                    (true, _) => quote!(#name),
                    (_, true) => quote!(#name::<f32>),
                    // A structure's literal infers its scalar from its values.
                    _ if is_value
                        && ["Explained", "Measure", "Motion", "Signal"]
                            .iter()
                            .any(|inferred| name == inferred)
                        && !out_ends_with_arrow(&out) =>
                    {
                        quote!(#name)
                    }
                    _ => quote!(#name<f32>),
                });
            }
            TokenTree::Literal(literal) => out.extend([TokenTree::Literal(shortened(literal))]),
            other => out.extend([other]),
        }
    }
    out
}

/// Whether the last tokens are `->`: what follows is a type.
fn out_ends_with_arrow(out: &TokenStream) -> bool {
    out.clone()
        .into_iter()
        .last()
        .is_some_and(|tree| matches!(tree, TokenTree::Punct(mark) if mark.as_char() == '>'))
}

/// A float in the fewest digits of single precision; other literals as they are.
fn shortened(literal: Literal) -> Literal {
    let text = literal.to_string();
    let is_float = text.contains('.')
        || (text.contains('e') && text.starts_with(|first: char| first.is_ascii_digit()));
    match text.parse::<f32>() {
        // Beyond single precision the number would become infinite or zero; it stays, and the compiler says so.
        Ok(value) if is_float && value.is_finite() => {
            let short = if value != 0.0 && !(1e-5..1e16).contains(&value.abs()) {
                format!("{value:e}")
            } else {
                format!("{value:?}")
            };
            short.parse().unwrap_or(literal)
        }
        _ => literal,
    }
}
