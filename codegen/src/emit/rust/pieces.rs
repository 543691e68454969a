//! Items as tokens → their source as the formatter leaves it.
//!
//! The syntax of a large module takes a hundred times the room of its text, so a few items at a time become text, also those inside
//! of modules and implementations. Each is formatted where it stands, so that its lines break as they would in the whole.

use std::iter::Peekable;

use proc_macro2::token_stream::IntoIter;
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::quote;

/// So many items become text together.
const TOGETHER: usize = 32;

/// What items stand in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Around {
    Module,
    Implementation,
}

/// Items that stand in all of these, the outermost first.
pub(super) fn formatted(items: TokenStream, around: &[Around]) -> String {
    let (mut text, mut piece, mut count) = (String::new(), Vec::new(), 0);
    let mut tokens = items.into_iter().peekable();
    while let Some(mut item) = next_item(&mut tokens) {
        match inside(&mut item) {
            Some((kind, inner)) => {
                text += &whole(std::mem::take(&mut piece), around);
                let inner_around = [around, &[kind]].concat();
                text += &block(item, around, &formatted(inner, &inner_around));
                count = 0;
            }
            None => {
                piece.extend(item);
                count += 1;
            }
        }
        if count == TOGETHER {
            text += &whole(std::mem::take(&mut piece), around);
            count = 0;
        }
    }
    text + &whole(piece, around)
}

/// An item of these first tokens, with formatted items inside of it.
pub(super) fn block(
    head: impl IntoIterator<Item = TokenTree>,
    around: &[Around],
    inner: &str,
) -> String {
    let empty = TokenTree::Group(Group::new(Delimiter::Brace, TokenStream::new()));
    let head = whole(head.into_iter().chain([empty]), around);
    let indent = "    ".repeat(around.len());
    format!(
        "{}\n{inner}{indent}}}\n",
        head.trim_end().trim_end_matches('}')
    )
}

/// The tokens up to the end of the first item.
fn next_item(tokens: &mut Peekable<IntoIter>) -> Option<Vec<TokenTree>> {
    let mut item = Vec::new();
    while let Some(token) = tokens.next() {
        let ends = match &token {
            TokenTree::Punct(punct) => punct.as_char() == ';',
            TokenTree::Group(group) => {
                // A semicolon after braces belongs to the item: they are a value.
                let is_value = tokens.peek().is_some_and(is_semicolon);
                group.delimiter() == Delimiter::Brace && !is_value
            }
            _ => false,
        };
        item.push(token);
        if ends {
            break;
        }
    }
    (!item.is_empty()).then_some(item)
}

fn is_semicolon(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == ';')
}

/// What is inside of a module or an implementation, where that is not empty; taken away from the item.
fn inside(item: &mut Vec<TokenTree>) -> Option<(Around, TokenStream)> {
    let mut words = item.iter().filter_map(|token| match token {
        TokenTree::Ident(word) => Some(word.to_string()),
        _ => None,
    });
    let kind = match words.find(|word| word != "pub")?.as_str() {
        "mod" => Around::Module,
        "impl" => Around::Implementation,
        _ => return None,
    };
    match item.pop()? {
        TokenTree::Group(group) if !group.stream().is_empty() => Some((kind, group.stream())),
        other => {
            item.push(other);
            None
        }
    }
}

/// Whole items as text, as deep as they stand.
fn whole(items: impl IntoIterator<Item = TokenTree>, around: &[Around]) -> String {
    let mut tokens: TokenStream = items.into_iter().collect();
    if tokens.is_empty() {
        return String::new();
    }
    for kind in around.iter().rev() {
        tokens = match kind {
            Around::Module => quote!(mod around { #tokens }),
            Around::Implementation => quote!(impl Around { #tokens }),
        };
    }
    let file: Result<syn::File, _> = syn::parse2(tokens);
    // They are made of whole items, so this is a matter of our own code alone.
    let file = file.unwrap_or_else(|error| panic!("generated code does not parse: {error}"));
    let text = prettyplease::unparse(&file);
    // What stands around them takes a line before and a line after.
    let lines = text.split_inclusive('\n').skip(around.len());
    let lines: Vec<&str> = lines.collect();
    lines[..lines.len() - around.len()].concat()
}

#[cfg(test)]
mod tests {
    use super::formatted;
    use quote::quote;

    #[test]
    fn pieces_are_what_the_formatter_makes_of_the_whole() {
        let methods = (0..100).map(|number| {
            let name = quote::format_ident!("number_{number}");
            quote!(
                /// A number.
                pub fn #name(&self) -> [f64; 2] { let Pair { a, b } = self; [*a, if *b < 1.0 { 1.0 } else { 2.0 }] }
            )
        });
        let items = quote! {
            use a::{b, c};
            #[allow(dead_code)]
            pub mod motion {
                note!("first");
                const PAIR: Pair = Pair { a: 1.0, b: 2.0 };
                struct Unit;
                impl Empty for Unit {}
                impl Pair { #(#methods)* }
                impl Other for Pair { type Own = f64; const N: usize = { 3 }; fn f() {} }
            }
            frame! { Frame }
            fn last() {}
        };
        let file = syn::parse2(items.clone()).expect("items");
        assert_eq!(formatted(items, &[]), prettyplease::unparse(&file));
    }
}
