//! Adds up tolerances in first order: derivatives of measures by parameters, times tolerances.
//!
//! Derivatives of measures of positions and rates are exact, by the sensitivities of the blocks. Those of accelerations and forces are
//! central differences of solved motions.

use linkwright::{Blocks as _, Failure, Settings, Shell};
use linkwright_codegen::stages::model::Distribution;

use super::prepared::Prepared;
use crate::batch::Batch;
use crate::derivatives::{EXACT_ORDER, SensitivityPlaces};
use crate::observable::Observable;
use crate::view::View;

/// Step of differences, as a share of the larger one of value and tolerance: the cube root of ε, which balances rounding and curvature.
const STEP: f64 = 6.1e-6;

/// Parameter with its distribution, or component of an offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Toleranced {
    /// Index into the mechanism's parameters.
    pub parameter: usize,
    /// Value about which it is distributed, in SI units.
    pub nominal: f64,
    /// Distribution.
    pub distribution: Distribution,
}

/// Spreads of all measures in first order.
#[derive(Clone, Debug)]
pub struct StackUp {
    /// Times (s) at which the nominal motion is solved.
    pub times: Vec<f64>,
    /// Parameters with a tolerance, in the order of the description, then both components of the offset of each loose pin.
    pub toleranced: Vec<Toleranced>,
    /// Spreads, in the order of the measures of the description.
    pub measures: Vec<LinearSpread>,
    /// Reason of an early end of the nominal motion; `None` if it is complete.
    pub ended: Option<String>,
}

/// Spread of a measure in first order, in SI units.
#[derive(Clone, Debug)]
pub struct LinearSpread {
    /// Observable of the measure.
    pub observable: Observable,
    /// True if its derivatives are exact, false if they are differences.
    pub is_exact: bool,
    /// Value of the nominal mechanism at each time.
    pub nominal: Vec<f64>,
    /// Derivatives by time, then by parameter with a tolerance; NaN where a neighboring mechanism cannot be solved.
    pub slopes: Vec<Vec<f64>>,
    /// Worst case at each time: the sum of the largest departures.
    pub worst: Vec<f64>,
    /// Standard deviation at each time: the root of the sum of squares.
    pub deviation: Vec<f64>,
}

impl StackUp {
    /// Returns the spreads at the solved ones of these times (s), the first of which is that of the assembly.
    ///
    /// # Errors
    /// The nominal mechanism cannot be assembled.
    pub fn new(prepared: &Prepared, times: &[f64], threads: usize) -> Result<StackUp, Failure> {
        let along = &prepared.along;
        let system = along.system();
        let nominal = along.nominal_parameters().0;
        let toleranced: Vec<Toleranced> = (0..nominal.len())
            .filter_map(|parameter| {
                Some(Toleranced {
                    parameter,
                    nominal: nominal[parameter],
                    distribution: system.mechanism.parameters[parameter].tolerance?,
                })
            })
            .collect();
        let observables = Observable::all(along.derived());
        let measurements = &system.mechanism.measurements;
        // Measures are the last columns.
        let observables = &observables[observables.len() - measurements.len()..];
        let mut measures: Vec<LinearSpread> = measurements
            .iter()
            .zip(observables)
            .map(|(measurement, (_, observable))| LinearSpread {
                observable: *observable,
                is_exact: measurement.order <= EXACT_ORDER,
                nominal: Vec::with_capacity(times.len()),
                slopes: Vec::with_capacity(times.len()),
                worst: Vec::new(),
                deviation: Vec::new(),
            })
            .collect();
        let ended = follow_exact(prepared, times, toleranced.len(), &mut measures)?;
        let times = &times[..measures.first().map_or(0, |it| it.nominal.len())];
        difference(prepared, times, &toleranced, threads, &mut measures);
        for measure in &mut measures {
            measure.add_up(&toleranced);
        }
        Ok(StackUp {
            times: times.to_vec(),
            toleranced,
            measures,
            ended,
        })
    }
}

impl LinearSpread {
    fn add_up(&mut self, toleranced: &[Toleranced]) {
        let sums = (0..self.slopes.len()).map(|place| {
            let parts = self.parts(place, toleranced);
            let worst: f64 = parts.iter().map(|it| it[0]).sum();
            let variance: f64 = parts.iter().map(|it| it[1]).sum();
            (worst, variance.sqrt())
        });
        (self.worst, self.deviation) = sums.unzip();
    }

    /// Returns the largest departure and the variance that each source contributes at a time.
    fn parts(&self, place: usize, toleranced: &[Toleranced]) -> Vec<[f64; 2]> {
        let mut parts: Vec<[f64; 2]> = Vec::with_capacity(toleranced.len());
        for (slope, it) in self.slopes[place].iter().zip(toleranced) {
            let limit = slope.abs() * it.distribution.limit();
            let variance = slope * slope * it.distribution.variance();
            match parts.last_mut().filter(|_| !it.begins_source()) {
                // The largest departure within a disc is along the gradient.
                Some(last) => *last = [last[0].hypot(limit), last[1] + variance],
                None => parts.push([limit, variance]),
            }
        }
        parts
    }

    /// Returns the largest departures that each source contributes at a time.
    pub fn limits(&self, place: usize, toleranced: &[Toleranced]) -> Vec<f64> {
        let parts = self.parts(place, toleranced).into_iter();
        parts.map(|it| it[0]).collect()
    }

    /// Returns the shares of the variance that each source contributes at a time; all zero without a variance.
    pub fn shares(&self, place: usize, toleranced: &[Toleranced]) -> Vec<f64> {
        let parts = self.parts(place, toleranced);
        let whole: f64 = parts.iter().map(|it| it[1]).sum();
        let share = |part: f64| if whole > 0.0 { part / whole } else { 0.0 };
        parts.into_iter().map(|it| share(it[1])).collect()
    }
}

impl Toleranced {
    /// True if the parameter begins a source of spread; false for the second component of an offset.
    pub fn begins_source(&self) -> bool {
        !matches!(self.distribution, Distribution::Clearance { axis: 1.., .. })
    }
}

/// Returns the place of the largest value; the first one of equal values. `None` if no value is a number.
pub(super) fn largest(values: &[f64]) -> Option<usize> {
    let numbers = (0..values.len()).filter(|&it| !values[it].is_nan());
    numbers.reduce(|best, it| match values[it] > values[best] {
        true => it,
        false => best,
    })
}

/// Follows the nominal motion with its sensitivities; fills values and exact derivatives.
fn follow_exact(
    prepared: &Prepared,
    times: &[f64],
    count: usize,
    measures: &mut [LinearSpread],
) -> Result<Option<String>, Failure> {
    let along = &prepared.along;
    let places = SensitivityPlaces::of(along.system());
    let observables: Vec<Observable> = measures.iter().map(|it| it.observable).collect();
    let laws = along.input_laws();
    let mut shell: Option<Shell<_>> = None;
    for &t in times {
        let inputs = laws.at(t);
        let reached = match &mut shell {
            Some(shell) => shell.advance(t, &inputs).map(|_| ()),
            None => {
                let parameters = along.nominal_parameters();
                let pose = along.drawn_pose(&parameters);
                let modes = along.drawn_branches();
                let settings = Settings::default();
                let blocks = along.clone();
                let assembled =
                    Shell::assemble(blocks, &parameters, &pose, modes, t, &inputs, settings);
                shell = Some(assembled?);
                Ok(())
            }
        };
        let Some(shell) = &shell else { continue };
        if let Err(failure) = reached {
            return Ok(Some(shell.blocks().ended(&failure, shell.frame())));
        }
        let values = Observable::values(shell.blocks(), &observables, shell.frame());
        let derivatives = shell.blocks().derivatives(shell.frame());
        let derivatives = derivatives.unwrap_or_default();
        for (place, (measure, value)) in measures.iter_mut().zip(values).enumerate() {
            measure.nominal.push(value);
            let slopes = (0..count).map(|parameter| {
                let derivative = places
                    .measure(parameter, place)
                    .and_then(|it| derivatives.get(it));
                derivative.copied().unwrap_or(f64::NAN)
            });
            measure.slopes.push(slopes.collect());
        }
    }
    Ok(None)
}

/// Fills derivatives of accelerations and forces by central differences.
fn difference(
    prepared: &Prepared,
    times: &[f64],
    toleranced: &[Toleranced],
    threads: usize,
    measures: &mut [LinearSpread],
) {
    let mut measures: Vec<&mut LinearSpread> =
        measures.iter_mut().filter(|it| !it.is_exact).collect();
    if measures.is_empty() || times.is_empty() {
        return;
    }
    let observables: Vec<Observable> = measures.iter().map(|it| it.observable).collect();
    let mut batch = Batch::new(&prepared.unlimited, times, &observables);
    batch.threads = threads;
    let nominal = prepared.unlimited.nominal_parameters().0;
    let step = |it: &Toleranced| STEP * it.nominal.abs().max(it.distribution.limit());
    let mut parameters = Vec::with_capacity(2 * toleranced.len() * nominal.len());
    for it in toleranced {
        for sign in [1.0, -1.0] {
            let mut moved = nominal.clone();
            moved[it.parameter] += sign * step(it);
            parameters.extend(moved);
        }
    }
    let of_set = times.len() * observables.len();
    let mut values = vec![f64::NAN; 2 * toleranced.len() * of_set];
    if batch.solve(&parameters, &[], &mut values).is_err() {
        return;
    }
    let pairs = values.chunks_exact(2 * of_set).enumerate();
    for (parameter, pair) in pairs {
        let (above, below) = pair.split_at(of_set);
        // The difference of the rounded values.
        let it = &toleranced[parameter];
        let moved = [1.0, -1.0].map(|sign| it.nominal + sign * step(it));
        let width = moved[0] - moved[1];
        for place in 0..times.len() {
            for (column, measure) in measures.iter_mut().enumerate() {
                let index = place * observables.len() + column;
                let slope = match width > 0.0 {
                    true => (above[index] - below[index]) / width,
                    // A parameter of zero without a tolerance.
                    false => 0.0,
                };
                measure.slopes[place][parameter] = slope;
            }
        }
    }
}
