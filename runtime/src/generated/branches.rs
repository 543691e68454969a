//! *The assembly modes of the loops* → *the structure that holds them*.

/// A structure with the mode of each loop, those of the drawing, and the blocks that can exchange theirs.
#[doc(hidden)]
#[macro_export]
macro_rules! branches {
    (
        $(#[$docs:meta])*
        $name:ident {
            $($(#[$field_docs:meta])* $field:ident: $mode:ty = $drawn:expr $(, block $number:literal)?;)*
        }
    ) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name {
            $($(#[$field_docs])* pub $field: $mode,)*
        }

        impl $name {
            /// The modes of the drawing.
            pub const DRAWN: Self = Self { $($field: $drawn,)* };

            /// Those beyond a pose at which the two modes of a block meet.
            #[allow(clippy::needless_update)]
            fn exchanged(self, block: u16) -> Option<Self> {
                match block {
                    $($($number => Some(Self { $field: $crate::Mode::other(self.$field)?, ..self }),)?)*
                    _ => None,
                }
            }
        }
    };
}
