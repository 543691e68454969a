//! The repository's mechanisms, generated in single precision.

macro_rules! registry {
    ($($module:ident: $mechanism:ident { $($point:literal => $motion:ident,)+ })+) => {
        $(
            #[doc = concat!("`", stringify!($module), "` in single precision.")]
            pub mod $module {
                linkwright::include_mechanism!($module);
            }
        )+
    };
}

include!(concat!(env!("OUT_DIR"), "/registry.rs"));

/// The excavator's tool alone.
pub mod excavator_tool {
    linkwright::include_mechanism!(excavator_tool);
}
