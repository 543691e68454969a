//! *What a solve ran into → sentences with times, joints and bodies.*
//!
//! The module does not solve anything; it evaluates Φ and Φ_q where the solver stopped.

use linkwright::{Equations, FailureKind};
use linkwright_codegen::joint::Quantity;
use linkwright_codegen::system::System;
use nalgebra::{DMatrix, DVector};

use crate::concerned::Concerned;
use crate::condition::{Condition, Weakness, dimensionless, jacobian};
use crate::dead_end::dead_end;
use crate::interpreter::Interpreter;
use crate::number::{fixed, scientific};
use crate::singularity::{ABSOLUTE, Candidate, Event};
use crate::solved_interpreter::SolvedInterpreter;
use crate::trajectory::{Stop, Trajectory};

/// The last frame of a motion is called singular where its reciprocal condition is this fraction of the largest on the
/// way. Near a turning point it falls with the square root of the time left, so that it cannot become much smaller
/// within the [`crate::trajectory::END`] that is left.
const NEAR_END: f64 = 1e-2;

/// How many warnings are worked out; each costs a singular value decomposition.
const WORKED_OUT: usize = 100;

/// How many times a warning lists.
const LISTED: usize = 4;

/// One sentence per kind of event and group of joints, with the times at which it happens.
pub fn warnings(
    system: &System,
    interpreter: &Interpreter,
    trajectory: &Trajectory,
) -> Vec<String> {
    let largest = trajectory.largest_reciprocal;
    let mut found: Vec<&Candidate> = trajectory
        .candidates
        .iter()
        .filter(|it| it.matters(largest))
        .collect();
    found.sort_by(|a, b| a.t.total_cmp(&b.t));
    found.dedup_by(|a, b| a.t == b.t);
    let mut groups: Vec<(String, Vec<f64>, String)> = Vec::new();
    for candidate in found.iter().take(WORKED_OUT) {
        let what = match candidate.event {
            Event::Crossing => "Φ_q is singular",
            Event::Minimum if candidate.reciprocal < ABSOLUTE => "Φ_q is singular",
            Event::Minimum => "Φ_q is close to singular",
        };
        let who = format!(
            "; {}",
            concerned(system, interpreter, &candidate.q, candidate.t)
        );
        match groups
            .iter_mut()
            .find(|(same, _, whom)| same == what && *whom == who)
        {
            Some((_, times, _)) => times.push(candidate.t),
            None => groups.push((what.to_string(), vec![candidate.t], who)),
        }
    }
    let mut sentences: Vec<String> = groups
        .iter()
        .map(|(what, times, who)| format!("{what} at t = {} s{who}", listed(times)))
        .collect();
    if found.len() > WORKED_OUT {
        sentences.push(format!(
            "Φ_q is singular or close to it at {} more times",
            found.len() - WORKED_OUT
        ));
    }
    sentences
}

/// Why the motion ends, where, and which joints are concerned.
pub fn end(
    system: &System,
    interpreter: &Interpreter,
    solved: Option<&SolvedInterpreter>,
    trajectory: &Trajectory,
    stop: &Stop,
) -> String {
    let (q, t) = match &stop.last {
        Some(frame) => (&frame.q, frame.t),
        None => (interpreter.estimate(), stop.failure.time),
    };
    let matrix = scaled_jacobian(interpreter, q, t);
    let reciprocal = Condition::of(&matrix).reciprocal;
    let limit = (NEAR_END * trajectory.largest_reciprocal).max(ABSOLUTE);
    let already_said = matches!(stop.failure.kind, FailureKind::Singular { .. });
    let singular = reciprocal < limit || already_said;
    let in_the_way = stop
        .last
        .as_ref()
        .filter(|_| singular)
        .and_then(|last| dead_end(solved?, last, stop.failure.time));
    let mut sentence = match &stop.last {
        Some(_) => format!("cannot be solved beyond t = {} s", time(t)),
        None => format!("cannot be assembled at t = {} s", time(t)),
    };
    sentence.push_str(": ");
    match &in_the_way {
        Some(block) => sentence.push_str(block),
        None => sentence.push_str(&reason(system, interpreter, stop)),
    }
    if stop.last.is_none() && reciprocal.is_finite() {
        sentence.push_str(&drawing(system, interpreter, t));
    }
    if singular {
        if !already_said || in_the_way.is_some() {
            sentence.push_str("; Φ_q is singular there");
        }
        sentence.push_str("; ");
        sentence.push_str(&concerned(system, interpreter, q, t));
    } else if stop.last.is_none() && stop.failure.kind != FailureKind::NotFinite {
        sentence.push_str(
            "; the drawing is too far from any pose that satisfies the equations, or there is none",
        );
    }
    sentence
}

/// What happened, with the joint whose equation is farthest from being satisfied.
fn reason(system: &System, interpreter: &Interpreter, stop: &Stop) -> String {
    let failure = &stop.failure;
    let label = |row: usize| match system.rows.get(row) {
        Some(row) => system.mechanism.joints[row.joint].label.as_str(),
        None => "",
    };
    let not_finite = |row: usize, what: &str| {
        format!(
            "{what} of `{}` is not finite at t = {} s",
            label(row),
            time(failure.time)
        )
    };
    let row = usize::from(failure.row);
    let what = match failure.kind {
        FailureKind::Singular { pivot_ratio, .. } => {
            return format!(
                "Φ_q is singular (pivot ratio {})",
                scientific(pivot_ratio, 1)
            );
        }
        FailureKind::NotFinite if !failure.residual.is_finite() => {
            return not_finite(row, "the residual");
        }
        FailureKind::NotFinite => {
            return match row_of_infinite_rate(interpreter, stop) {
                Some(row) => not_finite(row, "a time derivative"),
                None => "a coordinate, velocity or acceleration is not finite".to_string(),
            };
        }
        FailureKind::Diverged => "Newton-Raphson runs away",
        FailureKind::Cycling => "Newton-Raphson repeats itself",
        FailureKind::Stalled => "Newton-Raphson stalls",
        FailureKind::WrongBranch => "Newton-Raphson finds only another assembly mode",
        FailureKind::StepTooLarge => "the step is too large for the motion to be followed",
        // Later versions of the runtime may know more kinds of failure; each has these figures.
        _ => "Newton-Raphson does not converge",
    };
    if failure.iterations == 0 {
        return what.to_string();
    }
    format!(
        "{what}; after {} steps `{}` is violated by {} of its scale",
        failure.iterations,
        label(row),
        scientific(failure.residual, 1)
    )
}

/// The first equation with a time derivative that is not finite where the motion ends.
fn row_of_infinite_rate(interpreter: &Interpreter, stop: &Stop) -> Option<usize> {
    let last = stop.last.as_ref()?;
    let t = stop.failure.time;
    let mut rate = DVector::zeros(last.q.len());
    interpreter.time_derivative(&last.q, t, &mut rate);
    let mut gamma = rate.clone();
    interpreter.gamma(&last.q, &last.qd, t, &mut gamma);
    (0..rate.len()).find(|row| !(rate[*row].is_finite() && gamma[*row].is_finite()))
}

/// By how much the drawing violates its worst equation.
fn drawing(system: &System, interpreter: &Interpreter, t: f64) -> String {
    let q = interpreter.estimate();
    let mut phi = DVector::zeros(q.len());
    interpreter.residual(q, t, &mut phi);
    let scaled = |row: usize| phi[row].abs() / interpreter.row_scale(row);
    let worst = (0..phi.len())
        .filter(|row| phi[*row].is_finite())
        .max_by(|a, b| scaled(*a).total_cmp(&scaled(*b)));
    match worst {
        Some(row) if phi[row] != 0.0 => format!(
            "; the drawing violates `{}` most, by {} {}",
            system.mechanism.joints[system.rows[row].joint].label,
            scientific(phi[row].abs(), 1),
            unit(system, row)
        ),
        _ => String::new(),
    }
}

/// What the residual of a row is measured in.
pub fn unit(system: &System, row: usize) -> String {
    match system.rows[row].quantity {
        Quantity::Length => "m".to_string(),
        Quantity::Angle => "rad".to_string(),
        Quantity::Power(0) => "1".to_string(),
        Quantity::Power(exponent) => format!("m^{exponent}"),
    }
}

fn concerned(system: &System, interpreter: &Interpreter, q: &DVector<f64>, t: f64) -> String {
    match Weakness::of(&scaled_jacobian(interpreter, q, t)) {
        Some(weakness) => Concerned::of(system, &weakness).to_string(),
        None => "Φ_q has entries that are not finite".to_string(),
    }
}

fn scaled_jacobian(interpreter: &Interpreter, q: &DVector<f64>, t: f64) -> DMatrix<f64> {
    dimensionless(interpreter, jacobian(interpreter, q, t))
}

/// A time with the digits to which it was located, without trailing zeros.
pub fn time(t: f64) -> String {
    let text = fixed(t, 9);
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// `1, 2, 3, 4 and 7 more until 12`.
fn listed(times: &[f64]) -> String {
    let shown: Vec<String> = times.iter().take(LISTED).map(|t| time(*t)).collect();
    match times.get(LISTED..).and_then(<[f64]>::last) {
        None => shown.join(", "),
        Some(last) => format!(
            "{} and {} more until {}",
            shown.join(", "),
            times.len() - LISTED,
            time(*last)
        ),
    }
}
