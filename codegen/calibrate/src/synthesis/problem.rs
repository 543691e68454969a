//! Holds the least-squares problem of a start: differences from the targets, and penalties of limits.
//!
//! Penalties are brought to a fixed number of rows, so that neither the residuals nor their derivatives change their size.

use levenberg_marquardt::LeastSquaresProblem;
use linkwright_solver::Modes;
use linkwright_solver::comparison::difference;
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::minimum::Minimizer;
use super::motion::{Sample, Wanted};
use super::penalties::Penalties;
use super::starts::Start;

/// Residual that represents a mechanism that does not move, in terms of the initial one.
const FAILURE_FACTOR: f64 = 1e3;

/// Distance from a bound at which a fit begins, as a share of the width: at the bound, a variable has no slope.
const OFF_BOUND: f64 = 1e-6;

/// Samples at all rows, and in all frames.
struct Sampled {
    rows: Vec<Sample>,
    frames: Vec<Sample>,
}

/// Least-squares problem of a start.
pub(super) struct Problem<'a> {
    minimizer: &'a Minimizer<'a>,
    start: &'a Start,
    /// Variables of the parameters, then of the times of rows if these are sought.
    variables: DVector<f64>,
    sampled: Option<Sampled>,
    /// Rows of the penalties by variable with their residuals in the last column, as many as variables and one; `None` without limits.
    penalized: Option<DMatrix<f64>>,
    penalties: Penalties,
    /// Residual that represents a mechanism that does not move.
    far: f64,
    /// Times (s) that one unit of a variable of time is.
    span: f64,
}

impl<'a> Problem<'a> {
    /// Creates the problem with the variables of a start; `None` if the start does not move.
    pub fn new(
        minimizer: &'a Minimizer<'a>,
        start: &'a Start,
        penalties: Penalties,
    ) -> Option<Self> {
        let task = minimizer.task;
        let span = match &task.frames[..] {
            [first, .., last] if last > first => last - first,
            _ => 1.0,
        };
        let bounds = task.bounds.iter().zip(&start.values);
        let mut variables: Vec<f64> = bounds
            .map(|(it, value)| {
                let margin = OFF_BOUND * (it.high - it.low);
                it.variable(value.clamp(it.low + margin, it.high - margin), *value)
            })
            .collect();
        if minimizer.rates.is_some() {
            variables.extend(start.times.iter().map(|t| t / span));
        }
        let mut problem = Problem {
            minimizer,
            start,
            variables: DVector::from_vec(variables),
            sampled: None,
            penalized: None,
            penalties,
            far: 0.0,
            span,
        };
        problem.update();
        problem.sampled.as_ref()?;
        let largest = problem.residuals().map_or(1.0, |it| it.amax());
        problem.far = FAILURE_FACTOR * largest.max(1.0);
        Some(problem)
    }

    /// Assembly modes, which a fit keeps.
    pub fn modes(&self) -> &Modes {
        &self.start.modes
    }

    /// Returns the parameters and the times of the rows.
    pub fn values(&self) -> (Vec<f64>, Vec<f64>) {
        let bounds = self.minimizer.task.bounds.iter().enumerate();
        let values =
            bounds.map(|(place, it)| it.value(self.variables[place], self.start.values[place])[0]);
        let values: Vec<f64> = values.collect();
        let times = match self.minimizer.rates {
            None => self.start.times.clone(),
            Some(_) => {
                let times = self.variables.iter().skip(values.len());
                times.map(|it| it * self.span).collect()
            }
        };
        (values, times)
    }

    /// Takes multipliers.
    pub fn penalize(&mut self, penalties: Penalties) {
        self.penalties = penalties;
        self.update();
    }

    /// Moves the mechanism with the present variables.
    pub fn update(&mut self) {
        let minimizer = self.minimizer;
        let (values, times) = self.values();
        let rows = Wanted {
            times: &times,
            observables: &minimizer.observables,
            rates: minimizer.rates.as_deref(),
        };
        let frames = Wanted {
            times: &minimizer.task.frames,
            observables: &minimizer.limited,
            rates: None,
        };
        let samples = minimizer
            .moved
            .samples(&values, &self.start.modes, &[rows, frames]);
        self.sampled = samples.and_then(|samples| {
            let [rows, frames] = <[Vec<Sample>; 2]>::try_from(samples).ok()?;
            Some(Sampled { rows, frames })
        });
        self.penalized = match minimizer.limited.is_empty() {
            true => None,
            false => self.penalized(),
        };
    }

    /// Returns the rows of all penalties, brought to a fixed number by reflections, which change neither their squares nor their products.
    fn penalized(&self) -> Option<DMatrix<f64>> {
        let sampled = self.sampled.as_ref()?;
        let minimizer = self.minimizer;
        let excesses = self.excesses()?;
        let (by_variable, count) = (self.by_variable(), self.variables.len());
        let mut rows: Vec<f64> = Vec::new();
        let mut place = 0;
        for (limit, kept) in minimizer.task.limits.iter().enumerate() {
            for frame in &sampled.frames {
                let slopes = &frame.slopes[limit * by_variable.len()..][..by_variable.len()];
                for sign in [-1.0, 1.0] {
                    let [residual, weight] = self.penalties.residual(place, excesses[place]);
                    place += 1;
                    if residual == 0.0 {
                        continue;
                    }
                    let slopes = slopes.iter().zip(&by_variable);
                    rows.extend(slopes.map(|(slope, own)| sign * weight * slope * own / kept.size));
                    rows.resize(rows.len() + count - by_variable.len(), 0.0);
                    rows.push(residual);
                }
            }
        }
        let rows = DMatrix::from_row_slice(rows.len() / (count + 1), count + 1, &rows);
        let rows = match rows.nrows() > count + 1 {
            true => rows.qr().r(),
            false => rows.resize_vertically(count + 1, 0.0),
        };
        Some(rows)
    }

    /// Returns the derivatives of the parameters by their variables.
    fn by_variable(&self) -> Vec<f64> {
        let bounds = self.minimizer.task.bounds.iter().enumerate();
        let slopes =
            bounds.map(|(place, it)| it.value(self.variables[place], self.start.values[place])[1]);
        slopes.collect()
    }

    /// Returns the relative excess of all limits in all frames, at both ends; negative within the limits.
    pub fn excesses(&self) -> Option<Vec<f64>> {
        let sampled = self.sampled.as_ref()?;
        let minimizer = self.minimizer;
        let limits = minimizer
            .task
            .limits
            .iter()
            .zip(&minimizer.ends)
            .enumerate();
        let excesses = limits.flat_map(|(limit, (kept, [low, high]))| {
            sampled.frames.iter().flat_map(move |frame| {
                let value = frame.values[limit];
                let below = low.map_or(f64::NEG_INFINITY, |low| (low - value) / kept.size);
                let above = high.map_or(f64::NEG_INFINITY, |high| (value - high) / kept.size);
                [below, above]
            })
        });
        Some(excesses.collect())
    }

    /// Returns the differences from the targets, column by column.
    pub fn differences(&self) -> Option<Vec<Vec<Option<f64>>>> {
        Some(self.differences_of(&self.sampled.as_ref()?.rows))
    }

    /// Returns the differences from the targets if the rows are at these times (s).
    pub fn differences_at(&self, times: &[f64]) -> Option<Vec<Vec<Option<f64>>>> {
        let (values, _) = self.values();
        let rows = Wanted {
            times,
            observables: &self.minimizer.observables,
            rates: None,
        };
        let moved = self.minimizer.moved;
        let mut samples = moved.samples(&values, &self.start.modes, &[rows])?;
        Some(self.differences_of(&samples.pop()?))
    }

    fn differences_of(&self, samples: &[Sample]) -> Vec<Vec<Option<f64>>> {
        let columns = self.minimizer.task.targets.columns.iter().enumerate();
        let columns = columns.map(|(place, column)| {
            let rows = column.values.iter().zip(samples);
            let rows = rows.map(|(target, sample)| {
                Some(difference(
                    (*target)?,
                    sample.values[place],
                    column.is_angle,
                ))
            });
            rows.collect()
        });
        columns.collect()
    }

    fn count(&self) -> usize {
        let penalized = match self.minimizer.limited.is_empty() {
            true => 0,
            false => self.variables.len() + 1,
        };
        self.minimizer.task.targets.count() + penalized
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, variables: &DVector<f64>) {
        self.variables.copy_from(variables);
        self.update();
    }

    fn params(&self) -> DVector<f64> {
        self.variables.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let Some(differences) = self.differences() else {
            return Some(DVector::from_element(self.count(), self.far));
        };
        let columns = self.minimizer.task.targets.columns.iter();
        let columns = columns.zip(&differences);
        let differences = columns.flat_map(|(column, differences)| {
            let differences = differences.iter().flatten();
            differences.map(move |it| it / column.size)
        });
        let penalized = self.penalized.iter();
        let penalized = penalized.flat_map(|it| it.column(self.variables.len()));
        let all = differences.chain(penalized.copied());
        Some(DVector::from_iterator(self.count(), all))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let sampled = self.sampled.as_ref()?;
        let targets = &self.minimizer.task.targets;
        let by_variable = self.by_variable();
        let parameters = by_variable.len();
        let mut jacobian = DMatrix::zeros(self.count(), self.variables.len());
        let mut next = 0;
        for (place, column) in targets.columns.iter().enumerate() {
            for (row, sample) in sampled.rows.iter().enumerate() {
                if column.values[row].is_none() {
                    continue;
                }
                let slopes = &sample.slopes[place * parameters..][..parameters];
                for (parameter, slope) in slopes.iter().enumerate() {
                    jacobian[(next, parameter)] = -slope * by_variable[parameter] / column.size;
                }
                if let Some(rate) = sample.rates.get(place) {
                    jacobian[(next, parameters + row)] = -rate * self.span / column.size;
                }
                next += 1;
            }
        }
        if let Some(penalized) = &self.penalized {
            let (rows, columns) = (penalized.nrows(), self.variables.len());
            let slopes = penalized.view((0, 0), (rows, columns));
            jacobian
                .view_mut((next, 0), (rows, columns))
                .copy_from(&slopes);
        }
        Some(jacobian)
    }
}
