//! Declares the structure with the assembly mode of each loop.

/// Structure with the mode of each loop, those of the design configuration, and the blocks that can exchange their
/// mode.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_branches {
    (
        $(#[$docs:meta])*
        $name:ident {
            $($(#[$field_docs:meta])* $field:ident: $mode:ty = $drawn:expr $(, block $number:literal)?;)*
        }
    ) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(non_snake_case)]
        pub struct $name {
            $($(#[$field_docs])* pub $field: $mode,)*
        }

        impl $name {
            /// Modes of the design configuration.
            pub const DESIGN: Self = Self { $($field: $drawn,)* };

            /// True if a block can exchange its mode.
            const MAY_CROSS: bool = !<[u16]>::is_empty(&[$($($number,)?)*]);

            /// Modes beyond a change point of a block; `None` if the block has no other mode.
            #[allow(unused_mut)]
            fn exchanged(mut self, block: u16) -> Option<Self> {
                let is_one = match block {
                    $($($number => { self.$field = $crate::generated::Mode::other(self.$field)?; true })?)*
                    _ => false,
                };
                is_one.then_some(self)
            }
        }
    };
}
