//! Answers of the interpreted formulations for a mechanism with its truth, in f64.

use linkwright_solver::Interpreted;

use super::known::Known;
use super::ways::{Answered, solved, textbook};

/// All answers of the textbook view, then all of the solved view.
pub fn answers(known: &Known) -> [Vec<Answered>; 2] {
    let dense = textbook(&known.interpreter, &known.task);
    let blocks = Interpreted::new(&known.derived).map(|blocks| solved(&blocks, &known.task));
    [dense, blocks.unwrap_or_default()]
}
