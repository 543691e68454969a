//! Equations of a mechanism by construction, with its exact motion and bounds at each instant.

use linkwright::Equations;
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{Interpreted, Numbers};
use nalgebra::DVector;

use super::mechanism::Mechanism;
use super::mixing::mixing;
use super::motion::hunted;
use super::track::{End, Tracker};
use super::ways::Task;
use crate::random::Random;
use crate::stability::precise::Precise;
use crate::stability::truth::{Exact, Given, Levels, Truth};
use crate::stability::verdict::Scalar;

/// Number of instants after the first one.
pub const INSTANTS: usize = 24;

/// Time between two instants (s).
pub const INSTANT_SPACING: f64 = 0.125;

/// Largest violation of the construction by an exact pose, in scales and rad per unit of `away`.
const VIOLATION: f64 = 1e-9;

/// Exact motion and bounds at an instant.
pub struct Instant {
    /// Exact motion.
    pub exact: Exact,
    /// Bounds on the error in f64 and in f32.
    pub bounds: [Levels<f64>; 2],
    /// Magnitudes that elimination mixes into q̇ and q̈: see [`mixing`].
    pub mixed: [Vec<f64>; 2],
}

/// A mechanism with its truth.
pub struct Known {
    /// Equations.
    pub derived: Derived,
    /// Equations for evaluation.
    pub interpreter: TextbookEquations,
    /// Equations in 384 bits.
    pub truth: Truth,
    /// Characteristic length: scale of residuals in m.
    pub length: f64,
    /// Size of the mechanism (m).
    pub size: f64,
    /// Instants that the path reaches.
    pub instants: Vec<Instant>,
    /// Continuation of the path after the instants.
    pub end: End,
    /// True if the design configuration is the exact pose, so that both have the same assembly mode.
    pub is_drawn_exactly: bool,
    /// True if every block of the solved formulation has a closed form.
    pub is_closed: bool,
    /// Requested solves.
    pub task: Task,
}

/// Reason why a mechanism is not hunted.
#[derive(Clone, Debug)]
pub enum Unused {
    /// Refused description: its codes and the whole text.
    Refused(String, String),
    /// Pose by construction too close to a singular one to follow a path from it.
    Singular,
    /// Tracker that gave up: the path may end or continue.
    Undecided,
    /// Exact pose that contradicts the construction: the equations differ from the text.
    Contradiction(String),
}

/// Exact motion and bounds at `t` on the path through an exact pose near `start`.
fn instant(
    truth: &Truth,
    interpreter: &TextbookEquations,
    parameters: &[f64],
    t: f64,
    start: &DVector<f64>,
    length: f64,
) -> Option<Instant> {
    let instant_inputs = Given {
        t,
        parameters: parameters.to_vec(),
        ..Given::default()
    };
    let start: Vec<Precise> = start.iter().map(|it| Precise::from_f64(*it)).collect();
    let exact = truth.solve(&instant_inputs, &start)?;
    let bounds = [Scalar::F64, Scalar::F32]
        .map(|scalar| truth.allowance(&instant_inputs, &exact, length, scalar));
    let q: Vec<f64> = exact.levels[0].iter().map(Precise::to_f64).collect();
    // A computed value may exceed the exact one by its bound.
    let [qd, qdd] = [1, 2].map(|level| -> Vec<f64> {
        let values = exact.levels[level].iter().zip(&bounds[0][level]);
        values
            .map(|(value, bound)| value.to_f64().abs() + bound)
            .collect()
    });
    let mixed = mixing(interpreter, &q, t, [&qd, &qdd]);
    Some(Instant {
        exact,
        bounds,
        mixed,
    })
}

/// Times of all instants.
pub fn times() -> Vec<f64> {
    (0..=INSTANTS)
        .map(|it| it as f64 * INSTANT_SPACING)
        .collect()
}

/// Reads the description and computes its exact motion.
///
/// # Errors
/// The reason why the mechanism is not hunted.
pub fn known(mechanism: &Mechanism, seed: u64) -> Result<Known, Unused> {
    let source = Source::new("found.mech", mechanism.text());
    let refused = |errors: &linkwright_codegen::diagnostic::Diagnostics| {
        let rendered = errors.render(&source);
        let mut codes: Vec<&str> = rendered
            .split("error[")
            .skip(1)
            .filter_map(|rest| rest.split(']').next())
            .collect();
        codes.sort_unstable();
        codes.dedup();
        Unused::Refused(codes.join(" "), rendered)
    };
    let read = linkwright_codegen::read(&source).map_err(|errors| refused(&errors))?;
    let derived = hunted(read).expect("the hunted motion");
    linkwright_codegen::stages::check(&derived).map_err(|errors| refused(&errors))?;
    let interpreter = TextbookEquations::new(&derived.pool, &derived.system);
    let truth = Truth::new(&derived);
    let size = mechanism.size;
    let length = derived.system.mechanism.characteristic_length.max(size);
    let times = times();
    let start = DVector::from_vec(mechanism.coordinates());
    let scales = truth.scales(size);
    let away = start
        .iter()
        .zip(&scales)
        .map(|(it, scale)| it.abs() / scale);
    let away = away.fold(1.0, f64::max);
    let mut phi = DVector::zeros(start.len());
    interpreter.residual(&start, 0.0, &mut phi);
    let residuals = phi.iter().enumerate();
    let residual = residuals
        .map(|(row, it)| it.abs() / interpreter.row_scale(row))
        .fold(0.0, f64::max);
    if residual > VIOLATION * away * away {
        return Err(Unused::Contradiction(format!(
            "a residual of {residual:.1e} by construction"
        )));
    }
    let tracker = Tracker::new(&interpreter, truth.scales(size), away);
    let path = tracker.path(&start, &times);
    let Some(first) = path.poses.first() else {
        return Err(Unused::Singular);
    };
    let off = (first - &start)
        .iter()
        .zip(&scales)
        .map(|(it, scale)| it.abs() / scale)
        .fold(0.0, f64::max);
    if off > 1e-6 * away {
        return Err(Unused::Singular);
    }
    let parameters = Numbers::nominal_parameters(&derived.pool, &derived.system).0;
    let mut instants = Vec::new();
    let mut end = path.end;
    for (t, tracked) in times.iter().zip(&path.poses) {
        let Some(found) = instant(&truth, &interpreter, &parameters, *t, tracked, length) else {
            end = End::Unknown;
            break;
        };
        let q: Vec<f64> = found.exact.levels[0].iter().map(Precise::to_f64).collect();
        let moved = q.iter().zip(tracked.iter()).zip(&scales);
        let moved = moved.map(|((a, b), scale)| (a - b).abs() / scale);
        if moved.fold(0.0, f64::max) > 1e-6 * away {
            end = End::Unknown;
            break;
        }
        let violation = mechanism.violation(&q, *t);
        // A comparison with NaN is false.
        let fits = violation <= VIOLATION * away;
        if !fits {
            return Err(Unused::Contradiction(format!(
                "violated by {violation:.1e} at t = {t}"
            )));
        }
        if mechanism.rate_violation(&found.exact.levels, *t) > VIOLATION {
            return Err(Unused::Contradiction(format!("other rates at t = {t}")));
        }
        instants.push(found);
    }
    if instants.is_empty() {
        return Err(Unused::Singular);
    }
    if end == End::Unknown {
        return Err(Unused::Undecided);
    }
    let is_closed = Interpreted::new(&derived).is_some_and(|view| {
        let mut forms = view.program().forms.iter().flatten();
        forms.all(|form| form.modes().is_some())
    });
    let task = task(&instants, &scales, times, seed);
    Ok(Known {
        derived,
        interpreter,
        truth,
        length,
        size,
        instants,
        end,
        is_drawn_exactly: mechanism.is_drawn_exactly(),
        is_closed,
        task,
    })
}

/// Estimates at every instant; after the end of the path near its last pose.
fn task(instants: &[Instant], scales: &[f64], times: Vec<f64>, seed: u64) -> Task {
    let mut random = Random::new(seed ^ 0x5ca7_7e4e_d000_0001);
    let pose = |instant: usize| -> Vec<f64> {
        let instant = &instants[instant.min(instants.len() - 1)];
        instant.exact.levels[0]
            .iter()
            .map(Precise::to_f64)
            .collect()
    };
    let mut around = |instant: usize, part: f64| -> Vec<f64> {
        let pose = pose(instant);
        let moved = pose.iter().zip(scales);
        moved
            .map(|(it, scale)| it + part * scale * random.between(-1.0, 1.0))
            .collect()
    };
    Task {
        start: pose(0),
        near: (0..times.len()).map(|it| around(it, 1e-3)).collect(),
        scattered: (0..times.len()).map(|it| around(it, 0.5)).collect(),
        is_negative: instants[0].exact.is_negative,
        times,
    }
}

/// Exact motion through the pose nearest to `found`; `None` if no pose is near.
pub fn elsewhere(known: &Known, instant: usize, found: &[f64]) -> Option<Instant> {
    let near = DVector::from_column_slice(found);
    self::instant(
        &known.truth,
        &known.interpreter,
        &Numbers::nominal_parameters(&known.derived.pool, &known.derived.system).0,
        known.task.times[instant],
        &near,
        known.length,
    )
}
