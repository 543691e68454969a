//! *The assembly modes of the loops* → *the structure that holds them*.

use crate::closed_form::Branch;

/// The mode of a block.
pub trait Mode: Sized {
    /// The one beyond a pose at which it meets another; `None` where it is not known.
    fn other(self) -> Option<Self>;
}

impl Mode for Branch {
    fn other(self) -> Option<Self> {
        Some(self.opposite())
    }
}

impl Mode for Option<Branch> {
    fn other(self) -> Option<Self> {
        self.map(|branch| Some(branch.opposite()))
    }
}

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
