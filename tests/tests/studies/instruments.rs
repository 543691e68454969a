//! The instruments of the tests: random numbers, high precision, jets, difference quotients, exponents and shrinking.

use linkwright_tests::chains::truth::exact;
use linkwright_tests::description::written;
use linkwright_tests::hunt::mechanism;
use linkwright_tests::hunt::mechanism::Mechanism;
use linkwright_tests::hunt::shrink::shrunk;
use linkwright_tests::jet::Jet;
use linkwright_tests::majorant::Majorant;
use linkwright_tests::pantograph::Pantograph;
use linkwright_tests::random::Random;
use linkwright_tests::stability::precise::{Precise, pi};
use linkwright_tests::stability::truth::{Given, Truth};
use linkwright_tests::stencil::{first, second};
use linkwright_tests::study::exponent::fitted;

#[test]
fn the_sequence_of_a_seed_is_the_published_one() {
    let mut random = Random::new(1_234_567);
    assert_eq!(random.bits(), 6_457_827_717_110_365_317);
    assert_eq!(random.bits(), 3_203_168_211_198_807_973);
}

#[test]
fn floats_come_back_as_they_were() {
    for value in [1.0, -0.1, 1e300, -3.5e-300, 123_456_789.123_456_78, 0.0] {
        assert_eq!(Precise::from_f64(value).to_f64(), value);
    }
}

#[test]
fn subnormal_numbers_are_multiples_of_the_smallest() {
    let smallest = Precise::from_f64(f64::MIN_POSITIVE).times(&Precise::from_f64(f64::EPSILON));
    for count in [1.0, 3.0, 12_345.0, 2_f64.powi(40) + 1.0] {
        let subnormal = Precise::from_f64(f64::from_bits(count as u64));
        let ratio = subnormal.over(&smallest).to_f64();
        assert_eq!(ratio, count);
    }
}

#[test]
fn a_third_of_pi_has_the_cosine_one_half() {
    let third = pi().over(&Precise::from_f64(3.0));
    let error = third.cos().minus(&Precise::from_f64(0.5)).to_f64();
    assert!(error.abs() < 1e-110, "{error}");
    let error = Precise::from_f64(0.5).acos().minus(&third).to_f64();
    assert!(error.abs() < 1e-110, "{error}");
}

/// Against differences of the values.
#[test]
fn jets_agree_with_differences() {
    let functions: [fn(Jet) -> Jet; 6] = [
        |t| (2.0 * t).sin() * t.cos(),
        |t| (t * t + 1.0).sqrt(),
        |t| 1.0 / (t + 2.0) - t.square(),
        |t| (t / 3.0).acos(),
        |t| (t.sin() + 2.0).atan2(t.cos() - 0.5),
        |t| -t / (t.cos() + 3.0),
    ];
    for (index, function) in functions.into_iter().enumerate() {
        for t in [0.1, 0.7, 1.9] {
            let h = 1e-3;
            let at = |t| function(Jet::time(t)).0;
            let [back, here, ahead] = [t - h, t, t + h].map(at);
            let first = (ahead[0] - back[0]) / (2.0 * h);
            let second = (ahead[1] - back[1]) / (2.0 * h);
            assert!((here[1] - first).abs() < 1e-5, "{index} at {t}");
            assert!((here[2] - second).abs() < 1e-5, "{index} at {t}");
        }
    }
}

/// sin(1 + s): coefficients at most 1/k!, values rounded to one unit in the last place.
#[test]
fn the_errors_of_quotients_of_a_sine_lie_within_their_bounds_and_near_them() {
    let h = 1.0 / 64.0;
    let at = |i: f64| (1.0 + i * h).sin();
    let factorials = [1.0, 1.0, 2.0, 6.0, 24.0, 120.0, 720.0];
    let coefficients: [f64; 7] = factorials.map(|it: f64| 1.0 / it);
    let [c0, c1, c2, c3, c4, c5, _] = coefficients;
    let error = f64::EPSILON;
    let majorant = Majorant {
        coefficients: [c0, c1, c2, c3, c4, c5],
        error,
    };
    let slope = first([at(-2.0), at(-1.0), at(1.0), at(2.0)], h, &majorant);
    let curve = second(
        [-2.0, -1.0, 0.0, 1.0, 2.0].map(at),
        h,
        &Majorant {
            coefficients,
            error,
        },
    );
    for (quotient, exact) in [(slope, 1_f64.cos()), (curve, -1_f64.sin())] {
        let error = (quotient.value - exact).abs();
        assert!(
            error <= quotient.error && quotient.error < 20.0 * error,
            "{error:e}, {quotient:?}"
        );
    }
}

/// Against Newton-Raphson on all equations of the description, in as many bits.
#[test]
fn closed_forms_solve_the_description() {
    for growth in [1.0, 0.8, 1.4] {
        let chain = Pantograph::new(3, growth);
        let truth = Truth::new(&written(&chain.text("")));
        for t in [0.3, 2.0] {
            let [q, qd, qdd] = exact(&chain, t);
            let instant_inputs = Given {
                t,
                ..Given::default()
            };
            let solved = truth.solve(&instant_inputs, &q).expect("a regular pose");
            let levels = [q, qd, qdd];
            for (levels, solved) in levels.iter().flatten().zip(solved.levels.iter().flatten()) {
                let difference = levels.minus(solved).to_f64().abs();
                assert!(difference < 1e-80, "growth {growth}: {difference:e}");
            }
        }
    }
}

#[test]
fn powers_have_their_exponent() {
    let points = [1.0, 10.0, 100.0].map(|x: f64| (x, 7.0 * x.powf(1.5)));
    assert!((fitted(&points).expect("three points") - 1.5).abs() < 1e-12);
    assert_eq!(fitted(&points[..1]), None);
}

#[test]
fn unneeded_parts_are_left_out() {
    let number = (0..100).find(|number| {
        let groups = mechanism(3, *number, 8).groups;
        groups.len() >= 4 && groups.contains(&"dyad RRR")
    });
    let large = mechanism(3, number.expect("such a mechanism"), 8);
    let has_dyad = |it: &Mechanism| {
        let left = it.joint_order.iter().map(|joint| it.joints[*joint].1);
        left.clone().any(|group| it.groups[group] == "dyad RRR")
    };
    let small = shrunk(&large, has_dyad);
    assert!(has_dyad(&small) && small.joint_order.len() < large.joint_order.len());
    assert!(
        small.text().len() < large.text().len() / 2,
        "{}",
        small.text()
    );
}
