//! *The last pose of a motion that ends, and a time beyond it → which loop stands in the way, in words.*
//!
//! The textbook view knows only that its one large Jacobian is singular. The solved view is moved beyond the end from the same
//! pose, in the assembly modes of that pose: the block that then fails is the one, and where its determinant is zero is known
//! in words. The module does not look for the end.

use linkwright::{FailureKind, Frame};
use linkwright_codegen::emit::{Notation, derivation};
use nalgebra::Dyn;

use crate::solved_interpreter::SolvedInterpreter;

/// `loop M-F-N: c2 and the actuator c8-c7 are in line`, with what follows from it; `None` where all blocks can be solved at
/// `beyond` (s), the pose of `last` is none of the solved view, or the block that cannot be solved is never singular.
pub fn dead_end(solved: &SolvedInterpreter, last: &Frame<f64, Dyn>, beyond: f64) -> Option<String> {
    let (signs, mut values) = solved.modes_of(&last.q, last.t)?;
    let failure = solved.solve(beyond, &signs, &mut values).err()?;
    let block = usize::from(failure.block);
    let poses = derivation::singular_poses(&solved.system, &solved.plan, Notation::Unicode);
    let said: Vec<&str> = poses
        .iter()
        .filter(|pose| pose.block == block)
        .filter_map(|pose| pose.said.as_deref())
        .collect();
    if said.is_empty() || failure.kind == FailureKind::NotFinite {
        return None;
    }
    let [_, spoken] = solved.block_names(block);
    let ends = match failure.kind {
        FailureKind::OutOfReach { .. } => "; beyond, its links do not reach",
        _ => "",
    };
    Some(format!("{spoken}: {}{ends}", said.join(", or ")))
}
