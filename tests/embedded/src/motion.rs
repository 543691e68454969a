//! Moves a mechanism and prints frames of a loop, frames far apart, failures, and their cost.
//!
//! A loop requests a frame every 1/1024 s, for 5 s. All numbers of all frames go into digests, and the frames of
//! every half second are printed in full: those are the times of the committed references. Then come steps that are
//! too long for one attempt, forwards and back, and times that are NaN.

use core::hint::black_box;

use linkwright::{Failure, FailureKind};

use crate::digest::Digest;
use crate::machine::Machine;

/// Frames per second, and in all.
const RATE: u32 = 1024;
const FRAMES: u32 = 5 * RATE;
/// Number of frames in one digest.
const BUNDLE: u32 = RATE / 2;
/// Number of long steps, and frames in each.
const LONG_STEPS: u32 = 24;
const LONG: u32 = 200;

/// Generated mechanism, in the scalar of its module.
pub trait Moved: Sized {
    type Real: Real;
    fn assemble(t: Self::Real) -> Result<Self, Failure<Self::Real>>;
    fn advance(&mut self, t: Self::Real) -> Result<(), Failure<Self::Real>>;
    /// Calls `each` with the numbers of the last frame: its time, coordinates, rates, accelerations.
    fn numbers(&self, each: impl FnMut(u64));
    /// Calls functions of the textbook formulation, which no loop needs.
    #[cfg(feature = "planted_textbook")]
    fn textbook(&self) -> u64;
}

/// Scalar as its bits.
pub trait Real: Copy {
    const NAN: Self;
    fn time(frame: u32) -> Self;
    fn bits(self) -> u64;
}

impl Real for f32 {
    const NAN: Self = f32::NAN;

    fn time(frame: u32) -> Self {
        frame as f32 / RATE as f32
    }

    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
}

impl Real for f64 {
    const NAN: Self = f64::NAN;

    fn time(frame: u32) -> Self {
        f64::from(frame) / f64::from(RATE)
    }

    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// First call of a loop, a function of its own so that its name is in the program.
#[inline(never)]
fn assemble<M: Moved>(t: M::Real) -> Result<M, Failure<M::Real>> {
    M::assemble(t)
}

/// Call of a loop for each frame.
#[inline(never)]
fn advance<M: Moved>(mechanism: &mut M, t: M::Real) -> Result<(), Failure<M::Real>> {
    mechanism.advance(t)
}

/// Instructions of calls of one kind.
#[derive(Clone, Copy)]
struct Work {
    calls: u64,
    total: u64,
    worst: u64,
}

impl Work {
    const NONE: Self = Self {
        calls: 0,
        total: 0,
        worst: 0,
    };

    fn add(&mut self, instructions: u64) {
        self.calls += 1;
        self.total += instructions;
        self.worst = self.worst.max(instructions);
    }
}

/// Moves a mechanism and prints the results.
pub fn run<M: Moved, B: Machine>(machine: &mut B) {
    print(machine, "measured state", &[size_of::<M>() as u64]);
    let start = M::Real::time(0);
    let (stack, _) = machine.stack(|_| assemble::<M>(black_box(start)).is_ok());
    let (instructions, assembled) = machine.count(|| assemble::<M>(black_box(start)));
    print(machine, "measured assemble", &[instructions, stack]);
    let mut mechanism = match assembled {
        Ok(mechanism) => mechanism,
        Err(failure) => return failed(machine, &failure),
    };
    frame(machine, &mechanism);
    let (stack, work) = machine.stack(|machine| in_loop(machine, &mut mechanism));
    report(machine, "measured advance", work, stack);
    let (stack, work) = machine.stack(|machine| in_long_steps(machine, &mut mechanism));
    report(machine, "measured long", work, stack);
    #[cfg(feature = "planted_textbook")]
    print(machine, "planted", &[mechanism.textbook()]);
}

/// Frames of a loop.
fn in_loop<M: Moved, B: Machine>(machine: &mut B, mechanism: &mut M) -> Work {
    let (mut work, mut digest) = (Work::NONE, Digest::EMPTY);
    for number in 1..=FRAMES {
        let t = black_box(M::Real::time(number));
        let (instructions, moved) = machine.count(|| advance(mechanism, t));
        work.add(instructions);
        if let Err(failure) = moved {
            failed(machine, &failure);
        }
        mechanism.numbers(|word| digest.add(word));
        if number.is_multiple_of(BUNDLE) {
            print(machine, "digest", &[digest.value()]);
            frame(machine, mechanism);
        }
    }
    work
}

/// Steps of a fifth of a second from the end of the loop, two forwards and one back, and a time that is NaN.
fn in_long_steps<M: Moved, B: Machine>(machine: &mut B, mechanism: &mut M) -> Work {
    let (mut work, mut digest) = (Work::NONE, Digest::EMPTY);
    let mut number = FRAMES;
    for step in 0..LONG_STEPS {
        number = match step % 3 {
            2 => number - LONG,
            _ => number + LONG,
        };
        let t = match step % 8 {
            7 => M::Real::NAN,
            _ => M::Real::time(number),
        };
        let (instructions, moved) = machine.count(|| advance(mechanism, black_box(t)));
        work.add(instructions);
        if let Err(failure) = moved {
            failed(machine, &failure);
        }
        mechanism.numbers(|word| digest.add(word));
        print(machine, "digest", &[digest.value()]);
    }
    work
}

fn frame<M: Moved, B: Machine>(machine: &mut B, mechanism: &M) {
    machine.write("frame");
    mechanism.numbers(|word| machine.number(word));
    machine.write("\n");
}

fn failed<T: Real, B: Machine>(machine: &mut B, failure: &Failure<T>) {
    let kind = match failure.kind {
        FailureKind::Singular { .. } => 1,
        FailureKind::Diverged => 2,
        FailureKind::Cycling => 3,
        FailureKind::Stalled => 4,
        FailureKind::IterationLimit => 5,
        FailureKind::OutOfReach { .. } => 6,
        FailureKind::WrongBranch => 7,
        FailureKind::StepTooLarge => 8,
        FailureKind::NotPositive { .. } => 9,
        FailureKind::NotFinite => 10,
        FailureKind::Undecided => 11,
        FailureKind::LoadNotFinite { .. } => 12,
        FailureKind::FrictionUnsettled { .. } => 14,
        FailureKind::OutsideRange { .. } => 13,
        _ => 14,
    };
    let Failure {
        time,
        block,
        iterations,
        ..
    } = *failure;
    // The bits of a NaN are the processor's choice.
    let time = time.bits();
    let time = if time == T::NAN.bits() { 0 } else { time };
    let numbers = [kind, time, u64::from(block), u64::from(iterations)];
    print(machine, "failure", &numbers);
}

fn report<B: Machine>(machine: &mut B, what: &str, work: Work, stack: u64) {
    let Work {
        calls,
        total,
        worst,
    } = work;
    print(machine, what, &[calls, total, worst, stack]);
}

fn print<B: Machine>(machine: &mut B, what: &str, numbers: &[u64]) {
    machine.write(what);
    for number in numbers {
        machine.number(*number);
    }
    machine.write("\n");
}
