//! Items that generated modules and the interpreter call; no part of the public interface.
//!
//! A generated module begins with `use linkwright::generated::double::*;`, or `single` for f32. Types have their
//! scalar already, and unused items cost nothing. The macros contain the code that modules repeat. All of it may change
//! with every release, together with the generator.

mod assemblies;
mod branches;
mod equations;
mod frame;
mod lane_structures;
pub mod lanes;
mod mechanism;
mod numbers;
mod textbook;

// Exported macros are items of the root, where these names keep them apart.
pub use crate::{
    generated_assemblies as assemblies, generated_branches as branches,
    generated_constants as constants, generated_coordinates as coordinates,
    generated_drawing as drawing, generated_equations as equations, generated_frame as frame,
    generated_held as held, generated_inputs as inputs, generated_lane_values as lane_values,
    generated_mechanism as mechanism, generated_only as only, generated_or_drawn as or_drawn,
    generated_or_unit as or_unit, generated_parameters as parameters,
    generated_parametric as parametric, generated_path as path, generated_read_lanes as read_lanes,
    generated_textbook as textbook, generated_values as values,
};

pub use crate::block::Start;
pub use crate::block_equations::BlockEquations;
pub use crate::blocks::{Conditions, first_not_positive, sum};
pub use crate::chain_isolation::{isolate_chain, isolate_whole_chain};
pub use crate::closed_form::{
    Mode, all_finite, exceeds_rounding, failed, load_not_finite, not_finite, not_positive,
    out_of_reach, singular_divisor,
};
pub use crate::contact::pressure_angle;
pub use crate::friction::friction;
pub use crate::guard::Pair;
pub use crate::isolation::{Chord, isolate, isolate_all};
pub use crate::linear::{Factorization, Measure};
pub use crate::multipliers::multipliers;
pub use crate::scale::{Scales, largest_length};
pub use crate::substeps::{Broken, in_steps};
pub use crate::table::Table;
pub use crate::time_window::{PathEnclosure, TimeWindow, required};
pub use crate::torn::Torn;

/// Solution of a block from the last frame.
pub mod block {
    pub use crate::block::{solve, solve_measured};
}

/// Newton-Raphson with line search, for rough estimates.
pub mod damped {
    pub use crate::damped::{SHORTENINGS, solve_damped};
}

/// Frames of one block, and the factorization of its Jacobian.
pub mod kinematics {
    pub use crate::kinematics::{Frame, factorize};
}

/// Friction in any number of joints.
pub mod friction {
    pub use crate::friction::{STEPS, settle};
}

/// Damped least squares, for rough estimates.
pub mod least_squares {
    pub use crate::least_squares::{STEPS, approach};
}

/// Multipliers of a block of any size.
pub mod multipliers {
    pub use crate::multipliers::solve;
}

/// Newton-Raphson and its thresholds.
pub mod newton {
    pub use crate::newton::{
        Convergence, GROWING_STEPS, LARGEST_GROWTH, NOISE, ROUNDING, Step, solve, step,
    };
}

/// Steps along a path.
pub mod path {
    pub use crate::path::step;
}

/// Newton-Raphson on the tearing variables of a block.
pub mod torn {
    pub use crate::torn::{
        Completion, EVALUATIONS, Evaluation, Found, Memory, largest_of, sign, solve,
    };
}

macro_rules! precision {
    ($(#[$docs:meta])* $name:ident, $scalar:ident, $types:path) => {
        $(#[$docs])*
        pub mod $name {
            // Public types under the names for which `rustdoc` has pages.
            pub use $types::{Failure, NormalizedDeterminant, PointMotion, Settings, Signal};
            pub use crate::generated::{
                BlockEquations, Chord, Factorization, Start, Torn, all_finite, block, exceeds_rounding, friction, isolate,
                isolate_chain, kinematics, largest_length, load_not_finite, multipliers, newton, not_finite,
                not_positive, out_of_reach, pressure_angle, required, singular_divisor, torn,
            };
            // A type in place of `math` has the functions by their trait.
            pub use crate::math::{Functions as _, Real as math, angle_near};
            pub use linkwright_math::$name::two_angles_near;
            pub use crate::{BlockName, Blocks, Branch, Mechanism, Shell, nalgebra::Const};

            /// Scalar of everything in this module.
            pub type Scalar = $scalar;
            /// Failure with the name of its block.
            pub type FailureMessage = crate::FailureMessage<'static, Scalar>;
            /// Matrix of R rows and C columns.
            pub type Matrix<const R: usize, const C: usize> = crate::nalgebra::SMatrix<Scalar, R, C>;
            /// Distance of a block's Jacobian from singular.
            pub type Measure = crate::generated::Measure<Scalar>;
            /// Name of a point, and the method of the frames F that returns its motion.
            pub type NamedPoint<F> = (&'static str, fn(&F) -> PointMotion);
            /// Window of time about two frames.
            pub type TimeWindow = crate::generated::TimeWindow<Scalar>;
            /// Chord through the values of two frames, with a bound on the deviation from it.
            pub type PathEnclosure = crate::generated::PathEnclosure<Scalar>;
            /// Range of a parameter or an input.
            pub type ValueRange = crate::ValueRange<'static, Scalar>;
            /// One Newton-Raphson step.
            pub type Step<const N: usize> = crate::generated::newton::Step<Scalar, Const<N>>;
            /// Smooth curve through N points.
            pub type Table<const N: usize> = crate::generated::Table<N, Scalar>;
            /// Vector of N entries.
            pub type Vector<const N: usize> = crate::nalgebra::SVector<Scalar, N>;
        }
    };
}

precision!(
    /// Types and functions of generated modules in f64.
    double,
    f64,
    crate
);
precision!(
    /// Types and functions of generated modules in f32.
    single,
    f32,
    crate::single
);
