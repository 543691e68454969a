//! Exports solves of equations written by hand.

use linkwright::math::Real;
use linkwright::nalgebra::{Const, SVector};
use linkwright::{Equations, Frame, Settings};

#[path = "../../../runtime/tests/solving/exam_equations.rs"]
mod exam_equations;
#[path = "ring.rs"]
mod ring;

/// Pose, velocity and acceleration of `N` coordinates.
#[repr(C)]
pub struct Solved<T, const N: usize> {
    /// True if both frames were solved; everything else is zero otherwise.
    pub solved: bool,
    /// The pose.
    pub q: [T; N],
    /// The velocity.
    pub qd: [T; N],
    /// The acceleration.
    pub qdd: [T; N],
}

/// Assembles from the estimate at `start`, then advances to `end`.
fn run<T: Real, const N: usize>(
    equations: &impl Equations<T, Const<N>>,
    estimate: [T; N],
    start: T,
    end: T,
    settings: &Settings<T>,
) -> Solved<T, N> {
    let estimate = SVector::from([estimate]);
    let frame = Frame::assemble(equations, &estimate, start, settings)
        .and_then(|frame| frame.advance(equations, end, settings));
    motion(frame.ok())
}

/// Assembles from a poor estimate at `start`, then follows the path to `end`.
fn run_far<T: Real, const N: usize>(
    equations: &impl Equations<T, Const<N>>,
    estimate: [T; N],
    start: T,
    end: T,
    settings: &Settings<T>,
) -> Solved<T, N> {
    let estimate = SVector::from([estimate]);
    let frame = Frame::assemble_from_rough_estimate(equations, &estimate, None, start, settings)
        .and_then(|frame| {
            let branch = Frame::branch_of(equations, &frame.q, start, settings)?;
            frame.follow(equations, branch, end, settings)
        });
    motion(frame.ok())
}

fn motion<T: Real, const N: usize>(frame: Option<Frame<T, Const<N>>>) -> Solved<T, N> {
    match frame {
        Some(frame) => Solved {
            solved: true,
            q: frame.q.data.0[0],
            qd: frame.qd.data.0[0],
            qdd: frame.qdd.data.0[0],
        },
        None => Solved {
            solved: false,
            q: [T::ZERO; N],
            qd: [T::ZERO; N],
            qdd: [T::ZERO; N],
        },
    }
}

macro_rules! export {
    ($run:ident, $name:ident, $scalar:ty, $size:expr, $equations:expr) => {
        /// Solves at two times from an estimate.
        #[unsafe(no_mangle)]
        pub extern "C" fn $name(
            estimate: &[$scalar; $size],
            start: $scalar,
            end: $scalar,
        ) -> Solved<$scalar, { $size }> {
            $run(&$equations, *estimate, start, end, &Settings::default())
        }
    };
}

export!(run, exam_f64, f64, 6, exam_equations::Exam);
export!(run, exam_f32, f32, 6, exam_equations::Exam);
export!(run, ring_f64, f64, ring::SIZE, ring::Ring);
export!(run, ring_f32, f32, ring::SIZE, ring::Ring);
export!(run_far, far_exam_f64, f64, 6, exam_equations::Exam);
export!(run_far, far_exam_f32, f32, 6, exam_equations::Exam);
