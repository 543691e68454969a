//! Sine and cosine of an angle in radians, computed together.
//!
//! The angle is brought within π/4 of a multiple of π/2 by subtracting that multiple in parts. The parts are cut off so
//! that all products except for the last one are exact (W. J. Cody and W. Waite, Software Manual for the Elementary
//! Functions, 1980). The rounding error of the last difference is kept beside it. Angles that are too large for that go
//! to [`far_angle`]. So do angles so close to the multiple that only the rounding of the parts would
//! be left.
//!
//! The remainder is the argument of an odd and an even polynomial. They are minimax fits of (sin y − y)/y³ and (cos y −
//! 1 + y²/2)/y⁴ on |y| ≤ π/4 (J.-M. Muller, Elementary Functions). Their errors are below 2⁻⁵⁷ in f64 and 2⁻²⁷ in f32
//! of the functions, so that little more than the last addition of each rounds. Both are always computed. The quadrant
//! therefore decides only which is which, and the signs.

use crate::far_angle;

/// Rotates the two values of a positive angle in the first quadrant to another quadrant, with the sign of the angle.
macro_rules! turned {
    ($scalar:ident, $bits:ident, $angle:ident, $sine:ident, $cosine:ident, $quadrant:ident) => {{
        let (sine, cosine) = ($sine.to_bits(), $cosine.to_bits());
        let sign = $angle.to_bits() & (1 << ($bits::BITS - 1));
        let quadrant = $quadrant as $bits;
        let different = (sine ^ cosine) & (quadrant & 1).wrapping_neg();
        const TOP: u32 = $bits::BITS - 2;
        (
            $scalar::from_bits(sine ^ different ^ ((quadrant & 2) << TOP) ^ sign),
            $scalar::from_bits(cosine ^ different ^ ((quadrant.wrapping_add(1) & 2) << TOP)),
        )
    }};
}

/// Defines the function of several angles, from the remainder of an angle in two parts, and true if only `sin_cos` reduces it.
macro_rules! array_function {
    ($scalar:ident, $bits:ident, |$size:ident, $quadrants:ident| $remainder:block) => {
        /// Returns sines and cosines of several angles, with the bits of [`sin_cos`]. Compilers vectorize it.
        #[inline(always)]
        pub fn sines_cosines<const N: usize>(angles: [$scalar; N]) -> [[$scalar; N]; 2] {
            let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
            let mut rare = 0;
            for lane in 0..N {
                let angle = angles[lane];
                let $size = angle.abs();
                // Angles below π/4 have quadrant 0 and are their own remainder.
                let shifted = $size * FRAC_2_PI + ROUNDER;
                let $quadrants = shifted - ROUNDER;
                let (y, tail, is_far) = $remainder;
                rare |= $bits::from(is_far);
                let (sine, cosine) = of_remainder!(y, tail);
                let quadrant = shifted.to_bits();
                (sines[lane], cosines[lane]) =
                    turned!($scalar, $bits, angle, sine, cosine, quadrant);
            }
            if rare != 0 {
                for lane in 0..N {
                    (sines[lane], cosines[lane]) = sin_cos(angles[lane]);
                }
            }
            [sines, cosines]
        }
    };
}

pub mod double {
    use core::f64::consts::{FRAC_2_PI, FRAC_PI_4};

    /// Leading 36 bits of π/2: their product with a number of quadrants below [`MAX_ANGLE`] is exact.
    const HALF_PI: f64 = 1.5707963267923333;
    /// Rest of π/2.
    const HALF_PI_REST: f64 = 2.563344151594519e-12;
    /// Largest angle whose quadrants have so few bits, 17, that the products above are exact.
    const MAX_ANGLE: f64 = 205_000.0;
    /// Smallest remainder for which the missing digits of π/2 and the rounding of the last product are within 2⁻⁵ ulp:
    /// 2⁻¹⁶.
    const MIN_REMAINDER: f64 = 1.525_878_906_25e-5;
    /// Adding it to a number of moderate size leaves the nearest integer in the last bits: 1.5 · 2⁵².
    const ROUNDER: f64 = 6_755_399_441_055_744.0;

    const SINE: [f64; 6] = [
        -0.1666666666666663,
        0.00833333333332184,
        -0.00019841269829358484,
        2.7557313538483216e-6,
        -2.505073438205976e-8,
        1.589543274989012e-10,
    ];

    const COSINE: [f64; 6] = [
        0.041666666666666595,
        -0.0013888888888873307,
        2.480158728896531e-5,
        -2.7557314203131543e-7,
        2.087570315049668e-9,
        -1.1358617758465667e-11,
    ];

    /// Sine and cosine of the remainder `y` + `tail`.
    macro_rules! of_remainder {
        ($y:ident, $tail:ident) => {{
            let z = $y * $y;
            let [s0, s1, s2, s3, s4, s5] = SINE;
            let [c0, c1, c2, c3, c4, c5] = COSINE;
            // In independent pairs.
            let fourth = z * z;
            let eighth = fourth * fourth;
            let cube = $y * z;
            let bend = fourth * (s2 + z * s3) + eighth * (s4 + z * s5);
            let rise = (c0 + z * c1) + fourth * (c2 + z * c3) + eighth * (c4 + z * c5);
            let half = 0.5 * z;
            let parabola = 1.0 - half;
            let sine = $y + ((cube * (s0 + z * s1) + $tail * parabola) + cube * bend);
            let cosine = parabola + (((1.0 - parabola) - half) + (fourth * rise - $y * $tail));
            (sine, cosine)
        }};
    }

    /// Returns the sine and the cosine of an angle in radians, in this order, each within 1 ulp; NaN for infinite
    /// angles.
    #[inline]
    pub fn sin_cos(angle: f64) -> (f64, f64) {
        let size = angle.abs();
        let (mut quadrant, mut y, mut tail) = (0, size, 0.0);
        if size.to_bits() > FRAC_PI_4.to_bits() {
            let shifted = size * FRAC_2_PI + ROUNDER;
            let quadrants = shifted - ROUNDER;
            let above = size - quadrants * HALF_PI;
            let below = quadrants * HALF_PI_REST;
            y = above - below;
            tail = (above - y) - below;
            quadrant = shifted.to_bits() as u32;
            // Positive numbers are ordered like their bits, which are compared faster if f64 is computed in software.
            if size.to_bits() > MAX_ANGLE.to_bits() || y.abs().to_bits() < MIN_REMAINDER.to_bits() {
                (quadrant, y, tail) = super::far_angle::double(size);
            }
        }

        let (sine, cosine) = of_remainder!(y, tail);
        turned!(f64, u64, angle, sine, cosine, quadrant)
    }

    array_function!(f64, u64, |size, quadrants| {
        let above = size - quadrants * HALF_PI;
        let below = quadrants * HALF_PI_REST;
        let y = above - below;
        let is_far = (size.to_bits() > MAX_ANGLE.to_bits())
            | ((y.abs() < MIN_REMAINDER) & (quadrants != 0.0));
        (y, (above - y) - below, is_far)
    });

    /// Returns the sine of an angle in radians, that of [`sin_cos`].
    #[inline]
    pub fn sin(angle: f64) -> f64 {
        sin_cos(angle).0
    }

    /// Returns the cosine of an angle in radians, that of [`sin_cos`].
    #[inline]
    pub fn cos(angle: f64) -> f64 {
        sin_cos(angle).1
    }
}

pub mod single {
    use core::f32::consts::{FRAC_2_PI, FRAC_PI_4};

    /// Leading 11 bits of π/2: their product with a number of quadrants below [`MAX_ANGLE`] is exact.
    const HALF_PI: f32 = 1.5703125;
    /// Next 11 bits of π/2, whose product is exact as well.
    const HALF_PI_MIDDLE: f32 = 0.0004837513;
    /// Rest of π/2.
    const HALF_PI_REST: f32 = 7.54979e-8;
    /// Largest angle whose quadrants have so few bits, 13, that the products above are exact.
    const MAX_ANGLE: f32 = 12_800.0;
    /// Smallest remainder, relative to the number of quadrants, for which the missing digits of π/2 and the rounding of
    /// the last product are within 2⁻⁵ ulp: 2⁻¹⁸.
    const MIN_REMAINDER: f32 = 3.814_697_3e-6;
    /// Adding it to a number of moderate size leaves the nearest integer in the last bits: 1.5 · 2²³.
    const ROUNDER: f32 = 12_582_912.0;

    const SINE: [f32; 3] = [-0.16666655, 0.008332187, -0.00019517897];

    const COSINE: [f32; 3] = [0.041666646, -0.001388731, 2.4432327e-5];

    /// Sine and cosine of the remainder `y` + `tail`.
    macro_rules! of_remainder {
        ($y:ident, $tail:ident) => {{
            let z = $y * $y;
            let [s0, s1, s2] = SINE;
            let [c0, c1, c2] = COSINE;
            let bend = s0 + z * (s1 + z * s2);
            let rise = c0 + z * (c1 + z * c2);
            let half = 0.5 * z;
            let parabola = 1.0 - half;
            let sine = $y + (($y * z) * bend + $tail * parabola);
            let cosine = parabola + (((1.0 - parabola) - half) + ((z * z) * rise - $y * $tail));
            (sine, cosine)
        }};
    }

    /// Returns the sine and the cosine of an angle in radians, in this order, each within 1 ulp; NaN for infinite
    /// angles.
    #[inline]
    pub fn sin_cos(angle: f32) -> (f32, f32) {
        let size = angle.abs();
        let (mut quadrant, mut y, mut tail) = (0, size, 0.0);
        if size > FRAC_PI_4 {
            let shifted = size * FRAC_2_PI + ROUNDER;
            let quadrants = shifted - ROUNDER;
            let above = (size - quadrants * HALF_PI) - quadrants * HALF_PI_MIDDLE;
            let below = quadrants * HALF_PI_REST;
            y = above - below;
            tail = (above - y) - below;
            quadrant = shifted.to_bits();
            if size > MAX_ANGLE || y.abs() < quadrants * MIN_REMAINDER {
                (quadrant, y, tail) = super::far_angle::single(size);
            }
        }

        let (sine, cosine) = of_remainder!(y, tail);
        turned!(f32, u32, angle, sine, cosine, quadrant)
    }

    array_function!(f32, u32, |size, quadrants| {
        let above = (size - quadrants * HALF_PI) - quadrants * HALF_PI_MIDDLE;
        let below = quadrants * HALF_PI_REST;
        let y = above - below;
        let is_near = (size <= MAX_ANGLE) & (y.abs() >= quadrants * MIN_REMAINDER);
        (y, (above - y) - below, !is_near)
    });

    /// Returns the sine of an angle in radians, that of [`sin_cos`].
    #[inline]
    pub fn sin(angle: f32) -> f32 {
        sin_cos(angle).0
    }

    /// Returns the cosine of an angle in radians, that of [`sin_cos`].
    #[inline]
    pub fn cos(angle: f32) -> f32 {
        sin_cos(angle).1
    }
}
