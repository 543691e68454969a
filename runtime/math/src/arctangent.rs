//! Angles of vectors, and angles with a sine and a cosine nearest to another angle.
//!
//! A quotient of magnitude 1/2 at most, or 7/16, is the argument of an odd polynomial, a minimax fit of (x − atan
//! x)/x³. Its error is below 2⁻⁵⁷ in f64 and 2⁻²⁶ in f32 of the arctangent. The general arctangent exchanges the
//! components, and rotates the vector by π/4 if the quotient would be larger; the difference of its components is then
//! exact. The rounding errors of the multiples of π/4 are added to the small parts first.
//!
//! From one frame to the next an angle moves little. [`double::angle_near`] therefore measures from the multiple of π/4
//! next to the last angle. This needs one quotient and the polynomial, and counts the turns at the same time. Only for
//! larger changes, the octant is determined first.

macro_rules! arctangents {
    (
        $name:ident, $scalar:ident, $bits:ident;
        rounder: $rounder:literal, quarter_rest: $quarter_rest:literal,
        ordinary: $smallest:literal to $largest:literal,
        bend: $coefficients:expr, |$square:ident, $c:pat_param| $bend:expr,
        slight_bend: $slight:expr, |$own_square:ident, $own_c:pat_param| $slight_bend:expr
    ) => {
        pub mod $name {
            use core::$scalar::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, PI, TAU};

            /// Adding it to a number of moderate size leaves the nearest integer in the last bits.
            const ROUNDER: $scalar = $rounder;

            /// Difference of π/4 from its rounded value.
            const QUARTER_REST: $scalar = $quarter_rest;

            /// cos(k π/4) for k = 0 … 7; the sine of such an angle is two entries further back.
            const COSINES: [$scalar; 8] = [
                1.0,
                FRAC_1_SQRT_2,
                0.0,
                -FRAC_1_SQRT_2,
                -1.0,
                -FRAC_1_SQRT_2,
                0.0,
                FRAC_1_SQRT_2,
            ];

            /// Returns x − atan(x) for |x| ≤ 1/2.
            #[inline]
            fn bend(x: $scalar) -> $scalar {
                let $square = x * x;
                let $c = $coefficients;
                x * $bend
            }

            /// Returns x − atan(x) for |x| ≤ 7/16, with fewer operations.
            #[inline]
            fn slight_bend(x: $scalar) -> $scalar {
                let $own_square = x * x;
                let $own_c = $slight;
                x * $slight_bend
            }

            /// Returns the angle in [-π, π] (rad) of the vector (`x`, `y`), within 2 ulp. If both components are zero,
            /// the angle is 0 or π with the sign of `y`; for infinite components it is the limit.
            #[inline]
            pub fn atan2(y: $scalar, x: $scalar) -> $scalar {
                let (across, along) = (y.abs(), x.abs());
                let high = if across > along { across } else { along };
                if ($smallest..=$largest).contains(&high) {
                    angle(y, x)
                } else {
                    extreme(y, x)
                }
            }

            /// Returns the angles of several vectors, with the bits of [`atan2`]. Compilers vectorize it.
            #[inline(always)]
            pub fn arctangents<const N: usize>(y: [$scalar; N], x: [$scalar; N]) -> [$scalar; N] {
                let mut angles = [0.0; N];
                let mut rare = 0;
                for lane in 0..N {
                    let (across, along) = (y[lane].abs(), x[lane].abs());
                    let high = if across > along { across } else { along };
                    rare |= $bits::from(!($smallest..=$largest).contains(&high));
                    angles[lane] = angle(y[lane], x[lane]);
                }
                if rare != 0 {
                    for lane in 0..N {
                        angles[lane] = atan2(y[lane], x[lane]);
                    }
                }
                angles
            }

            /// Returns the angle if the larger component neither overflows nor is subnormal when it is doubled or
            /// halved.
            #[inline]
            fn angle(y: $scalar, x: $scalar) -> $scalar {
                let (across, along) = (y.abs(), x.abs());
                let is_steep = across > along;
                let (low, high) = if is_steep {
                    (along, across)
                } else {
                    (across, along)
                };
                let is_turned = low > 0.5 * high;
                let (numerator, denominator) = if is_turned {
                    (low - high, low + high)
                } else {
                    (low, high)
                };
                let quotient = numerator / denominator;
                let bend = bend(quotient);
                let (base, rest) = if is_turned {
                    (FRAC_PI_4, QUARTER_REST)
                } else {
                    (0.0, 0.0)
                };
                let octant = base + (quotient - (bend - rest));
                let is_behind = x.is_sign_negative();
                let (base, rest) = if is_steep {
                    (FRAC_PI_2, 2.0 * QUARTER_REST)
                } else if is_behind {
                    (PI, 4.0 * QUARTER_REST)
                } else {
                    (0.0, 0.0)
                };
                let signed = if is_steep == is_behind {
                    octant
                } else {
                    -octant
                };
                (base + (signed + rest)).copysign(y)
            }

            /// Returns the angle of a vector whose larger component is zero, tiny, huge, infinite or NaN.
            #[cold]
            #[inline(never)]
            fn extreme(y: $scalar, x: $scalar) -> $scalar {
                if x.is_nan() || y.is_nan() {
                    return $scalar::NAN;
                }
                let is_infinite = x.is_infinite() || y.is_infinite();
                let is_zero = x == 0.0 && y == 0.0;
                // 2⁶⁰ and 1/4: powers of two are exact.
                let is_tiny = y.abs() < 1.0 && x.abs() < 1.0;
                let scale = if is_tiny {
                    1_152_921_504_606_846_976.0
                } else {
                    0.25
                };
                let scaled = |component: $scalar, otherwise: $scalar| {
                    let size = match component.is_infinite() {
                        // A vector that is infinite in both directions is taken to be between them.
                        true => 1.0,
                        false if is_infinite => 0.0,
                        false if is_zero => otherwise,
                        false => scale * component.abs(),
                    };
                    size.copysign(component)
                };
                angle(scaled(y, 0.0), scaled(x, 1.0))
            }

            /// Returns the angle (rad) with this sine and cosine, or a common positive multiple of them of ordinary
            /// size, that is nearest to `near`. NaN if one of them is NaN or both are zero.
            #[inline]
            pub fn angle_near(sine: $scalar, cosine: $scalar, near: $scalar) -> $scalar {
                let shifted = near * (4.0 / PI) + ROUNDER;
                let octants = shifted - ROUNDER;
                // Only the last three bits are used, which are right for any number of octants.
                let place = (shifted.to_bits() & 7) as usize;
                let (along, across) = (COSINES[place], COSINES[(place + 6) & 7]);
                let high = cosine * along + sine * across;
                let low = sine * along - cosine * across;
                let x = low / high;
                if high > 0.0 && x.abs() <= 0.4375 {
                    octants * FRAC_PI_4 + (octants * QUARTER_REST + (x - slight_bend(x)))
                } else {
                    angle_afar(sine, cosine, near)
                }
            }

            /// Returns the angles of several pairs of sine and cosine, with the bits of [`angle_near`]. Compilers vectorize
            /// it.
            #[inline(always)]
            pub fn angles_near<const N: usize>(
                sines: [$scalar; N],
                cosines: [$scalar; N],
                near: [$scalar; N],
            ) -> [$scalar; N] {
                let mut angles = [0.0; N];
                let mut rare = 0;
                for lane in 0..N {
                    // As in `angle_near`.
                    let shifted = near[lane] * (4.0 / PI) + ROUNDER;
                    let octants = shifted - ROUNDER;
                    let place = shifted.to_bits();
                    let (along, across) =
                        (eighth_cosine(place), eighth_cosine(place.wrapping_add(6)));
                    let high = cosines[lane] * along + sines[lane] * across;
                    let low = sines[lane] * along - cosines[lane] * across;
                    let x = low / high;
                    angles[lane] =
                        octants * FRAC_PI_4 + (octants * QUARTER_REST + (x - slight_bend(x)));
                    rare |= $bits::from(!((high > 0.0) & (x.abs() <= 0.4375)));
                }
                if rare != 0 {
                    for lane in 0..N {
                        angles[lane] = angle_near(sines[lane], cosines[lane], near[lane]);
                    }
                }
                angles
            }

            /// Returns the angles of two pairs of sine and cosine, with the bits of [`angle_near`]: by vectors where the
            /// processor has them, and one after the other where code without branches is only longer.
            #[inline(always)]
            pub fn two_angles_near(
                sines: [$scalar; 2],
                cosines: [$scalar; 2],
                near: [$scalar; 2],
            ) -> [$scalar; 2] {
                if $crate::HAS_VECTORS {
                    return angles_near(sines, cosines, near);
                }
                let ([sine, other_sine], [cosine, other_cosine]) = (sines, cosines);
                let [near, other_near] = near;
                [
                    angle_near(sine, cosine, near),
                    angle_near(other_sine, other_cosine, other_near),
                ]
            }

            /// Returns the entry of [`COSINES`] for the last three bits of a number, without reading memory.
            #[inline(always)]
            fn eighth_cosine(place: $bits) -> $scalar {
                const SIGN: $bits = 1 << ($bits::BITS - 1);
                let is_odd = (place & 1).wrapping_neg();
                // Neither π/2 nor 3π/2.
                let is_not_zero = is_odd | ((place >> 1) & 1).wrapping_sub(1);
                let one = (1.0 as $scalar).to_bits();
                let size = one ^ (is_odd & (one ^ FRAC_1_SQRT_2.to_bits()));
                let sign = (place.wrapping_add(1) << ($bits::BITS - 3)) & SIGN;
                $scalar::from_bits((size | sign) & is_not_zero)
            }

            /// Returns the angle nearest to a `near` that does not determine the octant.
            #[cold]
            fn angle_afar(sine: $scalar, cosine: $scalar, near: $scalar) -> $scalar {
                if sine == 0.0 && cosine == 0.0 {
                    return $scalar::NAN;
                }
                nearest_turn(angle(sine, cosine), near)
            }

            /// Returns the angle that differs from `angle` by whole turns and is nearest to `near` (rad).
            #[inline]
            pub fn nearest_turn(angle: $scalar, near: $scalar) -> $scalar {
                let gap = near - angle;
                if gap.abs() <= PI {
                    return angle;
                }
                angle + crate::$name::round(gap * (1.0 / TAU)) * TAU
            }
        }
    };
}

arctangents!(
    double, f64, u64;
    rounder: 6_755_399_441_055_744.0, quarter_rest: 3.061616997868383e-17,
    ordinary: 1e-290 to 1e307,
    bend: [
        0.3333333333333298,
        -0.1999999999990311,
        0.14285714276385547,
        -0.11111110659606666,
        0.0909089624363649,
        -0.0769207389053018,
        0.06663810351291395,
        -0.05858296891311183,
        0.05121995960854574,
        -0.04186474804083825,
        0.02743444999642423,
        -0.010116482732360559,
    ],
    |square, [c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11]| {
        // In independent pairs.
        let fourth = square * square;
        let eighth = fourth * fourth;
        let low = (c0 + square * c1) + fourth * (c2 + square * c3);
        let middle = (c4 + square * c5) + fourth * (c6 + square * c7);
        let high = (c8 + square * c9) + fourth * (c10 + square * c11);
        square * (low + eighth * (middle + eighth * high))
    },
    slight_bend: [
        0.3333333333333292,
        -0.19999999999873752,
        0.14285714272267291,
        -0.11111110395283973,
        0.09090886880563956,
        -0.0769187231230305,
        0.06661034789657813,
        -0.058333280116692414,
        0.04975930205904045,
        -0.036510629139443695,
        0.016265851216325327,
    ],
    |square, [c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10]| {
        // Two independent half polynomials: if f64 is computed in software, every operation counts.
        let fourth = square * square;
        let even = c0 + fourth * (c2 + fourth * (c4 + fourth * (c6 + fourth * (c8 + fourth * c10))));
        let odd = c1 + fourth * (c3 + fourth * (c5 + fourth * (c7 + fourth * c9)));
        square * even + fourth * odd
    }
);

arctangents!(
    single, f32, u32;
    rounder: 12_582_912.0, quarter_rest: -2.1855695e-8,
    ordinary: 1e-28 to 1e38,
    bend: [0.33333233, -0.19994168, 0.14174205, -0.10155718, 0.05125411],
    |square, [c0, c1, c2, c3, c4]| {
        let fourth = square * square;
        square * ((c0 + square * c1) + fourth * ((c2 + square * c3) + fourth * c4))
    },
    slight_bend: [0.33333305, -0.19997782, 0.14230172, -0.10494107, 0.05825629],
    |square, [c0, c1, c2, c3, c4]| {
        let fourth = square * square;
        square * ((c0 + square * c1) + fourth * ((c2 + square * c3) + fourth * c4))
    }
);
