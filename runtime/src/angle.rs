//! The cosine and the sine of an angle, and an angle near it → the angle.
//!
//! From one frame to the next an angle moves little. It is therefore measured from the multiple of π/4 next to the last one,
//! which needs one quotient and a polynomial, and is wound up at the same time; only where that is too far the octant is
//! found first.
//!
//! A closed form knows both, and their squares add up to one, so nothing of a general arctangent's care for infinities, zeros
//! and subnormal quotients is needed. The quotient of the smaller and the larger one, turned by an eighth of a turn where
//! that makes it smaller, is at most tan(π/8); there the arctangent is an odd polynomial of degree 23, a minimax fit of
//! atan(x)/x on |x| ≤ 7/16 (the coefficients are those that Sun's FDLIBM made known). The result is within 2 ε of its
//! magnitude, or of π/4 where it is larger. The module does not know whole turns.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// atan(x) = x − x · (C₀ x² + C₁ x⁴ + …).
const COEFFICIENTS: [f64; 11] = [
    3.333_333_333_333_293e-1,
    -1.999_999_999_987_648_3e-1,
    1.428_571_427_250_346_6e-1,
    -1.111_111_040_546_235_6e-1,
    9.090_887_133_436_507e-2,
    -7.691_876_205_044_83e-2,
    6.661_073_137_387_531e-2,
    -5.833_570_133_790_573_5e-2,
    4.976_877_994_615_932e-2,
    -3.653_157_274_421_691_6e-2,
    1.628_582_011_536_578_2e-2,
];

/// tan(π/8) = √2 − 1.
const TANGENT_OF_EIGHTH: f64 = 0.414_213_562_373_095_03;

/// What the rounded multiples of π/4 lack.
const QUARTER_REST: f64 = 3.061_616_997_868_383e-17;

/// cos(k π/4) for k = 0 … 7; the sine of the same is two places further back.
const COSINES: [f64; 8] = {
    const HALF: f64 = core::f64::consts::FRAC_1_SQRT_2;
    [1.0, HALF, 0.0, -HALF, -1.0, -HALF, 0.0, HALF]
};

/// The largest quotient for which the polynomial is good.
const LARGEST: f64 = 0.4375;

/// Adding it to a number of moderate size leaves the nearest integer in the last bits: 1.5 · 2⁵².
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// The angle (rad) with this sine and cosine, or a common positive multiple of them of ordinary size, that is nearest to
/// `near`. NaN where one of them is NaN or both are zero.
#[inline]
pub fn angle_near(sine: f64, cosine: f64, near: f64) -> f64 {
    let shifted = near * (4.0 / PI) + ROUNDER;
    let octants = shifted - ROUNDER;
    // Only the last three bits are used, which are right however many octants have been wound up.
    let place = (shifted.to_bits() & 7) as usize;
    let (along, across) = (COSINES[place], COSINES[(place + 6) & 7]);
    let high = cosine * along + sine * across;
    let low = sine * along - cosine * across;
    let x = low / high;
    if high > 0.0 && x.abs() <= LARGEST {
        octants * FRAC_PI_4 + (octants * QUARTER_REST + (x - bend(x)))
    } else {
        far_angle(sine, cosine, near)
    }
}

/// The same from an angle that says nothing about the octant.
#[cold]
fn far_angle(sine: f64, cosine: f64, near: f64) -> f64 {
    crate::closed_form::nearest_turn(angle_of(sine, cosine), near)
}

/// x − atan(x) for |x| ≤ 7/16.
#[inline]
fn bend(x: f64) -> f64 {
    let square = x * x;
    let fourth = square * square;
    let [c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10] = COEFFICIENTS;
    // Two half polynomials that do not wait for one another.
    let even = square
        * (c0 + fourth * (c2 + fourth * (c4 + fourth * (c6 + fourth * (c8 + fourth * c10)))));
    let odd = fourth * (c1 + fourth * (c3 + fourth * (c5 + fourth * (c7 + fourth * c9))));
    x * (even + odd)
}

/// The angle in [-π, π] (rad) whose sine and cosine are given, or any common positive multiple of them of ordinary size. NaN
/// where one of them is NaN or both are zero.
#[inline]
pub fn angle_of(sine: f64, cosine: f64) -> f64 {
    let (across, along) = (sine.abs(), cosine.abs());
    let steep = across > along;
    let (low, high) = if steep {
        (along, across)
    } else {
        (across, along)
    };
    let turned = low > TANGENT_OF_EIGHTH * high;
    let (numerator, denominator) = if turned {
        (low - high, low + high)
    } else {
        (low, high)
    };
    let x = numerator / denominator;
    let bend = bend(x);
    let (base, rest) = if turned {
        (FRAC_PI_4, QUARTER_REST)
    } else {
        (0.0, 0.0)
    };
    // The small parts are added first.
    let octant = base + (x - (bend - rest));
    let quadrant = if steep {
        FRAC_PI_2 - (octant - 2.0 * QUARTER_REST)
    } else {
        octant
    };
    let half = if cosine < 0.0 {
        PI - (quadrant - 4.0 * QUARTER_REST)
    } else {
        quadrant
    };
    if sine < 0.0 { -half } else { half }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_circle_agrees_with_the_arctangent_of_the_standard_library() {
        let mut largest = 0.0_f64;
        for step in -200_000..=200_000 {
            let angle = f64::from(step) * (PI / 200_000.0);
            let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
            let expected = libm::atan2(sine, cosine);
            let error = (angle_of(sine, cosine) - expected).abs() / expected.abs().max(FRAC_PI_4);
            largest = largest.max(error / f64::EPSILON);
        }
        assert!(largest <= 2.0, "{largest} ε");
    }

    #[test]
    fn an_angle_is_followed_through_many_turns() {
        let mut largest = 0.0_f64;
        for (step, stride) in [(0.01, 3_000), (0.4, 3_000), (2.5, 3_000), (-0.7, 3_000)] {
            let mut last = 0.0;
            for count in 0..stride {
                let angle = f64::from(count) * step;
                let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
                let found = angle_near(sine, cosine, last);
                let error = (found - angle).abs() / angle.abs().max(FRAC_PI_4);
                largest = largest.max(error / f64::EPSILON);
                last = found;
            }
        }
        assert!(largest <= 2.0, "{largest} ε");
        assert!(angle_near(0.0, 0.0, 0.0).is_nan() && angle_near(f64::NAN, 1.0, 0.0).is_nan());
        assert!(angle_near(1.0, 0.0, f64::NAN).is_nan());
        assert_eq!(angle_near(0.0, 1.0, 0.1), 0.0);
        assert_eq!(angle_near(1.0, 0.0, -1.0), FRAC_PI_2);
        assert_eq!(angle_near(1.0, 0.0, -2.0), -3.0 * FRAC_PI_2);
    }

    #[test]
    fn the_axes_are_exact() {
        assert_eq!(angle_of(0.0, 1.0), 0.0);
        assert_eq!(angle_of(1.0, 0.0), FRAC_PI_2);
        assert_eq!(angle_of(-1.0, 0.0), -FRAC_PI_2);
        assert_eq!(angle_of(0.0, -1.0), PI);
        assert_eq!(angle_of(0.5, 0.5), FRAC_PI_4);
        assert_eq!(angle_of(1e-300, 1.0), 1e-300);
    }

    #[test]
    fn what_has_no_direction_has_no_angle() {
        assert!(angle_of(0.0, 0.0).is_nan());
        assert!(angle_of(f64::NAN, 1.0).is_nan());
        assert!(angle_of(1.0, f64::NAN).is_nan());
    }
}
