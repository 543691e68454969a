//! Finds a pose near a given one in which rows hold.
//!
//! Levenberg-Marquardt steps have a damping that decreases with the residual. They converge quadratically even if solutions are
//! not isolated or rows repeat one another (Yamashita and Fukushima, On the rate of convergence of the Levenberg-Marquardt
//! method, Computing Suppl. 15 (2001)). For inconsistent rows, the pose is a local minimum of the residual.

use super::functions::{Functions, Pose, spread};
use super::independence::norm;
use super::least_squares::damped;
use crate::pool::Pool;
use crate::system::System;

/// Times of the poses, in s, and distances of drivers and estimates from the design configuration. The first pose is the design
/// configuration itself. The others are within its accuracy, and their distances have no simple ratio.
const POSES: [(f64, f64); 6] = [
    (0.0, 0.0),
    (0.0, 0.031),
    (0.0, -0.043),
    (0.113, 0.017),
    (0.271, -0.023),
    (0.0, 0.173),
];

/// Number of poses.
pub(super) const COUNT: usize = POSES.len();

/// Largest residual of rows that hold, in characteristic lengths or rad.
pub(super) const HOLDS: f64 = 1e-9;

/// Largest number of steps of a search.
const STEPS: usize = 60;

/// Smallest magnitude of a row by which the row is scaled.
const SMALLEST_ROW: f64 = 1e-6;

/// Largest residual or step that counts as rounding and ends a search.
const ROUNDING: f64 = 1e-15;

/// Damping at first, relative to the residual.
const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-6;
const LARGEST_DAMPING: f64 = 1e6;

/// Longest step, in characteristic lengths or rad: a longer one leads to another assembly.
const LONGEST_STEP: f64 = 0.5;

/// Returns the start of the search for the pose with this number.
pub(super) fn start(pool: &Pool, system: &System, number: usize) -> Pose {
    let (time, off) = POSES[number % COUNT];
    let graph = &pool.graph;
    let mut symbols = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut symbols);
    symbols[system.mechanism.time.index()] = time;
    for input in &system.mechanism.inputs {
        let initial = graph.constant_value(input.initial).unwrap_or(f64::NAN);
        symbols[input.symbols[0].index()] = initial;
    }
    let length = system.characteristic_length(pool);
    for (index, coordinate) in system.coordinates.iter().enumerate() {
        let drawn = graph.constant_value(coordinate.estimate);
        let scale = length.powi(coordinate.quantity.power_of_length());
        let shaken = off * spread(index, number) * scale;
        symbols[coordinate.position.index()] = drawn.unwrap_or(f64::NAN) + shaken;
    }
    Pose {
        symbols,
        shift: off,
    }
}

/// Searches a pose in which the rows hold, and returns the largest dimensionless residual there.
pub(super) fn project(functions: &Functions<'_>, pose: &mut Pose) -> f64 {
    let mut residuals = functions.residuals(pose);
    let weights: Vec<f64> = functions
        .jacobian(pose)
        .iter()
        .map(|row| match norm(row) {
            size if size > SMALLEST_ROW && size.is_finite() => 1.0 / size,
            _ => 1.0,
        })
        .collect();
    let weighted =
        |values: &[f64]| -> Vec<f64> { values.iter().zip(&weights).map(|(a, b)| a * b).collect() };
    let mut size = norm(&weighted(&residuals));
    let mut coordinates = functions.coordinates(pose);
    let rest = vec![0.0; coordinates.len()];
    let mut factor = FIRST_DAMPING;
    for _ in 0..STEPS {
        if !(size.is_finite() && size > ROUNDING) {
            break;
        }
        let mut rows = functions.jacobian(pose);
        for (row, weight) in rows.iter_mut().zip(&weights) {
            row.iter_mut().for_each(|entry| *entry *= weight);
        }
        let right: Vec<f64> = weighted(&residuals).iter().map(|value| -value).collect();
        let mut step = damped(&rows, &right, factor * size.min(1.0));
        let length = norm(&step);
        if !length.is_finite() {
            break;
        }
        if length > LONGEST_STEP {
            step.iter_mut().for_each(|by| *by *= LONGEST_STEP / length);
        }
        functions.place(pose, &coordinates, &step);
        let trial_residuals = functions.residuals(pose);
        let next_size = norm(&weighted(&trial_residuals));
        if next_size < size {
            (residuals, size) = (trial_residuals, next_size);
            coordinates = functions.coordinates(pose);
            factor = (factor * 0.1).max(LEAST_DAMPING);
            continue;
        }
        functions.place(pose, &coordinates, &rest);
        if factor > LARGEST_DAMPING || length < ROUNDING {
            break;
        }
        factor *= 10.0;
    }
    let largest = residuals
        .iter()
        .zip(&weights)
        .fold(0.0_f64, |most, (value, weight)| {
            let off = (value * weight.min(1.0)).abs();
            if off.is_nan() {
                f64::INFINITY
            } else {
                most.max(off)
            }
        });
    if size.is_finite() {
        largest
    } else {
        f64::INFINITY
    }
}
