//! Declares structures with the values of several mechanisms.

/// Structures of a module `lanes`, and the implementation of `InLanes` by its function `solve`.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_lanes {
    (
        $count:literal lanes;
        path: $path:ident;
        $(Coordinates { $($coordinate:ident),* $(,)? })?
        Frame($($held:ident),*) { $($field:ident),* $(,)? }
        Branches { $($branch:ident),* $(,)? }
        Parameters { $($parameter:ident),* $(,)? }
        Inputs { $($input:ident),* $(,)? }
    ) => {
        $(
            $crate::generated::read_lanes! {
                /// Coordinates of all lanes.
                Coordinates of super::Coordinates { $($coordinate: Lanes,)* }
            }
        )?

        $crate::generated::read_lanes! {
            /// Frames of all lanes.
            Frame of super::Frame {
                t: Lanes,
                $($held: $crate::generated::held!($held),)*
                $($field: Lanes,)*
            }
        }

        $crate::generated::lane_values! {
            /// Signs of the assembly modes of all lanes.
            Branches of super::Branches { $($branch: Lanes,)* }
        }

        $crate::generated::read_lanes! {
            /// Parameters of all lanes.
            Parameters of <Loops as Blocks>::Parameters { $($parameter: Lanes,)* }
        }

        $crate::generated::lane_values! {
            /// Inputs of all lanes.
            Inputs of <Loops as Blocks>::Inputs { $($input: Signals,)* }
        }

        /// Data with which one instant of all lanes is solved.
        type Conditions<'a> = $crate::generated::lanes::Conditions<'a, Lanes, Parameters, Inputs>;

        /// Mechanisms that move in step.
        pub type Group = $crate::lanes::Group<Loops, $count>;

        impl $crate::lanes::InLanes<$count> for Loops {
            type Frames = Frame;
            type Signs = Branches;
            type ParameterLanes = Parameters;
            type InputLanes = Inputs;

            fn lanes(&self) -> (Frame, Branches, Parameters, Inputs) {
                (Frame::ZERO, Branches::ZERO, Parameters::ZERO, Inputs::ZERO)
            }

            #[inline(always)]
            fn solve_lanes(
                &self,
                at: &mut Frame,
                last: &Frame,
                signs: &Branches,
                conditions: &Conditions<'_>,
            ) -> Mask {
                solve(at, last, signs, conditions)
            }

            #[allow(unused_variables)]
            #[inline(always)]
            fn verify_lanes(
                &self,
                at: &mut Frame,
                last: &Frame,
                window: &TimeWindow,
                parameters: &Parameters,
            ) -> Mask {
                $crate::generated::path!(@stays_in_lanes $path, at, last, window, parameters)
            }
        }
    };
}

/// Type of a field that a frame holds.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_held {
    (parameters) => {
        Parameters
    };
    ($vector:ident) => {
        Coordinates
    };
}

/// Structure whose fields are lanes of those of another one.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_lane_values {
    ($(#[$docs:meta])* $name:ident of $values:ty { $($field:ident: $kind:ty,)* }) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug)]
        #[allow(dead_code, non_snake_case)]
        pub struct $name {
            $(
                #[allow(missing_docs)]
                pub $field: $kind,
            )*
        }

        impl $crate::generated::lanes::Zero for $name {
            const ZERO: Self = Self { $($field: <$kind as $crate::generated::lanes::Zero>::ZERO,)* };
        }

        impl $crate::generated::lanes::LaneValues<$values> for $name {
            #[allow(unused_variables)]
            fn set_lane(&mut self, lane: usize, values: &$values) {
                $(self.$field.set_lane(lane, &values.$field);)*
            }
        }
    };
}

/// Structure of lanes that are read again.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_read_lanes {
    ($(#[$docs:meta])* $name:ident of $values:ty { $($field:ident: $kind:ty,)* }) => {
        $crate::generated::lane_values! { $(#[$docs])* $name of $values { $($field: $kind,)* } }

        impl $crate::generated::lanes::ReadLanes<$values> for $name {
            #[allow(unused_variables)]
            fn get_lane(&self, lane: usize, values: &mut $values) {
                $(self.$field.get_lane(lane, &mut values.$field);)*
            }
        }
    };
}
