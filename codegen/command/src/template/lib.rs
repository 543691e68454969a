//! A four-bar linkage, generated from its description.

linkwright::include_mechanism! {
    /// The linkage of `descriptions/four_bar.mech`.
    pub mod four_bar;
}
