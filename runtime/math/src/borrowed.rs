//! Functions of the standard library and of `libm`.
//!
//! Square roots and whole numbers are exact or correctly rounded in every library. They therefore come from the
//! standard library if it is there, which uses the processor's instructions. The other functions differ in their last
//! bits from library to library; they always come from `libm`.

#[cfg(feature = "std")]
extern crate std;

/// Functions with the same bits in every library.
#[cfg(not(feature = "std"))]
mod exact {
    pub use libm::{floor, floorf, round, roundf, sqrt};

    // On processors that multiply f32, its products are faster than the integers of `libm`.
    #[cfg(target_abi = "eabihf")]
    pub use crate::root::sqrt as sqrtf;
    #[cfg(not(target_abi = "eabihf"))]
    pub use libm::sqrtf;
}

macro_rules! borrowed {
    ($name:ident, $scalar:ident {
        exact: { $($exact:ident = $exact_free:ident: $exact_docs:literal;)* }
        rounded: { $($function:ident($($argument:ident),*) = $free:ident: $docs:literal;)* }
        $frexp:ident, $ldexp:ident
    }) => {
        pub mod $name {
            $(
                #[doc = $exact_docs]
                #[inline]
                pub fn $exact(x: $scalar) -> $scalar {
                    #[cfg(feature = "std")]
                    return x.$exact();
                    #[cfg(not(feature = "std"))]
                    return super::exact::$exact_free(x);
                }
            )*
            $(
                #[doc = $docs]
                #[inline]
                pub fn $function($($argument: $scalar),*) -> $scalar {
                    libm::$free($($argument),*)
                }
            )*

            /// Returns the magnitude.
            #[inline]
            pub fn abs(x: $scalar) -> $scalar {
                x.abs()
            }

            /// Returns the pair (m, e) with x = m · 2^e and |m| in [1/2, 1); (x, 0) for zero.
            #[inline]
            pub fn significand_exponent(x: $scalar) -> ($scalar, i32) {
                libm::$frexp(x)
            }

            /// Returns x · 2^`exponent`; infinite or zero if the product leaves the range of the scalar.
            #[inline]
            pub fn scale_by_power_of_two(x: $scalar, exponent: i32) -> $scalar {
                libm::$ldexp(x, exponent)
            }
        }
    };
}

borrowed!(double, f64 {
    exact: {
        sqrt = sqrt: "The square root; NaN for a negative argument.";
        floor = floor: "The largest whole number that is not greater.";
        round = round: "The nearest whole number; halves away from zero.";
    }
    rounded: {
        exp(x) = exp: "The exponential function.";
        ln(x) = log: "The natural logarithm; NaN for a negative argument, -∞ for zero.";
        powf(base, exponent) = pow: "The power with a real exponent.";
        hypot(x, y) = hypot: "The length √(x² + y²) without intermediate overflow.";
    }
    frexp, ldexp
});

borrowed!(single, f32 {
    exact: {
        sqrt = sqrtf: "The square root; NaN for a negative argument.";
        floor = floorf: "The largest whole number that is not greater.";
        round = roundf: "The nearest whole number; halves away from zero.";
    }
    rounded: {
        exp(x) = expf: "The exponential function.";
        ln(x) = logf: "The natural logarithm; NaN for a negative argument, -∞ for zero.";
        powf(base, exponent) = powf: "The power with a real exponent.";
        hypot(x, y) = hypotf: "The length √(x² + y²) without intermediate overflow.";
    }
    frexpf, ldexpf
});
