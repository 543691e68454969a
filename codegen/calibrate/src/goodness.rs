//! Goodness of a fit: the residuals of each column, compared with its noise.
//!
//! Noise is known to the caller, or estimated: as the deviation of a row from a cubic through the neighboring rows. The
//! rows are those of the measured values or of the residuals. Both estimates are upper ones: smooth motion and smooth
//! misfit add to them. Noise is never the magnitude of residuals. A column is explained under two conditions: a ratio
//! of mean squares is likely (χ², or F if noise is estimated), and signs of residuals are mixed (Wald and Wolfowitz
//! 1940).

use linkwright_solver::comparison::difference;

use crate::distribution::{KNOWN, exceeded};
use crate::{Column, Measurements};

/// Probability below which noise does not explain a fit: one half for single columns, one half for all together.
const CHANCE: f64 = 1e-3;

/// Number of neighbors of a row on each side.
const BESIDE: usize = 2;

/// Number of rows whose fourth differences count as one independent one: Σρ² of their correlations ρ (Anderson 1971,
/// section 3.4).
const CORRELATED: f64 = 2.63;

/// Precision of poses, which is the least noise of a column, relative to its range.
const POSE_PRECISION: f64 = 1e-9;

/// Least number of residuals that a runs test judges.
const MIN_RESIDUALS: usize = 10;

/// Goodness of the residuals of one column.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnGoodness {
    /// Standard deviation of the noise in SI units; `None` if there are too few rows to estimate it.
    pub noise: Option<f64>,
    /// True if the noise is known to the caller.
    pub is_given: bool,
    /// Reduced χ² in units of the column's noise; `None` without noise.
    pub reduced: Option<f64>,
    /// Probability of as much or more; `None` without noise.
    pub chance: Option<f64>,
    /// Number of runs of residuals of one sign, expected number, and probability of as few; `None` for too few rows.
    pub runs: Option<(usize, f64, f64)>,
    /// True if residuals exceed half a step of rounding, and rounding of poses, so that their signs are significant.
    pub exceeds_rounding: bool,
}

/// Goodness of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Goodness {
    /// Goodness of each column.
    pub columns: Vec<ColumnGoodness>,
}

impl Goodness {
    pub(crate) fn of(
        measured: &Measurements,
        residuals: &[Vec<Option<f64>>],
        is_angle: &[bool],
        determined: usize,
    ) -> Goodness {
        let count: usize = residuals.iter().map(|it| it.iter().flatten().count()).sum();
        let share = 1.0 - determined as f64 / count.max(1) as f64;
        let columns = measured.columns.iter().zip(residuals).zip(is_angle);
        let columns = columns
            .map(|((own, left), is_angle)| column(own, &measured.times, left, *is_angle, share));
        Goodness {
            columns: columns.collect(),
        }
    }

    /// True if noise explains the residuals of a column; `None` if that cannot be judged.
    pub fn explains(&self, place: usize) -> Option<bool> {
        let column = &self.columns[place];
        let limit = 0.5 * CHANCE / self.columns.len() as f64;
        let chance = column.chance?;
        let runs = column.runs.filter(|_| column.exceeds_rounding);
        Some(chance >= limit && runs.is_none_or(|it| it.2 >= limit))
    }

    /// Probability of as much or more in all columns together, by Fisher's method (1932); `None` if no column can be
    /// judged.
    pub fn chance(&self) -> Option<f64> {
        let chances: Vec<f64> = self.columns.iter().filter_map(|it| it.chance).collect();
        (!chances.is_empty()).then(|| together(&chances))
    }

    /// True if noise explains all columns together, irrespective of each.
    pub fn explains_all(&self) -> bool {
        self.chance().is_none_or(|it| it >= 0.5 * CHANCE)
    }

    /// True if noise explains each column and all together.
    pub fn is_explained(&self) -> bool {
        let each = (0..self.columns.len()).all(|it| self.explains(it) != Some(false));
        each && self.explains_all()
    }

    /// True if at least one column can be judged.
    pub fn is_judged(&self) -> bool {
        self.columns.iter().any(|it| it.chance.is_some())
    }
}

/// Probability of a product of probabilities at most as large: −2 Σ ln p has a χ² distribution with two degrees of
/// freedom for each.
fn together(chances: &[f64]) -> f64 {
    let half: f64 = chances
        .iter()
        .map(|it| -it.max(f64::MIN_POSITIVE).ln())
        .sum();
    let (mut term, mut sum) = (1.0, 1.0);
    let mut place = 0.0;
    for _ in 1..chances.len() {
        place += 1.0;
        term *= half / place;
        sum += term;
    }
    (-half).exp() * sum
}

fn column(
    own: &Column,
    times: &[f64],
    left: &[Option<f64>],
    is_angle: bool,
    share: f64,
) -> ColumnGoodness {
    let squares: Vec<f64> = left.iter().flatten().map(|it| it * it).collect();
    let count = squares.len() as f64;
    let mean = squares.iter().sum::<f64>() / count.max(1.0);
    let rounding = own.rounding_deviation();
    let floor = rounding.max(POSE_PRECISION * extent(&own.values));
    let (noise, below) = match own.deviation {
        Some(deviation) => (Some(deviation.hypot(rounding)), KNOWN),
        None => {
            let values = unwrapped(&own.values, is_angle);
            let estimates = [between_rows(times, &values), between_rows(times, left)];
            let least = estimates
                .into_iter()
                .flatten()
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let rows = least.map_or(0, |it| it.1);
            let below = (rows as f64 / CORRELATED).max(1.0);
            (least.map(|it| it.0.sqrt().max(floor)), below)
        }
    };
    let above = count * share;
    let reduced = noise
        .filter(|_| above > 0.0)
        .map(|it| mean / share / (it * it));
    ColumnGoodness {
        noise,
        is_given: own.deviation.is_some(),
        reduced,
        chance: reduced.map(|it| exceeded(it, above, below)),
        runs: runs(left, floor),
        exceeds_rounding: mean.sqrt() > floor.max(own.rounding.unwrap_or(0.0) / 2.0),
    }
}

/// Range of values.
fn extent(values: &[Option<f64>]) -> f64 {
    let all = values.iter().flatten();
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
        (low.min(*it), high.max(*it))
    });
    (high - low).max(0.0)
}

/// Values of an angle without jumps by whole turns.
fn unwrapped(values: &[Option<f64>], is_angle: bool) -> Vec<Option<f64>> {
    let mut last = None;
    let next = |value: f64| {
        let continued = match last {
            Some(last) if is_angle => last + difference(value, last, true),
            _ => value,
        };
        last = Some(continued);
        continued
    };
    let mut next = next;
    values.iter().map(|it| it.map(&mut next)).collect()
}

/// Variance of rows about cubics through their neighbors, and number of these rows; `None` for fewer than five.
pub(crate) fn between_rows(times: &[f64], values: &[Option<f64>]) -> Option<(f64, usize)> {
    let mut rows: Vec<(f64, f64)> = Vec::with_capacity(times.len());
    for (t, value) in times.iter().zip(values) {
        if let Some(value) = value
            && rows.last().is_none_or(|it| it.0 < *t)
        {
            rows.push((*t, *value));
        }
    }
    let windows = rows.windows(2 * BESIDE + 1).map(|window| {
        let t = window[BESIDE].0;
        let others = || (0..window.len()).filter(|it| *it != BESIDE);
        let (mut predicted, mut square) = (0.0, 1.0);
        for own in others() {
            let weight: f64 = others()
                .filter(|it| *it != own)
                .map(|it| (t - window[it].0) / (window[own].0 - window[it].0))
                .product();
            predicted += weight * window[own].1;
            square += weight * weight;
        }
        (window[BESIDE].1 - predicted).powi(2) / square
    });
    let squares: Vec<f64> = windows.collect();
    let count = squares.len();
    (count > 0).then(|| (squares.iter().sum::<f64>() / count as f64, count))
}

/// Runs of one sign among residuals that exceed rounding of the computation; `None` for too few.
fn runs(left: &[Option<f64>], floor: f64) -> Option<(usize, f64, f64)> {
    let least = floor * POSE_PRECISION;
    let signs: Vec<bool> = left
        .iter()
        .flatten()
        .filter(|it| it.abs() > least)
        .map(|it| *it > 0.0)
        .collect();
    let count = signs.len() as f64;
    let above = signs.iter().filter(|it| **it).count() as f64;
    let below = count - above;
    if signs.len() < MIN_RESIDUALS {
        return None;
    }
    let run_count = 1 + signs.windows(2).filter(|it| it[0] != it[1]).count();
    let twice = 2.0 * above * below;
    let expected = 1.0 + twice / count;
    let variance = twice * (twice - count) / (count * count * (count - 1.0));
    if variance <= 0.0 {
        // All of one sign: half of each is expected.
        return Some((run_count, 1.0 + count / 2.0, 0.5_f64.powf(count - 1.0)));
    }
    // Continuity is corrected for by half a run; the lower tail of the normal distribution.
    let deviations = (run_count as f64 + 0.5 - expected) / variance.sqrt();
    let tail = 0.5 * exceeded(deviations * deviations, 1.0, KNOWN);
    let chance = if deviations < 0.0 { tail } else { 1.0 - tail };
    Some((run_count, expected, chance))
}

#[cfg(test)]
mod tests {
    use super::{between_rows, runs, together};

    #[test]
    fn cubics_leave_nothing_and_alternation_leaves_itself() {
        let times: Vec<f64> = (0..12)
            .map(|it| 0.1 * f64::from(it) + 0.01 * f64::from(it % 3))
            .collect();
        let cubic: Vec<Option<f64>> = times
            .iter()
            .map(|t| Some(1.0 + t - 3.0 * t * t * t))
            .collect();
        let (variance, rows) = between_rows(&times, &cubic).expect("rows");
        assert!(variance < 1e-28 && rows == 8, "{variance}");
        // White noise of variance 1 leaves 1; a sign that changes leaves (16/6)²·36/70 of the fourth difference.
        let even: Vec<f64> = (0..12).map(f64::from).collect();
        let signs: Vec<Option<f64>> = (0..12)
            .map(|it| Some(f64::from(1 - 2 * (it % 2))))
            .collect();
        let (variance, _) = between_rows(&even, &signs).expect("rows");
        assert!((variance - 256.0 / 70.0).abs() < 1e-12, "{variance}");
        assert_eq!(between_rows(&even[..4], &signs[..4]), None);
    }

    #[test]
    fn chances_are_combined_as_tables_of_chi_square_have_it() {
        // χ² with 4 degrees of freedom exceeds 9.4877 with a chance of 0.05.
        let each = (-9.4877_f64 / 4.0).exp();
        assert!((together(&[each, each]) - 0.05).abs() < 1e-5);
        assert!((together(&[0.3]) - 0.3).abs() < 1e-15);
    }

    /// 20 residuals of two runs: 10 and 10 have at most 6 runs with a chance of 0.019 (Swed and Eisenhart 1943).
    #[test]
    fn few_runs_are_a_surprise() {
        let left = |runs: &[i32]| -> Vec<Option<f64>> {
            let mut sign = 1.0;
            let mut all = Vec::new();
            for length in runs {
                all.extend((0..*length).map(|_| Some(sign)));
                sign = -sign;
            }
            all
        };
        let (found, expected, chance) = runs(&left(&[10, 10]), 0.0).expect("enough");
        assert_eq!((found, expected), (2, 11.0));
        assert!(chance < 1e-4, "{chance}");
        let (_, _, chance) = runs(&left(&[4, 3, 3, 4, 3, 3]), 0.0).expect("enough");
        assert!((0.015..0.023).contains(&chance), "{chance}");
        let (_, _, chance) = runs(&left(&[1; 20]), 0.0).expect("enough");
        assert!(chance > 0.999, "{chance}");
        assert_eq!(runs(&left(&[9]), 0.0), None);
    }
}
