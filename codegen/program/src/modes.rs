//! Warns about assembly modes that the design configuration hardly decides.
//!
//! The mode of a closed form is the sign of its determinant in the design configuration, even if that does not fit the lengths.
//! For Newton-Raphson, the pose is the design configuration if that fits, otherwise the solution found from it. The sign of a
//! nearly zero determinant is accidental.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::program::{Block, Branch, DrawnMode};
use crate::system::System;

/// Smallest sine of the angle between two links, or a link and its slide, that determines their mode: descriptions have at least
/// three digits.
const DECIDED: f64 = 1e-3;

/// Warns about modes that the design configuration hardly decides; modes of other blocks are skipped.
pub fn undecided(system: &System, blocks: &[Block], branches: &[Branch]) -> Diagnostics {
    let mut warnings = Diagnostics::new();
    let block_of = |place: usize| blocks.iter().find(|it| it.place == Some(place));
    for branch in branches {
        // NaN must count as undecided, hence this comparison.
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
            warnings.extend(warning(block, &decided, system));
        }
    }
    for block in blocks {
        let newton = block.newton.as_ref();
        if newton.is_some_and(|newton| newton.drawn == DrawnMode::Undecided) {
            let decided = "which pose Newton-Raphson finds; the nearest one is taken";
            warnings.extend(warning(block, decided, system));
        }
    }
    warnings
}

fn warning(block: &Block, decided: &str, system: &System) -> Option<Diagnostic> {
    let joints = &system.mechanism.joints;
    let mut joints = block.joints.iter().map(|&joint| &joints[joint]);
    let first = joints.next()?;
    let message = format!("the design configuration hardly decides {decided}");
    let mut warning = Diagnostic::warning(Code::UndecidedMode, first.span, message)
        .label("in the loop that this closes")
        .help(
            "place the links clearly on the intended side: if they are nearly collinear, rounding decides",
        );
    if let Some(last) = joints.next_back() {
        warning = warning.also(last.span, "and this");
    }
    Some(warning)
}
