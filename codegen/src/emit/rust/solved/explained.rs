//! What the blocks are called, for those who read of a failure.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::rust::literal::count;
use crate::program::solved::SolvedProgram;

/// The names of all blocks, and the function that puts them together with a failure.
pub(in crate::emit::rust) fn explained(solved: &SolvedProgram) -> TokenStream {
    let names = solved.blocks.iter().map(|block| {
        let (name, singular) = (&block.spoken, &block.singular);
        quote!(BlockName { name: #name, singular: #singular })
    });
    let length = count(solved.blocks.len());
    quote! {
        /// What the blocks are called, in solve order, and what can be said of them where they are singular.
        #[allow(dead_code)]
        pub const BLOCKS: [BlockName; #length] = [#(#names),*];

        /// A failure in the mechanism's own terms, as one sentence.
        #[allow(dead_code)]
        pub fn describe(failure: &Failure) -> Explained {
            Explained { failure: *failure, blocks: &BLOCKS }
        }
    }
}
