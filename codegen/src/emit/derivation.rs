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
use crate::program::Kept;
use crate::program::forms::Form;
use crate::solved::Solved;
use crate::structure::{Shift, SolvedPlan, Unplanned};
use crate::system::{Derived, System};
use crate::words::Phrase;
use document::Document;
use page::Writer;
use spelling::Spelling;

/// Motion of which nothing is omitted, for any page.
///
/// Generated code has another program: a derivation also shows the values that no output needs, and states why each value is found.
pub struct Derivation {
    solved: Solved,
}

impl Derivation {
    /// Derivation of a motion.
    ///
    /// # Errors
    /// The equations do not determine the motion, or a limit is exceeded.
    pub fn of(derived: Derived, shift: Shift) -> Result<Derivation, Unplanned> {
        let solved = Solved::of(derived, shift, Kept::Everything)?;
        Ok(Derivation { solved })
    }

    /// Derivation of a plan that exists; the pool holds its expressions.
    pub fn of_plan(derived: Derived, plan: SolvedPlan) -> Derivation {
        Derivation {
            solved: Solved::of_plan(derived, plan, Kept::Everything),
        }
    }

    /// Returns the motion with all blocks.
    pub fn solved(&self) -> &Solved {
        &self.solved
    }

    /// Returns the derivation as plain text.
    pub fn text(&self, notation: Notation) -> String {
        text_page::page(&self.document(Script::Text(notation)))
    }

    /// Returns the derivation as a LaTeX document, which needs only amsmath.
    pub fn latex(&self) -> String {
        latex_page::page(&self.document(Script::Latex))
    }

    /// Returns the derivation as LaTeX for a document with its own preamble.
    pub fn latex_fragment(&self) -> String {
        latex_page::fragment(&self.document(Script::Latex))
    }

    /// Returns the derivation as parts of a page with MathML.
    pub fn html(&self) -> HtmlDerivation {
        html_page::page(&self.document(Script::Html))
    }

    /// Returns only the table at the head as plain text: unknowns, method and joints of each block in solve order.
    pub fn outline(&self, notation: Notation) -> String {
        let (pool, system, plan) = (self.solved.pool(), self.solved.system(), self.solved.plan());
        let forms = &self.solved.program().forms;
        let lines = outline::outline(pool, system, plan, forms, Script::Text(notation));
        text_page::outline(&lines)
    }

    fn document(&self, script: Script) -> Document {
        let mut draft = self.solved.pool().draft();
        Writer::new(&mut draft, &self.solved, script).document()
    }
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
