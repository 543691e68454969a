//! Decides where the first order does not describe the spread of sampled mechanisms.

use super::first_order::{LinearSpread, largest};
use super::sampled::SampledMeasure;

/// Number of standard errors that a difference must exceed; smaller ones may come from the choice of samples.
pub const STANDARD_ERRORS: f64 = 4.0;

/// Share of the largest standard deviation along the motion that a difference must exceed; smaller ones do not matter.
pub const RELEVANT: f64 = 0.01;

/// Largest difference between the first order and sampled mechanisms, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// Index of the time.
    pub place: usize,
    /// True if means differ, false if standard deviations do.
    pub is_of_mean: bool,
    /// Mean or standard deviation in first order.
    pub linear: f64,
    /// Mean or standard deviation of the samples.
    pub sampled: f64,
    /// Number of times at which the first order is not enough.
    pub instants: usize,
}

/// Returns the largest difference of means and of standard deviations beyond [`STANDARD_ERRORS`] and [`RELEVANT`]; empty if the first
/// order is enough at all times.
pub fn departures(linear: &LinearSpread, sampled: &SampledMeasure) -> Vec<Departure> {
    let moments = &sampled.moments;
    let of_samples = moments.iter().map(|it| it.deviation);
    let all = linear.deviation.iter().copied().chain(of_samples);
    let scale = all.filter(|it| it.is_finite()).fold(0.0, f64::max);
    let departure = |is_of_mean: bool| {
        let [from, to, errors]: [Vec<f64>; 3] = match is_of_mean {
            true => [
                linear.nominal.clone(),
                moments.iter().map(|it| it.mean).collect(),
                moments.iter().map(|it| it.error_of_mean).collect(),
            ],
            false => [
                linear.deviation.clone(),
                moments.iter().map(|it| it.deviation).collect(),
                moments.iter().map(|it| it.error_of_deviation).collect(),
            ],
        };
        let differences = from.iter().zip(&to).zip(&errors);
        let differences = differences.map(|((from, to), error)| {
            let difference = (to - from).abs();
            let is_beyond = difference > STANDARD_ERRORS * error && difference > RELEVANT * scale;
            if is_beyond { difference } else { f64::NAN }
        });
        let differences: Vec<f64> = differences.collect();
        let place = largest(&differences)?;
        Some(Departure {
            place,
            is_of_mean,
            linear: from[place],
            sampled: to[place],
            instants: differences.iter().filter(|it| !it.is_nan()).count(),
        })
    };
    [true, false].into_iter().filter_map(departure).collect()
}
