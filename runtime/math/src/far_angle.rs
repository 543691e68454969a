//! Reduces a positive angle that is large, or close to a multiple of π/2, to its quadrant and the distance from that
//! multiple.
//!
//! The method is that of M. Payne and R. Hanek (1983): an angle is a whole number m times a power of two. Of its
//! product with 2/π only the last two bits of the whole part and the fraction matter. They come from a few consecutive
//! bits of 2/π, whose position follows from the power. In whole numbers the product is exact up to the bits that were
//! omitted at the end. The least distance of any f64 from a multiple of π/2 is 2⁻⁶¹, of any f32 2⁻³¹. The fractions
//! below, of 128 and 64 bits, leave more of it than the scalar can hold.
//!
//! Infinities and NaN have no quadrant: their rest is NaN.

/// Multiple of π/2 next to an angle, modulo 4 in the last bits, and the difference of the angle from it, as an
/// unevaluated sum.
pub type Reduced<T> = (u32, T, T);

macro_rules! far_angle {
    (
        $(#[$docs:meta])*
        $name:ident, $scalar:ident, $word:ident, $wide:ident, $signed:ident;
        first: $first:literal, half_pi: $half_pi:literal, two_over_pi: $two_over_pi:expr
    ) => {
        $(#[$docs])*
        #[cold]
        #[inline(never)]
        pub fn $name(x: $scalar) -> Reduced<$scalar> {
            const WORD: u32 = $word::BITS;
            const DIGITS: u32 = $scalar::MANTISSA_DIGITS;
            const FRACTION: $word = (1 << (DIGITS - 1)) - 1;
            /// Bits of the exponent of the number 1.
            const BIAS: $word = $scalar::MAX_EXP as $word - 1;

            let bits = x.to_bits();
            let (exponent, m) = (bits >> (DIGITS - 1), (bits & FRACTION) | (FRACTION + 1));
            // Index of the first bits with a weight of 2 and less.
            let place = (exponent as usize).wrapping_sub($first);
            let words = place / WORD as usize;
            let window = $two_over_pi.get(words..words + 4);
            let (true, Some(&[a, b, c, d])) = (x.is_finite(), window) else {
                return (0, $scalar::NAN, $scalar::NAN);
            };
            let shift = place as u32 % WORD;
            let shifted = |high: $word, low: $word| {
                ((((high as $wide) << WORD | low as $wide) << shift) >> WORD) as $word
            };
            let [a, b, c] = [shifted(a, b), shifted(b, c), shifted(c, d)];
            let product = ((m.wrapping_mul(a) as $wide) << WORD)
                .wrapping_add(m as $wide * b as $wide)
                .wrapping_add((m as $wide * c as $wide) >> WORD);

            // Two bits before the point; the fraction as one of -1/2 to 1/2.
            let fraction = (product << 2) as $signed;
            let quadrant = (product >> (2 * WORD - 2)) as u32 + u32::from(fraction < 0);
            let magnitude = fraction.unsigned_abs();
            let leading = (magnitude | 1).leading_zeros();
            let leading_word = ((magnitude << leading) >> WORD) as $word;
            let rest = leading_word as $wide * $half_pi as $wide;
            let high = (rest >> (2 * WORD - DIGITS)) as $word;
            let low = (rest >> (2 * WORD - 2 * DIGITS)) as $word & (2 * FRACTION + 1);
            let power = |exponent: u32| $scalar::from_bits((BIAS + 1 - exponent as $word) << (DIGITS - 1));
            let sign = if fraction < 0 { -1.0 } else { 1.0 };
            (
                quadrant,
                high as $scalar * (sign * power(leading + DIGITS)),
                low as $scalar * (sign * power(leading + 2 * DIGITS)),
            )
        }
    };
}

/// Bits of 2/π, after 64 zeros.
const TWO_OVER_PI: [u64; 20] = [
    0x0000_0000_0000_0000,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
];

far_angle!(
    /// Reduces an f64 of 1/2 or more; the rest is within 2⁻⁶¹ of its magnitude.
    double, f64, u64, u128, i128;
    first: 1013, half_pi: 0xc90f_daa2_2168_c235, two_over_pi: TWO_OVER_PI
);

/// Bits of 2/π, after 32 zeros.
const TWO_OVER_PI_SHORT: [u32; 8] = [
    0x0000_0000,
    0xa2f9_836e,
    0x4e44_1529,
    0xfc27_57d1,
    0xf534_ddc0,
    0xdb62_9599,
    0x3c43_9041,
    0xfe51_63ab,
];

far_angle!(
    /// Reduces an f32 of 1/2 or more; the rest is within 2⁻²⁹ of its magnitude.
    single, f32, u32, u64, i64;
    first: 120, half_pi: 0xc90f_daa2, two_over_pi: TWO_OVER_PI_SHORT
);
