//! *The names of numbers* → *constants*, and *the structure that holds them* for coordinates, parameters and signals.

/// The rounded values of exact constants.
#[doc(hidden)]
#[macro_export]
macro_rules! constants {
    ($($name:ident = $value:expr,)*) => {
        $(
            #[allow(clippy::approx_constant)]
            const $name: Scalar = $value;
        )*
    };
}

/// A structure with a number for each coordinate, its names, and its values in the drawing.
#[doc(hidden)]
#[macro_export]
macro_rules! coordinates {
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
            /// How many coordinates there are.
            pub const COUNT: usize = Self::NAMES.len();

            /// Their names, in order.
            pub const NAMES: [&'static str; <[&str]>::len(&[$(stringify!($field)),*])] = [$(stringify!($field)),*];

            /// The pose in the drawing, from which the mechanism is assembled.
            pub const DESIGN: Self = Self { $($field: $drawn,)* };

            /// Zero for each, as rates and accelerations are at rest.
            const REST: Self = Self::from_array([0.0; Self::COUNT]);

            /// The coordinates in order.
            pub const fn to_array(self) -> [$scalar; Self::COUNT] {
                [$(self.$field),*]
            }

            /// The coordinates from their values in order.
            pub const fn from_array(values: [$scalar; Self::COUNT]) -> Self {
                let [$($field),*] = values;
                Self { $($field),* }
            }
        }

        $crate::values!($name: $scalar { $($field),* });
    };
}

/// A structure with the parameters of a mechanism and their defaults.
#[doc(hidden)]
#[macro_export]
macro_rules! parameters {
    ($scalar:ident { $($(#[$field_docs:meta])* $field:ident = $nominal:expr,)* }) => {
        /// What can be changed at run time.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(non_snake_case)]
        pub struct Parameters {
            $($(#[$field_docs])* pub $field: $scalar,)*
        }

        #[allow(dead_code, non_snake_case, clippy::approx_constant)]
        impl Parameters {
            /// The values of the description.
            pub const NOMINAL: Self = Self { $($field: $nominal,)* };

            /// Their names, in order.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];
        }

        impl Default for Parameters {
            fn default() -> Self {
                Self::NOMINAL
            }
        }

        $crate::values!(Parameters: $scalar { $($field),* });
    };
}

/// Numbers by their places.
#[doc(hidden)]
#[macro_export]
macro_rules! values {
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
                $crate::closed_form::all_finite(&[$(self.$field),*])
            }
        }
    };
}

/// A structure with the signals that move a mechanism, and their values at assembly.
#[doc(hidden)]
#[macro_export]
macro_rules! inputs {
    ($scalar:ident { $($(#[$field_docs:meta])* $field:ident = $initial:expr,)* }) => {
        /// The signals that move the mechanism, each with its value, rate and acceleration at one time.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(non_snake_case)]
        pub struct Inputs {
            $($(#[$field_docs])* pub $field: $crate::Signal<$scalar>,)*
        }

        #[allow(dead_code, non_snake_case, clippy::approx_constant)]
        impl Inputs {
            /// The values of the description, at rest.
            pub const INITIAL: Self = Self {
                $($field: $crate::Signal { value: $initial, rate: 0.0, acceleration: 0.0 },)*
            };

            /// Their names, in order.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];
        }

        impl Default for Inputs {
            fn default() -> Self {
                Self::INITIAL
            }
        }

        impl $crate::Signals<$scalar> for Inputs {
            fn count(&self) -> usize {
                Self::NAMES.len()
            }

            fn signal(&self, index: usize) -> Option<$crate::Signal<$scalar>> {
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
                    $crate::closed_form::all_finite(&[signal.value, signal.rate, signal.acceleration])
                })
            }

            fn towards(&self, last: &Self, h: $scalar, part: $scalar) -> Self {
                Self { $($field: self.$field.towards(&last.$field, h, part),)* }
            }
        }
    };
}
