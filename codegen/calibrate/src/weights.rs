//! *Measured columns* → *the standard deviation of each*: as it is known, or from what a fit leaves of all columns of a group.

use crate::Measurements;
use crate::model::Sampled;

/// The least standard deviation of a group, as a share of how much it moves: what fits exactly has rounding left.
const EXACT: f64 = 1e-14;

/// Of which columns a group consists whose deviation is not known.
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

/// How many things have to be weighed against one another: groups whose deviations are unknown, beside what is known.
pub(crate) fn unknown_groups(measured: &Measurements) -> usize {
    let unknown = groups(measured).len();
    let is_known = measured.columns.iter().any(|it| it.deviation.is_some());
    unknown + usize::from(is_known && unknown > 0)
}

/// The range of the values of some columns.
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

/// Before anything is fitted: what is known, and of the other groups how far they move.
pub(crate) fn initial(measured: &Measurements) -> Vec<f64> {
    let columns = measured.columns.iter();
    let deviation = |own: &crate::Column| match own.deviation {
        Some(deviation) => deviation.hypot(own.rounding_deviation()),
        None => extent(measured, group(measured, own.group)),
    };
    columns.map(deviation).collect()
}

/// The root of what is left of some columns, over how many values are left over.
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

/// Sets the deviations of groups to what a fit has left of them; each pays for parameters by its share of the values.
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
        let least = EXACT * extent(measured, columns.iter().copied());
        let found = left(sampled, &columns, share).max(least);
        for column in columns {
            deviations[column] = found;
        }
    }
}

/// The variance of what was minimized.
pub(crate) struct Scale {
    /// In squares of the deviations.
    pub variance: f64,
    /// True if all deviations are known.
    pub is_known: bool,
}

/// The variance of what was minimized: one where all deviations are known, otherwise from what is left, and never less than rounding
/// makes. The deviations of columns are then those, too.
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
    let own = measured.columns.iter().zip(&*deviations);
    let rounding = own.map(|(own, deviation)| (own.rounding_deviation() / deviation).powi(2));
    let variance = rounding.fold(left, f64::max);
    for (deviation, own) in deviations.iter_mut().zip(&measured.columns) {
        if own.deviation.is_none() {
            *deviation *= variance.sqrt();
        }
    }
    Scale {
        variance,
        is_known: false,
    }
}
