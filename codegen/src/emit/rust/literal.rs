//! Numbers → literals of Rust.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// A finite number in the fewest digits that give it back, without a type suffix.
pub(super) fn float(value: f64) -> TokenStream {
    assert!(
        value.is_finite(),
        "non-finite constants are rejected when a description is read"
    );
    let magnitude = Literal::f64_unsuffixed(value.abs());
    // Beyond this a literal would be hundreds of digits long.
    let magnitude = if value != 0.0 && !(1e-5..1e16).contains(&value.abs()) {
        let text = format!("{:e}", value.abs());
        text.parse().unwrap_or(magnitude)
    } else {
        magnitude
    };
    if value.is_sign_negative() && value != 0.0 {
        quote!(-#magnitude)
    } else {
        quote!(#magnitude)
    }
}

/// A number of elements.
pub(super) fn count(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}
