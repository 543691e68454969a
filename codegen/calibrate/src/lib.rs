//! Fits the parameters of a described mechanism to measured values, with their uncertainty.
//!
//! The fit also names the parameters that the motion does not determine. Levenberg and Marquardt's method minimizes the
//! sum of the squared differences with the derived sensitivities; no difference quotient is taken anywhere.
//!
//! ```
//! use linkwright_calibrate::{Calibrator, Column, Measurements};
//! use linkwright_codegen::Source;
//! use linkwright_solver::Observable;
//!
//! let text = "mechanism crank {
//!     param L = 40mm;
//!     body arm at (0, 0, 0deg) { A: (0, 0), B: (L, 0) }
//!     point A = (0, 0);
//!     revolute A(ground, arm);
//!     drive phi(arm) = t;
//! }";
//! let read = linkwright_codegen::Read::along(&Source::new("crank.mech", text), &["L"]);
//! let derived = read.expect("no errors").only().expect("one motion");
//! let calibrator = Calibrator::new(&derived, 0.1).expect("its equations can be ordered");
//!
//! // Measured positions of B, for a crank that is 42 mm long.
//! let observable = Observable::named(&derived, "B_x").expect("a point");
//! let times: Vec<f64> = (0..20).map(|step| 0.1 * f64::from(step)).collect();
//! let values = times.iter().map(|t| Some(0.042 * t.cos())).collect();
//! let column = Column { observable, values, deviation: None, rounding: None, group: 0 };
//! let measured = Measurements { times, columns: vec![column] };
//!
//! let fit = calibrator.fit(&measured, &calibrator.nominal()).expect("it moves so");
//! assert!((fit.values[0] - 0.042).abs() < 1e-12);
//! assert!(fit.identified.indistinct.is_empty());
//! ```

#![doc(html_root_url = "https://docs.rs/linkwright-calibrate/0.1.0")]

mod bounds;
mod distribution;
mod goodness;
mod identification;
mod model;
mod rounding;
mod slopes;
mod synthesis;
mod table;
mod weights;

pub use bounds::Bounds;
pub use goodness::{ColumnGoodness, Goodness};
pub use identification::{Identification, Indistinct};
pub use model::{Calibrator, NotDerived};
#[doc(hidden)]
pub use synthesis::{
    Candidate, MAX_PARAMETERS, SearchCounts, StartSampling, Synthesis, Target, Targets,
    Unsearchable,
};
#[doc(hidden)]
pub use table::leave_out_underived;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use linkwright_solver::{Observable, View as _};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use model::Sampled;

/// Number of times that the weights of groups are estimated anew from the residuals.
const REWEIGHTED: usize = 4;

/// Multiple of the initial residuals that represents a trial for which the mechanism cannot be solved.
const FAILURE_FACTOR: f64 = 1e3;

/// Largest number of solutions of the motion per parameter.
const PATIENCE: usize = 60;

/// Probability that a parameter lies within its interval.
pub const CONFIDENCE: f64 = 0.95;

/// Measured values of a motion at some times.
#[derive(Clone, Debug)]
pub struct Measurements {
    /// Times in s, never decreasing.
    pub times: Vec<f64>,
    /// Quantities measured at these times.
    pub columns: Vec<Column>,
}

/// Measured quantity.
#[derive(Clone, Debug)]
pub struct Column {
    /// Kind of quantity: a coordinate, a point, or a rate of one.
    pub observable: Observable,
    /// Values in SI units, one per time; `None` if a value is missing.
    pub values: Vec<Option<f64>>,
    /// Standard deviation of one value in SI units; `None` if it is unknown.
    pub deviation: Option<f64>,
    /// Step in SI units to which values are rounded; `None` if it is unknown.
    pub rounding: Option<f64>,
    /// Group of columns that are measured equally well if no deviation is known; columns of different units are in
    /// different groups.
    pub group: usize,
}

impl Column {
    /// Standard deviation of rounding to a step: that of a uniform distribution.
    pub(crate) fn rounding_deviation(&self) -> f64 {
        self.rounding.unwrap_or(0.0) / 12.0_f64.sqrt()
    }
}

/// Parameters with which a mechanism moves as measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Values in SI units, in the order of [`Calibrator::names`].
    pub values: Vec<f64>,
    /// Standard deviation of each value; `None` if this motion does not determine it.
    pub deviations: Vec<Option<f64>>,
    /// Interval that holds each value with the probability [`CONFIDENCE`], from Student's distribution; `None` if this
    /// motion does not determine it.
    pub intervals: Vec<Option<[f64; 2]>>,
    /// Bound at which a value is; `None` if it is at none.
    pub at_bound: Vec<Option<f64>>,
    /// Goodness of the fit: residuals compared with noise.
    pub goodness: Goodness,
    /// Correlation of each pair, row by row; `None` if one of both is not determined.
    pub correlations: Vec<Vec<Option<f64>>>,
    /// Combinations of parameters that this motion determines.
    pub identified: Identification,
    /// Measured minus solved values, initial and final, column by column and time by time.
    pub residuals: [Vec<Vec<Option<f64>>>; 2],
    /// Standard deviation of each column at the end of the fit, in SI units.
    pub column_deviations: Vec<f64>,
    /// Degrees of freedom: number of measured values minus that of determined parameters.
    pub freedom: usize,
    /// Number of solutions of the motion.
    pub evaluations: usize,
}

/// Reason for a fit that failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unfit {
    /// The mechanism cannot be solved at the start, or its motion ends before the last time; the text says why.
    Unsolved(String),
    /// There are fewer measured values than parameters: both numbers.
    TooFew(usize, usize),
    /// The description has no parameter to fit.
    NoParameters,
    /// The initial value of this parameter is not within its bounds.
    OutsideBounds(String),
    /// The minimizer does not converge.
    NotConverged,
}

impl Calibrator {
    /// Identifies what the measured values determine of the parameters at these values, before a fit.
    ///
    /// # Errors
    /// Returns the reason: no parameters, too few measured values, or a motion that cannot be solved.
    pub fn identify(
        &self,
        measured: &Measurements,
        start: &[f64],
    ) -> Result<Identification, Unfit> {
        self.check(measured, start)?;
        let first = self.sample(measured, start).map_err(Unfit::Unsolved)?;
        Ok(self.identified(&first, &weights::initial(measured), start))
    }

    fn identified(&self, sampled: &Sampled, deviations: &[f64], values: &[f64]) -> Identification {
        let jacobian = weighted(sampled, deviations, self.names().len());
        Identification::of(&jacobian, values, self.names())
    }

    /// Returns the number of measured values if a fit can begin.
    fn check(&self, measured: &Measurements, start: &[f64]) -> Result<usize, Unfit> {
        let parameters = self.names().len();
        let all = measured.columns.iter().flat_map(|it| &it.values);
        let count = all.filter(|it| it.is_some()).count();
        if parameters == 0 {
            return Err(Unfit::NoParameters);
        }
        if count < parameters {
            return Err(Unfit::TooFew(count, parameters));
        }
        let bounds = self.names().iter().zip(self.bounds()).zip(start);
        for ((name, bounds), start) in bounds {
            if !bounds.contain(*start) {
                return Err(Unfit::OutsideBounds(name.clone()));
            }
        }
        Ok(count)
    }

    /// Fits the parameters, in the order of [`Calibrator::names`], from these initial values.
    ///
    /// A parameter that is not determined at the start keeps its value.
    ///
    /// # Errors
    /// Returns the reason if the fit fails.
    pub fn fit(&self, measured: &Measurements, start: &[f64]) -> Result<Fit, Unfit> {
        let parameters = self.names().len();
        let count = self.check(measured, start)?;
        let first = self.sample(measured, start).map_err(Unfit::Unsolved)?;
        let mut deviations = weights::initial(measured);
        let at_start = self.identified(&first, &deviations, start);
        let free: Vec<usize> = (0..parameters)
            .filter(|it| at_start.determines(*it))
            .collect();
        let groups = weights::unknown_groups(measured);
        let rounds = match (free.is_empty(), groups > 1) {
            (true, _) => 0,
            (false, true) => REWEIGHTED,
            (false, false) => 1,
        };
        let (mut values, mut evaluations) = (start.to_vec(), 1);
        for round in 0..rounds {
            let problem = Problem::new(self, measured, &deviations, &free, start, &values);
            let minimizer = LevenbergMarquardt::new().with_patience(PATIENCE);
            let (problem, report) = minimizer.minimize(problem);
            // If rounding leaves nothing to improve, the fit has ended, too.
            let is_done = report.termination.was_successful()
                || matches!(
                    report.termination,
                    levenberg_marquardt::TerminationReason::NoImprovementPossible(_)
                );
            if !is_done || !problem.values.iter().all(|it| it.is_finite()) {
                return Err(Unfit::NotConverged);
            }
            evaluations += problem.evaluations;
            values.clone_from(&problem.values);
            if round + 1 < rounds {
                let sampled = self.sample(measured, &values).map_err(Unfit::Unsolved)?;
                weights::improve(&mut deviations, measured, &sampled, free.len());
            }
        }
        let last = self.sample(measured, &values).map_err(Unfit::Unsolved)?;
        let in_the_end = self.identified(&last, &deviations, &values);
        let jacobian = weighted(&last, &deviations, parameters);
        let weighed_by = deviations.clone();
        let freedom = count - in_the_end.rank().min(free.len());
        let scale = weights::scale(measured, &last, &mut deviations, freedom);
        let errors = rounding::Errors {
            measured,
            sampled: &last,
            deviations: &weighed_by,
            variance: scale.variance,
        };
        let errors = errors.covariance(&in_the_end.projections(&jacobian));
        let covariance = in_the_end.covariance(&errors);
        let is_known = |place: usize| {
            at_start.determines(place) && in_the_end.determines(place) && freedom > 0
        };
        let deviation = |place: usize| is_known(place).then(|| covariance[(place, place)].sqrt());
        let deviations_of_values: Vec<Option<f64>> = (0..parameters).map(deviation).collect();
        let correlation = |row: usize, column: usize| {
            let both = deviations_of_values[row]? * deviations_of_values[column]?;
            if row == column {
                return Some(1.0);
            }
            (both > 0.0).then(|| covariance[(row, column)] / both)
        };
        let widths = match scale.is_known {
            true => distribution::KNOWN,
            false => freedom as f64,
        };
        let width = (freedom > 0).then(|| distribution::half_width(CONFIDENCE, widths));
        let interval = |place: usize| {
            let half = width? * deviations_of_values[place]?;
            Some([values[place] - half, values[place] + half])
        };
        let system = self.view().system();
        let columns = measured.columns.iter();
        let is_angle: Vec<bool> = columns.map(|it| it.observable.is_angle(system)).collect();
        let bounds = self.bounds().iter().zip(&values).zip(start);
        Ok(Fit {
            intervals: (0..parameters).map(interval).collect(),
            at_bound: bounds
                .map(|((bounds, value), start)| bounds.reached(*value, *start))
                .collect(),
            goodness: Goodness::of(
                measured,
                &last.residuals,
                &is_angle,
                in_the_end.rank().min(free.len()),
            ),
            correlations: (0..parameters)
                .map(|row| {
                    (0..parameters)
                        .map(|column| correlation(row, column))
                        .collect()
                })
                .collect(),
            deviations: deviations_of_values,
            residuals: [first.residuals, last.residuals],
            column_deviations: deviations,
            identified: match free.len() < parameters {
                true => at_start,
                false => in_the_end,
            },
            values,
            freedom,
            evaluations,
        })
    }
}

impl Fit {
    /// True if the parameters are determined, within their bounds, and noise explains the residuals.
    pub fn is_trusted(&self) -> bool {
        self.identified.determines_all()
            && self.freedom > 0
            && self.at_bound.iter().all(Option::is_none)
            && self.goodness.is_explained()
    }
}

/// Returns −∂r/∂p of the residuals r without missing values, each in standard deviations of its column.
fn weighted(sampled: &Sampled, deviations: &[f64], parameters: usize) -> DMatrix<f64> {
    let mut entries = Vec::new();
    for ((residuals, slopes), deviation) in sampled
        .residuals
        .iter()
        .zip(&sampled.slopes)
        .zip(deviations)
    {
        for (place, _) in residuals.iter().enumerate().filter(|it| it.1.is_some()) {
            let slopes = &slopes[place * parameters..][..parameters];
            entries.extend(slopes.iter().map(|it| it / deviation));
        }
    }
    DMatrix::from_row_slice(entries.len() / parameters.max(1), parameters, &entries)
}

/// Least-squares problem of a fit.
struct Problem<'a> {
    calibrator: &'a Calibrator,
    measured: &'a Measurements,
    deviations: &'a [f64],
    /// Indices of the parameters that change.
    free: &'a [usize],
    start: &'a [f64],
    /// Variables of the free parameters, which the minimizer changes.
    variables: DVector<f64>,
    values: Vec<f64>,
    sampled: Option<Sampled>,
    /// Residual that represents a failed solution.
    far: f64,
    count: usize,
    evaluations: usize,
}

impl<'a> Problem<'a> {
    fn new(
        calibrator: &'a Calibrator,
        measured: &'a Measurements,
        deviations: &'a [f64],
        free: &'a [usize],
        start: &'a [f64],
        values: &[f64],
    ) -> Problem<'a> {
        let all = measured.columns.iter().flat_map(|it| &it.values);
        let bounds = calibrator.bounds();
        let variables = free
            .iter()
            .map(|it| bounds[*it].variable(values[*it], start[*it]));
        let mut problem = Problem {
            calibrator,
            measured,
            deviations,
            free,
            start,
            variables: DVector::from_iterator(free.len(), variables),
            values: values.to_vec(),
            sampled: None,
            far: 0.0,
            count: all.filter(|it| it.is_some()).count(),
            evaluations: 0,
        };
        problem.sample();
        let largest = problem.residuals().map_or(1.0, |it| it.amax());
        problem.far = FAILURE_FACTOR * largest.max(1.0);
        problem
    }

    /// Value of a free parameter, and its derivative by its variable.
    fn value(&self, variable: usize) -> [f64; 2] {
        let place = self.free[variable];
        self.calibrator.bounds()[place].value(self.variables[variable], self.start[place])
    }

    fn sample(&mut self) {
        self.evaluations += 1;
        self.sampled = self.calibrator.sample(self.measured, &self.values).ok();
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, variables: &DVector<f64>) {
        self.variables.copy_from(variables);
        for (variable, place) in self.free.iter().enumerate() {
            self.values[*place] = self.value(variable)[0];
        }
        self.sample();
    }

    fn params(&self) -> DVector<f64> {
        self.variables.clone()
    }

    /// Residuals; for a failed solution they are so large that the step is taken back.
    fn residuals(&self) -> Option<DVector<f64>> {
        let Some(sampled) = &self.sampled else {
            return Some(DVector::from_element(self.count, self.far));
        };
        let columns = sampled.residuals.iter().zip(self.deviations);
        let all = columns
            .flat_map(|(column, deviation)| column.iter().flatten().map(move |it| it / deviation));
        Some(DVector::from_iterator(self.count, all))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let sampled = self.sampled.as_ref()?;
        let all = weighted(sampled, self.deviations, self.values.len());
        let slopes: Vec<f64> = (0..self.free.len()).map(|it| self.value(it)[1]).collect();
        Some(DMatrix::from_fn(
            all.nrows(),
            self.free.len(),
            |row, variable| -all[(row, self.free[variable])] * slopes[variable],
        ))
    }
}
