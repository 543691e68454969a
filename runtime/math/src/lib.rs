//! Elementary functions of floating-point numbers, with the same bits on every platform.
//!
//! [`double`] is for f64, [`single`] for f32. Both contain the same functions, so that one can replace the other:
//!
//! | function | f64 | f32 |
//! |---|---|---|
//! | `sin`, `cos`, `sin_cos` | within 1 ulp | within 1 ulp |
//! | `atan2` | within 2 ulp | within 2 ulp |
//! | `angle_near` | within 2 ε of the angle's magnitude, or of π/4 where that is larger | the same |
//! | `sqrt`, `floor`, `round`, `abs` | exact or correctly rounded | the same |
//! | `exp`, `ln`, `powf`, `hypot` | those of `libm` | the same |
//!
//! One ulp is the distance of the two numbers between which the exact result lies. The bounds hold for all finite
//! arguments, including subnormal ones; the tests cover all arguments in f32, and dense samples in f64.
//!
//! `sines_cosines`, `arctangents` and `angles_near` do the same for arrays, without branches for ordinary arguments, so
//! that compilers vectorize them. Each number of an array has the bits of the function of one number.
//!
//! The functions of the first three rows are implemented here. They add, subtract, multiply, divide and read bits:
//! operations that no platform, standard library or optimizer may do in another way. A debug build, a microcontroller
//! with or without a floating-point unit and a WebAssembly module therefore agree to the last bit. In f32 they never
//! use f64, for which many microcontrollers have no instructions. None of them can panic.
//!
//! The runtime and the generator both use this crate, because numbers that are computed during generation must be those
//! that the code would compute.
#![doc(html_root_url = "https://docs.rs/linkwright-math/0.1.0")]
#![no_std]

mod arctangent;
mod borrowed;
mod far_angle;
mod lanes;
#[cfg(any(test, all(not(feature = "std"), target_abi = "eabihf")))]
mod root;
mod sine_cosine;

pub use lanes::Lanes;

/// True if the processor computes vectors.
const HAS_VECTORS: bool = cfg!(any(
    target_feature = "sse2",
    target_feature = "neon",
    target_feature = "simd128"
));

/// Functions of f64.
pub mod double {
    pub use crate::arctangent::double::*;
    pub use crate::borrowed::double::*;
    pub use crate::sine_cosine::double::*;
}

/// Functions of f32, which use no f64.
pub mod single {
    pub use crate::arctangent::single::*;
    pub use crate::borrowed::single::*;
    pub use crate::sine_cosine::single::*;
}

#[cfg(test)]
mod tests {
    use super::{double, single};

    /// Pseudorandom numbers of 64 bits: a linear congruence (D. Knuth's), of which the upper bits are taken twice.
    struct Sequence(u64);

    impl Sequence {
        fn word(&mut self) -> u64 {
            let mut upper = || {
                self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
                self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
                self.0 >> 32
            };
            upper() << 32 | upper()
        }
    }

    /// Hash of all the bits of many results (Fowler, Noll and Vo).
    fn digest() -> u64 {
        let mut digest = 0xcbf2_9ce4_8422_2325_u64;
        let mut add = |bits: u64| digest = (digest ^ bits).wrapping_mul(0x0100_0000_01b3);
        let mut sequence = Sequence(14);
        for _ in 0..20_000 {
            let (a, b) = (sequence.word(), sequence.word());
            // Up to 2^18 and below, and any finite number.
            let of_size = |word: u64, size: u64| {
                f64::from_bits((word & !(0x7ff << 52)) | (1023 - 32 + word % size) << 52)
            };
            let any = f64::from_bits(a & !(1 << 62));
            for angle in [of_size(a, 50), any] {
                let (sine, cosine) = double::sin_cos(angle);
                add(sine.to_bits());
                add(cosine.to_bits());
                let (sine, cosine) = single::sin_cos(angle as f32);
                if sine.is_finite() {
                    add(sine.to_bits().into());
                    add(cosine.to_bits().into());
                }
            }
            let (y, x, near) = (of_size(a, 40), of_size(b, 40), of_size(a ^ b, 40));
            add(double::atan2(y, x).to_bits());
            add(double::angle_near(y, x, near).to_bits());
            let (y, x, near) = (y as f32, x as f32, near as f32);
            add(single::atan2(y, x).to_bits().into());
            add(single::angle_near(y, x, near).to_bits().into());
            add(double::sqrt(y.abs().into()).to_bits());
            add(single::sqrt(y.abs()).to_bits().into());
        }
        digest
    }

    /// The digest is equal on every platform, with and without the standard library, optimized or not. An intended
    /// change of the functions changes it.
    #[test]
    fn the_bits_are_those_of_every_other_platform() {
        assert_eq!(digest(), 0xe142_8d95_b9b7_8851);
    }

    /// Numbers of all sizes, also subnormal, infinite and NaN, and multiples of π/4 with neighbors.
    fn numbers(sequence: &mut Sequence) -> f64 {
        let word = sequence.word();
        let near = core::f64::consts::FRAC_PI_4 * ((word >> 20) % 64) as f64;
        let specials = [
            0.0,
            -0.0,
            f64::INFINITY,
            f64::NAN,
            f64::MIN_POSITIVE / 4.0,
            1e300,
            near,
            near.next_up(),
        ];
        match word % 4 {
            0 => specials[(word >> 8) as usize % specials.len()],
            1 => f64::from_bits(sequence.word()),
            _ => (word >> 11) as f64 / (1_u64 << 50) as f64 - 4.0,
        }
    }

    /// Compares functions of arrays with those of their numbers, for arrays of this length.
    macro_rules! compare_arrays {
        ($name:ident, $scalar:ident, $count:literal) => {
            let mut sequence = Sequence(35);
            for _ in 0..100_000 {
                let [a, b, near]: [[$scalar; $count]; 3] = core::array::from_fn(|_| {
                    core::array::from_fn(|_| numbers(&mut sequence) as $scalar)
                });
                let [sines, cosines] = $name::sines_cosines(a);
                let arctangents = $name::arctangents(a, b);
                let angles = $name::angles_near(a, b, near);
                for lane in 0..$count {
                    let (sine, cosine) = $name::sin_cos(a[lane]);
                    let arctangent = $name::atan2(a[lane], b[lane]);
                    let angle = $name::angle_near(a[lane], b[lane], near[lane]);
                    let pairs = [
                        (sines[lane], sine),
                        (cosines[lane], cosine),
                        (arctangents[lane], arctangent),
                        (angles[lane], angle),
                    ];
                    for (one, other) in pairs {
                        let is_equal = one.to_bits() == other.to_bits();
                        assert!(
                            is_equal || one.is_nan() && other.is_nan(),
                            "{:?} {:?} {:?}: {one:?} {other:?}",
                            a[lane],
                            b[lane],
                            near[lane]
                        );
                    }
                }
            }
        };
    }

    #[test]
    fn arrays_have_the_bits_of_their_numbers() {
        compare_arrays!(double, f64, 8);
        compare_arrays!(single, f32, 16);
        compare_arrays!(double, f64, 1);
    }
}
