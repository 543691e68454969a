//! Tests rationals and numbers: conversion, overflow, surds.

use super::generator::Generator;
use crate::expr::{Number, Rational};

const SEED: u64 = 0x5eed_0002;

fn fraction(numerator: i128, denominator: i128) -> Rational {
    Rational::new(numerator, denominator).expect("a fraction that fits")
}

#[test]
fn a_fraction_is_reduced_with_a_positive_denominator() {
    let half = fraction(-3, -6);
    assert_eq!((half.numerator(), half.denominator()), (1, 2));
    assert_eq!(fraction(4, -8), -half);
    assert_eq!(fraction(0, -8), Rational::ZERO);
    assert_eq!(Rational::new(1, 0), None);
    assert_eq!(Rational::new(i128::MIN, 1), None);
    assert_eq!(fraction(i128::MIN, 2).numerator(), i128::MIN / 2);
    assert_eq!(Rational::new(1, i128::MIN), None);
}

#[test]
fn arithmetic_that_does_not_fit_answers_none() {
    let largest = fraction(i128::MAX, 1);
    let smallest = fraction(1, i128::MAX);
    assert_eq!(largest.checked_add(Rational::ONE), None);
    assert_eq!((-largest).checked_sub(Rational::ONE), None);
    assert_eq!((-largest).checked_sub(Rational::integer(2)), None);
    assert_eq!(largest.checked_mul(fraction(2, 1)), None);
    assert_eq!(largest.checked_mul(smallest), Some(Rational::ONE));
    assert_eq!(smallest.checked_mul(smallest), None);
    assert_eq!(smallest.checked_div(Rational::ZERO), None);
    assert_eq!(Rational::integer(10).checked_pow(39), None);
    assert_eq!(
        Rational::integer(10).checked_pow(-38),
        Rational::parse("1e-38")
    );
    assert_eq!(
        (-Rational::ONE).checked_pow(i128::MAX),
        Some(-Rational::ONE)
    );
    assert_eq!(Rational::ZERO.checked_pow(-1), None);
    assert_eq!(Rational::ZERO.checked_pow(0), Some(Rational::ONE));
}

#[test]
fn comparison_is_that_of_the_cross_products() {
    let mut generator = Generator::new(SEED);
    for round in 0..20_000 {
        let mut random = || {
            fraction(
                i128::from(generator.within(-40, 40)),
                i128::from(generator.within(1, 40)),
            )
        };
        let (a, b) = (random(), random());
        let crossed = (a.numerator() * b.denominator()).cmp(&(b.numerator() * a.denominator()));
        assert_eq!(
            a.cmp(&b),
            crossed,
            "seed {SEED:#x}, round {round}: {a:?} {b:?}"
        );
    }
    assert!(fraction(i128::MAX, i128::MAX - 1) < fraction(i128::MAX - 1, i128::MAX - 2));
}

#[test]
fn decimal_text_is_exact() {
    let cases = [
        ("12", 12, 1),
        ("0.05", 1, 20),
        ("-1_000.5", -2001, 2),
        ("+.5", 1, 2),
        ("5.", 5, 1),
        ("1e-20", 1, 10i128.pow(20)),
        ("1.5E+3", 1500, 1),
        ("0.000e999999999999", 0, 1),
        ("1.000000000000000000000000000000000000000000000000", 1, 1),
        ("100000000000000000000000000000000000000000000e-44", 1, 1),
    ];
    for (text, numerator, denominator) in cases {
        assert_eq!(
            Rational::parse(text),
            Some(fraction(numerator, denominator)),
            "{text}"
        );
    }
    for text in [
        "", ".", "-", "e5", "1e", "1e+", "1.2.3", "inf", "nan", "0x10", "1e5.0", "_1", "--1", "1 ",
    ] {
        assert_eq!(Rational::parse(text), None, "{text}");
        assert_eq!(Number::parse(text), None, "{text}");
    }
    assert_eq!(Rational::parse("1e-300"), None);
    assert_eq!(Number::parse("1e-300"), Some(Number::Float(1e-300)));
    assert_eq!(Number::parse("-1_0e299"), Some(Number::Float(-1e300)));
    assert_eq!(Number::parse("5e-324"), Some(Number::Float(5e-324)));
    assert_eq!(
        Number::parse("1e400").map(|value| value.is_finite()),
        Some(false)
    );
    assert_eq!(
        Number::parse("1e99999999999999999999").map(|value| value.is_finite()),
        Some(false)
    );
}

#[test]
fn the_nearest_float_is_that_of_the_decimal_text() {
    let mut generator = Generator::new(SEED ^ 1);
    for round in 0..50_000 {
        let digits = generator.within(1, 38) as usize;
        let mut text: String = (0..digits)
            .map(|_| char::from(b'0' + generator.below(10) as u8))
            .collect();
        if generator.below(2) == 0 {
            text.insert(0, '-');
        }
        let exponent = generator.within(-37, 37 - digits as i64);
        text.push_str(&format!("e{exponent}"));
        let Some(rational) = Rational::parse(&text) else {
            continue;
        };
        let expected: f64 = text.parse().expect("decimal text");
        assert!(
            rational.to_f64() == expected,
            "seed {SEED:#x}, round {round}: {text} is {expected}, not {}",
            rational.to_f64()
        );
    }
}

#[test]
fn halfway_cases_go_to_the_even_neighbor() {
    let one = 1i128 << 53;
    assert_eq!(fraction(one + 1, 1).to_f64(), one as f64);
    assert_eq!(fraction(one + 3, 1).to_f64(), (one + 4) as f64);
    // One half, and one half with one part in 10^20 above and below it.
    let large = 10i128.pow(20);
    assert_eq!(
        fraction((one + 1) * large, large * 3).to_f64(),
        fraction(one + 1, 3).to_f64()
    );
    assert_eq!(
        fraction((one + 1) * large + 1, large).to_f64(),
        (one + 2) as f64
    );
    assert_eq!(fraction((one + 1) * large - 1, large).to_f64(), one as f64);
    assert_eq!(fraction(i128::MAX, 1).to_f64(), 2f64.powi(127));
    assert_eq!(fraction(-1, i128::MAX).to_f64(), -(2f64.powi(-127)));
}

#[test]
fn square_roots_stay_exact() {
    let root = |value: i64| Number::integer(value).pow(Rational::HALF);
    let surd = |numerator, denominator, radicand| Number::Exact {
        rational: fraction(numerator, denominator),
        radicand,
    };
    assert_eq!(root(12), surd(2, 1, 3));
    assert_eq!(root(49), surd(7, 1, 1));
    assert_eq!(root(3).mul(root(3)), Number::integer(3));
    assert_eq!(root(3).recip(), surd(1, 3, 3));
    assert_eq!(root(6).mul(root(2)), surd(2, 1, 3));
    assert_eq!(root(6).mul(root(10)), surd(2, 1, 15));
    assert_eq!(
        Number::rational(fraction(3, 8)).pow(Rational::HALF),
        surd(1, 4, 6)
    );
    assert_eq!(root(3).pow(Rational::integer(3)), surd(3, 1, 3));
    assert_eq!(root(3).pow(Rational::integer(-3)), surd(1, 9, 3));
    assert_eq!(Number::integer(4).pow(fraction(1, 4)), root(2));
    assert_eq!(Number::integer(8).pow(fraction(-2, 3)), surd(1, 4, 1));
    assert_eq!(surd(3, 1, 3).pow(fraction(1, 3)), root(3));
    assert_eq!(root(2).add(root(2)), Some(root(8)));
    assert_eq!(root(2).add(root(3)), None);
    assert_eq!(root(2).add(root(2).neg()), Some(Number::ZERO));
    assert_eq!(root(2).mul(Number::ZERO), Number::ZERO);
    let large_prime = 1_000_003i128;
    assert_eq!(
        Number::rational(fraction(2 * large_prime * large_prime, 1)).pow(Rational::HALF),
        surd(large_prime, 1, 2)
    );
}

#[test]
fn falls_back_to_floats() {
    let largest = Number::rational(fraction(i128::MAX, 1));
    let twice = 2.0 * i128::MAX as f64;
    assert_eq!(largest.add(largest), Some(Number::Float(twice)));
    assert_eq!(largest.mul(Number::integer(2)), Number::Float(twice));
    assert_eq!(
        largest.pow(Rational::integer(2)),
        Number::Float(2f64.powi(254))
    );
    let cube_root = Number::integer(2).pow(fraction(1, 3));
    assert!((cube_root.to_f64() - 2f64.cbrt()).abs() <= f64::EPSILON);
    assert_eq!(
        Number::ZERO.pow(-Rational::ONE),
        Number::Float(f64::INFINITY)
    );
    assert_eq!(Number::ZERO.recip(), Number::Float(f64::INFINITY));
    assert!(Number::integer(-1).pow(Rational::HALF).to_f64().is_nan());
    assert!(
        Number::ZERO
            .mul(Number::Float(f64::INFINITY))
            .to_f64()
            .is_nan()
    );
    assert_eq!(Number::float(-0.0), Number::ZERO);
    assert_eq!(Number::float(-f64::NAN), Number::float(f64::NAN));
    assert_eq!(
        Number::Float(0.5).pow(Rational::integer(-2)),
        Number::Float(4.0)
    );
}

#[test]
fn random_products_and_powers_of_surds_have_the_value_of_floats() {
    let mut generator = Generator::new(SEED ^ 2);
    for round in 0..20_000 {
        let mut random = || {
            let rational = fraction(
                i128::from(generator.within(1, 200)),
                i128::from(generator.within(1, 200)),
            );
            Number::surd(rational, u128::from(generator.below(500)))
        };
        let (a, b) = (random(), random());
        let exponent = fraction(
            i128::from(generator.within(-6, 6)),
            i128::from(generator.within(1, 4)),
        );
        let (product, power) = (a.mul(b), a.pow(exponent));
        let close =
            |left: f64, right: f64| left == right || (left - right).abs() <= 1e-14 * right.abs();
        assert!(
            close(product.to_f64(), a.to_f64() * b.to_f64())
                && close(power.to_f64(), a.to_f64().powf(exponent.to_f64())),
            "seed {SEED:#x}, round {round}: {a:?}, {b:?}, {exponent:?}: {product:?}, {power:?}"
        );
        assert!(
            matches!(product, Number::Exact { .. }),
            "round {round}: {a:?} {b:?}"
        );
    }
}
