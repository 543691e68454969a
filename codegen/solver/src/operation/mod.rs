//! Executes operations of a function on registers.

mod arithmetic;
mod friction;
mod isolation;
mod lanes;
mod writer;

use std::ops::Range;

use linkwright::generated::{
    exceeds_rounding, multipliers, not_positive, out_of_reach, singular_divisor,
};
use linkwright::math::Real as _;
use linkwright::{Failure, FailureKind};
use linkwright_codegen::stages::expr::{Code, Register};

use nalgebra::{DMatrix, DVector};

pub(crate) use friction::FrictionJoints;
pub(crate) use isolation::Isolation;
pub(crate) use lanes::run_lanes;
pub(crate) use writer::Writer;

/// Operation of a block.
#[derive(Clone, Debug)]
pub(crate) enum Operation {
    /// Runs instructions.
    Run(Range<usize>),
    /// Finds an angle near its last value.
    Angle {
        target: Register,
        sine: Register,
        cosine: Register,
        last: Register,
    },
    /// Fails where links do not reach; how far they do is computed only then.
    Reach {
        excess: Register,
        scale: Register,
        bounds: Range<usize>,
        /// The distance, and the longest and the shortest that the links bridge.
        bridged: [Register; 3],
    },
    /// Fails where a divisor vanishes.
    Nonzero { value: Register, scale: Register },
    /// Fails where a driven length is not positive, by its place among what must be.
    Positive { length: Register, place: u16 },
    /// Runs the Newton-Raphson of the block.
    Newton,
    /// Factorizes its Jacobian at the tears that were found.
    Factorize,
    /// Solves with it.
    Solve {
        targets: Vec<Option<Register>>,
        right_hand_side: Vec<Register>,
    },
    /// Solves Jᵀ λ = f for the multipliers of a part.
    Multipliers {
        targets: Vec<Option<Register>>,
        /// Row by row.
        jacobian: Vec<Register>,
        forces: Vec<Register>,
    },
    /// Solves for the forces of friction in joints.
    Friction {
        targets: Vec<Option<Register>>,
        joints: FrictionJoints,
    },
    /// Finds the bounds of an input.
    Signal {
        input: usize,
        /// Its radius and its deviation.
        found: [Register; 2],
    },
    /// Fails where a value is negative, and blames a block of the plan.
    Require(Register, usize),
    /// Finds how far unknowns may be from a straight line.
    Isolate(Isolation),
}

/// Runs an operation that concerns no Newton-Raphson, in the block of this number.
#[inline]
pub(crate) fn run(
    operation: &Operation,
    code: &Code,
    registers: &mut [f64],
    t: f64,
    block: u16,
) -> Result<(), Failure> {
    match *operation {
        Operation::Run(ref range) => code.run(range.clone(), registers),
        Operation::Angle {
            target,
            sine,
            cosine,
            last,
        } => {
            let [sine, cosine, last] = [sine, cosine, last].map(|it| registers[it.index()]);
            registers[target.index()] = sine.angle_near(cosine, last);
        }
        Operation::Reach {
            excess,
            scale,
            ref bounds,
            bridged,
        } => {
            if !exceeds_rounding(registers[excess.index()], registers[scale.index()]) {
                code.run(bounds.clone(), registers);
                let [distance, longest, shortest] = bridged.map(|it| registers[it.index()]);
                return Err(out_of_reach(distance, longest, shortest, t, block));
            }
        }
        Operation::Nonzero { value, scale } => {
            let [value, scale] = [value, scale].map(|it| registers[it.index()]);
            if !exceeds_rounding(value * value, scale * scale) {
                return Err(singular_divisor(value, scale, t, block));
            }
        }
        Operation::Positive { length, place } => {
            let length = registers[length.index()];
            if length <= 0.0 {
                return Err(not_positive(length, t, place));
            }
        }
        Operation::Multipliers {
            ref targets,
            ref jacobian,
            ref forces,
        } => {
            let entries = jacobian.iter().map(|it| registers[it.index()]);
            let matrix = DMatrix::from_row_iterator(forces.len(), forces.len(), entries);
            let forces = forces.iter().map(|it| registers[it.index()]);
            let mut solution = DVector::from_iterator(targets.len(), forces);
            multipliers::solve(&matrix, &mut solution)
                .map_err(|kind| linkwright::generated::failed(kind, t, block))?;
            for (target, value) in targets.iter().zip(solution.iter()) {
                if let Some(target) = target {
                    registers[target.index()] = *value;
                }
            }
        }
        Operation::Friction {
            ref targets,
            ref joints,
        } => {
            let forces = joints
                .forces(|register| registers[register.index()])
                .map_err(|kind| linkwright::generated::failed(kind, t, block))?;
            for (target, value) in targets.iter().zip(forces.iter()) {
                if let Some(target) = target {
                    registers[target.index()] = *value;
                }
            }
        }
        Operation::Newton
        | Operation::Factorize
        | Operation::Solve { .. }
        | Operation::Signal { .. }
        | Operation::Require(..)
        | Operation::Isolate(_) => {
            return Err(linkwright::generated::failed(
                FailureKind::NotFinite,
                t,
                block,
            ));
        }
    }
    Ok(())
}
