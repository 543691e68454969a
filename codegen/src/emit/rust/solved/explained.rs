//! What the blocks are called and where they are singular, for those who read of a failure.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::derivation::SingularPose;
use crate::emit::rust::literal::count;
use crate::program::solved::{BlockProgram, SolvedProgram};

/// The longest line of documentation that is not broken, in characters.
const WIDTH: usize = 100;

/// The longest determinant that is documented.
const LONGEST: usize = 160;

/// The names of all blocks, and the function that puts them together with a failure.
pub(in crate::emit::rust) fn explained(
    solved: &SolvedProgram,
    poses: &[SingularPose],
) -> TokenStream {
    let names = solved.blocks.iter().map(|block| {
        let (name, singular) = (&block.spoken, said(block, poses));
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

/// The steps of a block.
fn of<'a>(
    block: &BlockProgram,
    poses: &'a [SingularPose],
) -> impl Iterator<Item = &'a SingularPose> {
    let place = block.place;
    poses.iter().filter(move |pose| place == Some(pose.block))
}

/// `c2 and the actuator c8-c7 are in line`; empty where the block is never singular.
fn said(block: &BlockProgram, poses: &[SingularPose]) -> String {
    let said = of(block, poses).filter_map(|pose| pose.said.as_deref());
    said.collect::<Vec<_>>().join(", or ")
}

/// What the documentation of a block's function says of its determinants: `det = √3·sin φ₂: zero where …`.
pub(super) fn determinants(block: &BlockProgram, poses: &[SingularPose]) -> Vec<String> {
    let mut lines = Vec::new();
    for pose in of(block, poses) {
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
