//! Compares measured and solved values: root mean square, largest difference and its time.

use std::f64::consts::TAU;

/// Differences of measured values from the motion, in the unit of the values.
///
/// ```
/// use linkwright_solver::Comparison;
///
/// // Pairs of a time (s) and of the measured minus the solved value.
/// let differences = [(0.0, 3.0), (0.5, -4.0)];
/// let comparison = Comparison::of(differences.into_iter()).expect("two pairs");
/// assert_eq!((comparison.largest, comparison.at), (-4.0, 0.5));
/// assert!((comparison.rms - 12.5_f64.sqrt()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Number of compared values.
    pub count: usize,
    /// Root mean square of the differences.
    pub rms: f64,
    /// Difference of the largest magnitude, measured minus solved.
    pub largest: f64,
    /// Time of the largest difference (s).
    pub at: f64,
}

/// Returns measured minus solved. Of angles, the difference nearest to zero is taken, since whole turns do not count.
pub fn difference(measured: f64, solved: f64, is_angle: bool) -> f64 {
    let difference = measured - solved;
    match is_angle {
        true => difference - TAU * (difference / TAU).round(),
        false => difference,
    }
}

impl Comparison {
    /// Compares from pairs of a time and a difference; `None` without pairs.
    pub fn of(differences: impl Iterator<Item = (f64, f64)>) -> Option<Comparison> {
        let (mut count, mut square) = (0, 0.0);
        let mut largest: Option<(f64, f64)> = None;
        for (t, difference) in differences {
            count += 1;
            square += difference * difference;
            if largest.is_none_or(|it| difference.abs() > it.1.abs()) {
                largest = Some((t, difference));
            }
        }
        let (at, largest) = largest?;
        Some(Comparison {
            count,
            rms: (square / count as f64).sqrt(),
            largest,
            at,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_difference_keeps_its_sign_and_its_time() {
        let comparison = Comparison::of([(0.0, 3.0), (1.0, -4.0), (2.0, 0.0)].into_iter());
        let comparison = comparison.expect("there are some");
        assert_eq!(
            (comparison.count, comparison.largest, comparison.at),
            (3, -4.0, 1.0)
        );
        assert!((comparison.rms - (25.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert_eq!(Comparison::of(std::iter::empty()), None);
    }

    #[test]
    fn whole_turns_are_no_difference() {
        assert!((difference(TAU + 0.1, 0.0, true) - 0.1).abs() < 1e-15);
        assert_eq!(difference(TAU + 0.1, 0.0, false), TAU + 0.1);
    }
}
