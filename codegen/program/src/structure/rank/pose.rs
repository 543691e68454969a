//! Rows and a pose near by → a pose in which they hold.
//!
//! Levenberg and Marquardt, with a damping that shrinks with the residual: it converges quadratically also where the solutions
//! are not isolated or the rows repeat one another (Yamashita and Fukushima, On the rate of convergence of the Levenberg-Marquardt
//! method, Computing Suppl. 15 (2001)). Where the rows cannot hold, the pose is one in which they miss the least near by.

use super::functions::{Functions, Pose, spread};
use super::independence::norm;
use super::least_squares::damped;
use crate::system::System;

/// At which times the poses are, in s, and how far the drivers and the estimates are off the drawing in each. The first is the
/// drawing itself; the others are as far off as its accuracy forgives, and in no ratio to one another.
const POSES: [(f64, f64); 6] = [
    (0.0, 0.0),
    (0.0, 0.031),
    (0.0, -0.043),
    (0.113, 0.017),
    (0.271, -0.023),
    (0.0, 0.173),
];

/// How many poses are tried.
pub(super) const COUNT: usize = POSES.len();

/// How far a residual may be off, in characteristic lengths or rad, where the rows hold.
pub(super) const HOLDS: f64 = 1e-9;

/// The most steps of one search.
const STEPS: usize = 60;

/// The smallest size of a row that is measured by it.
const SMALLEST_ROW: f64 = 1e-6;

/// A residual, or a step, below this is rounding: no search goes on.
const ROUNDING: f64 = 1e-15;

/// The damping at first, at least and at most, relative to the residual.
const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-6;
const LARGEST_DAMPING: f64 = 1e6;

/// The longest step, in characteristic lengths or rad: a longer one leads to another assembly.
const LONGEST_STEP: f64 = 0.5;

/// Where the search for the pose with this number starts.
pub(super) fn start(system: &System, number: usize) -> Pose {
    let (time, off) = POSES[number % COUNT];
    let graph = &system.mechanism.graph;
    let mut symbols = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut symbols);
    symbols[system.mechanism.time.index()] = time;
    for input in &system.mechanism.inputs {
        let initial = graph.constant_value(input.initial).unwrap_or(f64::NAN);
        symbols[input.symbols[0].index()] = initial;
    }
    let length = system.characteristic_length();
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

/// Looks for a pose in which the rows hold, and says how far they are off there: the largest dimensionless residual.
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
        let found = functions.residuals(pose);
        let next_size = norm(&weighted(&found));
        if next_size < size {
            (residuals, size) = (found, next_size);
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
