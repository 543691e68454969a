//! Summarizes sampled values of a measure at an instant.

/// Shares of the sampled mechanisms below the reported quantiles: those of three standard deviations of a normal distribution, and
/// the median.
pub const QUANTILES: [f64; 3] = [0.001_35, 0.5, 0.998_65];

/// Moments and quantiles of sampled values, in SI units; NaN if there are too few.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// Number of values.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Standard error of the mean of independent samples.
    pub error_of_mean: f64,
    /// Standard error of the standard deviation of independent samples.
    pub error_of_deviation: f64,
    /// Values below which the shares [`QUANTILES`] of the mechanisms lie, interpolated.
    pub quantiles: [f64; 3],
}

impl Moments {
    /// Returns the moments of some numbers about a near value, and sorts them.
    pub fn of(values: &mut [f64], about: f64) -> Moments {
        values.sort_unstable_by(f64::total_cmp);
        let count = values.len() as f64;
        let mean_of = |power: i32, center: f64| {
            let powers = values.iter().map(|it| (it - about - center).powi(power));
            powers.sum::<f64>() / count
        };
        let shift = mean_of(1, 0.0);
        let (second, fourth) = (mean_of(2, shift), mean_of(4, shift));
        let variance = second * count / (count - 1.0);
        let deviation = variance.sqrt();
        // Variance of the sample variance (Kenney and Keeping 1951, section 7.6).
        let of_variance =
            (fourth - second * second * (count - 3.0) / (count - 1.0)).max(0.0) / count;
        Moments {
            count: values.len(),
            mean: about + shift,
            deviation,
            error_of_mean: deviation / count.sqrt(),
            error_of_deviation: match deviation > 0.0 {
                true => of_variance.sqrt() / (2.0 * deviation),
                false => 0.0 * deviation,
            },
            quantiles: QUANTILES.map(|share| quantile(values, share)),
        }
    }
}

/// Returns the quantile of ascending values, linear between neighbors; NaN without a value.
fn quantile(values: &[f64], share: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else {
        return f64::NAN;
    };
    let place = share * last as f64;
    let below = (place as usize).min(last);
    let above = (below + 1).min(last);
    let part = place - below as f64;
    values[below] * (1.0 - part) + values[above] * part
}

#[cfg(test)]
mod tests {
    use super::Moments;

    /// Values of NumPy for 1, 2, 4, 8: mean, standard deviation with n - 1, and linear quantiles.
    #[test]
    fn moments_of_four_numbers() {
        let moments = Moments::of(&mut [8.0, 1.0, 4.0, 2.0], 3.0);
        assert_eq!((moments.count, moments.mean), (4, 3.75));
        assert!((moments.deviation - 3.095_695_936_834_452).abs() < 1e-14);
        assert_eq!(moments.quantiles[1], 3.0);
        assert!((moments.quantiles[0] - 1.004_05).abs() < 1e-14);
        assert!((moments.quantiles[2] - 7.983_8).abs() < 1e-13);
    }

    /// An even spread over an interval has the fourth moment 9/5 of the squared variance, so the error is s √(0.8/(4 n)).
    #[test]
    fn the_error_of_the_deviation_is_that_of_the_distribution() {
        let count = 10_000;
        let mut values: Vec<f64> = (0..count).map(f64::from).collect();
        let moments = Moments::of(&mut values, 0.0);
        let expected = moments.deviation * (0.8 / (4.0 * f64::from(count))).sqrt();
        assert!((moments.error_of_deviation / expected - 1.0).abs() < 1e-3);
    }
}
