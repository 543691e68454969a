//! Reports diagnostics in the text of a description as diagnostics of the compiler, at its tokens.
//!
//! An error is a `compile_error!`. A macro cannot warn. A warning is therefore a deprecated constant with the text as
//! its note, used at the location of the warning. The warning therefore shows in an editor, is repeated by every build,
//! and follows `#[allow(deprecated)]` and `#![deny(warnings)]` as any other warning of code does.

use std::fmt::Write as _;

use linkwright_codegen::diagnostic::{Diagnostic, Diagnostics, Severity};
use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream};
use quote::{quote, quote_spanned};

use crate::written::Written;

/// Items that make the compiler report diagnostics.
pub fn items(diagnostics: Diagnostics, written: &Written) -> TokenStream {
    let diagnostics = diagnostics.into_iter();
    diagnostics
        .map(|finding| {
            let place = written.tokens_at(finding.primary.span);
            let message = message(&finding, written);
            match finding.severity {
                Severity::Error => error(place, &format!("{}: {message}", finding.code)),
                Severity::Warning => warning(place[0], finding.code.name(), &message),
            }
        })
        .collect()
}

/// Error from the first to the last of two locations.
pub fn error([first, last]: [Span; 2], message: &str) -> TokenStream {
    // The compiler marks from the beginning of the path to the end of the braces.
    let mut braces = Group::new(Delimiter::Brace, quote_spanned!(last=> #message));
    braces.set_span(last);
    quote_spanned!(first=> ::core::compile_error! #braces)
}

/// Warning with a constant that is named after its code.
fn warning(place: Span, code: &str, message: &str) -> TokenStream {
    let name = Ident::new(code, place);
    quote! {
        const _: () = {
            #[deprecated(note = #message)]
            const #name: () = ();
            #name
        };
    }
}

/// Text of a diagnostic without its code; other locations by their lines.
fn message(finding: &Diagnostic, written: &Written) -> String {
    let mut text = finding.message.clone();
    if !finding.primary.text.is_empty() {
        let _ = write!(text, "\n{}", finding.primary.text);
    }
    for label in &finding.secondary {
        let [place, _] = written.tokens_at(label.span);
        let (file, start) = (place.file(), place.start());
        let label_text = match label.text.as_str() {
            "" => "see",
            label_text => label_text,
        };
        let column = start.column + 1;
        let _ = write!(text, "\n{label_text}: {file}:{}:{column}", start.line);
    }
    for note in &finding.notes {
        let _ = write!(text, "\nnote: {note}");
    }
    for help in &finding.help {
        let _ = write!(text, "\nhelp: {help}");
    }
    text
}
