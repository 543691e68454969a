//! Blocks and their modes → warnings about assembly modes that the drawing decides by little.
//!
//! The mode of a closed form is the sign of its determinant in the drawing, whether or not the drawing fits its lengths; the same
//! holds for a Newton-Raphson where the drawing fits, and where it does not, for the pose that is found from the drawing. Where the
//! determinant is nearly zero, its sign is an accident. Deliberately unknown here: what is done with the sign.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::program::{Block, Branch, DrawnMode};
use crate::system::System;

/// The least sine of the angle between two links, or a link and its slide, that tells their sides apart: drawings are written with
/// three digits at least.
const DECIDED: f64 = 1e-3;

/// What the drawing of a system decides by little; modes of other blocks are passed over.
pub fn undecided(system: &System, blocks: &[Block], branches: &[Branch]) -> Diagnostics {
    let mut found = Diagnostics::new();
    let block_of = |place: usize| blocks.iter().find(|it| it.place == Some(place));
    for branch in branches {
        // Written so that NaN decides nothing.
        let is_decided = branch.drawn.abs() >= DECIDED;
        if is_decided {
            continue;
        }
        if let Some(block) = block_of(branch.block) {
            let sign = if branch.is_positive() {
                "positive"
            } else {
                "negative"
            };
            let decided = format!("{}; the {sign} sign is taken", branch.meaning);
            found.extend(warning(block, &decided, system));
        }
    }
    for block in blocks {
        let newton = block.newton.as_ref();
        if newton.is_some_and(|newton| newton.drawn == DrawnMode::Undecided) {
            let decided = "which pose Newton-Raphson finds; that nearest to the drawing is taken";
            found.extend(warning(block, decided, system));
        }
    }
    found
}

fn warning(block: &Block, decided: &str, system: &System) -> Option<Diagnostic> {
    let joints = &system.mechanism.joints;
    let mut own = block.joints.iter().map(|&joint| &joints[joint]);
    let first = own.next()?;
    let message = format!("the drawing hardly decides {decided}");
    let mut warning = Diagnostic::warning(Code::UndecidedMode, first.span, message)
        .label("in the loop that this closes")
        .help("draw the links clearly on the side that is meant: nearly in line, rounding decides");
    if let Some(last) = own.next_back() {
        warning = warning.also(last.span, "and this");
    }
    Some(warning)
}
