//! System and SolvedPlan → the derivation in words and formulas, block by block, as a person would hand it in.
//!
//! The page prints the very statements of each block's function, with the words that its forms say beside them; what the code
//! calls by a short name and computes once is written out where a person would. A script says how words and formulas look, and a
//! page lays them out. Deliberately unknown here: what is particular to a form.

mod block_words;
mod document;
mod html_page;
mod latex_page;
mod outline;
mod page;
mod script;
mod singular;
mod spelling;
mod text_page;

pub use block_words::{BlockWords, block_words};
pub use html_page::{HtmlDerivation, HtmlSection};
pub use script::Script;
pub use singular::SingularPose;

use std::cell::RefCell;
use std::sync::Arc;

use super::Notation;
use crate::program::forms::Form;
use crate::program::{Block, Branch, unpruned};
use crate::structure::SolvedPlan;
use crate::system::System;
use crate::words::Phrase;
use page::Writer;
use spelling::Spelling;

/// The functions of all blocks with nothing left out, which any page shows.
pub struct Derivation<'a> {
    system: System,
    plan: &'a SolvedPlan,
    blocks: Vec<Block>,
    branches: Vec<Branch>,
}

impl<'a> Derivation<'a> {
    /// Of a system and its plan.
    pub fn new(mut system: System, plan: &'a SolvedPlan) -> Derivation<'a> {
        let (blocks, branches) = unpruned(&mut system, plan);
        Derivation {
            system,
            plan,
            blocks,
            branches,
        }
    }

    /// The system with what has been computed on the way.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// What is shown, block by block.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The assembly modes.
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// As plain text.
    pub fn text(self, notation: Notation) -> String {
        text_page::page(&Writer::new(self, Script::Text(notation)).document())
    }

    /// As a LaTeX document, which needs amsmath only.
    pub fn latex(self) -> String {
        latex_page::page(&Writer::new(self, Script::Latex).document())
    }

    /// As LaTeX for a document that has a preamble.
    pub fn latex_fragment(self) -> String {
        latex_page::fragment(&Writer::new(self, Script::Latex).document())
    }

    /// As parts of a page with MathML.
    pub fn html(self) -> HtmlDerivation {
        html_page::page(&Writer::new(self, Script::Html).document())
    }
}

/// The derivation as plain text.
pub fn text(system: &System, plan: &SolvedPlan, notation: Notation) -> String {
    Derivation::new(system.clone(), plan).text(notation)
}

/// The derivation as a LaTeX document, which needs amsmath only.
pub fn latex(system: &System, plan: &SolvedPlan) -> String {
    Derivation::new(system.clone(), plan).latex()
}

/// The derivation as parts of a page with MathML.
pub fn html(system: &System, plan: &SolvedPlan) -> HtmlDerivation {
    Derivation::new(system.clone(), plan).html()
}

/// The table at the head of the derivation alone: unknowns, method and joints of each block in solve order.
pub fn outline(system: &System, plan: &SolvedPlan, notation: Notation) -> String {
    let forms = crate::program::forms_of(&mut system.clone(), plan);
    let lines = outline::outline(system, plan, &forms, Script::Text(notation));
    text_page::outline(&lines)
}

/// Where each part of the plan is singular, in solve order; `forms` says how they are solved, block by block.
pub fn singular_poses(
    system: &System,
    plan: &SolvedPlan,
    forms: &[Vec<Arc<dyn Form>>],
    script: Script,
) -> Vec<SingularPose> {
    singular::singular_poses(&mut Spelling::new(system.clone(), script), plan, forms)
}

/// What each joint and driver asks for, in the order of the mechanism, as sentences with formulas in MathML.
pub fn constraints_in_html(system: &System) -> Vec<String> {
    let mut mechanism = system.mechanism.clone();
    let phrases: Vec<Phrase> = (0..mechanism.joints.len())
        .map(|joint| crate::words::constraint(&mut mechanism, joint))
        .collect();
    // What has been made of expressions is in this graph.
    let mut spelling = Spelling::new(
        System {
            mechanism,
            ..system.clone()
        },
        Script::Html,
    );
    let sentences = phrases.iter().map(|words| spelling.phrase(words));
    sentences.collect()
}

/// Writes words as plain text.
pub struct PlainWords {
    /// Formulas in words are made in its graph.
    spelling: RefCell<Spelling>,
}

impl PlainWords {
    /// For words about this system.
    pub fn new(system: &System, notation: Notation) -> PlainWords {
        PlainWords {
            spelling: RefCell::new(Spelling::new(system.clone(), Script::Text(notation))),
        }
    }

    /// Words as text.
    pub fn say(&self, words: &Phrase) -> String {
        self.spelling.borrow_mut().phrase(words)
    }
}
