//! Declares the frames of a mechanism, with the estimate from which it is assembled.

/// Frame: the time, all coordinates with their rates and accelerations, the quantities of requested points, and other
/// numbers. Fields that are `drawn` are not zero in the estimate from which the mechanism is assembled.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_frame {
    (
        $(#[$docs:meta])*
        $name:ident(q, qd, qdd $(, $kept:ident)?) from ($pose:ident, $parameters:ident) { $($field:ident),* $(,)? }
        $(drawn { $($own:ident = $drawn:expr),* $(,)? })?
    ) => {
        $crate::generated::frame! {
            @define $(#[$docs])* $name from ($pose, $parameters) {
                /// Pose.
                pub q: Coordinates = Coordinates::REST,
                /// Rates of the coordinates.
                pub qd: Coordinates = Coordinates::REST,
                /// Accelerations of the coordinates.
                pub qdd: Coordinates = Coordinates::REST,
                $(
                    /// Parameters with which the points of this instant are computed.
                    $kept: Parameters = Parameters::NOMINAL,
                )?
                $($field: Scalar = 0.0,)*
            }
            { q = *$pose, $($kept = *$parameters,)? $($($own = $drawn,)*)? }
        }

        impl $name {
            const HOLDS_COORDINATES: bool = true;

            /// Coordinate with its rate and its acceleration.
            fn coordinate(&self, index: usize) -> Option<[Scalar; 3]> {
                let of = |values: &Coordinates| values.to_array().get(index).copied();
                Some([of(&self.q)?, of(&self.qd)?, of(&self.qdd)?])
            }

            /// Adds a multiple of the difference of two frames.
            fn add(&mut self, multiple: Scalar, frame: &Self, base: &Self) {
                for (sum, frame, base) in [
                    (&mut self.q, &frame.q, &base.q),
                    (&mut self.qd, &frame.qd, &base.qd),
                    (&mut self.qdd, &frame.qdd, &base.qdd),
                ] {
                    *sum = Coordinates::from_array($crate::generated::sum(
                        sum.to_array(),
                        multiple,
                        [frame.to_array(), base.to_array()],
                    ));
                }
                $(self.$field += multiple * (frame.$field - base.$field);)*
            }
        }
    };
    (
        $(#[$docs:meta])*
        $name:ident() from ($pose:ident, $parameters:ident) { $($field:ident),* $(,)? }
        $(drawn { $($own:ident = $drawn:expr),* $(,)? })?
    ) => {
        $crate::generated::frame! {
            @define $(#[$docs])* $name from ($pose, $parameters) { $($field: Scalar = 0.0,)* } { $($($own = $drawn,)*)? }
        }

        impl $name {
            const HOLDS_COORDINATES: bool = false;

            /// Returns `None`: frames hold requested quantities only.
            fn coordinate(&self, _index: usize) -> Option<[Scalar; 3]> {
                None
            }

            /// Adds a multiple of the difference of two frames.
            fn add(&mut self, multiple: Scalar, frame: &Self, base: &Self) {
                $(self.$field += multiple * (frame.$field - base.$field);)*
            }
        }
    };
    (
        @define $(#[$docs:meta])* $name:ident from ($pose:ident, $parameters:ident) {
            $($(#[$field_docs:meta])* $visible:vis $field:ident: $type:ty = $rest:expr,)*
        }
        { $($own:ident = $drawn:expr,)* }
    ) => {
        $(#[$docs])*
        #[allow(non_snake_case)]
        pub struct $name {
            /// Time t (s).
            pub t: Scalar,
            $($(#[$field_docs])* $visible $field: $type,)*
        }

        impl $name {
            const REST: Self = Self { t: 0.0, $($field: $rest,)* };

            /// Estimate before the first frame: a pose at rest.
            #[allow(clippy::needless_update)]
            fn estimate($pose: &Coordinates, $parameters: &<Loops as Blocks>::Parameters, t: Scalar) -> Self {
                let _ = ($pose, $parameters);
                Self { t, $($own: $drawn,)* ..Self::REST }
            }
        }
    };
}
