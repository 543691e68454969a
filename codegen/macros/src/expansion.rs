//! Expands an invocation into a module, or into errors.

use std::path::{Path, PathBuf};
use std::{env, path};

use linkwright_codegen::diagnostic::internal::caught;
use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::files::attach_files;
use linkwright_codegen::{Generated, Options, Page, generate};
use proc_macro2::{Ident, Span, TokenStream, fallback};
use quote::quote;

use crate::findings;
use crate::head::Head;
use crate::tokens::{Token, flat};
use crate::written::Written;

/// Expands the description of a mechanism into its module, or into the errors of the description.
pub fn expand(input: TokenStream) -> TokenStream {
    let head = Head::read(input);
    let tokens = flat(head.description);
    let written = Written::of(&tokens);
    let mistakes = head.mistakes.iter();
    let mistakes = mistakes.map(|(place, mistake)| findings::error(*place, mistake));
    let mistakes: TokenStream = mistakes.collect();
    let source = Source::new("mechanism!", written.text.as_str());
    let folder = folder(&tokens);
    let (source, generated) = generated(source, &folder, &head.options);
    let (generated, page) = match generated {
        Ok(generated) => generated,
        Err(diagnostics) => {
            let diagnostics = findings::items(diagnostics, &written);
            return quote!(#mistakes #diagnostics);
        }
    };
    if !mistakes.is_empty() {
        return mistakes;
    }
    let name = match module_name(&generated.name, &tokens) {
        Ok(name) => name,
        Err(error) => return error,
    };
    let Ok(code) = generated.code().parse::<TokenStream>() else {
        let problem = "the generated code is not Rust: this is an error of Linkwright";
        return findings::error([Span::call_site(); 2], problem);
    };
    let (attributes, visibility) = (head.attributes, head.visibility);
    let Page {
        documentation,
        html,
    } = page;
    let warnings = findings::items(generated.warnings, &written);
    let files = watched(&source, &folder);
    let style = match generated.name.chars().any(char::is_uppercase) {
        true => quote!(#[allow(non_snake_case)]),
        false => TokenStream::new(),
    };
    // The whole module has one location, that of the macro: lints of clippy that depend on locations do not apply.
    quote! {
        #(#[doc = #documentation])*
        #[cfg_attr(doc, doc = #html)]
        #attributes
        #style
        #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
        #visibility mod #name {
            #code
            #files
            #warnings
        }
    }
}

/// Generates code from a description, with the files that it names. The generator parses text of its own and must know
/// the locations of tokens in it. While it runs, tokens therefore do not belong to the compiler.
fn generated(
    source: Source,
    folder: &Path,
    options: &Options,
) -> (Source, Result<(Generated, Page), Diagnostics>) {
    /// Guard that returns tokens to the compiler.
    struct Aside;

    impl Drop for Aside {
        fn drop(&mut self) {
            fallback::unforce();
        }
    }

    fallback::force();
    let _aside = Aside;
    let source = attach_files(source, folder);
    let generated = caught(|| {
        generate(&source, options).map(|generated| {
            let page = generated.page();
            (generated, page)
        })
    });
    (
        source,
        generated.unwrap_or_else(|error| Err(error.findings())),
    )
}

/// Folder to which file names are relative: that of the description's file, or of the package.
fn folder(tokens: &[Token]) -> PathBuf {
    let first = tokens
        .first()
        .map_or_else(Span::call_site, |token| token.span);
    let file = first.local_file();
    let folder = file.as_deref().and_then(Path::parent).map(PathBuf::from);
    let package = || env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    folder.or_else(package).unwrap_or_default()
}

/// Items that make cargo rebuild after a change of a file that the description names.
fn watched(source: &Source, folder: &Path) -> TokenStream {
    let files = source.attachments.iter();
    files
        .filter_map(|file| {
            let path = path::absolute(folder.join(&file.path)).ok()?;
            let path = path.to_str()?;
            Some(quote!(
                const _: &[u8] = ::core::include_bytes!(#path);
            ))
        })
        .collect()
}

/// Name of the module, at the location of the description's name.
fn module_name(name: &str, tokens: &[Token]) -> Result<Ident, TokenStream> {
    let mut pairs = tokens.windows(2);
    let named = pairs.find(|pair| pair[0].text == "mechanism" && pair[1].text == name);
    let span = named.map_or_else(Span::call_site, |pair| pair[1].span);
    if syn::parse_str::<Ident>(name).is_ok() {
        return Ok(Ident::new(name, span));
    }
    if matches!(name, "crate" | "self" | "super") {
        let problem = format!("`{name}` is not a name for a module: Rust reserves this word");
        return Err(findings::error([span; 2], &problem));
    }
    Ok(Ident::new_raw(name, span))
}
