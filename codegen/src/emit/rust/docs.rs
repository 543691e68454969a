//! Documentation attributes.

use proc_macro2::TokenStream;
use quote::quote;

/// One `///` line per line of text.
pub(super) fn docs<S: AsRef<str>>(lines: impl IntoIterator<Item = S>) -> TokenStream {
    let mut tokens = TokenStream::new();
    for line in lines {
        // A space after the slashes, as a person writes it.
        let line = line.as_ref().trim();
        let line = if line.is_empty() {
            String::new()
        } else {
            format!(" {line}")
        };
        tokens.extend(quote!(#[doc = #line]));
    }
    tokens
}
