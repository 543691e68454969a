//! The elementary functions of both scalars, whichever library they come from.

use linkwright::Settings;
use linkwright::math::Real;

/// Checks the functions against `f64`'s own at a few arguments, to a few units in the last place of `T`.
fn agrees_with_the_standard_library<T: Real>() {
    let tolerance = 2.0 * T::EPSILON.to_f64();
    let close = |found: T, expected: f64| {
        let error = (found.to_f64() - expected).abs();
        assert!(
            error <= tolerance * expected.abs().max(1.0),
            "{found} for {expected}"
        );
    };
    for x in [0.125, 0.5, 1.0, 2.75, 3.5] {
        let scalar = T::from_f64(x);
        close(Real::sin(scalar), x.sin());
        close(Real::cos(scalar), x.cos());
        let (sin, cos) = Real::sin_cos(-scalar);
        close(sin, -x.sin());
        close(cos, x.cos());
        close(Real::sqrt(scalar), x.sqrt());
        close(Real::exp(scalar), x.exp());
        close(Real::ln(scalar), x.ln());
        close(Real::powf(scalar, T::HALF), x.powf(0.5));
        close(Real::atan2(scalar, -T::ONE), x.atan2(-1.0));
        close(Real::hypot(scalar, T::ONE), x.hypot(1.0));
        let (significand, exponent) = scalar.significand_exponent();
        assert!(significand >= T::HALF && significand < T::ONE);
        assert!(significand.scale_by_power_of_two(exponent) == scalar);
    }
    assert!(T::ONE + T::EPSILON > T::ONE && T::ONE + T::EPSILON * T::HALF == T::ONE);
    assert!(T::from_f64(f64::NAN).max(T::ONE) == T::ONE && T::ONE.min(T::ZERO) == T::ZERO);
    assert!(!(T::ONE / T::ZERO).is_finite() && (-T::ONE).abs() == T::ONE);
}

#[test]
fn elementary_functions_agree_with_the_standard_library() {
    agrees_with_the_standard_library::<f64>();
    agrees_with_the_standard_library::<f32>();
}

#[test]
fn default_settings_are_the_documented_ones() {
    let double = Settings::<f64>::default();
    assert_eq!(
        (double.tolerance, double.iterations, double.polish),
        (1e-12, 25, true)
    );
    assert!((double.pivot_ratio - 1.4e-14).abs() < 0.05e-14);
    let single = Settings::<f32>::default();
    assert_eq!(
        (single.tolerance, single.iterations, single.polish),
        (1e-5, 25, true)
    );
    assert!((single.pivot_ratio - 7.6e-6).abs() < 0.05e-6);
}
