//! Reads descriptions of planar mechanisms: syntax, expressions, joints and the resolved model.
//!
//! Each module imports only those named before it: `units`, `diagnostic`, `columns`, `syntax`, `format`, `consequences`, `expr`,
//! `joint`, `force`, `pool`, `model`. A resolved [`model::Mechanism`] has SI units and no unresolved name.
//!
//! This is an internal package of `linkwright-codegen`; its items may change with every release.

#![doc(html_root_url = "https://docs.rs/linkwright-description/0.1.0")]

pub mod columns;
pub mod consequences;
pub mod diagnostic;
pub mod expr;
pub mod force;
pub mod format;
pub mod joint;
pub mod model;
pub mod pool;
pub mod syntax;
pub mod units;
