//! Tables: the spline through given points against closed forms, and the generated code against the interpreter.

mod mechanisms;
mod periodic;
mod splines;

use linkwright_tests::law::Law;

fn close(found: f64, expected: f64, bound: f64, what: &str) {
    assert!(
        (found - expected).abs() <= bound,
        "{what}: {found} instead of {expected}"
    );
}

/// Table as a function of t.
fn table(points: &[[f64; 2]], ends: &str) -> Law {
    let points: Vec<String> = points
        .iter()
        .map(|[x, y]| format!("({x:e}, {y:e})"))
        .collect();
    let statement = format!("table f = [{}] {ends};", points.join(", "));
    Law::with(&statement, "f(t)")
}

/// Points at unequal distances, with equal first and last values.
const UNEQUAL: [[f64; 2]; 6] = [
    [-0.5, 0.25],
    [0.25, 1.5],
    [1.0, -0.75],
    [1.125, -0.5],
    [2.5, 3.0],
    [3.5, 0.25],
];
