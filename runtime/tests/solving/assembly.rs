//! Assembly from poor estimates at which plain Newton-Raphson fails: on the requested branch, with bounded work.

use std::f64::consts::{PI, TAU};

use crate::counted::Counted;
use crate::single::{Single, single};
use crate::turning::{Turning, closed_form};
use linkwright::generated::{
    damped::{SHORTENINGS, solve_damped},
    least_squares::{STEPS, approach},
    newton,
};
use linkwright::nalgebra::SVector;
use linkwright::{Branch, Equations, FailureKind, Frame, Settings};

/// A reproducible sequence of numbers in [-1, 1) (xorshift64*, Vigna 2016).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn arctangent() -> Single {
    single(f64::atan, |x| 1.0 / (1.0 + x * x))
}

#[test]
fn damped_steps_reach_what_full_steps_run_away_from() {
    let settings = Settings::default();
    for start in [1.5, -3.0, 10.0, 40.0] {
        let mut q = SVector::<f64, 1>::new(start);
        let failure = newton::solve(&arctangent(), &mut q, 0.0, &settings).expect_err("diverges");
        assert_eq!(failure.kind, FailureKind::Diverged, "{start}");
        let convergence = solve_damped(&arctangent(), &mut q, 0.0, &settings).expect("converges");
        assert!(q[0].abs() <= f64::EPSILON, "{start}: {}", q[0]);
        assert!(convergence.iterations <= 12, "{start}: {convergence:?}");
    }
}

#[test]
fn least_squares_and_all_together_reach_it_too() {
    for start in [1.5, -3.0, 10.0] {
        let estimate = SVector::<f64, 1>::new(start);
        let mut q = estimate;
        assert!(approach(&arctangent(), &mut q, 0.0), "{start}: {}", q[0]);
        assert!(q[0].abs() <= 1e-4);
        let settings = Settings::default();
        let frame =
            Frame::assemble_from_rough_estimate(&arctangent(), &estimate, None, 0.0, &settings)
                .expect("near");
        assert!(frame.q[0].abs() <= f64::EPSILON, "{start}: {}", frame.q[0]);
    }
}

#[test]
fn damped_steps_from_a_good_estimate_are_the_plain_ones() {
    let settings = Settings::default();
    let start = closed_form(0.3, 1.0).add_scalar(0.01);
    let (mut plain, mut damped) = (start, start);
    let expected = newton::solve(&Turning, &mut plain, 0.3, &settings).expect("near");
    let damped_convergence = solve_damped(&Turning, &mut damped, 0.3, &settings).expect("near");
    assert_eq!((plain, expected), (damped, damped_convergence));
}

#[test]
fn an_equation_without_solution_fails_and_leaves_the_pose() {
    let settings = Settings::default();
    let none = single(|x| x * x + 1.0, |x| 2.0 * x);
    for start in [2.0, 0.3, 1.0 / 3.0_f64.sqrt()] {
        let mut q = SVector::<f64, 1>::new(start);
        let failure = solve_damped(&none, &mut q, 0.25, &settings).expect_err("no solution");
        assert_eq!(q[0].to_bits(), start.to_bits());
        // The point nearest to a solution is the stationary one: steps towards it become too short, or it is met.
        let stationary = matches!(
            failure.kind,
            FailureKind::Stalled | FailureKind::Singular { .. }
        );
        assert!(stationary && failure.residual >= 1.0, "{start}: {failure}");
        let estimate = SVector::<f64, 1>::new(start);
        let branch = Some(Branch::Positive);
        assert!(
            Frame::assemble_from_rough_estimate(&none, &estimate, branch, 0.25, &settings).is_err()
        );
    }
    // No method can start from a stationary point.
    let parabola = single(|x| x * x - 1.0, |x| 2.0 * x);
    let estimate = SVector::<f64, 1>::new(0.0);
    let failure = Frame::assemble_from_rough_estimate(&parabola, &estimate, None, 0.0, &settings)
        .expect_err("stationary");
    assert!(matches!(failure.kind, FailureKind::Singular { .. }));
    for start in [f64::NAN, f64::INFINITY] {
        let mut q = SVector::<f64, 1>::new(start);
        let failure = solve_damped(&parabola, &mut q, 0.0, &settings).expect_err("no number");
        assert_eq!(failure.kind, FailureKind::NotFinite);
        let failure = Frame::assemble_from_rough_estimate(&parabola, &q, None, 0.0, &settings)
            .expect_err("no number");
        assert_eq!(failure.kind, FailureKind::NotFinite);
    }
}

#[test]
fn another_root_is_the_wrong_branch() {
    let parabola = single(|x| x * x - 1.0, |x| 2.0 * x);
    let settings = Settings::default();
    for (start, near, far) in [
        (3.0, Branch::Positive, Branch::Negative),
        (-0.5, Branch::Negative, Branch::Positive),
    ] {
        let estimate = SVector::<f64, 1>::new(start);
        let frame =
            Frame::assemble_from_rough_estimate(&parabola, &estimate, Some(near), 0.0, &settings)
                .expect("the near root");
        assert_eq!(frame.q[0], near.sign::<f64>());
        let failure =
            Frame::assemble_from_rough_estimate(&parabola, &estimate, Some(far), 0.0, &settings)
                .expect_err("the far root");
        assert_eq!(failure.kind, FailureKind::WrongBranch);
        assert!(failure.residual <= 1e-12, "it is a root: {failure}");
    }
}

/// The exam's mechanism from 10,000 starts around its pose, in either scalar; returns how many assembled.
fn perturbed_starts(reach: f64) -> (u32, u32, u32) {
    let settings = Settings::default();
    let truth = closed_form(0.3, 1.0);
    let branch = Frame::branch_of(&Turning, &truth, 0.3, &settings).expect("regular");
    let mut sequence = Sequence(99);
    let (mut from_rough_estimate, mut plain, mut other) = (0, 0, 0);
    for _ in 0..10_000 {
        let start = truth.map(|x| x + reach * sequence.next());
        match Frame::assemble_from_rough_estimate(&Turning, &start, Some(branch), 0.3, &settings) {
            Ok(frame) => {
                // This branch has one pose, up to whole turns of the rod.
                let mut difference = frame.q - truth;
                difference[5] -= TAU * (difference[5] / TAU).round();
                assert!(difference.amax() <= 1e-13, "{difference}");
                from_rough_estimate += 1;
            }
            Err(failure) => {
                assert_eq!(failure.kind, FailureKind::WrongBranch, "{failure}");
                other += 1;
            }
        }
        let newton = Frame::assemble(&Turning, &start, 0.3, &settings);
        let right = newton.is_ok_and(|frame| frame.q[5].rem_euclid(TAU) < PI);
        plain += u32::from(right);
    }
    assert_eq!(from_rough_estimate + other, 10_000);
    (from_rough_estimate, plain, other)
}

#[test]
fn half_a_radian_and_half_a_link_are_near_enough() {
    let (from_rough_estimate, _, _) = perturbed_starts(0.5);
    assert_eq!(from_rough_estimate, 10_000);
}

#[test]
fn from_farther_away_more_assemble_than_by_newton_raphson_and_the_others_are_named() {
    let (from_rough_estimate, plain, _) = perturbed_starts(1.5);
    assert!(
        from_rough_estimate >= plain && from_rough_estimate >= 8_000,
        "{from_rough_estimate} {plain}"
    );
}

#[test]
fn single_precision_assembles_too() {
    let settings = Settings::<f32>::default();
    let truth = closed_form(0.3, 1.0);
    let mut sequence = Sequence(7);
    for _ in 0..1000 {
        let start = truth.map(|x| (x + 0.5 * sequence.next()) as f32);
        let frame = Frame::assemble_from_rough_estimate(&Turning, &start, None, 0.3, &settings)
            .expect("near");
        let error = (frame.q.map(f64::from) - truth).amax();
        assert!(error <= 4e-6, "{error:e}");
    }
}

/// Requests the work of every function and compares it with the function's documentation.
fn work_is_bounded<E: Equations<f64, D>, D: linkwright::nalgebra::DimName>(
    equations: E,
    starts: &[linkwright::nalgebra::OVector<f64, D>],
) where
    linkwright::nalgebra::DefaultAllocator: linkwright::nalgebra::allocator::Allocator<D>
        + linkwright::nalgebra::allocator::Allocator<D, D>,
{
    let equations = Counted::new(equations);
    for start in starts {
        for iterations in [0, 1, 3, 25, 60] {
            let settings = Settings {
                iterations,
                ..Settings::default()
            };
            let n = u32::from(iterations);
            let mut q = start.clone();
            let _ = newton::solve(&equations, &mut q, 0.3, &settings);
            let count = equations.take();
            assert!(
                count.residuals <= n + 2 && count.jacobians <= n + 3,
                "{count:?}"
            );
            let _ = Frame::assemble(&equations, start, 0.3, &settings);
            let count = equations.take();
            assert!(
                count.residuals <= n + 2 && count.jacobians <= n + 5,
                "{count:?}"
            );
            assert!(
                count.time_derivatives <= 1 && count.gammas <= 1,
                "{count:?}"
            );
            let mut q = start.clone();
            let _ = solve_damped(&equations, &mut q, 0.3, &settings);
            let count = equations.take();
            let trials = n * (1 + u32::from(SHORTENINGS));
            assert!(count.residuals <= trials + n + 3, "{count:?}");
            assert!(count.jacobians <= 2 * n + 3, "{count:?}");
            let mut q = start.clone();
            let _ = approach(&equations, &mut q, 0.3);
            let count = equations.take();
            let steps = 1 + u32::from(STEPS);
            assert!(
                count.residuals <= steps && count.jacobians <= steps,
                "{count:?}"
            );
            for branch in [None, Some(Branch::Positive), Some(Branch::Negative)] {
                let _ =
                    Frame::assemble_from_rough_estimate(&equations, start, branch, 0.3, &settings);
                let count = equations.take();
                assert!(count.residuals <= 13 * n + 74, "{count:?}");
                assert!(count.jacobians <= 5 * n + 79, "{count:?}");
                assert!(
                    count.time_derivatives <= 3 && count.gammas <= 3,
                    "{count:?}"
                );
            }
        }
    }
}

#[test]
fn work_is_what_the_documentation_says_whatever_happens() {
    let numbers = [0.0, 1e-7, 0.02, 0.5, 1.5, 3.0, 40.0, 1e8, f64::NAN];
    let starts = numbers.map(SVector::<f64, 1>::new);
    for equation in [
        arctangent(),
        single(|x| x * x, |x| 2.0 * x),
        single(|x| x * x + 1.0, |x| 2.0 * x),
        single(|x| x * x * x - 2.0 * x + 2.0, |x| 3.0 * x * x - 2.0),
        single(|x| x.powi(20), |x| 20.0 * x.powi(19)),
        single(|x| x.sin() - 0.5, f64::cos),
        single(f64::exp, f64::exp),
        single(|_| 1.0, |_| 0.0),
        single(|x| x - 1.0, |_| 1e-3),
        single(|x| x, |_| -1.0),
    ] {
        work_is_bounded(equation, &starts);
    }
    let mut sequence = Sequence(3);
    let starts: Vec<_> = (0..20)
        .map(|_| SVector::<f64, 6>::from_fn(|_, _| 4.0 * sequence.next()))
        .collect();
    work_is_bounded(Turning, &starts);
}
