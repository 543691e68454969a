//! Makes each call at each instant, on equations or on a generated mechanism.
//!
//! The file needs only the runtime and [`crate::values`]: it is compiled here for interpreted mechanisms, and beside
//! the generated ones in a package of their own.

use linkwright::math::Real;
use linkwright::nalgebra::allocator::Allocator;
use linkwright::nalgebra::{Const, DefaultAllocator, Dim, OVector};
use linkwright::{Blocks, Branch, Equations, Frame, Settings};

use crate::values::{Levels, assembled_from, levels};

/// Number of steps of a fine motion between two instants.
pub const FINE: u32 = 8;

/// Number of instants that a long step skips.
pub const LONG: usize = 6;

/// Requested solves of a mechanism.
#[derive(Clone, Debug, Default)]
pub struct Task {
    /// Instants (s), equally spaced, and numbers of f32.
    pub times: Vec<f64>,
    /// Pose at the first instant.
    pub start: Vec<f64>,
    /// Good estimate at each instant.
    pub near: Vec<Vec<f64>>,
    /// Poor estimate at each instant.
    pub scattered: Vec<Vec<f64>>,
    /// True if the determinant is negative on the path.
    pub is_negative: bool,
}

/// A call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Call {
    /// `assemble` from a good estimate.
    Assemble,
    /// `assemble_from_rough_estimate` on a branch, from a poor estimate.
    Afar,
    /// `advance` from instant to instant in [`FINE`] steps.
    AdvanceFine,
    /// `advance` in one step.
    Advance,
    /// `follow` in one step.
    Follow,
    /// `follow` over [`LONG`] instants.
    FollowLong,
    /// The mechanism's `assemble_from` a good estimate.
    SolvedAssemble,
    /// The mechanism's `assemble_from` a poor estimate.
    SolvedAfar,
    /// The mechanism's `advance` in [`FINE`] steps.
    SolvedFine,
    /// The mechanism's `advance` in one step.
    Solved,
    /// The mechanism's `advance` over [`LONG`] instants.
    SolvedLong,
}

/// All calls.
pub const CALLS: [Call; 11] = [
    Call::Assemble,
    Call::Afar,
    Call::AdvanceFine,
    Call::Advance,
    Call::Follow,
    Call::FollowLong,
    Call::SolvedAssemble,
    Call::SolvedAfar,
    Call::SolvedFine,
    Call::Solved,
    Call::SolvedLong,
];

impl Call {
    /// True if the call continues from its last frame; its start is then its answer at the first instant.
    pub fn moves(self) -> bool {
        !matches!(
            self,
            Call::Assemble | Call::Afar | Call::SolvedAssemble | Call::SolvedAfar
        )
    }

    /// Label in reports.
    pub fn words(self) -> &'static str {
        match self {
            Call::Assemble => "assemble, good estimate",
            Call::Afar => "assemble_from_rough_estimate, poor estimate",
            Call::AdvanceFine => "advance, fine steps",
            Call::Advance => "advance, coarse steps",
            Call::Follow => "follow, coarse steps",
            Call::FollowLong => "follow, long steps",
            Call::SolvedAssemble => "assembly, good estimate",
            Call::SolvedAfar => "assembly, poor estimate",
            Call::SolvedFine => "motion, fine steps",
            Call::Solved => "motion, coarse steps",
            Call::SolvedLong => "motion, long steps",
        }
    }
}

/// q, q̇ and q̈ (only q if the call returns no more), or the name of a failure.
pub type Answer = Result<Levels, String>;

/// Answer of a call at an instant.
#[derive(Clone, Debug)]
pub struct Answered {
    /// The call.
    pub call: Call,
    /// The instant.
    pub instant: usize,
    /// Answer.
    pub answer: Answer,
}

/// Name of a failure's kind.
pub fn named<K: std::fmt::Debug>(kind: K) -> String {
    let text = format!("{kind:?}");
    let end = text.find([' ', '{', '(']).unwrap_or(text.len());
    text[..end].to_string()
}

/// Instants at which a motion stops, each with the times of the steps to it.
fn stops(times: &[f64], steps: u32, stride: usize) -> Vec<(usize, Vec<f64>)> {
    let indices = (0..times.len()).step_by(stride).skip(1);
    let stop = |index: usize| {
        let (from, to) = (times[index - stride], times[index]);
        let at = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps);
        (index, (1..=steps).map(at).collect())
    };
    indices.map(stop).collect()
}

/// Solves the equations as one dense system with every call.
pub fn textbook<T: Real, D: Dim, E: Equations<T, D>>(equations: &E, task: &Task) -> Vec<Answered>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
    Settings<T>: Default,
{
    let settings = Settings::default();
    let vector = |values: &[f64]| {
        let values = values.iter().map(|it| T::from_f64(*it));
        OVector::<T, D>::from_iterator_generic(equations.dimension(), Const::<1>, values)
    };
    let branch = if task.is_negative {
        Branch::Negative
    } else {
        Branch::Positive
    };
    let mut answers = Vec::new();
    let mut answer = |call, instant, found: &Result<Frame<T, D>, linkwright::Failure<T>>| {
        let answer = match found {
            Ok(it) => {
                let levels = [&it.q, &it.qd, &it.qdd];
                Ok(levels.map(|level| level.as_slice().iter().map(|it| it.to_f64()).collect()))
            }
            Err(failure) => Err(named(failure.kind)),
        };
        answers.push(Answered {
            call,
            instant,
            answer,
        });
    };
    for (instant, t) in task.times.iter().enumerate() {
        let t = T::from_f64(*t);
        let pose = Frame::assemble(equations, &vector(&task.near[instant]), t, &settings);
        answer(Call::Assemble, instant, &pose);
        let estimate = vector(&task.scattered[instant]);
        let pose =
            Frame::assemble_from_rough_estimate(equations, &estimate, Some(branch), t, &settings);
        answer(Call::Afar, instant, &pose);
    }
    let first = T::from_f64(task.times[0]);
    let Ok(first) = Frame::assemble(equations, &vector(&task.start), first, &settings) else {
        return answers;
    };
    for (call, steps, stride) in [
        (Call::AdvanceFine, FINE, 1),
        (Call::Advance, 1, 1),
        (Call::Follow, 1, 1),
        (Call::FollowLong, 1, LONG),
    ] {
        let mut frame = first.clone();
        answer(call, 0, &Ok(first.clone()));
        for (instant, times) in stops(&task.times, steps, stride) {
            let mut last = Ok(frame.clone());
            for t in times.into_iter().map(T::from_f64) {
                last = match call {
                    Call::Follow | Call::FollowLong => {
                        frame.follow(equations, branch, t, &settings)
                    }
                    _ => frame.advance(equations, t, &settings),
                };
                // After a failure the frame is the last valid one, and the next instant is tried from there.
                if let Ok(moved) = &last {
                    frame = moved.clone();
                }
            }
            answer(call, instant, &last);
        }
    }
    answers
}

/// Solves a mechanism block by block with every call.
pub fn solved<B: Blocks + Clone>(blocks: &B, task: &Task) -> Vec<Answered>
where
    Settings<B::Scalar>: Default,
{
    let mut answers = Vec::new();
    let mut answer = |call, instant, answer| {
        answers.push(Answered {
            call,
            instant,
            answer,
        });
    };
    let assembled = |estimate: &[f64], t: f64| {
        assembled_from(blocks.clone(), estimate, t, Settings::default())
            .map_err(|failure| named(failure.kind))
    };
    for (instant, t) in task.times.iter().enumerate() {
        for (call, estimates) in [
            (Call::SolvedAssemble, &task.near),
            (Call::SolvedAfar, &task.scattered),
        ] {
            let pose = assembled(&estimates[instant], *t);
            answer(call, instant, pose.map(|it| levels(blocks, it.frame())));
        }
    }
    let Ok(first) = assembled(&task.start, task.times[0]) else {
        return answers;
    };
    let inputs = blocks.initial_inputs();
    for (call, steps, stride) in [
        (Call::SolvedFine, FINE, 1),
        (Call::Solved, 1, 1),
        (Call::SolvedLong, 1, LONG),
    ] {
        let mut moving = first.clone();
        answer(call, 0, Ok(levels(blocks, first.frame())));
        for (instant, times) in stops(&task.times, steps, stride) {
            let mut last = Ok(());
            for t in times {
                // After a failure the frame is the last valid one, and the next instant is tried from there.
                let moved = moving.advance(B::Scalar::from_f64(t), &inputs);
                last = moved.map(|_| ()).map_err(|failure| named(failure.kind));
            }
            let frame_levels = last.map(|()| levels(blocks, moving.frame()));
            answer(call, instant, frame_levels);
        }
    }
    answers
}
