//! System and SolvedPlan → the derivation in words and formulas, block by block, as a person would hand it in.
//!
//! The wording is written once; a script says how formulas look in it, and a page lays them out. Every formula is printed from
//! the nodes of the plan, so that the page says what the generated code does. Deliberately unknown here: statements of the
//! program, and how its values are named.

mod block;
mod definitions;
mod document;
mod dyad_motion;
mod ends;
mod geometry;
mod latex_page;
mod newton;
mod one_angle;
mod origin;
mod outline;
mod script;
mod singular;
mod singular_words;
mod slides;
mod text_page;
mod triangle;
mod turning_slide;
mod two_rotations;
mod vector;
mod words;
mod writer;

pub use singular::SingularPose;

use super::Notation;
use crate::structure::SolvedPlan;
use crate::system::System;
use script::Script;
use writer::Writer;

/// The derivation as plain text.
pub fn text(system: &System, plan: &SolvedPlan, notation: Notation) -> String {
    text_page::page(&Writer::new(system, plan, Script::Text(notation)).document())
}

/// The derivation as a LaTeX document, which needs amsmath only.
pub fn latex(system: &System, plan: &SolvedPlan) -> String {
    latex_page::page(&Writer::new(system, plan, Script::Latex).document())
}

/// The table at the head of the derivation alone: unknowns, method and joints of each block in solve order.
pub fn outline(system: &System, plan: &SolvedPlan, notation: Notation) -> String {
    let lines = Writer::new(system, plan, Script::Text(notation)).outline();
    text_page::outline(&lines)
}

/// Where each step of the plan is singular, in solve order.
pub fn singular_poses(system: &System, plan: &SolvedPlan, notation: Notation) -> Vec<SingularPose> {
    Writer::new(system, plan, Script::Text(notation)).singular_poses()
}
