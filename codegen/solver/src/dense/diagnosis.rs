//! Explains a failure of all equations at once in a sentence with times, joints and bodies.
//!
//! Nothing is solved; Φ and Φ_q are evaluated where the solver stopped.

use linkwright::{Equations, Failure, FailureKind};
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector};

use super::Dense;
use crate::condition::{Condition, Weakness, dimensionless, jacobian};
use crate::instant::Instant;
use crate::number::{scientific, time};
use crate::ranges::outside;
use crate::singular_participants::SingularParticipants;
use crate::textbook::TextbookEquations;
use crate::view::View;

/// Reciprocal condition of a singular pose, about the square root of ε: half of the digits of an acceleration may be lost.
pub const ABSOLUTE: f64 = 1e-8;

/// Reciprocal condition below which the last pose of a motion is called singular. Near a turning point the reciprocal condition falls
/// with the square root of the remaining time.
const NEAR_END: f64 = 1e-5;

/// Returns the reason that the motion ends at the last instant or does not begin, with the joints concerned.
pub fn cause(dense: &Dense, failure: &Failure, last: Option<&Instant>) -> String {
    let (system, equations) = (dense.system(), dense.equations());
    if let Some(outside) = outside(&system.mechanism, failure) {
        return outside;
    }
    let (q, t) = match last {
        Some(last) => (DVector::from_column_slice(last.q()), last.t()),
        None => (equations.estimate().clone(), failure.time),
    };
    let matrix = scaled_jacobian(equations, &q, t);
    let reciprocal = Condition::of(&matrix).reciprocal;
    let already_said = matches!(failure.kind, FailureKind::Singular { .. });
    let limit = if last.is_some() { NEAR_END } else { ABSOLUTE };
    let mut sentence = reason(system, equations, failure, last);
    if last.is_none() && reciprocal.is_finite() {
        sentence.push_str(&drawing(system, equations, t));
    }
    if reciprocal < limit || already_said {
        if !already_said {
            sentence.push_str("; Φ_q is singular there");
        }
        sentence.push_str("; ");
        sentence.push_str(&concerned(system, &matrix));
    } else if last.is_none() && failure.kind != FailureKind::NotFinite {
        sentence.push_str(
            "; the design configuration is too far from any pose that satisfies the equations, or no such pose exists",
        );
    }
    sentence
}

/// Returns the event, with the joint whose equation has the largest residual.
fn reason(
    system: &System,
    equations: &TextbookEquations,
    failure: &Failure,
    last: Option<&Instant>,
) -> String {
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
            return match row_of_infinite_rate(equations, failure.time, last) {
                Some(row) => not_finite(row, "a time derivative"),
                None => "a coordinate, velocity or acceleration is not finite".to_string(),
            };
        }
        FailureKind::WrongBranch => "Newton-Raphson finds only another assembly mode",
        kind => kind.words(),
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

/// Returns the first equation whose time derivative is not finite at the end of the motion; `None` if all are.
fn row_of_infinite_rate(
    equations: &TextbookEquations,
    t: f64,
    last: Option<&Instant>,
) -> Option<usize> {
    let last = last?.frame();
    let mut rate = DVector::zeros(last.q.len());
    equations.time_derivative(&last.q, t, &mut rate);
    let mut gamma = rate.clone();
    equations.gamma(&last.q, &last.qd, t, &mut gamma);
    (0..rate.len()).find(|row| !(rate[*row].is_finite() && gamma[*row].is_finite()))
}

/// Describes the largest residual in the design configuration.
fn drawing(system: &System, equations: &TextbookEquations, t: f64) -> String {
    let q = equations.estimate();
    let mut phi = DVector::zeros(q.len());
    equations.residual(q, t, &mut phi);
    let scaled = |row: usize| phi[row].abs() / equations.row_scale(row);
    let worst = (0..phi.len())
        .filter(|row| phi[*row].is_finite())
        .max_by(|a, b| scaled(*a).total_cmp(&scaled(*b)));
    match worst {
        Some(row) if phi[row] != 0.0 => {
            let unit = system.mechanism.units.of_messages().of(&unit(system, row));
            format!(
                "; the design configuration violates `{}` most, by {} {}",
                system.mechanism.joints[system.rows[row].joint].label,
                scientific(unit.of_si(phi[row].abs()), 1),
                unit.name
            )
        }
        _ => String::new(),
    }
}

/// Unit of the residual of a row.
pub fn unit(system: &System, row: usize) -> String {
    match system.rows[row].quantity.unit() {
        plain if plain.is_empty() => "1".to_string(),
        unit => unit,
    }
}

fn concerned(system: &System, matrix: &DMatrix<f64>) -> String {
    match Weakness::of(matrix) {
        Some(weakness) => SingularParticipants::of(system, &weakness).to_string(),
        None => "Φ_q has entries that are not finite".to_string(),
    }
}

fn scaled_jacobian(equations: &TextbookEquations, q: &DVector<f64>, t: f64) -> DMatrix<f64> {
    dimensionless(equations, jacobian(equations, q, t))
}
