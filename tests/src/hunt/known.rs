//! *A mechanism by construction* → *its equations and what is true of them*: exact motion and bounds at each instant on its path,
//! or why there is nothing to hunt.

use linkwright::Equations;
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::supplied::Numbers;
use linkwright_solver::textbook::TextbookEquations;
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

/// How many instants there are after the first one.
pub const INSTANTS: usize = 24;

/// The time between two of them (s).
pub const APART: f64 = 0.125;

/// What no exact pose may violate in terms of the construction, in sizes and rad per unit of `away`.
const VIOLATION: f64 = 1e-9;

/// What is true at an instant.
pub struct Instant {
    /// The exact motion.
    pub exact: Exact,
    /// By how much it may be off in f64 and in f32.
    pub bounds: [Levels<f64>; 2],
    /// What elimination mixes into q̇ and q̈: see [`mixing`].
    pub mixed: [Vec<f64>; 2],
}

/// A mechanism with its truth.
pub struct Known {
    /// The equations.
    pub derived: Derived,
    /// The same to be evaluated.
    pub interpreter: TextbookEquations,
    /// The same in 384 bits.
    pub truth: Truth,
    /// What residuals in m are judged against.
    pub length: f64,
    /// The size (m).
    pub size: f64,
    /// The instants that the path reaches.
    pub instants: Vec<Instant>,
    /// How it goes on after them.
    pub end: End,
    /// Whether the drawing is the exact pose, so that it has the same modes.
    pub is_drawn_exactly: bool,
    /// Whether every block of the solved view has a closed form.
    pub is_closed: bool,
    /// What is asked.
    pub task: Task,
}

/// Why a mechanism is not hunted.
#[derive(Clone, Debug)]
pub enum Unused {
    /// The description is refused: the codes, and the whole text.
    Refused(String, String),
    /// The pose by construction is so near to a singular one that no path can be followed from it.
    Singular,
    /// The tracker gave up, where it cannot be said whether the path goes on.
    Undecided,
    /// The exact pose is none of the mechanism that was constructed: the equations say something else than the text.
    Contradiction(String),
}

/// What is true of the equations at `t` on the path through an exact pose near `start`.
fn instant(
    truth: &Truth,
    interpreter: &TextbookEquations,
    parameters: &[f64],
    t: f64,
    start: &DVector<f64>,
    length: f64,
) -> Option<Instant> {
    let given = Given {
        t,
        parameters: parameters.to_vec(),
        ..Given::default()
    };
    let start: Vec<Precise> = start.iter().map(|it| Precise::from_f64(*it)).collect();
    let exact = truth.solve(&given, &start)?;
    let bounds =
        [Scalar::F64, Scalar::F32].map(|scalar| truth.allowance(&given, &exact, length, scalar));
    let q: Vec<f64> = exact.levels[0].iter().map(Precise::to_f64).collect();
    // What is computed may be larger than the exact value by its bound.
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

/// The times of all instants.
pub fn times() -> Vec<f64> {
    (0..=INSTANTS).map(|it| it as f64 * APART).collect()
}

/// Reads the description and finds what is true of it.
///
/// # Errors
/// Why there is nothing to hunt.
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
    linkwright_codegen::check(&derived).map_err(|errors| refused(&errors))?;
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
        // No comparison with NaN holds.
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

/// The exact motion through a pose near `found`, wherever that lies; `None` where there is none.
pub fn elsewhere(known: &Known, instant: usize, found: &[f64]) -> Option<Instant> {
    let found = DVector::from_column_slice(found);
    self::instant(
        &known.truth,
        &known.interpreter,
        &Numbers::nominal_parameters(&known.derived.pool, &known.derived.system).0,
        known.task.times[instant],
        &found,
        known.length,
    )
}
