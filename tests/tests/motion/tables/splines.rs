//! Splines through given points against cubics, error bounds and differences.

use std::f64::consts::TAU;

use linkwright_tests::law::Law;
use linkwright_tests::random::Random;

use super::{UNEQUAL, close, table};

#[test]
fn a_cubic_with_its_slopes_at_the_ends_is_reproduced() {
    let cubic = |x: f64| {
        [
            1.0 + x * (-2.0 + x * (0.5 + x * 0.25)),
            -2.0 + x * (1.0 + x * 0.75),
            1.0 + 1.5 * x,
            1.5,
            0.0,
        ]
    };
    let places = [-1.0, 0.0, 0.5, 2.0, 3.0];
    let points = places.map(|x| [x, cubic(x)[0]]);
    let slopes = [-1.0, 3.0].map(|x| cubic(x)[1]);
    let motion = table(
        &points,
        &format!("clamped({:e}, {:e})", slopes[0], slopes[1]),
    );
    for step in 0..400 {
        let x = -1.0 + f64::from(step) / 100.0;
        for (order, (found, expected)) in motion.at(x).iter().zip(cubic(x)).enumerate() {
            close(*found, expected, 1e-13, &format!("order {order} at {x}"));
        }
    }
    // Outside, the tangent continues.
    for (end, x) in [(-1.0, -3.5), (3.0, 7.25)] {
        let [value, slope, ..] = cubic(end);
        let continued = motion.at(x);
        close(
            continued[0],
            value + slope * (x - end),
            1e-12,
            "a continuation",
        );
        close(continued[1], slope, 1e-13, "its slope");
        assert_eq!(continued[2..], [0.0; 3]);
    }
}

/// Samples of the sine over one turn, with this number of pieces.
fn sine(pieces: u32, ends: &str) -> (f64, Law) {
    let width = TAU / f64::from(pieces);
    let points: Vec<[f64; 2]> = (0..=pieces)
        .map(|place| {
            let x = width * f64::from(place);
            // The last sample is the first one, as a periodic table requires.
            [x, if place == pieces { 0.0 } else { x.sin() }]
        })
        .collect();
    (width, table(&points, ends))
}

#[test]
fn a_sampled_sine_is_met_to_the_order_of_truncation() {
    // Hall & Meyer, Optimal error bounds for cubic spline interpolation, J. Approx. Theory 16 (1976): with the slopes at the
    // ends the errors are at most c hᵏ max|f⁗|, and the first two constants cannot be improved.
    let bounds = [(5.0 / 384.0, 4), (1.0 / 24.0, 3), (3.0 / 8.0, 2)];
    let exact = |x: f64| [x.sin(), x.cos(), -x.sin()];
    for ends in ["clamped(1, 1)", "periodic"] {
        let mut errors = Vec::new();
        for pieces in [16, 32, 64] {
            let (width, motion) = sine(pieces, ends);
            let mut largest = [0.0_f64; 3];
            for step in 0..=4000 {
                let x = TAU * f64::from(step) / 4000.0;
                for (order, expected) in exact(x).iter().enumerate() {
                    let error = (motion.at(x)[order] - expected).abs();
                    largest[order] = largest[order].max(error);
                }
            }
            for (order, (constant, power)) in bounds.iter().enumerate() {
                let bound = constant * width.powi(*power);
                let error = largest[order];
                assert!(
                    error <= bound + 1e-14,
                    "{ends}, order {order}: {error:e}, {bound:e}"
                );
                assert!(
                    error >= 0.1 * bound,
                    "{ends}, order {order}: {error:e}, {bound:e}"
                );
            }
            errors.push(largest);
        }
        for pair in errors.windows(2) {
            for (order, power) in [4.0, 3.0, 2.0].iter().enumerate() {
                let order_of_convergence = (pair[0][order] / pair[1][order]).log2();
                close(
                    order_of_convergence,
                    *power,
                    0.1,
                    &format!("{ends}: the power of order {order}"),
                );
            }
        }
    }
}

#[test]
fn pieces_join_in_value_slope_and_curvature_but_not_beyond() {
    for (ends, [before, after]) in [
        ("", [-3.0, 6.5]),
        ("natural", [-3.0, 6.5]),
        ("clamped(2, -1)", [-3.0, 6.5]),
        ("periodic", [-4.5, 7.5]),
    ] {
        let motion = table(&UNEQUAL, ends);
        let mut jumps = 0;
        for (place, [x, y]) in UNEQUAL.into_iter().enumerate() {
            let [left, right] = [x.next_down(), x].map(|x| motion.at(x));
            close(right[0], y, 1e-14, "the value at a point");
            let is_end = place == 0 || place == UNEQUAL.len() - 1;
            // Beside clamped ends the table continues straight.
            let smooth = if is_end && ends.starts_with("clamped") {
                2
            } else {
                3
            };
            for order in 0..smooth {
                close(
                    left[order],
                    right[order],
                    1e-12,
                    &format!("{ends}, order {order} at {x}"),
                );
            }
            jumps += usize::from((left[3] - right[3]).abs() > 1.0);
        }
        assert!(
            jumps >= 4,
            "{ends}: the third derivative jumps {jumps} times"
        );
        if ends == "periodic" {
            continue;
        }
        let [first, last] = [before, after].map(|x| motion.at(x));
        assert_eq!([first[2], first[3], last[2], last[3]], [0.0; 4], "{ends}");
        let [start, end] = [UNEQUAL[0], UNEQUAL[5]];
        close(
            first[0],
            start[1] + first[1] * (before - start[0]),
            1e-12,
            "before",
        );
        close(last[0], end[1] + last[1] * (after - end[0]), 1e-12, "after");
        if ends.starts_with("clamped") {
            assert_eq!([first[1], last[1]], [2.0, -1.0]);
        } else {
            let [from, to] = [start[0], end[0]].map(|x| motion.at(x)[2]);
            assert_eq!([from, to], [0.0; 2]);
        }
    }
    // The default of `clamped` is rest.
    let resting = table(&UNEQUAL, "clamped");
    assert_eq!([resting.at(-7.0)[1], resting.at(9.0)[1]], [0.0; 2]);
}

#[test]
fn few_points_give_what_they_must() {
    let line = table(&[[1.0, 2.0], [3.0, 8.0]], "");
    for x in [-4.0, 1.0, 1.5, 3.0, 10.0] {
        assert_eq!(line.at(x), [2.0 + 3.0 * (x - 1.0), 3.0, 0.0, 0.0, 0.0]);
    }
    // Hermite: 3 s² − 2 s³.
    let rise = table(&[[0.0, 0.0], [1.0, 1.0]], "clamped");
    for s in [0.0, 0.25, 0.5, 0.875_f64] {
        close(rise.at(s)[0], s * s * (3.0 - 2.0 * s), 1e-15, "a rise");
    }
    // Two pieces of one period, by symmetry 1 − 6 s² + 4 s³ up to half a period.
    let wave = table(&[[0.0, 1.0], [1.0, -1.0], [2.0, 1.0]], "periodic");
    for s in [0.0, 0.25, 0.5, 1.0_f64] {
        let expected = 1.0 - 6.0 * s * s + 4.0 * s.powi(3);
        close(wave.at(s)[0], expected, 1e-14, "a wave");
        close(wave.at(2.0 - s)[0], expected, 1e-14, "its other half");
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let statement = "table f = [(-0.5, 0.25), (0.25, 1.5), (1, -0.75), (1.125, -0.5), (2.5, 3), (3.5, 0.25)] periodic;";
    let inner = |t: f64| 1.5 * t + 0.3 * t.sin();
    let motion = Law::with(statement, "f(1.5*t + 0.3*sin(t))*cos(t)");
    let (mut random, step, mut compared) = (Random::new(3), 1e-3, 0);
    for _ in 0..2000 {
        let t = random.between(-6.0, 6.0);
        // Across a point of the table the third derivative jumps, and a difference of the second is meaningless.
        let piece = |t: f64| {
            let place = (inner(t) + 0.5).rem_euclid(4.0) - 0.5;
            UNEQUAL.iter().filter(|point| point[0] <= place).count()
        };
        if piece(t - 2.0 * step) != piece(t + 2.0 * step) {
            continue;
        }
        compared += 1;
        let stencil = [-2.0, -1.0, 1.0, 2.0].map(|side| motion.at(t + side * step));
        let here = motion.at(t);
        for order in 0..3 {
            let [a, b, c, d] = stencil.map(|it| it[order]);
            let quotient = (a - 8.0 * b + 8.0 * c - d) / (12.0 * step);
            let scale = 1.0 + here[order + 1].abs();
            close(
                quotient,
                here[order + 1],
                1e-8 * scale,
                &format!("order {order} at {t}"),
            );
        }
    }
    assert!(compared > 1500, "{compared}");
}
