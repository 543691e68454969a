//! Elementary functions: their errors, their special values, and a type with other functions.

use std::cell::Cell;

use linkwright::math::{Functions, Real};
use linkwright_math::{double, single};
use linkwright_tests::elementary::{
    Angles, Worst, angle, followed, sine_and_cosine, single_angle, single_sine_and_cosine, vector,
};
use linkwright_tests::random::Random;

/// Bounds in the documentation of the functions, in ulps.
const SINE: f64 = 1.0;
const ANGLE: f64 = 2.0;

fn assert_within(worst: &Worst, bound: f64, count: u64) {
    assert!(worst.count >= count && worst.error <= bound, "{worst:?}");
    // An error near zero would show that nothing was compared.
    assert!(worst.error > 0.4, "{worst:?}");
}

#[test]
fn sine_and_cosine_are_within_one_ulp_in_double_precision() {
    let mut random = Random::new(14);
    for (angles, _) in Angles::LIST {
        let mut worst = [Worst::default(); 2];
        for _ in 0..2000 {
            sine_and_cosine(angles.next(&mut random), &mut worst);
        }
        // The f64 that is closest to a multiple of π/2: Muller, Elementary Functions.
        sine_and_cosine(6_381_956_970_095_103.0 * 2.0_f64.powi(797), &mut worst);
        for worst in worst {
            assert_within(&worst, SINE, 2000);
        }
    }
}

#[test]
fn sine_and_cosine_are_within_one_ulp_in_single_precision() {
    let mut worst = [Worst::default(); 2];
    for bits in (0..f32::INFINITY.to_bits()).step_by(2039) {
        single_sine_and_cosine(f32::from_bits(bits), &mut worst);
        single_sine_and_cosine(-f32::from_bits(bits), &mut worst);
    }
    // Angles close to multiples of π/2, up to 8192 rad and beyond.
    for multiple in 1..20_000 {
        let nearest = (f64::from(multiple) * std::f64::consts::FRAC_PI_2) as f32;
        for bits in nearest.to_bits() - 1..=nearest.to_bits() + 1 {
            single_sine_and_cosine(f32::from_bits(bits), &mut worst);
        }
    }
    for worst in worst {
        assert_within(&worst, SINE, 2_000_000);
    }
}

#[test]
fn the_angle_of_a_vector_is_within_two_ulps() {
    let mut random = Random::new(2);
    let (mut wide, mut narrow) = (Worst::default(), Worst::default());
    for _ in 0..10_000 {
        angle(vector(&mut random), &mut wide);
    }
    for _ in 0..1_000_000 {
        let bits = random.bits();
        let any = [bits as u32, (bits >> 32) as u32].map(f32::from_bits);
        let ordinary = vector(&mut random).map(|component| component as f32);
        for vector in [any, ordinary] {
            if vector.iter().all(|component| component.is_finite()) {
                single_angle(vector, &mut narrow);
            }
        }
    }
    assert_within(&wide, ANGLE, 9_000);
    assert_within(&narrow, ANGLE, 1_000_000);
}

#[test]
fn an_angle_is_followed_within_two_epsilons() {
    let mut random = Random::new(3);
    let mut worst = [Worst::default(); 2];
    for _ in 0..10_000 {
        followed(&mut random, &mut worst);
    }
    for worst in worst {
        assert_within(&worst, 2.0, 10_000);
    }
}

/// The standard library and these functions agree about zeros, infinities and NaN, with their signs.
#[test]
fn special_values_are_those_of_the_standard_library() {
    let values = [
        0.0,
        1.0,
        5e-324,
        1e-310,
        1e-45,
        3e-39,
        1e30,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    let signed = values.iter().flat_map(|value| [*value, -*value]);
    let same = |found: f64, expected: f64| {
        found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan()
    };
    for y in signed.clone() {
        for x in signed.clone() {
            // Both are rounded correctly if one of the components is special.
            let special = |it: f64| it == 0.0 || !it.is_finite();
            if special(x) || special(y) {
                let (found, expected) = (double::atan2(y, x), y.atan2(x));
                assert!(same(found, expected), "{y} {x}: {found} {expected}");
                let (y, x) = (y as f32, x as f32);
                let (found, expected) = (single::atan2(y, x), y.atan2(x));
                assert!(
                    same(found.into(), expected.into()),
                    "{y} {x}: {found} {expected}"
                );
            }
        }
        let is_number = y.is_finite();
        assert_eq!(double::sin(y).is_nan(), !is_number, "{y}");
        assert_eq!(double::cos(y).is_nan(), !is_number, "{y}");
        let narrow = y as f32;
        assert_eq!(single::sin(narrow).is_nan(), !narrow.is_finite(), "{y}");
        assert_eq!(single::cos(narrow).is_nan(), !narrow.is_finite(), "{y}");
    }
    for zero in [0.0, -0.0] {
        assert!(same(double::sin(zero), zero) && double::cos(zero) == 1.0);
        assert_eq!(single::sin(zero as f32).to_bits(), (zero as f32).to_bits());
        assert_eq!(single::cos(zero as f32), 1.0);
    }
    assert!(double::angle_near(0.0, 0.0, 0.0).is_nan());
    assert!(single::angle_near(-0.0, 0.0, 1.0).is_nan());
    assert!(double::angle_near(f64::NAN, 1.0, 0.0).is_nan());
    assert!(double::angle_near(1.0, 0.0, f64::NAN).is_nan());
}

#[test]
fn sine_is_odd_and_cosine_even_to_the_last_bit() {
    let mut random = Random::new(4);
    for (angles, _) in Angles::LIST {
        for _ in 0..1000 {
            let angle = angles.next(&mut random);
            assert_eq!(double::sin(-angle), -double::sin(angle));
            assert_eq!(double::cos(-angle), double::cos(angle));
        }
    }
}

/// Interpreter, generator and runtime use the same functions.
#[test]
fn the_runtime_has_these_functions() {
    let mut random = Random::new(5);
    for _ in 0..1000 {
        let [y, x] = vector(&mut random);
        assert_eq!(Real::sin_cos(x), double::sin_cos(x));
        assert_eq!(Real::atan2(y, x).to_bits(), double::atan2(y, x).to_bits());
        let [y, x] = [y, x].map(|it| it as f32);
        let angle = Real::angle_near(y, x, 1.0);
        assert_eq!(angle.to_bits(), single::angle_near(y, x, 1.0).to_bits());
    }
}

thread_local! {
    static CALLS: Cell<[u32; 3]> = const { Cell::new([0; 3]) };
}

fn count(place: usize) {
    let mut calls = CALLS.get();
    calls[place] += 1;
    CALLS.set(calls);
}

/// Functions that count their calls.
struct Counting;

impl Functions<f64> for Counting {
    fn sin_cos(angle: f64) -> (f64, f64) {
        count(0);
        angle.sin_cos()
    }

    fn sqrt(x: f64) -> f64 {
        count(1);
        x.sqrt()
    }

    fn angle_near(sine: f64, cosine: f64, near: f64) -> f64 {
        count(2);
        Real::nearest_turn(sine.atan2(cosine), near)
    }
}

/// `four_bar.mech` with `Options { math: Some("crate::math::Counting"), .. }`.
mod counted {
    include!(concat!(env!("OUT_DIR"), "/linkwright/counted_four_bar.rs"));
}

#[test]
fn a_module_calls_the_functions_that_its_options_name() {
    use linkwright_mechanisms::four_bar;
    let mut usual = four_bar::FourBar::assemble(0.0).expect("it assembles");
    let mut counted_mechanism = counted::FourBar::assemble(0.0).expect("it assembles");
    CALLS.set([0; 3]);
    for step in 1..=100 {
        let t = f64::from(step) / 100.0;
        let usual = usual.advance(t).expect("it moves").q.to_array();
        let counted_mechanism = counted_mechanism.advance(t).expect("it moves").q.to_array();
        for (counted_mechanism, usual) in counted_mechanism.into_iter().zip(usual) {
            assert!(
                (counted_mechanism - usual).abs() < 1e-13,
                "{counted_mechanism} {usual}"
            );
        }
    }
    let [waves, roots, angles] = CALLS.get();
    assert!(
        waves >= 100 && roots >= 100 && angles >= 200,
        "{waves} {roots} {angles}"
    );
}
