//! How close the mechanism is to a singular pose, as functions of the frame.

use proc_macro2::TokenStream;
use quote::quote;

use super::literal::count;
use crate::emit::module::Module;
use crate::program::Measured;

/// The functions that say it; nothing where the description does not ask.
pub(super) fn smallest_determinant(module: &Module<'_>) -> TokenStream {
    if !module.system.mechanism.monitor {
        return TokenStream::new();
    }
    let blocks = module.program.blocks.iter().enumerate();
    let each = blocks.flat_map(|(index, block)| {
        let number = count(index);
        block.measured.iter().map(move |measured| {
            let measure = measure(measured, module);
            quote!(NormalizedDeterminant::new(#number, #measure, BLOCKS[#number]))
        })
    });
    let each: Vec<TokenStream> = each.collect();
    let number = count(each.len());
    quote! {
        /// How close every loop is to a singular pose, in solve order; see `linkwright::NormalizedDeterminant`.
        pub fn normalized_determinants(&self) -> [NormalizedDeterminant; #number] {
            [#(#each),*]
        }

        /// How close the loop is to a singular pose that is closest to one.
        pub fn smallest_determinant(&self) -> NormalizedDeterminant {
            NormalizedDeterminant::closest(&self.normalized_determinants())
        }
    }
}

fn measure(measured: &Measured, module: &Module<'_>) -> TokenStream {
    let own = |symbol| module.field_name(symbol);
    match measured {
        Measured::Sine(sine) => {
            let sine = own(*sine);
            quote!(Measure::sine(self.#sine))
        }
        Measured::Slope(slope) => {
            let slope = own(*slope);
            quote!(Measure::slope(self.#slope))
        }
        Measured::Block(both) => {
            let [determinant, condition] = both.map(own);
            quote!(Measure { determinant: self.#determinant, reciprocal_condition: self.#condition })
        }
    }
}
