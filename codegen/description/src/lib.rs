//! Reads descriptions of planar mechanisms: syntax, expressions, joints and the resolved model.
//!
//! This is an internal package of `linkwright-codegen`, not to be named in a manifest. Its items are not shown and may
//! change with every release.
//!
//! Each module imports only those named before it: `units`, `diagnostic`, `columns`, `syntax`, `format`, `consequences`, `expr`,
//! `joint`, `force`, `pool`, `model`. A resolved [`model::Mechanism`] has SI units and no unresolved name.

#![doc(html_root_url = "https://docs.rs/linkwright-description/0.1.0")]

#[doc(hidden)]
pub mod columns;
#[doc(hidden)]
pub mod consequences;
pub mod diagnostic;
#[doc(hidden)]
pub mod expr;
#[doc(hidden)]
pub mod force;
#[doc(hidden)]
pub mod format;
#[doc(hidden)]
pub mod joint;
#[doc(hidden)]
pub mod model;
#[doc(hidden)]
pub mod pool;
#[doc(hidden)]
pub mod syntax;
#[doc(hidden)]
pub mod units;
