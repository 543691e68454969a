//! *Equations or a generated mechanism, and instants* → *what each call makes of each instant*.
//!
//! The file needs nothing but the runtime and [`crate::values`], because it is compiled in two places: here for interpreted
//! mechanisms, and beside the generated ones in a package of their own.

use linkwright::math::Real;
use linkwright::nalgebra::allocator::Allocator;
use linkwright::nalgebra::{Const, DefaultAllocator, Dim, OVector};
use linkwright::{
    Blocks, Branch, Equations, Frame, Settings, advance, assemble, assemble_from_rough_estimate,
    follow,
};

use crate::values::{Levels, assembled_from, levels};

/// In how many steps a fine motion goes from one instant to the next.
pub const FINE: u32 = 8;

/// How many instants a long step leaves out.
pub const LONG: usize = 6;

/// What is asked of a mechanism.
#[derive(Clone, Debug, Default)]
pub struct Task {
    /// The instants (s), equally far apart, and numbers of f32.
    pub times: Vec<f64>,
    /// The pose at the first instant.
    pub start: Vec<f64>,
    /// A good estimate at each instant.
    pub near: Vec<Vec<f64>>,
    /// A poor one.
    pub scattered: Vec<Vec<f64>>,
    /// Whether the determinant is negative on the path.
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
    /// The same from a poor one.
    SolvedAfar,
    /// The mechanism's `advance` in [`FINE`] steps.
    SolvedFine,
    /// The same in one step.
    Solved,
    /// The same over [`LONG`] instants.
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
    /// Whether it goes on from its last frame; what it begins with is then its answer at the first instant.
    pub fn moves(self) -> bool {
        !matches!(
            self,
            Call::Assemble | Call::Afar | Call::SolvedAssemble | Call::SolvedAfar
        )
    }

    /// What is called, and how.
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

/// q, q̇ and q̈ (only q where that is all), or the name of a failure.
pub type Answer = Result<Levels, String>;

/// What a call has made of an instant.
#[derive(Clone, Debug)]
pub struct Answered {
    /// The call.
    pub call: Call,
    /// The instant.
    pub instant: usize,
    /// What came of it.
    pub answer: Answer,
}

/// The name of a failure's kind.
pub fn named<K: std::fmt::Debug>(kind: K) -> String {
    let text = format!("{kind:?}");
    let end = text.find([' ', '{', '(']).unwrap_or(text.len());
    text[..end].to_string()
}

/// The instants that a motion stops at, each with the times on the way there.
fn stops(times: &[f64], steps: u32, stride: usize) -> Vec<(usize, Vec<f64>)> {
    let indices = (0..times.len()).step_by(stride).skip(1);
    let stop = |index: usize| {
        let (from, to) = (times[index - stride], times[index]);
        let at = |step: u32| from + (to - from) * f64::from(step) / f64::from(steps);
        (index, (1..=steps).map(at).collect())
    };
    indices.map(stop).collect()
}

/// Solves the equations as one dense system in every way.
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
        let found = assemble(equations, &vector(&task.near[instant]), t, &settings);
        answer(Call::Assemble, instant, &found);
        let estimate = vector(&task.scattered[instant]);
        let found = assemble_from_rough_estimate(equations, &estimate, Some(branch), t, &settings);
        answer(Call::Afar, instant, &found);
    }
    let first = T::from_f64(task.times[0]);
    let Ok(first) = assemble(equations, &vector(&task.start), first, &settings) else {
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
                        follow(equations, &frame, branch, t, &settings)
                    }
                    _ => advance(equations, &frame, t, &settings),
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

/// Solves a mechanism block by block in every way.
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
            let found = assembled(&estimates[instant], *t);
            answer(call, instant, found.map(|it| levels(blocks, it.frame())));
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
            let found = last.map(|()| levels(blocks, moving.frame()));
            answer(call, instant, found);
        }
    }
    answers
}
