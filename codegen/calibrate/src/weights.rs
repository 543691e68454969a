//! Standard deviations of measured columns: known ones, or those of a fit's residuals in all columns of a group.

use crate::Measurements;
use crate::model::Sampled;

/// Least standard deviation of a group, relative to its range: an exact fit leaves rounding.
const MIN_DEVIATION: f64 = 1e-14;

/// Indices of the columns in a group without known deviations.
fn group(measured: &Measurements, group: usize) -> impl Iterator<Item = usize> + '_ {
    let columns = measured.columns.iter().enumerate();
    columns
        .filter(move |(_, it)| it.group == group && it.deviation.is_none())
        .map(|(place, _)| place)
}

fn groups(measured: &Measurements) -> Vec<usize> {
    let unknown = measured.columns.iter().filter(|it| it.deviation.is_none());
    let mut groups: Vec<usize> = unknown.map(|it| it.group).collect();
    groups.sort_unstable();
    groups.dedup();
    groups
}

/// Number of classes with separate weights: groups of unknown deviations, and if there are any, one of known
/// deviations.
pub(crate) fn unknown_groups(measured: &Measurements) -> usize {
    let unknown = groups(measured).len();
    let is_known = measured.columns.iter().any(|it| it.deviation.is_some());
    unknown + usize::from(is_known && unknown > 0)
}

/// Range of the values of some columns.
fn extent(measured: &Measurements, columns: impl Iterator<Item = usize>) -> f64 {
    let ranges = columns.map(|column| {
        let values = measured.columns[column].values.iter().flatten();
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
            (low.min(*it), high.max(*it))
        });
        high - low
    });
    let extent = ranges.fold(0.0, f64::max);
    if extent > 0.0 { extent } else { 1.0 }
}

/// Initial deviations: the known ones, and the range of motion for the other groups.
pub(crate) fn initial(measured: &Measurements) -> Vec<f64> {
    let columns = measured.columns.iter();
    let deviation = |own: &crate::Column| match own.deviation {
        Some(deviation) => deviation.hypot(own.rounding_deviation()),
        None => extent(measured, group(measured, own.group)),
    };
    columns.map(deviation).collect()
}

/// Root of the mean square of some columns' residuals over their degrees of freedom.
fn left(sampled: &Sampled, columns: &[usize], share: f64) -> f64 {
    let residuals = columns
        .iter()
        .flat_map(|it| sampled.residuals[*it].iter().flatten());
    let (count, square) = residuals.fold((0, 0.0), |(count, square), it| {
        (count + 1, square + it * it)
    });
    let freedom = f64::from(count) * share;
    if freedom > 0.0 {
        (square / freedom).sqrt()
    } else {
        0.0
    }
}

/// Sets the deviations of groups to those of a fit's residuals; each group pays for parameters by its share of the
/// values.
pub(crate) fn improve(
    deviations: &mut [f64],
    measured: &Measurements,
    sampled: &Sampled,
    parameters: usize,
) {
    let all = measured.columns.iter().flat_map(|it| &it.values);
    let count = all.filter(|it| it.is_some()).count();
    let share = (count.saturating_sub(parameters)).max(1) as f64 / count.max(1) as f64;
    for own in groups(measured) {
        let columns: Vec<usize> = group(measured, own).collect();
        let least = MIN_DEVIATION * extent(measured, columns.iter().copied());
        let deviation = left(sampled, &columns, share).max(least);
        for column in columns {
            deviations[column] = deviation;
        }
    }
}

/// Variance of the minimized residuals.
pub(crate) struct Scale {
    /// Variance in squares of the deviations.
    pub variance: f64,
    /// True if all deviations are known.
    pub is_known: bool,
}

/// Variance of the minimized residuals: one if all deviations are known, otherwise from the residuals, and at least
/// that of rounding. In the latter case, the deviations of columns are scaled with it.
pub(crate) fn scale(
    measured: &Measurements,
    sampled: &Sampled,
    deviations: &mut [f64],
    freedom: usize,
) -> Scale {
    if groups(measured).is_empty() || freedom == 0 {
        return Scale {
            variance: 1.0,
            is_known: groups(measured).is_empty(),
        };
    }
    let columns = sampled.residuals.iter().zip(&*deviations);
    let squares = columns.flat_map(|(column, deviation)| {
        column
            .iter()
            .flatten()
            .map(move |it| (it / deviation).powi(2))
    });
    let left = squares.sum::<f64>() / freedom as f64;
    let columns = measured.columns.iter().zip(&*deviations);
    let rounding =
        columns.map(|(column, deviation)| (column.rounding_deviation() / deviation).powi(2));
    let variance = rounding.fold(left, f64::max);
    for (deviation, column) in deviations.iter_mut().zip(&measured.columns) {
        if column.deviation.is_none() {
            *deviation *= variance.sqrt();
        }
    }
    Scale {
        variance,
        is_known: false,
    }
}
