//! Covariance of errors that are partly rounding of the table.
//!
//! Neighboring rows of slow motion are rounded almost equally, so their errors are correlated. With normal noise of σ
//! steps, the mean error of a value is a Fourier series of its position within a step. Its amplitudes are
//! 1/(πk)·exp(−2π²k²σ²) in steps (Widrow and Kollár 2008, *Quantization Noise*). The rest of an error is independent
//! from row to row. The position of zero within a step counts as evenly distributed, so different harmonics are
//! uncorrelated. The mean square of an error is σ² + 1/12 at any σ.

use std::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};

use crate::goodness::between_rows;
use crate::model::Sampled;
use crate::{Column, Measurements};

/// Number of harmonics of the mean error; those beyond count as independent from row to row.
const HARMONICS: usize = 24;

/// Number of halvings of the range in which noise is sought.
const HALVINGS: usize = 40;

/// Noise in steps from which on rounding is independent: 2.7e-9 of its first harmonic is left.
const INDEPENDENT: f64 = 1.0;

/// Errors of the measured values after a fit.
pub(crate) struct Errors<'a> {
    /// Rounded values.
    pub measured: &'a Measurements,
    /// Their residuals.
    pub sampled: &'a Sampled,
    /// Standard deviations by which columns are weighed.
    pub deviations: &'a [f64],
    /// Mean square of errors, in squares of these deviations.
    pub variance: f64,
}

impl Errors<'_> {
    /// Covariance of the sums of errors by these weights: a row for each measured value, column by column.
    pub fn covariance(&self, weights: &DMatrix<f64>) -> DMatrix<f64> {
        let count = weights.ncols();
        let mut covariance = DMatrix::from_diagonal_element(count, count, self.variance);
        let mut first = 0;
        let columns = self.measured.columns.iter();
        for (place, own) in columns.enumerate() {
            let residuals = &self.sampled.residuals[place];
            let rows = residuals.iter().flatten().count();
            let weights = weights.rows(first, rows);
            first += rows;
            let Some(rounded) = Rounded::of(own, &self.measured.times, residuals) else {
                continue;
            };
            // In squares of the deviation by which the column is weighed.
            let step = (rounded.step / self.deviations[place]).powi(2);
            for (harmonic, phases) in (1..).zip(&rounded.phases) {
                let square = step * mean_square(harmonic, rounded.noise);
                covariance -= weights.transpose() * weights * square;
                for part in phases {
                    let part = DVector::from_iterator(rows, part.iter().flatten().copied());
                    let sum = weights.transpose() * part;
                    covariance += &sum * sum.transpose() * square;
                }
            }
        }
        covariance
    }
}

/// Mean square of a harmonic of the mean error, in squares of the step.
fn mean_square(harmonic: u8, noise: f64) -> f64 {
    let order = f64::from(harmonic) * PI;
    0.5 / (order * order) * (-4.0 * (order * noise).powi(2)).exp()
}

/// A column whose errors of rounding are correlated.
struct Rounded {
    step: f64,
    /// Standard deviation of the noise in steps.
    noise: f64,
    /// Cosine and sine of each harmonic, row by row.
    phases: Vec<[Vec<Option<f64>>; 2]>,
}

impl Rounded {
    /// Returns the column; `None` if it is not rounded, or if noise makes errors of rounding independent.
    fn of(column: &Column, times: &[f64], residuals: &[Option<f64>]) -> Option<Rounded> {
        let step = column.rounding.filter(|it| *it > 0.0)?;
        let variance = match column.deviation {
            Some(deviation) => (deviation / step).powi(2),
            None => between_rows(times, residuals)?.0 / (step * step),
        };
        if variance > INDEPENDENT * INDEPENDENT {
            return None;
        }
        let rows = column.values.iter().zip(residuals);
        let places: Vec<Option<f64>> = rows
            .map(|(value, left)| Some((((*value)? - (*left)?) / step).fract() * TAU))
            .collect();
        let phases = (1..=HARMONICS).map(|harmonic| {
            [f64::cos, f64::sin].map(|part| {
                let places = places.iter();
                places
                    .map(|it| it.map(|it| part(harmonic as f64 * it)))
                    .collect()
            })
        });
        let phases: Vec<[Vec<Option<f64>>; 2]> = phases.collect();
        let noise = match column.deviation {
            Some(_) => variance.sqrt(),
            None => noise_between_rows(variance, times, &phases)?,
        };
        Some(Rounded {
            step,
            noise,
            phases,
        })
    }
}

/// Noise in steps for which cubics through neighboring rows leave this mean square, in squares of the step.
///
/// They leave all errors that are independent from row to row, and of each harmonic the residuals of its cosine and
/// sine.
fn noise_between_rows(found: f64, times: &[f64], phases: &[[Vec<Option<f64>>; 2]]) -> Option<f64> {
    let mut followed = Vec::with_capacity(phases.len());
    for [cosines, sines] in phases {
        followed.push(1.0 - between_rows(times, cosines)?.0 - between_rows(times, sines)?.0);
    }
    let left = |noise: f64| {
        let harmonics = (1..).zip(&followed);
        let smooth = harmonics.map(|(harmonic, share)| share * mean_square(harmonic, noise));
        noise * noise + 1.0 / 12.0 - smooth.sum::<f64>()
    };
    let (mut low, mut high) = (0.0, INDEPENDENT);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match left(middle) < found {
            true => low = middle,
            false => high = middle,
        }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkwright_solver::Observable;

    fn column(values: &[f64], deviation: Option<f64>) -> Column {
        Column {
            observable: Observable::Coordinate { place: 0, level: 0 },
            values: values.iter().copied().map(Some).collect(),
            deviation,
            rounding: Some(1.0),
            group: 0,
        }
    }

    /// Variance of the sum of errors of rows with these values before they are rounded to whole numbers.
    fn of_the_sum(exact: &[f64], deviation: Option<f64>) -> f64 {
        let rounded: Vec<f64> = exact.iter().map(|it| it.round()).collect();
        let residuals = rounded.iter().zip(exact).map(|(a, b)| Some(a - b));
        let sampled = Sampled {
            residuals: vec![residuals.collect()],
            slopes: Vec::new(),
        };
        let measured = Measurements {
            times: (0..exact.len()).map(|it| it as f64).collect(),
            columns: vec![column(&rounded, deviation)],
        };
        let noise = deviation.unwrap_or(0.0);
        let errors = Errors {
            measured: &measured,
            sampled: &sampled,
            deviations: &[1.0],
            variance: noise * noise + 1.0 / 12.0,
        };
        let root = (exact.len() as f64).sqrt().recip();
        let weights = DMatrix::from_element(exact.len(), 1, root);
        errors.covariance(&weights)[(0, 0)] / (root * root)
    }

    /// At rest, the errors of all rows are equal, of variance 1/12; noise makes them independent.
    #[test]
    fn errors_of_rows_at_rest_are_one_error() {
        let rows = 40.0;
        let rest = of_the_sum(&[0.3; 40], Some(1e-6));
        assert!((rest / (rows * rows / 12.0) - 1.0).abs() < 0.03, "{rest}");
        let steady: Vec<f64> = (0..40).map(|it| f64::from(it) / 8.0).collect();
        let steady = of_the_sum(&steady, Some(1e-6));
        // The errors of eight rows that share a step evenly add up to one error, here five times equal: Σ B1(x + k/8) =
        // B1(8x).
        assert!((steady / (25.0 / 12.0) - 1.0).abs() < 0.15, "{steady}");
        let noisy = of_the_sum(&[0.3; 40], Some(1.0));
        assert!(
            (noisy / (rows * (1.0 + 1.0 / 12.0)) - 1.0).abs() < 1e-6,
            "{noisy}"
        );
    }

    /// Errors of two rows, half a step apart, have the covariance −1/24 of a sawtooth (that of the Bernoulli polynomial of degree two).
    #[test]
    fn errors_half_a_step_apart_cancel_each_other() {
        let variance = of_the_sum(&[0.2, 0.7], Some(1e-6));
        assert!(
            (variance - 2.0 * (1.0 / 12.0 - 1.0 / 24.0)).abs() < 3e-3,
            "{variance}"
        );
    }

    /// Noise of a fifth of a step, evenly spread normal quantiles in changing order, is found between slowly moving rows.
    #[test]
    fn noise_is_found_in_spite_of_rounding() {
        let mut seed = 7_u64;
        let mut uniform = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((seed >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
        };
        for noise in [0.05, 0.2] {
            let exact: Vec<f64> = (0..4000).map(|it| f64::from(it) * 0.083).collect();
            let values: Vec<f64> = exact
                .iter()
                .map(|it| {
                    let radius = (-2.0 * uniform().ln()).sqrt();
                    (it + noise * radius * (TAU * uniform()).cos()).round()
                })
                .collect();
            let left: Vec<Option<f64>> = values
                .iter()
                .zip(&exact)
                .map(|(a, b)| Some(a - b))
                .collect();
            let times: Vec<f64> = (0..4000).map(f64::from).collect();
            let rounded = Rounded::of(&column(&values, None), &times, &left).expect("rounded");
            assert!(
                (rounded.noise / noise - 1.0).abs() < 0.1,
                "{}",
                rounded.noise
            );
        }
    }
}
