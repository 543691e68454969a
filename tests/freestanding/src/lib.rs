//! Static library of hand-written and generated mechanisms that links only without panic paths and allocations.
//!
//! The panic handler calls the symbol `PANIC_PATH`, which is never defined. After `cargo build --release` the
//! library's symbols tell: `nm` must list neither ` U PANIC_PATH` nor an allocator (`__rust_alloc`, `__rdl_alloc`).
//! All inputs come from the caller, so that the compiler cannot evaluate a solve and drop it.
#![no_std]

#[path = "../../../runtime/tests/solving/exam_equations.rs"]
mod exam_equations;
#[cfg(feature = "generated")]
mod forces;
#[cfg(feature = "generated")]
mod given;
#[cfg(feature = "generated")]
mod mechanisms;
mod ring;
#[cfg(feature = "generated")]
mod tables;

use linkwright::math::Real;
use linkwright::nalgebra::{Const, SVector};
use linkwright::{Equations, Frame, Settings};

unsafe extern "C" {
    #[allow(non_snake_case, reason = "The name is what nm is searched for.")]
    fn PANIC_PATH() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: the symbol is never defined, so a library that still contains this call does not link.
    unsafe { PANIC_PATH() }
}

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
    let frame = Frame::assemble_from_rough_estimate(equations, &estimate, None, start, settings).and_then(
        |frame| {
            let branch = Frame::branch_of(equations, &frame.q, start, settings)?;
            frame.follow(equations, branch, end, settings)
        },
    );
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

/// Index that only the caller knows: a panic path that no optimizer removes.
#[cfg(feature = "planted")]
#[unsafe(no_mangle)]
pub extern "C" fn planted(values: &[f64; 4], index: usize) -> f64 {
    values[index]
}
