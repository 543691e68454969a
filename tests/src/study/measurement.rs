//! *A mechanism with a reference* → *error and time per frame of each method*.

use std::time::Instant;

use crate::method::{Method, methods};
use crate::reference::{reference, yardsticks};
use crate::table::Table;

/// The frames of a sweep: 0 to 5 s by 0.01 s.
const FRAMES: usize = 501;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// How often each method is timed; the median counts.
    pub repeats: usize,
    /// The shortest time (s) over which a repeat is measured, in whole sweeps.
    pub shortest: f64,
}

impl Effort {
    /// Sweeps of a method in a repeat, by the time (s) that one takes; that is not asked where one is enough.
    fn sweeps(&self, once: impl FnOnce() -> f64) -> usize {
        if self.shortest == 0.0 {
            return 1;
        }
        ((self.shortest / once()).ceil() as usize).max(1)
    }
}

/// One method on one mechanism.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The family of the method.
    pub family: String,
    /// The setting of the method.
    pub setting: String,
    /// Family and setting.
    pub name: String,
    /// `f64` or `f32`.
    pub scalar: &'static str,
    /// The largest relative error of positions, velocities and accelerations.
    pub errors: [f64; 3],
    /// The median time per frame (ns).
    pub time: f64,
    /// The fastest and slowest repeat (ns per frame).
    pub range: [f64; 2],
}

/// Measures all methods of a mechanism, the baseline first. `progress` hears what is done.
///
/// Repeats go round the methods, so that what else the machine does meets all of them alike.
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
    let mut found: Vec<Vec<f64>> = vec![Vec::new(); methods.len()];
    for repeat in 0..effort.repeats {
        progress(&format!("repeat {} of {}", repeat + 1, effort.repeats));
        for ((method, &sweeps), found) in methods.iter_mut().zip(&sweeps).zip(&mut found) {
            let taken = seconds(&mut **method, &times, sweeps);
            found.push(taken * 1e9 / (sweeps * FRAMES) as f64);
        }
    }
    methods
        .iter()
        .zip(errors)
        .zip(found)
        .map(|((method, errors), mut found)| {
            found.sort_by(f64::total_cmp);
            Measurement {
                family: method.family().to_string(),
                setting: method.setting().to_string(),
                name: method.name(),
                scalar: method.scalar(),
                errors,
                time: median(&found),
                range: [found[0], found[found.len() - 1]],
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

/// Of sorted values.
pub(super) fn median(sorted: &[f64]) -> f64 {
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 {
        sorted[middle]
    } else {
        0.5 * (sorted[middle - 1] + sorted[middle])
    }
}

/// The largest error of each level at the times of the reference, in the largest magnitude of its column.
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
