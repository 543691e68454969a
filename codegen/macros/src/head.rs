//! Separates the head of an invocation, which is Rust, from the tokens of the description.
//!
//! Comments that document the description are part of the description. Everything else before its first word belongs to
//! the head.

use linkwright_codegen::{Options, Scalar};
use proc_macro2::{Delimiter, Group, Span, TokenStream, TokenTree};
use quote::quote;
use syn::Visibility;
use syn::parse::Parser as _;

use crate::tokens::{Attribute, spliced};

/// Head of an invocation, and its description.
pub struct Head {
    /// Attributes of the module.
    pub attributes: TokenStream,
    /// `pub`, `pub(crate)`, … or nothing.
    pub visibility: TokenStream,
    /// Options of the generated code.
    pub options: Options,
    /// Description.
    pub description: Vec<TokenTree>,
    /// Errors in the options, with the first and the last location.
    pub mistakes: Vec<([Span; 2], String)>,
}

impl Head {
    /// Reads the head of an invocation. Unknown tokens are left to the description.
    pub fn read(input: TokenStream) -> Head {
        let mut head = Head {
            attributes: TokenStream::new(),
            visibility: TokenStream::new(),
            options: Options::default(),
            description: Vec::new(),
            mistakes: Vec::new(),
        };
        let mut given_names = Vec::new();
        let mut rest = spliced(input).into_iter();
        while let Some(attribute) = Attribute::first_of(rest.as_slice()) {
            let trees = rest.by_ref().take(attribute.length);
            let mistake = if attribute.words().is_some() {
                head.description.extend(trees);
                continue;
            } else if attribute.is_inner {
                trees.for_each(drop);
                head.choose(&attribute.inside, &mut given_names).err()
            } else {
                let of_module: TokenStream = trees.collect();
                let parsed = syn::Attribute::parse_outer.parse2(of_module.clone());
                head.attributes.extend(parsed.is_ok().then_some(of_module));
                parsed.err().map(|error| error.to_string())
            };
            head.mistakes
                .extend(mistake.map(|mistake| (attribute.place, mistake)));
        }
        // Of several mechanisms the last one becomes the module.
        let mut rest: Vec<TokenTree> = rest.collect();
        let mechanism =
            |it: &TokenTree| matches!(it, TokenTree::Ident(word) if word == "mechanism");
        if let Some(last) = rest.iter().rposition(mechanism) {
            let visibility = start_of_visibility(&rest[..last])..last;
            head.visibility = rest.drain(visibility).collect();
        }
        head.description.extend(rest);
        head
    }

    /// Takes an option; `given_names` are the options before it.
    fn choose(
        &mut self,
        inside: &[TokenTree],
        given_names: &mut Vec<String>,
    ) -> Result<(), String> {
        let (name, value) = match inside {
            [TokenTree::Ident(name), TokenTree::Group(value)]
                if value.delimiter() == Delimiter::Parenthesis =>
            {
                (name.to_string(), value)
            }
            _ => return Err(unknown()),
        };
        match name.as_str() {
            "scalar" => self.options.scalar = scalar(value)?,
            // An option must live until the compiler ends.
            "math" => self.options.math = Some(value.stream().to_string()),
            _ => return Err(unknown()),
        }
        if given_names.contains(&name) {
            return Err(format!("the option `{name}` is given twice"));
        }
        given_names.push(name);
        Ok(())
    }
}

/// Index of the visibility that ends the trees.
fn start_of_visibility(trees: &[TokenTree]) -> usize {
    let is_public = |it: &TokenTree| matches!(it, TokenTree::Ident(word) if word == "pub");
    match trees {
        [.., word] if is_public(word) => trees.len() - 1,
        [.., word, place] if is_public(word) => {
            match syn::parse2::<Visibility>(quote!(#word #place)) {
                Ok(_) => trees.len() - 2,
                Err(_) => trees.len(),
            }
        }
        _ => trees.len(),
    }
}

fn scalar(value: &Group) -> Result<Scalar, String> {
    let value = value.stream().to_string();
    match value.as_str() {
        "f64" => Ok(Scalar::F64),
        "f32" => Ok(Scalar::F32),
        _ => Err(format!("the scalar `{value}` is neither `f64` nor `f32`")),
    }
}

fn unknown() -> String {
    "unknown option\nhelp: the options are `#![scalar(f32)]` and `#![math(crate::Plain)]`"
        .to_string()
}
