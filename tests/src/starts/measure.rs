//! Assembles a mechanism from many starts and records where each ends: at the design pose, at another one, or at a
//! typed failure, with the number of evaluations.
//!
//! The reference is the pose to which the design configuration itself leads; whole turns of angles do not count. A
//! solved frame is judged by a residual of its own evaluation.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use linkwright::{Equations, Failure, Frame, Settings};
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::{DMatrix, DVector, Dyn};

use super::perturbation::{estimate, reach};
use crate::generated::MODULES;
use crate::stability::sample::named;

/// Largest distance of a pose from the reference, in scales: the tolerance is 1e-12.
const POSE_DISTANCE_LIMIT: f64 = 1e-9;

/// Largest scaled residual of a solved frame.
const SOLVED: f64 = 1e-11;

/// Numbers of starts by end, and their cost.
#[derive(Clone, Debug, Default)]
pub struct Outcomes {
    /// Number of starts.
    pub starts: u32,
    /// At the design pose.
    pub drawn: u32,
    /// At another pose with the same sign of the determinant.
    pub another: u32,
    /// At a pose with the other sign, if no sign was requested.
    pub other_branch: u32,
    /// At no pose, or at one with the other sign although a sign was requested.
    pub wrong: u32,
    /// Typed failures by kind.
    pub failed: BTreeMap<&'static str, u32>,
    /// Evaluations of the Jacobian, one for each start.
    pub jacobians: Vec<u32>,
    /// Evaluations of the residual, one for each start.
    pub residuals: Vec<u32>,
}

impl Outcomes {
    fn fail(&mut self, failure: &Failure<f64>) {
        *self.failed.entry(named(failure.kind)).or_default() += 1;
    }

    /// Share of the starts that ended at the design pose, in percent.
    pub fn success(&self) -> f64 {
        100.0 * f64::from(self.drawn) / f64::from(self.starts.max(1))
    }
}

/// One motion of a mechanism, by every function that assembles it.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Name of the mechanism, with its motion if it has several.
    pub name: String,
    /// Number of coordinates.
    pub coordinates: usize,
    /// `assemble` of the textbook formulation.
    pub plain: Outcomes,
    /// `assemble_from_rough_estimate` of the textbook formulation on the branch of the design configuration.
    pub afar: Outcomes,
    /// `assemble_from` of the generated mechanism, if its frames hold all coordinates and it has no inputs.
    pub generated: Option<Outcomes>,
}

/// Equations that count their evaluations.
struct Counted<'a> {
    inner: &'a TextbookEquations,
    residuals: Cell<u32>,
    jacobians: Cell<u32>,
}

impl Equations<f64, Dyn> for Counted<'_> {
    fn dimension(&self) -> Dyn {
        self.inner.dimension()
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        self.residuals.set(self.residuals.get() + 1);
        self.inner.residual(q, t, phi);
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        self.jacobians.set(self.jacobians.get() + 1);
        self.inner.jacobian(q, t, phi_q);
    }

    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        self.inner.time_derivative(q, t, phi_t);
    }

    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        self.inner.gamma(q, qd, t, gamma);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.inner.row_scale(row)
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.inner.coordinate_scale(column)
    }
}

/// Assembles a motion from this many estimates.
///
/// # Panics
/// If the design configuration itself does not lead to a pose.
pub fn measure(derived: &Derived, starts: u32) -> Measured {
    let mechanism = &derived.system.mechanism;
    let motion = mechanism.motion.as_ref();
    let name = match motion {
        Some(motion) => format!("{}, {}", mechanism.name, motion.name),
        None => mechanism.name.clone(),
    };
    let interpreter = TextbookEquations::new(&derived.pool, &derived.system);
    let settings = Settings::default();
    let drawn = interpreter.estimate();
    let truth = Frame::assemble(&interpreter, drawn, 0.0, &settings)
        .unwrap_or_else(|failure| panic!("{name}: {failure}"))
        .q;
    let branch = Frame::branch_of(&interpreter, &truth, 0.0, &settings)
        .unwrap_or_else(|failure| panic!("{name}: {failure}"));
    let reach = reach(derived);
    let judge = Judge {
        derived,
        interpreter: &interpreter,
        truth: &truth,
    };
    let module = MODULES.iter().find(|module| module.name == name);
    let mut measured = Measured {
        name,
        coordinates: drawn.len(),
        plain: Outcomes::default(),
        afar: Outcomes::default(),
        generated: module.map(|_| Outcomes::default()),
    };
    for number in 0..starts {
        let start = estimate(drawn, &reach, number);
        for (outcomes, from_rough_estimate) in
            [(&mut measured.plain, false), (&mut measured.afar, true)]
        {
            let counted = Counted {
                inner: &interpreter,
                residuals: Cell::new(0),
                jacobians: Cell::new(0),
            };
            let assembled: Result<Frame<f64, Dyn>, _> = if from_rough_estimate {
                Frame::assemble_from_rough_estimate(&counted, &start, Some(branch), 0.0, &settings)
            } else {
                Frame::assemble(&counted, &start, 0.0, &settings)
            };
            outcomes.starts += 1;
            outcomes.jacobians.push(counted.jacobians.get());
            outcomes.residuals.push(counted.residuals.get());
            match assembled {
                Ok(frame) => {
                    let is_branch =
                        Frame::branch_of(&interpreter, &frame.q, 0.0, &settings) == Ok(branch);
                    judge.judge(&frame.q, is_branch, from_rough_estimate, outcomes);
                }
                Err(failure) => outcomes.fail(&failure),
            }
        }
        if let (Some(module), Some(outcomes)) = (module, &mut measured.generated) {
            outcomes.starts += 1;
            match (module.assemble_from)(start.as_slice(), 0.0) {
                Ok(q) => {
                    let q = DVector::from_vec(q);
                    let is_branch =
                        Frame::branch_of(&interpreter, &q, 0.0, &settings) == Ok(branch);
                    // Its branches are those of its blocks, so that the sign of the whole determinant adds nothing.
                    judge.judge(&q, is_branch, true, outcomes);
                }
                Err(failure) => outcomes.fail(&failure),
            }
        }
    }
    measured
}

struct Judge<'a> {
    derived: &'a Derived,
    interpreter: &'a TextbookEquations,
    truth: &'a DVector<f64>,
}

impl Judge<'_> {
    fn judge(&self, q: &DVector<f64>, is_branch: bool, is_asked: bool, outcomes: &mut Outcomes) {
        let mut phi = DVector::zeros(q.len());
        self.interpreter.residual(q, 0.0, &mut phi);
        let scaled = phi.iter().zip(&self.derived.system.rows);
        // NaN does not count as a pose.
        let is_solved = scaled
            .map(|(value, row)| {
                value.abs() / self.derived.system.scale(row.quantity, &self.derived.pool)
            })
            .all(|value| value <= SOLVED);
        if !is_solved || (is_asked && !is_branch) {
            outcomes.wrong += 1;
        } else if self.is_drawn(q) {
            outcomes.drawn += 1;
        } else if is_branch {
            outcomes.another += 1;
        } else {
            outcomes.other_branch += 1;
        }
    }

    fn is_drawn(&self, q: &DVector<f64>) -> bool {
        let pairs = q.iter().zip(self.truth.iter());
        pairs
            .zip(&self.derived.system.coordinates)
            .all(|((found, wanted), coordinate)| {
                let mut difference = found - wanted;
                if coordinate.quantity == Quantity::Angle {
                    difference -= TAU * (difference / TAU).round();
                }
                difference.abs()
                    <= POSE_DISTANCE_LIMIT
                        * self
                            .derived
                            .system
                            .scale(coordinate.quantity, &self.derived.pool)
            })
    }
}
