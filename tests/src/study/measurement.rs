//! Measures error and time per frame of each method on mechanisms with a reference.

use std::time::Instant;

use crate::method::{Method, methods};
use crate::reference::{reference, yardsticks};
use crate::table::Table;

/// Number of frames of a sweep: 0 to 5 s by 0.01 s.
const FRAMES: usize = 501;

/// Extent of a measurement.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Number of timed repeats of each method; the median counts.
    pub repeats: usize,
    /// Shortest time (s) over which a repeat is measured, in whole sweeps.
    pub shortest: f64,
}

impl Effort {
    /// Sweeps of a method in a repeat, by the time (s) of one, which is not measured if one is enough.
    fn sweeps(&self, once: impl FnOnce() -> f64) -> usize {
        if self.shortest == 0.0 {
            return 1;
        }
        ((self.shortest / once()).ceil() as usize).max(1)
    }
}

/// Method on a mechanism.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// Family of the method.
    pub family: String,
    /// Setting of the method.
    pub setting: String,
    /// Family and setting.
    pub name: String,
    /// `f64` or `f32`.
    pub scalar: &'static str,
    /// Largest relative error of positions, velocities and accelerations.
    pub errors: [f64; 3],
    /// Median time per frame (ns).
    pub time: f64,
    /// Fastest and slowest repeat (ns per frame).
    pub range: [f64; 2],
}

/// Measures all methods of a mechanism, the baseline first. `progress` is called with each step.
///
/// Repeats alternate between the methods, so that other work of the machine affects all of them alike.
///
/// # Panics
/// If a method fails: the motions of the repository exist.
pub fn measure(
    mechanism: &str,
    effort: Effort,
    mut progress: impl FnMut(&str),
) -> Vec<Measurement> {
    let table = reference(mechanism);
    let times: Vec<f64> = (0..FRAMES).map(|frame| frame as f64 / 100.0).collect();
    let mut methods = methods(mechanism);
    let errors: Vec<[f64; 3]> = methods
        .iter_mut()
        .map(|method| errors(&mut **method, &times, &table))
        .collect();
    let sweeps: Vec<usize> = methods
        .iter_mut()
        .map(|method| effort.sweeps(|| seconds(&mut **method, &times, 1)))
        .collect();
    let mut times_per_method: Vec<Vec<f64>> = vec![Vec::new(); methods.len()];
    for repeat in 0..effort.repeats {
        progress(&format!("repeat {} of {}", repeat + 1, effort.repeats));
        for ((method, &sweeps), times_per_method) in
            methods.iter_mut().zip(&sweeps).zip(&mut times_per_method)
        {
            let taken = seconds(&mut **method, &times, sweeps);
            times_per_method.push(taken * 1e9 / (sweeps * FRAMES) as f64);
        }
    }
    methods
        .iter()
        .zip(errors)
        .zip(times_per_method)
        .map(|((method, errors), mut times_per_method)| {
            times_per_method.sort_by(f64::total_cmp);
            Measurement {
                family: method.family().to_string(),
                setting: method.setting().to_string(),
                name: method.name(),
                scalar: method.scalar(),
                errors,
                time: median(&times_per_method),
                range: [
                    times_per_method[0],
                    times_per_method[times_per_method.len() - 1],
                ],
            }
        })
        .collect()
}

fn seconds(method: &mut dyn Method, times: &[f64], sweeps: usize) -> f64 {
    let start = Instant::now();
    for _ in 0..sweeps {
        method.sweep(times);
    }
    start.elapsed().as_secs_f64()
}

/// Median of sorted values.
pub(super) fn median(sorted: &[f64]) -> f64 {
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 {
        sorted[middle]
    } else {
        0.5 * (sorted[middle - 1] + sorted[middle])
    }
}

/// Largest error of each level at the times of the reference, relative to the largest magnitude of its column.
fn errors(method: &mut dyn Method, times: &[f64], table: &Table) -> [f64; 3] {
    let indices: Vec<usize> = table
        .rows
        .iter()
        .map(|row| (row[0] * 100.0).round() as usize)
        .collect();
    let yardsticks = yardsticks(table);
    let records = method.record(times, &indices);
    assert_eq!(
        records.len(),
        table.rows.len(),
        "a record per row of the reference"
    );
    let mut errors = [0.0_f64; 3];
    for (levels, row) in records.iter().zip(&table.rows) {
        let mut columns = row[1..].iter().zip(&yardsticks);
        for (level, error) in levels.iter().zip(&mut errors) {
            for (found, (wanted, yardstick)) in level.iter().zip(&mut columns) {
                *error = error.max((found - wanted).abs() / yardstick);
            }
        }
        assert!(columns.next().is_none(), "a value for each column");
    }
    errors
}
