//! How close the mechanism is to a singular pose, as functions of the frame.

use proc_macro2::TokenStream;
use quote::quote;

use super::names::plain_name;
use crate::emit::rust::literal::count;
use crate::program::solved::{Measured, SolvedProgram};
use crate::system::System;

/// The functions that say it; nothing where the description does not ask.
pub(in crate::emit::rust) fn closeness(system: &System, solved: &SolvedProgram) -> TokenStream {
    if !system.mechanism.monitor {
        return TokenStream::new();
    }
    let blocks = solved.blocks.iter().enumerate();
    let each = blocks.flat_map(|(index, block)| {
        let number = count(index);
        block.measured.iter().map(move |measured| {
            let measure = measure(measured, system);
            quote!(Closeness::new(#number, #measure, &BLOCKS[#number]))
        })
    });
    let each: Vec<TokenStream> = each.collect();
    let number = count(each.len());
    quote! {
        /// How close every loop is to a singular pose, in solve order; see `linkwright::Closeness`.
        pub fn closeness_of_each(&self) -> [Closeness; #number] {
            [#(#each),*]
        }

        /// How close the loop is to a singular pose that is closest to one.
        pub fn closeness(&self) -> Closeness {
            Closeness::closest(&self.closeness_of_each())
        }
    }
}

fn measure(measured: &Measured, system: &System) -> TokenStream {
    match measured {
        Measured::Sine(sine) => {
            let sine = plain_name(*sine, system);
            quote!(Measure::sine(self.#sine))
        }
        Measured::Slope(slope) => {
            let slope = plain_name(*slope, system);
            quote!(Measure::slope(self.#slope))
        }
        Measured::Block(both) => {
            let [determinant, condition] = both.map(|symbol| plain_name(symbol, system));
            quote!(Measure { determinant: self.#determinant, reciprocal_condition: self.#condition })
        }
    }
}
