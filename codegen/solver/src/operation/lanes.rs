//! Executes operations of closed forms in sixteen lanes at once.
//!
//! A lane that does not fail has the bits of [`run`](super::run). Checks return the lanes that fail; their registers then hold
//! arbitrary numbers.

use linkwright::generated::{exceeds_rounding, multipliers};
use linkwright::lanes::Mask;
use linkwright_codegen::stages::expr::{Code, LANES, Lanes, Register};
use linkwright_math::double;
use nalgebra::{DMatrix, DVector};

use super::{FrictionJoints, Operation};

/// Runs an operation; returns the lanes that fail, all of them for an operation of Newton-Raphson.
#[inline(always)]
pub(crate) fn run_lanes(
    operation: &Operation,
    code: &Code,
    registers: &mut [Lanes],
) -> Mask<LANES> {
    let of = |register: Register| registers[register.index()].0;
    match *operation {
        Operation::Run(ref range) => {
            code.run_lanes(range.clone(), registers);
            Mask::NONE
        }
        Operation::Angle {
            target,
            sine,
            cosine,
            last,
        } => {
            let angles = double::angles_near(of(sine), of(cosine), of(last));
            registers[target.index()] = linkwright::lanes::Lanes(angles);
            Mask::NONE
        }
        Operation::Reach { excess, scale, .. } => {
            let [excess, scale] = [excess, scale].map(of);
            Mask::of(|lane| !exceeds_rounding(excess[lane], scale[lane]))
        }
        Operation::Nonzero { value, scale } => {
            let [value, scale] = [value, scale].map(of);
            Mask::of(|lane| {
                let [value, scale] = [value[lane], scale[lane]];
                !exceeds_rounding(value * value, scale * scale)
            })
        }
        Operation::Positive { length, .. } => {
            let length = of(length);
            Mask::of(|lane| length[lane] <= 0.0)
        }
        Operation::Multipliers {
            ref targets,
            ref jacobian,
            ref forces,
        } => Mask::of(|lane| !solve_multipliers(targets, jacobian, forces, lane, registers)),
        Operation::Friction {
            ref targets,
            ref joints,
        } => Mask::of(|lane| !settle_friction(targets, joints, lane, registers)),
        Operation::Newton
        | Operation::Factorize
        | Operation::Solve { .. }
        | Operation::Signal { .. }
        | Operation::Require(..)
        | Operation::Isolate(_) => Mask::ALL,
    }
}

/// Solves Jᵀ λ = f in one lane; false if the matrix is singular.
#[inline(never)]
fn solve_multipliers(
    targets: &[Option<Register>],
    jacobian: &[Register],
    forces: &[Register],
    lane: usize,
    registers: &mut [Lanes],
) -> bool {
    let of = |register: &Register| registers[register.index()].0[lane];
    let matrix = DMatrix::from_row_iterator(forces.len(), forces.len(), jacobian.iter().map(of));
    let mut solution = DVector::from_iterator(targets.len(), forces.iter().map(of));
    if multipliers::solve(&matrix, &mut solution).is_err() {
        return false;
    }
    for (target, value) in targets.iter().zip(solution.iter()) {
        if let Some(target) = target {
            registers[target.index()].0[lane] = *value;
        }
    }
    true
}

/// Solves for the forces of friction in one lane; false if they do not settle.
#[inline(never)]
fn settle_friction(
    targets: &[Option<Register>],
    joints: &FrictionJoints,
    lane: usize,
    registers: &mut [Lanes],
) -> bool {
    let Ok(forces) = joints.forces(|register| registers[register.index()].0[lane]) else {
        return false;
    };
    for (target, value) in targets.iter().zip(forces.iter()) {
        if let Some(target) = target {
            registers[target.index()].0[lane] = *value;
        }
    }
    true
}
