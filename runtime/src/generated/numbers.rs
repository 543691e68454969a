//! Declares constants, and the structures of coordinates, parameters and signals.

/// Rounded values of exact constants.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_constants {
    ($($name:ident = $value:expr,)*) => {
        $(
            #[allow(clippy::approx_constant)]
            const $name: Scalar = $value;
        )*
    };
}

/// Structure with a number for each coordinate, its names, and its values in the design configuration.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_coordinates {
    (
        $(#[$docs:meta])*
        $name:ident: $scalar:ident {
            $($(#[$field_docs:meta])* $field:ident = $drawn:expr,)*
        }
    ) => {
        $(#[$docs])*
        #[repr(C)]
        #[allow(non_snake_case)]
        pub struct $name {
            $($(#[$field_docs])* pub $field: $scalar,)*
        }

        #[allow(dead_code, non_snake_case, clippy::approx_constant)]
        impl $name {
            /// Number of coordinates.
            pub const COUNT: usize = Self::NAMES.len();

            /// Names of the coordinates, in order.
            pub const NAMES: [&'static str; <[&str]>::len(&[$(stringify!($field)),*])] = [$(stringify!($field)),*];

            /// Pose in the design configuration, from which the mechanism is assembled.
            pub const DESIGN: Self = Self { $($field: $drawn,)* };

            /// Zero for each coordinate, as for rates and accelerations at rest.
            const REST: Self = Self::from_array([0.0; Self::COUNT]);

            /// Coordinates in order.
            pub const fn to_array(self) -> [$scalar; Self::COUNT] {
                [$(self.$field),*]
            }

            /// Returns the coordinates with these values, in order.
            pub const fn from_array(values: [$scalar; Self::COUNT]) -> Self {
                let [$($field),*] = values;
                Self { $($field),* }
            }
        }

        $crate::generated::values!($name: $scalar { $($field),* });
    };
}

/// Structure with the parameters of a mechanism and their defaults.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_parameters {
    ($scalar:ident { $($(#[$field_docs:meta])* $field:ident = $nominal:expr,)* }) => {
        /// Parameters that can be changed at run time.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(non_snake_case)]
        pub struct Parameters {
            $($(#[$field_docs])* pub $field: $scalar,)*
        }

        #[allow(dead_code, non_snake_case, clippy::approx_constant)]
        impl Parameters {
            /// Values of the description.
            pub const NOMINAL: Self = Self { $($field: $nominal,)* };

            /// Names of the parameters, in order.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];
        }

        impl Default for Parameters {
            fn default() -> Self {
                Self::NOMINAL
            }
        }

        $crate::generated::values!(Parameters: $scalar { $($field),* });
    };
}

/// Numbers by their indices.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_values {
    ($name:ident: $scalar:ident { $($field:ident),* }) => {
        impl $crate::Values<$scalar> for $name {
            fn count(&self) -> usize {
                Self::NAMES.len()
            }

            fn value(&self, index: usize) -> Option<$scalar> {
                [$(self.$field),*].get(index).copied()
            }

            fn set(&mut self, index: usize, value: $scalar) {
                if let Some(place) = [$(&mut self.$field),*].into_iter().nth(index) {
                    *place = value;
                }
            }

            #[inline]
            fn are_finite(&self) -> bool {
                $crate::generated::all_finite(&[$(self.$field),*])
            }
        }
    };
}

/// Structure with the signals that drive a mechanism, and their values at assembly.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_inputs {
    ($scalar:ident { $($(#[$field_docs:meta])* $field:ident = $initial:expr,)* }) => {
        /// Signals that drive the mechanism, each with its value, rate and acceleration at one time.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(non_snake_case)]
        pub struct Inputs {
            $($(#[$field_docs])* pub $field: $crate::Signal<$scalar>,)*
        }

        #[allow(dead_code, non_snake_case, clippy::approx_constant)]
        impl Inputs {
            /// Values of the description, at rest.
            pub const INITIAL: Self = Self {
                $($field: $crate::Signal { value: $initial, rate: 0.0, acceleration: 0.0 },)*
            };

            /// Names of the signals, in order.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];
        }

        impl Default for Inputs {
            fn default() -> Self {
                Self::INITIAL
            }
        }

        impl $crate::Values<$crate::Signal<$scalar>> for Inputs {
            fn count(&self) -> usize {
                Self::NAMES.len()
            }

            fn value(&self, index: usize) -> Option<$crate::Signal<$scalar>> {
                [$(self.$field),*].get(index).copied()
            }

            fn set(&mut self, index: usize, signal: $crate::Signal<$scalar>) {
                if let Some(place) = [$(&mut self.$field),*].into_iter().nth(index) {
                    *place = signal;
                }
            }

            #[inline]
            fn are_finite(&self) -> bool {
                [$(self.$field),*].iter().all(|signal| {
                    $crate::generated::all_finite(&[signal.value, signal.rate, signal.acceleration])
                })
            }
        }
    };
}
