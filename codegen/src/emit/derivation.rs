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
use crate::pool::{Draft, Pool};
use crate::program::forms::Form;
use crate::program::{Block, Branch, unpruned};
use crate::structure::SolvedPlan;
use crate::system::System;
use crate::words::Phrase;
use page::Writer;
use spelling::Spelling;

/// The functions of all blocks with nothing left out, which any page shows.
pub struct Derivation<'a> {
    pool: Draft,
    system: &'a System,
    plan: &'a SolvedPlan,
    blocks: Vec<Block>,
    branches: Vec<Branch>,
}

impl<'a> Derivation<'a> {
    /// Of a system and its plan.
    pub fn new(pool: &Pool, system: &'a System, plan: &'a SolvedPlan) -> Derivation<'a> {
        let mut pool = pool.draft();
        let (blocks, branches) = unpruned(&mut pool, system, plan);
        Derivation {
            pool,
            system,
            plan,
            blocks,
            branches,
        }
    }

    /// The expressions, with those that were made on the way.
    pub fn pool(&self) -> &Pool {
        &self.pool
    }

    /// The equations.
    pub fn system(&self) -> &System {
        self.system
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
    pub fn text(mut self, notation: Notation) -> String {
        text_page::page(&Writer::new(&mut self, Script::Text(notation)).document())
    }

    /// As a LaTeX document, which needs amsmath only.
    pub fn latex(mut self) -> String {
        latex_page::page(&Writer::new(&mut self, Script::Latex).document())
    }

    /// As LaTeX for a document that has a preamble.
    pub fn latex_fragment(mut self) -> String {
        latex_page::fragment(&Writer::new(&mut self, Script::Latex).document())
    }

    /// As parts of a page with MathML.
    pub fn html(mut self) -> HtmlDerivation {
        html_page::page(&Writer::new(&mut self, Script::Html).document())
    }
}

/// The derivation as plain text.
pub fn text(pool: &Pool, system: &System, plan: &SolvedPlan, notation: Notation) -> String {
    Derivation::new(pool, system, plan).text(notation)
}

/// The derivation as a LaTeX document, which needs amsmath only.
pub fn latex(pool: &Pool, system: &System, plan: &SolvedPlan) -> String {
    Derivation::new(pool, system, plan).latex()
}

/// The derivation as parts of a page with MathML.
pub fn html(pool: &Pool, system: &System, plan: &SolvedPlan) -> HtmlDerivation {
    Derivation::new(pool, system, plan).html()
}

/// The table at the head of the derivation alone: unknowns, method and joints of each block in solve order.
pub fn outline(pool: &Pool, system: &System, plan: &SolvedPlan, notation: Notation) -> String {
    let forms = crate::program::forms_of(&mut pool.draft(), system, plan);
    let lines = outline::outline(pool, system, plan, &forms, Script::Text(notation));
    text_page::outline(&lines)
}

/// Where each part of the plan is singular, in solve order; `forms` says how they are solved, block by block.
pub fn singular_poses(
    pool: &Pool,
    system: &System,
    plan: &SolvedPlan,
    forms: &[Vec<Arc<dyn Form>>],
    script: Script,
) -> Vec<SingularPose> {
    singular::singular_poses(
        &mut Spelling::new(&mut pool.draft(), system, script),
        plan,
        forms,
    )
}

/// What each joint and driver asks for, in the order of the mechanism, as sentences with formulas in MathML.
pub fn constraints_in_html(pool: &Pool, system: &System) -> Vec<String> {
    let mut pool = pool.draft();
    let mechanism = &system.mechanism;
    let phrases: Vec<Phrase> = (0..mechanism.joints.len())
        .map(|joint| crate::words::constraint(mechanism, joint, &mut pool.graph))
        .collect();
    let mut spelling = Spelling::new(&mut pool, system, Script::Html);
    let sentences = phrases.iter().map(|words| spelling.phrase(words));
    sentences.collect()
}

/// Writes words as plain text.
pub struct PlainWords<'a> {
    system: &'a System,
    script: Script,
    /// Formulas in words are made in it.
    draft: RefCell<Draft>,
}

impl<'a> PlainWords<'a> {
    /// For words about this system.
    pub fn new(pool: &Pool, system: &'a System, notation: Notation) -> PlainWords<'a> {
        PlainWords {
            system,
            script: Script::Text(notation),
            draft: RefCell::new(pool.draft()),
        }
    }

    /// Words as text.
    pub fn say(&self, words: &Phrase) -> String {
        let mut draft = self.draft.borrow_mut();
        Spelling::new(&mut draft, self.system, self.script).phrase(words)
    }
}
