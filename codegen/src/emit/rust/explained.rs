//! What the blocks are called and where they are singular, for those who read of a failure.

use proc_macro2::TokenStream;
use quote::quote;

use super::literal::count;
use super::module::Module;
use crate::emit::derivation::{BlockWords, SingularPose};
use crate::program::Block;

/// The longest line of documentation that is not broken, in characters.
const WIDTH: usize = 100;

/// The longest determinant that is documented.
const LONGEST: usize = 160;

/// The names of all blocks.
pub(super) fn block_names(module: &Module<'_>) -> TokenStream {
    let names = module
        .words
        .iter()
        .map(|BlockWords { name, singular }| quote!(BlockName::new(#name, #singular)));
    let length = count(module.program.blocks.len());
    quote! {
        /// What the blocks are called, in solve order, and what can be said of them where they are singular.
        pub const BLOCKS: [BlockName<'static>; #length] = [#(#names),*];
    }
}

/// The parts of a block.
fn of<'a>(block: &Block, module: &'a Module<'_>) -> impl Iterator<Item = &'a SingularPose> {
    let place = block.place;
    module
        .poses
        .iter()
        .filter(move |pose| place == Some(pose.block))
}

/// What the documentation of a block's function says of its determinants: `det = √3·sin φ₂: zero where …`.
pub(super) fn determinants(block: &Block, module: &Module<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    for pose in of(block, module) {
        let short = |formula: &&String| formula.chars().count() <= LONGEST;
        let text = match (pose.determinant.as_ref().filter(short), &pose.meaning) {
            (Some(formula), Some(meaning)) => {
                format!("det = {formula} up to the sign: zero where {meaning}.")
            }
            (Some(formula), None) => format!("det = {formula} up to the sign: never zero."),
            (None, Some(meaning)) => {
                format!("det has no short form; zero where {meaning}.")
            }
            (None, None) => "det is constant: never zero.".to_string(),
        };
        lines.push(String::new());
        lines.extend(broken(&text));
    }
    lines
}

/// A text as lines of [`WIDTH`], broken between words.
fn broken(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let Some(line) = lines.last_mut() else { break };
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= WIDTH {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.push(word.to_string());
        }
    }
    lines
}
