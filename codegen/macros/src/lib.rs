//! Planar mechanisms described in the middle of Rust code.

#![doc(html_root_url = "https://docs.rs/linkwright-macros/0.1.0")]

mod expansion;
mod findings;
mod head;
#[cfg(test)]
mod tests;
mod tokens;
mod written;

use std::sync::{Mutex, PoisonError};

use proc_macro::TokenStream;

/// One at a time: whether tokens are the compiler's holds for a whole process, and a compiler may expand on several threads.
static EXPANDING: Mutex<()> = Mutex::new(());

/// The module of a described mechanism.
#[proc_macro]
pub fn mechanism(input: TokenStream) -> TokenStream {
    let _one = EXPANDING.lock().unwrap_or_else(PoisonError::into_inner);
    expansion::expand(input.into()).into()
}
