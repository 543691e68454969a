//! The two-body mechanism of the ME 451 midterm against the exam's worked solution and a high-precision reference.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_4, FRAC_PI_6, PI};

use linkwright::generated::{Factorization, Scales};
use linkwright_tests::description;
use linkwright_tests::deviation::{deviations, worst};
use linkwright_tests::random::Random;
use linkwright_tests::solver::both;
use linkwright_tests::table::Table;
use nalgebra::{DMatrix, Dyn};

const NAME: &str = "two_body";

fn sqrt_3() -> f64 {
    3_f64.sqrt()
}

/// Pose of the exam's question 4.
fn initial_pose() -> [f64; 6] {
    [0.0, 0.0, FRAC_PI_6, sqrt_3(), 2.0, FRAC_PI_3]
}

fn determinant(matrix: &DMatrix<f64>) -> f64 {
    let scales = Scales::unit(Dyn(matrix.nrows()));
    Factorization::new(matrix, &scales, 0.0)
        .expect("a regular matrix")
        .determinant()
}

#[track_caller]
fn assert_close(what: &str, found: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    for (index, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        let error = (found - wanted).abs();
        assert!(
            error <= tolerance,
            "{what}[{index}]: {found} instead of {wanted}, {error:e}"
        );
    }
}

#[test]
fn the_answers_at_the_start_come_out() {
    for mut solver in both(NAME) {
        solver.assemble(0.0);
        let kind = solver.kind();
        let frame = solver.frame();
        assert_close(
            &format!("{kind} q"),
            frame.q.as_slice(),
            &initial_pose(),
            1e-14,
        );
        let rates = [0.0, 0.0, 2.0, 0.0, 2.0 * sqrt_3() / 3.0, -2.0 / 3.0];
        assert_close(&format!("{kind} qd"), frame.qd.as_slice(), &rates, 1e-14);
        let middle = solver.point("Q");
        let position = [3.0 * sqrt_3() / 4.0, 5.0 / 4.0];
        assert_close(
            &format!("{kind} position of Q"),
            &middle.position,
            &position,
            1e-14,
        );
        let velocity = [-0.5, 5.0 * sqrt_3() / 6.0];
        assert_close(
            &format!("{kind} velocity of Q"),
            &middle.velocity,
            &velocity,
            1e-14,
        );
    }
}

/// Matrix and right-hand side of the exam's question 6. The pose in floating-point numbers is the exam's to one
/// rounding of π/6, π/3 and √3, and so are the sines; everything else is exact.
#[test]
fn the_first_newton_step_at_t_0_01_is_the_printed_one() {
    let s = sqrt_3() / 2.0;
    #[rustfmt::skip]
    let printed = DMatrix::from_row_slice(6, 6, &[
        1.0, 0.0,  0.0,  0.0,  0.0,  0.0,
        0.0, 1.0,  0.0,  0.0,  0.0,  0.0,
        1.0, 0.0, -0.5, -1.0,  0.0, -1.5,
        0.0, 1.0,    s,  0.0, -1.0,    s,
        0.0, 0.0,  0.0,  1.0,  0.0,  0.0,
        0.0, 0.0,  1.0,  0.0,  0.0,  0.0,
    ]);
    for solver in both(NAME) {
        let kind = solver.kind();
        let step = solver.newton_step(&initial_pose(), 0.01);
        for (index, (found, wanted)) in step.jacobian.iter().zip(printed.iter()).enumerate() {
            let (row, column) = (index % 6, index / 6);
            // A unit in the last place of the largest entries with a sine or cosine; all others are exact.
            let tolerance = if wanted.abs() == 1.0 || *wanted == 0.0 {
                0.0
            } else {
                2.0 * f64::EPSILON
            };
            assert!(
                (found - wanted).abs() <= tolerance,
                "{kind} ({row}, {column}): {found} instead of {wanted}"
            );
        }
        let right_hand_side = [0.0, 0.0, 0.0, 0.0, 0.0, 0.02_f64.sin()];
        assert_close(
            kind,
            step.right_hand_side.as_slice(),
            &right_hand_side,
            2.0 * f64::EPSILON,
        );
        // Solved by hand: Δφ1 = sin 0.02, Δφ2 = -Δφ1/3, Δy2 = √3/2 (Δφ1 + Δφ2).
        let turn = 0.02_f64.sin();
        let update = [0.0, 0.0, turn, 0.0, s * (turn - turn / 3.0), -turn / 3.0];
        assert_close(kind, step.update.as_slice(), &update, 4.0 * f64::EPSILON);
    }
}

/// The printed Newton step with exact numbers: the pose is substituted into the equations symbolically.
#[test]
fn the_printed_newton_step_is_exact_in_the_equations() {
    let mut derived = description::system(NAME);
    let rows = derived.system.rows.clone();
    let symbols: Vec<_> = derived
        .system
        .coordinates
        .iter()
        .map(|coordinate| coordinate.position)
        .collect();
    let time = derived.system.mechanism.time;
    let graph = &mut derived.pool.graph;
    let fraction = |graph: &mut linkwright_codegen::stages::expr::Graph, part| {
        let (pi, part) = (graph.pi(), graph.rational(1, part));
        graph.multiply(pi, part)
    };
    let three = graph.integer(3);
    let root = graph.sqrt(three);
    let (zero, two) = (graph.zero(), graph.integer(2));
    let (sixth, third) = (fraction(graph, 6), fraction(graph, 3));
    let pose = [zero, zero, sixth, root, two, third];
    let mut place: Vec<_> = symbols.into_iter().zip(pose).collect();
    let instant = graph.rational(1, 100);
    place.push((time, instant));
    let half_root = {
        let half = graph.rational(1, 2);
        graph.multiply(root, half)
    };
    let (one, minus_one) = (graph.one(), graph.integer(-1));
    let (minus_half, minus_three_halves) = (graph.rational(-1, 2), graph.rational(-3, 2));
    let printed: [&[(usize, _)]; 6] = [
        &[(0, one)],
        &[(1, one)],
        &[
            (0, one),
            (2, minus_half),
            (3, minus_one),
            (5, minus_three_halves),
        ],
        &[(1, one), (2, half_root), (4, minus_one), (5, half_root)],
        &[(3, one)],
        &[(2, one)],
    ];
    let argument = graph.rational(1, 50);
    let sine = graph.sin(argument);
    let last = graph.negate(sine);
    for ((index, row), printed) in rows.iter().enumerate().zip(printed) {
        let entries: Vec<_> = row
            .jacobian
            .iter()
            .map(|entry| (entry.coordinate, graph.substitute(entry.value, &place)))
            .collect();
        assert_eq!(entries, printed, "row {index}");
        let residual = graph.substitute(row.residual, &place);
        assert_eq!(
            residual,
            if index == 5 { last } else { zero },
            "row {index}"
        );
    }
}

#[test]
fn the_determinant_is_the_root_of_3_times_the_sine_of_phi2() {
    let mut random = Random::new(1);
    let mut largest = 0.0_f64;
    let mut signs = Vec::new();
    let solvers = both(NAME);
    for _ in 0..1000 {
        let q: Vec<f64> = (0..6).map(|_| random.between(-PI, PI)).collect();
        for solver in &solvers {
            let computed = determinant(
                &solver
                    .functions(&q, &[0.0; 6], random.between(0.0, 5.0))
                    .phi_q,
            );
            let expected = sqrt_3() * q[5].sin();
            signs.push(computed.signum() == expected.signum());
            let error = (computed.abs() - expected.abs()).abs() / expected.abs();
            largest = largest.max(error);
            // One sine and one product on either side; every other pivot is ±1.
            assert!(
                error <= 2.0 * f64::EPSILON,
                "{}: {computed} instead of ±{expected}",
                solver.kind()
            );
        }
    }
    assert!(
        signs.iter().all(|sign| *sign == signs[0]),
        "the sign must be the same everywhere"
    );
    println!("largest relative error of the determinant: {largest:.1e}");
}

/// The driver repeats after π seconds. φ2 = 0, the singular pose, needs φ1 = π/2.
#[test]
fn the_singular_pose_is_never_reached() {
    let bound = FRAC_PI_6 + 1.0;
    assert!(bound < FRAC_PI_2);
    // cos φ2 = 1 - cos φ1 / √3, largest at the driver's turning point t = π/4.
    let smallest_possible = sqrt_3() * (1.0 - bound.cos() / sqrt_3()).acos().sin();
    for mut solver in both(NAME) {
        solver.assemble(0.0);
        let mut times: Vec<f64> = (0..=315).map(|step| f64::from(step) / 100.0).collect();
        times.push(FRAC_PI_4);
        times.sort_by(f64::total_cmp);
        let (mut highest, mut smallest) = (0.0_f64, f64::INFINITY);
        for t in times {
            solver.advance(t);
            let q = solver.frame().q.as_slice().to_vec();
            highest = highest.max(q[2]);
            smallest = smallest.min(determinant(&solver.functions(&q, &[0.0; 6], 0.0).phi_q).abs());
        }
        assert!(
            (highest - bound).abs() <= 2.0 * f64::EPSILON,
            "{}: {highest}",
            solver.kind()
        );
        let error = (smallest - smallest_possible).abs();
        assert!(
            error <= 1e-14,
            "{}: {smallest} instead of {smallest_possible}",
            solver.kind()
        );
        println!(
            "{}: largest φ1 = {highest}, smallest |det| = {smallest}",
            solver.kind()
        );
    }
}

#[test]
fn the_motion_agrees_with_the_reference_at_all_times() {
    let table = Table::read("exam.csv");
    for mut solver in both(NAME) {
        let deviations = deviations(&mut *solver, &table);
        let worst = worst(&deviations);
        println!(
            "{}: {worst:?}, relative {:.1e}",
            solver.kind(),
            worst.relative()
        );
        assert!(worst.relative() <= 1e-12, "{}: {worst:?}", solver.kind());
    }
}
