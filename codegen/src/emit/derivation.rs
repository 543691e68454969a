//! Writes the derivation of a solution in words and formulas, block by block, as a textbook would.
//!
//! The page prints the statements of each block's function, with the words of its solution methods beside them. Short
//! local names of the code, which are computed once, are written out. A script writes words and formulas, and a page
//! lays them out.

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

/// Functions of all blocks without omissions, for pages of any format.
pub struct Derivation<'a> {
    pool: Draft,
    system: &'a System,
    plan: &'a SolvedPlan,
    blocks: Vec<Block>,
    branches: Vec<Branch>,
}

impl<'a> Derivation<'a> {
    /// Derivation of a system and its plan.
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

    /// Expressions, including those of the derivation.
    pub fn pool(&self) -> &Pool {
        &self.pool
    }

    /// Equations.
    pub fn system(&self) -> &System {
        self.system
    }

    /// Blocks in solve order.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Assembly modes.
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// Returns the derivation as plain text.
    pub fn text(mut self, notation: Notation) -> String {
        text_page::page(&Writer::new(&mut self, Script::Text(notation)).document())
    }

    /// Returns the derivation as a LaTeX document, which needs only amsmath.
    pub fn latex(mut self) -> String {
        latex_page::page(&Writer::new(&mut self, Script::Latex).document())
    }

    /// Returns the derivation as LaTeX for a document with its own preamble.
    pub fn latex_fragment(mut self) -> String {
        latex_page::fragment(&Writer::new(&mut self, Script::Latex).document())
    }

    /// Returns the derivation as parts of a page with MathML.
    pub fn html(mut self) -> HtmlDerivation {
        html_page::page(&Writer::new(&mut self, Script::Html).document())
    }
}

/// Returns the derivation as plain text.
pub fn text(pool: &Pool, system: &System, plan: &SolvedPlan, notation: Notation) -> String {
    Derivation::new(pool, system, plan).text(notation)
}

/// Returns the derivation as a LaTeX document, which needs only amsmath.
pub fn latex(pool: &Pool, system: &System, plan: &SolvedPlan) -> String {
    Derivation::new(pool, system, plan).latex()
}

/// Returns the derivation as parts of a page with MathML.
pub fn html(pool: &Pool, system: &System, plan: &SolvedPlan) -> HtmlDerivation {
    Derivation::new(pool, system, plan).html()
}

/// Returns only the table at the head of the derivation: unknowns, method and joints of each block in solve order.
pub fn outline(pool: &Pool, system: &System, plan: &SolvedPlan, notation: Notation) -> String {
    let forms = crate::program::forms_of(&mut pool.draft(), system, plan);
    let lines = outline::outline(pool, system, plan, &forms, Script::Text(notation));
    text_page::outline(&lines)
}

/// Singular poses of each subsystem of the plan, in solve order; `forms` are its solution methods, block by block.
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

/// Conditions of each joint and driver, in the order of the mechanism, as sentences with formulas in MathML.
pub fn constraints_in_html(pool: &Pool, system: &System) -> Vec<String> {
    let mut pool = pool.draft();
    let mechanism = &system.mechanism;
    let phrases: Vec<Phrase> = (0..mechanism.joints.len())
        .map(|joint| crate::words::constraint(mechanism, joint, &mut pool.graph))
        .collect();
    // New expressions are in this graph.
    let mut spelling = Spelling::new(&mut pool, system, Script::Html);
    let sentences = phrases.iter().map(|words| spelling.phrase(words));
    sentences.collect()
}

/// Writes words as plain text.
pub struct PlainWords<'a> {
    system: &'a System,
    script: Script,
    /// Draft of the pool, which formulas in words extend.
    draft: RefCell<Draft>,
}

impl<'a> PlainWords<'a> {
    /// Words about this system.
    pub fn new(pool: &Pool, system: &'a System, notation: Notation) -> PlainWords<'a> {
        PlainWords {
            system,
            script: Script::Text(notation),
            draft: RefCell::new(pool.draft()),
        }
    }

    /// Text of a phrase.
    pub fn say(&self, words: &Phrase) -> String {
        let mut draft = self.draft.borrow_mut();
        Spelling::new(&mut draft, self.system, self.script).phrase(words)
    }
}
