//! Declares the items with which generated modules are written, for each scalar.
//!
//! A generated module begins with `use linkwright::double::*;`, or `single` for f32. Types have their scalar already,
//! and unused items cost nothing. The macros contain the code that modules repeat.

mod assemblies;
mod branches;
mod equations;
mod frame;
mod mechanism;
mod numbers;
mod textbook;

macro_rules! precision {
    ($(#[$docs:meta])* $name:ident, $scalar:ident) => {
        $(#[$docs])*
        pub mod $name {
            pub use crate::chain_isolation::isolate_chain;
            pub use crate::closed_form::{
                all_finite, load_not_finite, out_of_reach, not_finite, not_positive, singular_divisor, exceeds_rounding,
            };
            pub use crate::contact::pressure_angle;
            pub use crate::linear::Factorization;
            pub use crate::math::angle_near;
            pub use crate::multipliers::multipliers;
            pub use crate::scale::largest_length;
            pub use crate::isolation::{Chord, isolate};
            pub use crate::time_window::required;
            pub use crate::{
                BlockEquations, BlockName, Blocks, Branch, Mechanism, Shell, Start, block, kinematics, math, newton,
                nalgebra::Const, torn, torn::Torn,
            };

            /// Scalar of everything in this module.
            pub type Scalar = $scalar;
            /// Distance of a block from a singular pose.
            pub type NormalizedDeterminant = crate::NormalizedDeterminant<Scalar>;
            /// Failure with the name of its block.
            pub type FailureMessage = crate::FailureMessage<'static, Scalar>;
            /// Failure of a solve.
            pub type Failure = crate::Failure<Scalar>;
            /// Matrix of R rows and C columns.
            pub type Matrix<const R: usize, const C: usize> = crate::nalgebra::SMatrix<Scalar, R, C>;
            /// Distance of a block's Jacobian from singular.
            pub type Measure = crate::Measure<Scalar>;
            /// Position, velocity and acceleration of a point.
            pub type PointMotion = crate::PointMotion<Scalar>;
            /// Name of a point, and the method of the frames F that returns its motion.
            pub type NamedPoint<F> = (&'static str, fn(&F) -> PointMotion);
            /// Limits within which a solve must succeed.
            pub type Settings = crate::Settings<Scalar>;
            /// Quantity that is supplied with its rate and acceleration.
            pub type Signal = crate::Signal<Scalar>;
            /// Window of time about two frames.
            pub type TimeWindow = crate::TimeWindow<Scalar>;
            /// Chord through the values of two frames, with a bound on the deviation from it.
            pub type PathEnclosure = crate::PathEnclosure<Scalar>;
            /// One Newton-Raphson step.
            pub type Step<const N: usize> = crate::Step<Scalar, Const<N>>;
            /// Smooth curve through N points.
            pub type Table<const N: usize> = crate::Table<N, Scalar>;
            /// Vector of N entries.
            pub type Vector<const N: usize> = crate::nalgebra::SVector<Scalar, N>;
        }
    };
}

pub(crate) use precision;
