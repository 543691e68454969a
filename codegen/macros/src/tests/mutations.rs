//! Any tokens expand to items, with a module or with errors, without a panic.

use proc_macro2::{Delimiter, Group, Literal, Punct, Spacing, TokenStream, TokenTree};

use super::{Random, descriptions, displaced};
use crate::expansion::expand;

/// Number of changed descriptions that are expanded.
const CASES: usize = 1500;

/// Pieces of the language, of Rust and of trouble.
const PIECES: &str = r#####"mechanism body point const param input drive motion table output at ground phi t pi sin sqrt 0 1 2.5 1e999
    30deg 5mm 2parsec 1.P r#type 'a 'x' "text" "lift.csv" b"bytes" c"c" r#"raw"# ; , : . + - * / ^ = == -> => .. ... # #! ! $ ? @ & | ~ < >
    () (1, 2) [a] {} { body } (()) #[doc = "words"] #![doc = "words"] #[doc = r"*/ /*"] #![scalar(f32)] pub _ self super 0x1F 1_0
    99999999999999999999999999999999999999999 /1 **1"#####;

/// Trees, in which any may be changed.
fn changed(stream: TokenStream, pieces: &[TokenTree], random: &mut Random) -> TokenStream {
    let mut trees: Vec<TokenTree> = stream.into_iter().collect();
    let at = random.below(trees.len() + 1);
    let piece = pieces[random.below(pieces.len())].clone();
    // A change further inside, as often as there are groups to go into.
    if let Some(TokenTree::Group(group)) = trees.get(at)
        && random.below(4) > 0
    {
        let inside = changed(group.stream(), pieces, random);
        let mut group = Group::new(group.delimiter(), inside);
        group.set_span(trees[at].span());
        trees[at] = TokenTree::Group(group);
        return trees.into_iter().collect();
    }
    match random.below(6) {
        0 if at < trees.len() => drop(trees.remove(at)),
        1 if at < trees.len() => trees[at] = piece,
        2 if at < trees.len() => trees.insert(at, trees[at].clone()),
        3 if at < trees.len() => {
            let other = random.below(trees.len());
            trees.swap(at, other);
        }
        4 if at < trees.len() => {
            let delimiters = [
                Delimiter::None,
                Delimiter::Parenthesis,
                Delimiter::Brace,
                Delimiter::Bracket,
            ];
            let inside: TokenStream = trees.drain(at..).collect();
            let group = Group::new(delimiters[random.below(4)], inside);
            trees.push(TokenTree::Group(group));
        }
        _ => trees.insert(at, piece),
    }
    trees.into_iter().collect()
}

fn is_warning(item: &syn::Item) -> bool {
    matches!(item, syn::Item::Const(it) if it.ident == "_")
}

/// Requires that an expansion consists of items, which are one module or only errors; returns true for a module.
fn assert_items(input: &TokenStream) -> bool {
    let output = expand(input.clone());
    let file: syn::File =
        syn::parse2(output).unwrap_or_else(|error| panic!("{error} in the items of {input}"));
    // Besides errors there may be warnings.
    let is_finding = |item: &syn::Item| matches!(item, syn::Item::Macro(_)) || is_warning(item);
    let is_module = matches!(file.items.as_slice(), [syn::Item::Mod(_)]);
    let is_wrong = file.items.iter().all(is_finding) && !file.items.iter().all(is_warning);
    assert!(is_module || is_wrong, "{input}");
    is_module
}

#[test]
fn changed_descriptions_give_a_module_or_errors() {
    let sources = descriptions("tests/fixtures/plans");
    let pieces: TokenStream = PIECES.parse().expect("tokens");
    let pieces: Vec<TokenTree> = pieces.into_iter().collect();
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut modules = 0;
    for case in 0..CASES {
        let source = &sources[random.below(sources.len())];
        let mut stream: TokenStream = source.text.parse().expect("tokens");
        for _ in 0..=random.below(3) {
            stream = changed(stream, &pieces, &mut random);
        }
        if case % 4 == 0 {
            stream = displaced(stream);
        }
        modules += usize::from(assert_items(&stream));
    }
    assert!(modules > CASES / 50 && modules < CASES, "{modules} modules");
}

#[test]
fn any_tokens_give_errors() {
    let pieces: TokenStream = PIECES.parse().expect("tokens");
    let pieces: Vec<TokenTree> = pieces.into_iter().collect();
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    for _ in 0..CASES {
        let count = random.below(12);
        let stream: TokenStream = (0..count)
            .map(|_| pieces[random.below(pieces.len())].clone())
            .collect();
        assert!(!assert_items(&stream), "{stream}");
    }
}

#[test]
fn tokens_that_nobody_can_write_are_told_apart() {
    let slash = || TokenTree::Punct(Punct::new('/', Spacing::Joint));
    let star = || TokenTree::Punct(Punct::new('*', Spacing::Joint));
    let number = || TokenTree::Literal(Literal::f64_unsuffixed(1.5));
    let trees = [
        slash(),
        slash(),
        star(),
        star(),
        slash(),
        number(),
        number(),
    ];
    assert!(!assert_items(&trees.into_iter().collect()));
    // Far deeper than any description.
    let mut nested = TokenStream::new();
    for _ in 0..2000 {
        nested = TokenTree::Group(Group::new(Delimiter::Parenthesis, nested)).into();
    }
    let tokens = crate::tokens::flat(nested.into_iter().collect());
    assert_eq!(tokens.len(), 4000);
}
