//! Numbers of several mechanisms.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// N numbers, each of a mechanism of its own. N is 8 in f64 and 16 in f32: as many as the widest registers hold.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Lanes<T, const N: usize>(pub [T; N]);

impl<T: Copy, const N: usize> Lanes<T, N> {
    /// Returns the same number in all lanes.
    #[inline(always)]
    pub const fn splat(value: T) -> Self {
        Self([value; N])
    }

    /// Changes the number of one lane; does nothing beyond the last one.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, value: T) {
        if let Some(place) = self.0.get_mut(lane) {
            *place = value;
        }
    }
}

macro_rules! operators {
    ($scalar:ident: $($name:ident, $function:ident, $sign:tt, $assign:tt;)*) => {
        $(
            impl<const N: usize> $name for Lanes<$scalar, N> {
                type Output = Self;

                #[inline(always)]
                fn $function(mut self, other: Self) -> Self {
                    for lane in 0..N {
                        self.0[lane] $assign other.0[lane];
                    }
                    self
                }
            }

            impl<const N: usize> $name<$scalar> for Lanes<$scalar, N> {
                type Output = Self;

                #[inline(always)]
                fn $function(mut self, other: $scalar) -> Self {
                    for lane in 0..N {
                        self.0[lane] $assign other;
                    }
                    self
                }
            }

            impl<const N: usize> $name<Lanes<$scalar, N>> for $scalar {
                type Output = Lanes<$scalar, N>;

                #[inline(always)]
                fn $function(self, other: Lanes<$scalar, N>) -> Lanes<$scalar, N> {
                    Lanes::splat(self) $sign other
                }
            }
        )*

        impl<const N: usize> Neg for Lanes<$scalar, N> {
            type Output = Self;

            #[inline(always)]
            fn neg(mut self) -> Self {
                for lane in 0..N {
                    self.0[lane] = -self.0[lane];
                }
                self
            }
        }
    };
}

operators!(f64: Add, add, +, +=; Sub, sub, -, -=; Mul, mul, *, *=; Div, div, /, /=;);
operators!(f32: Add, add, +, +=; Sub, sub, -, -=; Mul, mul, *, *=; Div, div, /, /=;);
