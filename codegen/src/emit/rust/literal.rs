//! Numbers → literals of Rust.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// Magnitudes from the first to below the second are written without an exponent.
const SMALLEST_PLAIN: f64 = 1e-5;
const LARGEST_PLAIN: f64 = 1e16;

/// The scalar of the generated code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scalar {
    /// Double precision.
    #[default]
    F64,
    /// Single precision, for processors without hardware for more.
    F32,
}

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
        let size = value.abs();
        let text = match self {
            // Beyond single precision a number would become infinite or zero; it stays, and the compiler says so.
            Scalar::F32 if (size as f32).is_finite() => digits(size, size as f32),
            _ => digits(size, size),
        };
        let magnitude = text
            .parse()
            .unwrap_or_else(|_| Literal::f64_unsuffixed(size));
        match value < 0.0 {
            true => quote!(-#magnitude),
            false => quote!(#magnitude),
        }
    }
}

/// The digits of a number; beyond ordinary sizes a literal would be hundreds of digits long.
fn digits<T: std::fmt::Display + std::fmt::LowerExp>(size: f64, value: T) -> String {
    if size != 0.0 && !(SMALLEST_PLAIN..LARGEST_PLAIN).contains(&size) {
        return format!("{value:e}");
    }
    let text = value.to_string();
    match text.contains('.') {
        true => text,
        false => format!("{text}.0"),
    }
}

/// A number of elements.
pub(super) fn count(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}
