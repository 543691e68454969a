//! A floating-point number → its sine and cosine, the angle of a vector and the other elementary functions, with the same bits
//! everywhere.
//!
//! [`double`] is for f64, [`single`] for f32. Both hold the same functions, so that one stands in for the other:
//!
//! | function | f64 | f32 |
//! |---|---|---|
//! | `sin`, `cos`, `sin_cos` | within 1 ulp | within 1 ulp |
//! | `atan2` | within 2 ulp | within 2 ulp |
//! | `angle_near` | within 2 ε of the angle's magnitude, or of π/4 where that is larger | the same |
//! | `sqrt`, `floor`, `round`, `abs` | exact or correctly rounded | the same |
//! | `exp`, `ln`, `powf`, `hypot` | those of `libm` | the same |
//!
//! One ulp is the distance of the two numbers between which the exact result lies. The bounds hold for all finite arguments,
//! subnormal ones included; the tests look at all arguments in f32, and at dense samples in f64.
//!
//! The functions of the first three rows are this crate's own. They add, subtract, multiply, divide and look at bits: nothing
//! that a platform, the standard library or the optimizer may do in another way, so that a debug build, a microcontroller with
//! or without a floating-point unit and a WebAssembly module agree to the last bit. In f32 they never use f64, which many
//! microcontrollers have no instructions for. None of them can panic.
//!
//! The crate does not know mechanisms. It stands below both the runtime and the generator, because numbers that are computed
//! while code is generated must be those that the code would compute.
#![no_std]

mod arctangent;
mod borrowed;
mod far_angle;
mod sine_cosine;

/// The functions of f64.
pub mod double {
    pub use crate::arctangent::double::*;
    pub use crate::borrowed::double::*;
    pub use crate::sine_cosine::double::*;
}

/// The functions of f32, which take no f64.
pub mod single {
    pub use crate::arctangent::single::*;
    pub use crate::borrowed::single::*;
    pub use crate::sine_cosine::single::*;
}
