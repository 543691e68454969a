//! Items that modules `lanes` call.

pub use crate::generated_lanes as structures;
pub use crate::lanes::{Conditions, LaneValues, ReadLanes, Zero};

macro_rules! precision {
    ($(#[$docs:meta])* $name:ident, $scalar:ident, $count:literal) => {
        $(#[$docs])*
        pub mod $name {
            pub use crate::Blocks;
            pub use crate::generated::lanes::{LaneValues as _, ReadLanes as _, Zero as _};
            pub use crate::lanes::elementary::$name::{angle_near, math};
            pub use crate::lanes::elementary::{
                choose, exceeds_rounding, friction, less, lookup, multipliers, negative, not_finite, not_positive,
            };

            /// Numbers of all lanes.
            pub type Lanes = crate::lanes::Lanes<$scalar, $count>;
            /// Set of lanes.
            pub type Mask = crate::lanes::Mask<$count>;
            /// Windows of time about two frames of all lanes.
            pub type TimeWindow = crate::generated::TimeWindow<Lanes>;
            /// Signals of all lanes.
            pub type Signals = crate::Signal<Lanes>;

            /// Returns the same number in all lanes.
            #[inline(always)]
            pub const fn lanes(value: $scalar) -> Lanes {
                Lanes::splat(value)
            }
        }
    };
}

precision!(
    /// Types and functions of lanes of f64.
    double,
    f64,
    8
);
precision!(
    /// Types and functions of lanes of f32.
    single,
    f32,
    16
);
