//! Functions of all lanes that generated code calls, with the bits of those of one number.
//!
//! A check returns at least the lanes that the check of one number rejects.

use core::ops::{Add, Mul};

use super::{Lanes, Mask};
use crate::closed_form;
use crate::friction::friction as friction_of_one;
use crate::math::Real;
use crate::multipliers::multipliers as multipliers_of_one;
use crate::table::Table;

macro_rules! functions {
    ($(#[$docs:meta])* $name:ident, $scalar:ident) => {
        $(#[$docs])*
        pub mod $name {
            use crate::lanes::Lanes;
            use crate::math::Real;
            use linkwright_math::$name as functions;

            /// Elementary functions of all lanes.
            #[allow(non_camel_case_types)]
            pub trait math: Sized {
                /// Sine and cosine of angles in radians.
                fn sin_cos(self) -> (Self, Self);
                /// Sine of angles in radians.
                fn sin(self) -> Self;
                /// Cosine of angles in radians.
                fn cos(self) -> Self;
                /// Angles of vectors.
                fn atan2(self, abscissa: Self) -> Self;
                /// Square root.
                fn sqrt(self) -> Self;
                /// Magnitude.
                fn abs(self) -> Self;
                /// Largest whole number that is not greater.
                fn floor(self) -> Self;
                /// Exponential function.
                fn exp(self) -> Self;
                /// Natural logarithm.
                fn ln(self) -> Self;
                /// Power with a real exponent.
                fn powf(self, exponent: Self) -> Self;
            }

            impl<const N: usize> math for Lanes<$scalar, N> {
                #[inline(always)]
                fn sin_cos(self) -> (Self, Self) {
                    let [sines, cosines] = functions::sines_cosines(self.0);
                    (Self(sines), Self(cosines))
                }
                #[inline(always)]
                fn sin(self) -> Self {
                    math::sin_cos(self).0
                }
                #[inline(always)]
                fn cos(self) -> Self {
                    math::sin_cos(self).1
                }
                #[inline(always)]
                fn atan2(self, abscissa: Self) -> Self {
                    Self(functions::arctangents(self.0, abscissa.0))
                }
                #[inline(always)]
                fn sqrt(self) -> Self {
                    each(self, Real::sqrt)
                }
                #[inline(always)]
                fn abs(self) -> Self {
                    each(self, Real::abs)
                }
                #[inline(always)]
                fn floor(self) -> Self {
                    each(self, Real::floor)
                }
                #[inline(always)]
                fn exp(self) -> Self {
                    each(self, Real::exp)
                }
                #[inline(always)]
                fn ln(self) -> Self {
                    each(self, Real::ln)
                }
                #[inline(always)]
                fn powf(mut self, exponent: Self) -> Self {
                    for lane in 0..N {
                        self.0[lane] = Real::powf(self.0[lane], exponent.0[lane]);
                    }
                    self
                }
            }

            #[inline(always)]
            fn each<const N: usize>(
                mut lanes: Lanes<$scalar, N>,
                function: impl Fn($scalar) -> $scalar,
            ) -> Lanes<$scalar, N> {
                for lane in 0..N {
                    lanes.0[lane] = function(lanes.0[lane]);
                }
                lanes
            }

            /// Returns the angles with these sines and cosines that are nearest to the angles `near`.
            #[inline(always)]
            pub fn angle_near<const N: usize>(
                sine: Lanes<$scalar, N>,
                cosine: Lanes<$scalar, N>,
                near: Lanes<$scalar, N>,
            ) -> Lanes<$scalar, N> {
                Lanes(functions::angles_near(sine.0, cosine.0, near.0))
            }
        }
    };
}

functions!(
    /// Functions of lanes of f64.
    double,
    f64
);
functions!(
    /// Functions of lanes of f32.
    single,
    f32
);

/// Returns the lanes whose half chord is a normal number and safely positive.
#[inline(always)]
pub fn exceeds_rounding<T: Real, const N: usize>(
    excess: Lanes<T, N>,
    scale: Lanes<T, N>,
) -> Mask<N> {
    Mask::of(|lane| closed_form::exceeds_rounding(excess.0[lane], scale.0[lane]))
}

/// Returns the lanes whose length is not positive.
#[inline(always)]
pub fn not_positive<T: Real, const N: usize>(length: Lanes<T, N>) -> Mask<N> {
    !less(Lanes::splat(T::ZERO), length)
}

/// Returns the lanes whose value is negative or NaN.
#[inline(always)]
pub fn negative<T: Real, const N: usize>(value: Lanes<T, N>) -> Mask<N> {
    !Mask::of(|lane| value.0[lane] >= T::ZERO)
}

/// Returns the lanes in which some value is infinite or NaN: zero times such a value is NaN.
#[inline(always)]
pub fn not_finite<T: Real, const N: usize, const K: usize>(values: [&Lanes<T, N>; K]) -> Mask<N>
where
    Lanes<T, N>: Add<Output = Lanes<T, N>> + Mul<T, Output = Lanes<T, N>>,
{
    let mut sums = [Lanes::splat(T::ZERO); 4];
    for (place, value) in values.into_iter().enumerate() {
        sums[place % 4] = sums[place % 4] + *value * T::ZERO;
    }
    let [a, b, c, d] = sums;
    let sum = (a + b) + (c + d);
    Mask::of(|lane| sum.0[lane] != T::ZERO)
}

/// Returns the lanes in which the first number is less.
#[inline(always)]
pub fn less<T: Real, const N: usize>(one: Lanes<T, N>, other: Lanes<T, N>) -> Mask<N> {
    Mask::of(|lane| one.0[lane] < other.0[lane])
}

/// Returns the first number in the lanes of a set, and the second one elsewhere.
#[inline(always)]
pub fn choose<T: Real, const N: usize>(
    lanes: Mask<N>,
    mut one: Lanes<T, N>,
    other: Lanes<T, N>,
) -> Lanes<T, N> {
    for lane in 0..N {
        if !lanes.has(lane) {
            one.0[lane] = other.0[lane];
        }
    }
    one
}

/// Returns the values of a table and their first three derivatives.
#[inline(always)]
pub fn lookup<T: Real, const N: usize, const K: usize>(
    table: &Table<K, T>,
    places: Lanes<T, N>,
) -> [Lanes<T, N>; 4] {
    let mut values = [Lanes::splat(T::ZERO); 4];
    for lane in 0..N {
        for (values, value) in values.iter_mut().zip(table.at(places.0[lane])) {
            values.0[lane] = value;
        }
    }
    values
}

/// Returns the multipliers of all lanes, and the lanes whose Jacobian is singular or not finite.
pub fn multipliers<T: Real, const N: usize, const K: usize>(
    jacobian: [[Lanes<T, N>; K]; K],
    forces: [Lanes<T, N>; K],
) -> ([Lanes<T, N>; K], Mask<N>) {
    let mut multipliers = [Lanes::splat(T::ZERO); K];
    let singular = Mask::of(|lane| {
        let rows = jacobian.map(|row| row.map(|entry| entry.0[lane]));
        match multipliers_of_one(rows, forces.map(|force| force.0[lane]), T::ZERO, 0) {
            Ok(solution) => {
                for (multiplier, value) in multipliers.iter_mut().zip(solution) {
                    multiplier.0[lane] = value;
                }
                false
            }
            Err(_) => true,
        }
    });
    (multipliers, singular)
}

/// Returns the forces of friction of all lanes, and the lanes in which they do not settle.
pub fn friction<T: Real, const N: usize, const K: usize>(
    pins: usize,
    coefficients: [Lanes<T, N>; K],
    alone: [[Lanes<T, N>; 2]; K],
    units: [[[Lanes<T, N>; 2]; K]; K],
) -> ([Lanes<T, N>; K], Mask<N>) {
    let mut forces = [Lanes::splat(T::ZERO); K];
    let unsettled = Mask::of(|lane| {
        let of = |values: [Lanes<T, N>; 2]| values.map(|it| it.0[lane]);
        let (coefficients, alone) = (coefficients.map(|it| it.0[lane]), alone.map(of));
        let units = units.map(|joint| joint.map(of));
        match friction_of_one(pins, coefficients, alone, units, T::ZERO, 0) {
            Ok(settled) => {
                for (force, value) in forces.iter_mut().zip(settled) {
                    force.0[lane] = value;
                }
                false
            }
            Err(_) => true,
        }
    });
    (forces, unsettled)
}
