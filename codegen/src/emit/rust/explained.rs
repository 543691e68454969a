//! What the blocks are called and where they are singular, for those who read of a failure.

use proc_macro2::TokenStream;
use quote::quote;

use super::literal::count;
use crate::emit::derivation::BlockWords;
use crate::emit::module::Module;

/// The names of all blocks.
pub(super) fn block_names(module: &Module<'_>) -> TokenStream {
    let names = module
        .words
        .iter()
        .map(|BlockWords { name, singular }| quote!(BlockName::new(#name, #singular)));
    let length = count(module.program.blocks.len());
    quote! {
        /// Names of the blocks in solve order, with descriptions of their singular poses.
        pub const BLOCKS: [BlockName<'static>; #length] = [#(#names),*];
    }
}
