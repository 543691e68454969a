//! *A scalar* → *everything that generated modules are written with, in this scalar*.
//!
//! A generated module begins with `use linkwright::double::*;`, or `single` for f32: types have their scalar already, and what a
//! module does not mention costs nothing. The macros state what modules repeat.

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

            /// The scalar of everything in this module.
            pub type Scalar = $scalar;
            /// How close a block is to a singular pose.
            pub type NormalizedDeterminant = crate::NormalizedDeterminant<Scalar>;
            /// A failure with the name of its block.
            pub type FailureMessage = crate::FailureMessage<'static, Scalar>;
            /// A solve that did not succeed.
            pub type Failure = crate::Failure<Scalar>;
            /// A matrix of R rows and C columns.
            pub type Matrix<const R: usize, const C: usize> = crate::nalgebra::SMatrix<Scalar, R, C>;
            /// How far a block is from singular.
            pub type Measure = crate::Measure<Scalar>;
            /// Position, velocity and acceleration of a point.
            pub type PointMotion = crate::PointMotion<Scalar>;
            /// A point's name, and the method of the frames F that gives its motion.
            pub type NamedPoint<F> = (&'static str, fn(&F) -> PointMotion);
            /// The limits within which a solve must succeed.
            pub type Settings = crate::Settings<Scalar>;
            /// A quantity that is supplied with its rate and acceleration.
            pub type Signal = crate::Signal<Scalar>;
            /// A window of time about two frames.
            pub type TimeWindow = crate::TimeWindow<Scalar>;
            /// A straight line through the values of two frames, and how far a value may be from it.
            pub type PathEnclosure = crate::PathEnclosure<Scalar>;
            /// One Newton-Raphson step.
            pub type Step<const N: usize> = crate::Step<Scalar, Const<N>>;
            /// A smooth curve through N points.
            pub type Table<const N: usize> = crate::Table<N, Scalar>;
            /// A vector of N entries.
            pub type Vector<const N: usize> = crate::nalgebra::SVector<Scalar, N>;
        }
    };
}

pub(crate) use precision;
