//! Numbers → literals of Rust.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::emit::scalar::Scalar;

impl Scalar {
    /// The module of the runtime whose types have this scalar.
    pub(super) fn precision(self) -> TokenStream {
        match self {
            Scalar::F64 => quote!(double),
            Scalar::F32 => quote!(single),
        }
    }

    /// A finite number in the fewest digits that give it back, without a type suffix.
    pub(super) fn literal(self, value: f64) -> TokenStream {
        let magnitude = self
            .digits(value)
            .parse()
            .unwrap_or_else(|_| Literal::f64_unsuffixed(value.abs()));
        match value < 0.0 {
            true => quote!(-#magnitude),
            false => quote!(#magnitude),
        }
    }
}

/// A number of elements.
pub(super) fn count(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}
