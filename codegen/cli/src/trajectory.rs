//! *Equations, a drawing and a schedule → the frames at the wanted times, or how far the motion goes.*
//!
//! The mechanism is assembled at the start and then advanced from time to time on its branch, so that it stays in its assembly
//! mode. A step that fails is retried with sub-steps down to 1/[`FINEST`] of it; a motion that passes straight through a
//! singular pose is followed to the branch beyond; one that ends is followed to within [`END`] of its end. Work per step is
//! bounded: at most [`FINEST`] sub-steps and the ten refinements before, each with at most two attempts to pass, each of
//! these at most [`Settings::iterations`] Newton-Raphson steps.
//!
//! Afterwards `frames` holds every wanted time up to the end of the motion, ascending. The module does not know what a
//! failure means in terms of joints: see [`crate::diagnosis`].

use linkwright::{Branch, Equations, Failure, Frame, Settings, branch_of};
use nalgebra::{DVector, Dyn};

use crate::counted::Counted;
use crate::schedule::{Schedule, Visit};
use crate::singularity::{Candidate, Watch};

/// Into how many sub-steps a step that fails is divided at most.
pub const FINEST: u32 = 1024;

/// How closely the end of a motion is found (s).
pub const END: f64 = 1e-9;

/// A motion, as far as it goes.
#[derive(Clone, Debug)]
pub struct Trajectory {
    /// The frame at the start, wanted or not; `None` if the mechanism cannot be assembled.
    pub start: Option<Frame<f64, Dyn>>,
    /// The frames at the wanted times that could be reached, ascending.
    pub frames: Vec<Frame<f64, Dyn>>,
    /// How many times were visited, those on the way included.
    pub visits: usize,
    /// How many Newton-Raphson steps were taken in all, polishing steps and failed attempts included.
    pub newton_steps: u64,
    /// Where Φ_q came close to being singular.
    pub candidates: Vec<Candidate>,
    /// The largest reciprocal condition of the dimensionless Φ_q on the way.
    pub largest_reciprocal: f64,
    /// Why the motion ends before the schedule does, if so.
    pub stop: Option<Stop>,
}

/// The end of a motion.
#[derive(Clone, Debug)]
pub struct Stop {
    /// The last frame that could be solved, at most [`END`] before the end; `None` if the mechanism cannot be assembled.
    pub last: Option<Frame<f64, Dyn>>,
    /// The earliest attempt that failed after it.
    pub failure: Failure<f64>,
}

/// Assembles the mechanism from `estimate` (n) and visits the times of `schedule`; `reached` hears how many were visited.
pub fn follow(
    equations: &impl Equations<f64, Dyn>,
    estimate: &DVector<f64>,
    schedule: &Schedule,
    settings: &Settings<f64>,
    mut reached: impl FnMut(usize),
) -> Trajectory {
    let counted = Counted::new(equations);
    let mut trajectory = Trajectory {
        start: None,
        frames: Vec::with_capacity(schedule.wanted()),
        visits: 0,
        newton_steps: 0,
        candidates: Vec::new(),
        largest_reciprocal: 0.0,
        stop: None,
    };
    match counted.assemble(estimate, schedule.start.t, settings) {
        Err(failure) => {
            trajectory.stop = Some(Stop {
                last: None,
                failure,
            });
        }
        Ok(start) => {
            trajectory.visits = 1;
            for leg in [&schedule.backward, &schedule.forward] {
                if trajectory.stop.is_none() && !(leg.is_empty() && schedule.visits() > 1) {
                    follow_leg(
                        &counted,
                        &start,
                        leg,
                        settings,
                        &mut trajectory,
                        &mut reached,
                    );
                }
            }
            if schedule.start.wanted {
                trajectory.frames.push(start.clone());
            }
            trajectory.start = Some(start);
        }
    }
    trajectory.frames.sort_by(|a, b| a.t.total_cmp(&b.t));
    trajectory.newton_steps = counted.steps();
    trajectory
}

fn follow_leg<E: Equations<f64, Dyn>>(
    equations: &Counted<E>,
    start: &Frame<f64, Dyn>,
    leg: &[Visit],
    settings: &Settings<f64>,
    trajectory: &mut Trajectory,
    reached: &mut impl FnMut(usize),
) {
    let mut watch = Watch::new(equations.inner(), settings, start);
    let mut frame = start.clone();
    let mut branch = match branch_of(equations.inner(), &start.q, start.t, settings) {
        Ok(branch) => branch,
        Err(failure) => {
            let last = Some(frame);
            trajectory.stop = Some(Stop { last, failure });
            return;
        }
    };
    for visit in leg {
        match advance_finely(equations, &frame, &mut branch, visit.t, settings) {
            Ok(next) => frame = next,
            Err(stuck) => {
                trajectory.stop = Some(approach(equations, *stuck, branch, settings));
                break;
            }
        }
        trajectory.visits += 1;
        reached(trajectory.visits);
        watch.see(&frame);
        if visit.wanted {
            trajectory.frames.push(frame.clone());
        }
    }
    let (candidates, largest) = watch.finish(trajectory.stop.is_none());
    trajectory.candidates.extend(candidates);
    trajectory.largest_reciprocal = trajectory.largest_reciprocal.max(largest);
}

/// A step that failed although it was divided: how far it came, and what then happened.
#[derive(Clone, Debug)]
struct Stuck {
    /// The last frame that could be solved.
    last: Frame<f64, Dyn>,
    /// The failure of the smallest sub-step after it.
    failure: Failure<f64>,
}

/// Advances to `t` in one step, or after a failure in two sub-steps, four, … up to [`FINEST`]. Where a sub-step of the finest
/// size fails, the motion may pass through a singular pose on it or the next one, to the other `branch`.
///
/// # Errors
/// [`Stuck`] when a sub-step of the finest size fails, and the motion does not pass.
fn advance_finely(
    equations: &Counted<impl Equations<f64, Dyn>>,
    frame: &Frame<f64, Dyn>,
    branch: &mut Branch,
    t: f64,
    settings: &Settings<f64>,
) -> Result<Frame<f64, Dyn>, Box<Stuck>> {
    let (begin, length) = (frame.t, t - frame.t);
    let mut last = frame.clone();
    let (mut done, mut parts) = (0_u32, 1_u32);
    while done < parts {
        let at = |place: u32| match place == parts {
            true => t,
            false => begin + length * (f64::from(place) / f64::from(parts)),
        };
        match equations.step(&last, *branch, at(done + 1), settings) {
            Ok(reached) => {
                last = reached;
                done += 1;
            }
            Err(failure) if parts == FINEST => {
                let mut beyond = (done + 1..=parts.min(done + 2)).filter_map(|place| {
                    let passed = equations.pass(&last, *branch, at(place), settings);
                    passed.map(|frame| (place, frame))
                });
                let Some((place, reached)) = beyond.next() else {
                    return Err(Box::new(Stuck { last, failure }));
                };
                (done, last) = (place, reached);
                *branch = branch.opposite();
            }
            Err(_) => {
                parts *= 2;
                done *= 2;
            }
        }
    }
    Ok(last)
}

/// Moves the last good frame to within [`END`] of the time that cannot be reached, by bisection.
fn approach(
    equations: &Counted<impl Equations<f64, Dyn>>,
    stuck: Stuck,
    branch: Branch,
    settings: &Settings<f64>,
) -> Stop {
    let Stuck {
        mut last,
        mut failure,
    } = stuck;
    while (failure.time - last.t).abs() > END {
        let middle = last.t + 0.5 * (failure.time - last.t);
        if middle == last.t || middle == failure.time {
            break;
        }
        match equations.step(&last, branch, middle, settings) {
            Ok(frame) => last = frame,
            Err(earlier) => failure = earlier,
        }
    }
    Stop {
        last: Some(last),
        failure,
    }
}
