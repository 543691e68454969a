//! Moves a mechanism along a schedule with `advance` and records every step.
//!
//! The file needs only the runtime and [`crate::values`]: it is compiled here for interpreted mechanisms, and beside
//! the generated ones in a package of their own.

use linkwright::math::Real;
use linkwright::{Blocks, FailureKind, Settings, Shell, Signal, Values};

/// Number of substeps to a target after a refusal.
pub const SMALLER: u32 = 32;

/// Number of targets missed by substeps too after which a schedule ends.
const BROKEN: usize = 4;

/// Signal at one time: its value, its rate and its acceleration.
pub type Given = [f64; 3];

/// Target of a step.
#[derive(Clone, Debug, Default)]
pub struct Target {
    /// Time (s).
    pub t: f64,
    /// Inputs at that time.
    pub inputs: Vec<Given>,
}

/// Requested motion of a mechanism.
#[derive(Clone, Debug, Default)]
pub struct Schedule {
    /// Pose at the start; empty for that of the design configuration.
    pub start: Vec<f64>,
    /// Start, then one target after another.
    pub targets: Vec<Target>,
}

/// Result of a step.
#[derive(Clone, Debug)]
pub struct Stepped {
    /// Index of the target, from 0 for the start.
    pub target: usize,
    /// Number of the substep among [`SMALLER`], from 1; 0 for a whole step.
    pub part: u32,
    /// Time at its end (s).
    pub t: f64,
    /// Pose, or components of the points if frames hold nothing else; or the kind and the time of a failure.
    pub answer: Result<Vec<f64>, (String, f64)>,
}

/// Coordinates of a frame, or else its points.
fn found<B: Blocks>(blocks: &B, frame: &B::Frame) -> Vec<f64> {
    let coordinates = (0..).map_while(|index| blocks.coordinate(frame, index));
    let values: Vec<f64> = coordinates.map(|it| it[0].to_f64()).collect();
    if !values.is_empty() {
        return values;
    }
    let points = (0..).map_while(|index| blocks.point(frame, index));
    points
        .flat_map(|it| it.position.map(|it| it.to_f64()))
        .collect()
}

/// Inputs of a mechanism with these values.
fn inputs<B: Blocks>(blocks: &B, given: &[Given]) -> B::Inputs {
    let mut inputs = blocks.initial_inputs();
    for (index, numbers) in given.iter().enumerate() {
        let [value, rate, acceleration] = numbers.map(B::Scalar::from_f64);
        inputs.set(index, Signal::new(value, rate, acceleration));
    }
    inputs
}

/// Inputs between two of them, each on this path.
fn between<T: Real, I: Values<Signal<T>>>(
    [first, last]: [&I; 2],
    path: impl Fn(Signal<T>, Signal<T>) -> Signal<T>,
) -> I {
    let mut between = first.clone();
    for index in 0..first.count() {
        if let (Some(from), Some(to)) = (first.value(index), last.value(index)) {
            between.set(index, path(from, to));
        }
    }
    between
}

/// Signal at a fraction of the chord between two of them, at constant time.
fn straight<T: Real>(from: Signal<T>, to: Signal<T>, part: T) -> Signal<T> {
    let at = |from: T, to: T| from + part * (to - from);
    Signal::new(
        at(from.value, to.value),
        at(from.rate, to.rate),
        at(from.acceleration, to.acceleration),
    )
}

/// Name of a failure's kind.
fn named<T: Real>(kind: FailureKind<T>) -> String {
    let text = format!("{kind:?}");
    let end = text.find([' ', '{', '(']).unwrap_or(text.len());
    text[..end].to_string()
}

/// Steps from target to target. After a failure, takes substeps from the last frame; if those fail too, goes on to
/// the next target.
pub fn stepped<B: Blocks + Clone>(blocks: &B, schedule: &Schedule) -> Vec<Stepped>
where
    Settings<B::Scalar>: Default,
{
    let mut all = Vec::new();
    let Some((start, targets)) = schedule.targets.split_first() else {
        return all;
    };
    let parameters = blocks.nominal_parameters();
    let mut pose = blocks.drawn_pose(&parameters);
    for (index, value) in schedule.start.iter().enumerate() {
        pose.set(index, B::Scalar::from_f64(*value));
    }
    let branches = blocks.drawn_branches();
    let t = B::Scalar::from_f64(start.t);
    let mut last = (start.t, inputs(blocks, &start.inputs));
    let assembled = Shell::assemble(
        blocks.clone(),
        &parameters,
        &pose,
        branches,
        t,
        &last.1,
        Settings::default(),
    );
    let mut shell = match assembled {
        Ok(shell) => shell,
        Err(failure) => {
            let answer = Err((named(failure.kind), failure.time.to_f64()));
            all.push(Stepped {
                target: 0,
                part: 0,
                t: start.t,
                answer,
            });
            return all;
        }
    };
    let answer = Ok(found(blocks, shell.frame()));
    all.push(Stepped {
        target: 0,
        part: 0,
        t: start.t,
        answer,
    });
    let mut broken = 0;
    for (index, target) in targets.iter().enumerate() {
        if broken == BROKEN {
            break;
        }
        let goal = inputs(blocks, &target.inputs);
        let mut go = |shell: &mut Shell<B>, t: f64, inputs: &B::Inputs, part: u32| {
            let moved = shell.advance(B::Scalar::from_f64(t), inputs);
            let moved = moved.map(|frame| found(blocks, frame));
            let answer = moved.map_err(|failure| (named(failure.kind), failure.time.to_f64()));
            let is_ok = answer.is_ok();
            all.push(Stepped {
                target: index + 1,
                part,
                t,
                answer,
            });
            is_ok
        };
        if go(&mut shell, target.t, &goal, 0) {
            last = (target.t, goal);
            continue;
        }
        let (from, before) = last.clone();
        let h = target.t - from;
        for part in 1..=SMALLER {
            let fraction = f64::from(part) / f64::from(SMALLER);
            let t = if part == SMALLER {
                target.t
            } else {
                from + h * fraction
            };
            let fraction = B::Scalar::from_f64(fraction);
            let ends = [&before, &goal];
            let inputs = match part {
                SMALLER => goal.clone(),
                _ if h == 0.0 => between(ends, |from, to| straight(from, to, fraction)),
                _ => between(ends, |from, to| {
                    from.towards(&to, B::Scalar::from_f64(h), fraction)
                }),
            };
            if !go(&mut shell, t, &inputs, part) {
                broken += 1;
                break;
            }
            last = (t, inputs);
        }
    }
    all
}
