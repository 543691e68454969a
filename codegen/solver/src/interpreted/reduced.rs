//! Leaves out the operations whose results nothing reads.

use linkwright_codegen::stages::expr::{Code, Reads, Register};

use crate::operation::Operation;

/// Operations of all blocks with their code.
#[derive(Clone, Debug)]
pub(super) struct Reduced {
    pub code: Code,
    /// Operations by block.
    pub operations: Vec<Vec<Operation>>,
    pub reads: Reads,
}

impl Reduced {
    /// Reduces the operations of all blocks to those whose results are among `read`, and to those that may fail. `None` for operations of
    /// Newton-Raphson, which read more than they name.
    pub fn new(
        code: &Code,
        blocks: &[&[Operation]],
        read: impl Iterator<Item = Register>,
    ) -> Option<Reduced> {
        let mut reads = Reads::new(code);
        reads.add(read);
        let mut operations: Vec<Vec<Operation>> = Vec::with_capacity(blocks.len());
        for block in blocks.iter().rev() {
            let mut kept = Vec::with_capacity(block.len());
            for operation in block.iter().rev() {
                if add(&mut reads, code, operation)? {
                    kept.push(operation.clone());
                }
            }
            kept.reverse();
            operations.push(kept);
        }
        operations.reverse();
        let (code, places) = code.reduced(&reads);
        for block in &mut operations {
            for operation in block.iter_mut() {
                if let Operation::Run(range) | Operation::Reach { bounds: range, .. } = operation {
                    *range = places[range.start]..places[range.end];
                }
            }
            block.retain(|it| !matches!(it, Operation::Run(range) if range.is_empty()));
        }
        Some(Reduced {
            code,
            operations,
            reads,
        })
    }
}

/// Adds what an operation reads; returns false if it can be left out.
fn add(reads: &mut Reads, code: &Code, operation: &Operation) -> Option<bool> {
    match operation {
        Operation::Run(range) => reads.add_range(code, range.clone()),
        Operation::Angle {
            target,
            sine,
            cosine,
            last,
        } => {
            if !reads.has(*target) {
                return Some(false);
            }
            reads.add([*sine, *cosine, *last]);
        }
        Operation::Reach {
            excess,
            scale,
            bounds,
            bridged,
        } => {
            reads.add(*bridged);
            reads.add_range(code, bounds.clone());
            reads.add([*excess, *scale]);
        }
        Operation::Nonzero { value, scale } => reads.add([*value, *scale]),
        Operation::Positive { length, .. } => reads.add([*length]),
        Operation::Multipliers {
            targets,
            jacobian,
            forces,
        } => {
            if !targets.iter().flatten().any(|it| reads.has(*it)) {
                return Some(false);
            }
            reads.add(jacobian.iter().chain(forces).copied());
        }
        Operation::Friction { targets, joints } => {
            if !targets.iter().flatten().any(|it| reads.has(*it)) {
                return Some(false);
            }
            reads.add(joints.read());
        }
        Operation::Newton
        | Operation::Factorize
        | Operation::Solve { .. }
        | Operation::Signal { .. }
        | Operation::Require(..)
        | Operation::Isolate(_) => return None,
    }
    Some(true)
}
