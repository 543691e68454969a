//! Scalar types and their elementary functions, those of `linkwright-math`: equal bits with and without the standard
//! library, on every platform.
//!
//! Everything else in this crate, and all generated code, is written against [`Real`]. Generated code can also be
//! written against a type that implements [`Functions`].
//!
//! Sines, cosines and angles are within 1 and 2 ulp, in f64 and in f32, and f32 does without f64; `linkwright-math`
//! states the bounds. Arguments of `sin` and `cos` are in radians, all else is unitless.

use core::fmt::{Debug, Display, LowerExp};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

mod sealed {
    /// Restricts [`super::Real`] to the two scalars whose rounding the default settings are made for.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// Floating-point scalar of the runtime: `f32` or `f64`.
///
/// The trait is sealed, because tolerances and rounding levels are chosen for these two. `x.sin()` calls the standard
/// library if there is one; `Real::sin(x)` always has the bits of generated code:
///
/// ```
/// use linkwright::math::Real;
///
/// let (sine, cosine) = Real::sin_cos(0.5_f64);
/// assert!((sine * sine + cosine * cosine - 1.0).abs() < 1e-15);
/// assert_eq!(Real::angle_near(0.0, -1.0, 9.0_f64), 3.0 * core::f64::consts::PI);
/// ```
pub trait Real:
    sealed::Sealed
    + nalgebra::Scalar
    + Copy
    + Debug
    + Display
    + LowerExp
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// Additive identity.
    const ZERO: Self;
    /// Multiplicative identity.
    const ONE: Self;
    /// One half.
    const HALF: Self;
    /// Distance from 1 to the next larger number.
    const EPSILON: Self;
    /// Smallest positive normal number.
    const MIN_POSITIVE: Self;

    /// Returns the scalar nearest to `value`.
    fn from_f64(value: f64) -> Self;
    /// Returns this scalar as an `f64`, exactly.
    fn to_f64(self) -> f64;
    /// Magnitude.
    fn abs(self) -> Self;
    /// Square root; NaN for a negative argument.
    fn sqrt(self) -> Self;
    /// Sine of an angle in radians.
    fn sin(self) -> Self;
    /// Cosine of an angle in radians.
    fn cos(self) -> Self;
    /// Sine and cosine of an angle in radians, in this order.
    fn sin_cos(self) -> (Self, Self);
    /// Angle in (-π, π] of the vector (`abscissa`, `self`).
    fn atan2(self, abscissa: Self) -> Self;
    /// Angle nearest to `near` whose sine and cosine are `self` and `cosine`, or a common positive multiple of them.
    fn angle_near(self, cosine: Self, near: Self) -> Self;
    /// Angle that differs from `self` by whole turns and is nearest to `near`.
    fn nearest_turn(self, near: Self) -> Self;
    /// Exponential function.
    fn exp(self) -> Self;
    /// Natural logarithm; NaN for a negative argument, -∞ for zero.
    fn ln(self) -> Self;
    /// Power with a real exponent.
    fn powf(self, exponent: Self) -> Self;
    /// Length √(`self`² + `other`²) without intermediate overflow.
    fn hypot(self, other: Self) -> Self;
    /// Largest whole number that is not greater.
    fn floor(self) -> Self;
    /// Nearest whole number; halves away from zero.
    fn round(self) -> Self;
    /// True if the scalar is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// Larger of two scalars; the other one if one is NaN.
    fn max(self, other: Self) -> Self;
    /// Smaller of two scalars; the other one if one is NaN.
    fn min(self, other: Self) -> Self;
    /// Pair (m, e) with `self` = m · 2^e and |m| in [1/2, 1); (self, 0) for zero.
    fn significand_exponent(self) -> (Self, i32);
    /// `self` · 2^`exponent`; infinite or zero if the product leaves the range of the scalar.
    fn scale_by_power_of_two(self, exponent: i32) -> Self;
}

macro_rules! implement_real {
    ($scalar:ident, $functions:ident, { $($function:ident($($argument:ident: $type:ty),*) -> $output:ty;)* }) => {
        impl Real for $scalar {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const HALF: Self = 0.5;
            const EPSILON: Self = $scalar::EPSILON;
            const MIN_POSITIVE: Self = $scalar::MIN_POSITIVE;

            #[inline]
            fn from_f64(value: f64) -> Self {
                value as $scalar
            }
            #[inline]
            fn to_f64(self) -> f64 {
                self.into()
            }
            #[inline]
            fn is_finite(self) -> bool {
                $scalar::is_finite(self)
            }
            #[inline]
            fn max(self, other: Self) -> Self {
                $scalar::max(self, other)
            }
            #[inline]
            fn min(self, other: Self) -> Self {
                $scalar::min(self, other)
            }
            $(
                #[inline]
                fn $function(self $(, $argument: $type)*) -> $output {
                    linkwright_math::$functions::$function(self $(, $argument)*)
                }
            )*
        }
    };
}

macro_rules! implement_reals {
    ($($scalar:ident: $functions:ident;)*) => {
        $(
            implement_real!($scalar, $functions, {
                abs() -> Self;
                sqrt() -> Self;
                sin() -> Self;
                cos() -> Self;
                sin_cos() -> (Self, Self);
                atan2(abscissa: Self) -> Self;
                angle_near(cosine: Self, near: Self) -> Self;
                nearest_turn(near: Self) -> Self;
                exp() -> Self;
                ln() -> Self;
                powf(exponent: Self) -> Self;
                hypot(other: Self) -> Self;
                floor() -> Self;
                round() -> Self;
                significand_exponent() -> (Self, i32);
                scale_by_power_of_two(exponent: i32) -> Self;
            });
        )*
    };
}

implement_reals!(f64: double; f32: single;);

/// Elementary functions that generated code calls, each of which a program can replace.
///
/// A type implements the trait for its scalar, with the functions that differ; the others stay those of [`Real`]. The
/// option `math` of the generator is the path of the type.
///
/// ```
/// use linkwright::math::{Functions, Real};
///
/// /// Sines and cosines of the standard library.
/// pub struct Plain;
///
/// impl Functions<f64> for Plain {
///     fn sin_cos(angle: f64) -> (f64, f64) {
///         angle.sin_cos()
///     }
/// }
/// assert_eq!(Plain::sin_cos(0.5), 0.5_f64.sin_cos());
/// assert_eq!(Plain::sqrt(2.0), Real::sqrt(2.0_f64));
/// ```
///
/// The bits of a frame are then those of these functions, and so are its errors. [`Real::angle_near`] does not call
/// `atan2`: a type that replaces the arctangent replaces both, [`Functions::angle_near`] by
/// `Real::nearest_turn(Self::atan2(sine, cosine), near)`.
pub trait Functions<T: Real> {
    /// Magnitude.
    #[inline]
    fn abs(value: T) -> T {
        value.abs()
    }

    /// Sine of an angle in radians.
    #[inline]
    fn sin(angle: T) -> T {
        angle.sin()
    }

    /// Cosine of an angle in radians.
    #[inline]
    fn cos(angle: T) -> T {
        angle.cos()
    }

    /// Sine and cosine of an angle in radians, in this order.
    #[inline]
    fn sin_cos(angle: T) -> (T, T) {
        angle.sin_cos()
    }

    /// Square root; NaN for a negative argument.
    #[inline]
    fn sqrt(x: T) -> T {
        x.sqrt()
    }

    /// Angle in (-π, π] of the vector (`abscissa`, `ordinate`).
    #[inline]
    fn atan2(ordinate: T, abscissa: T) -> T {
        ordinate.atan2(abscissa)
    }

    /// Angle (rad) nearest to `near` with this sine and cosine, or a common positive multiple of them. NaN if both are
    /// zero.
    #[inline]
    fn angle_near(sine: T, cosine: T, near: T) -> T {
        sine.angle_near(cosine, near)
    }

    /// Exponential function.
    #[inline]
    fn exp(x: T) -> T {
        x.exp()
    }

    /// Natural logarithm; NaN for a negative argument, -∞ for zero.
    #[inline]
    fn ln(x: T) -> T {
        x.ln()
    }

    /// Power with a real exponent.
    #[inline]
    fn powf(base: T, exponent: T) -> T {
        base.powf(exponent)
    }

    /// Largest whole number that is not greater.
    #[inline]
    fn floor(x: T) -> T {
        x.floor()
    }
}

/// Angle nearest to `near` with this sine and cosine, for generated code.
#[doc(hidden)]
#[inline]
pub fn angle_near<T: Real>(sine: T, cosine: T, near: T) -> T {
    sine.angle_near(cosine, near)
}
