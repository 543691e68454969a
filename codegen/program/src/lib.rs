//! Derives the constraint equations of described mechanisms and plans their solution.
//!
//! This is an internal package of `linkwright-codegen`, not to be named in a manifest. Its items are not shown and may
//! change with every release.
//!
//! Each module imports only those named before it: `system`, `structure`, `words`, `program`, `solved`, `assemblies`, `closing`,
//! `finiteness`, `modes`. A [`program::Program`] defines every value before a statement uses the value. Modules are independent
//! of output languages.

#![doc(html_root_url = "https://docs.rs/linkwright-program/0.1.0")]

use linkwright_description::{diagnostic, expr, force, joint, model, pool, units};

#[doc(hidden)]
pub mod assemblies;
#[doc(hidden)]
pub mod closing;
#[doc(hidden)]
pub mod finiteness;
#[doc(hidden)]
pub mod modes;
#[doc(hidden)]
pub mod program;
#[doc(hidden)]
pub mod solved;
#[doc(hidden)]
pub mod structure;
#[doc(hidden)]
pub mod system;
#[doc(hidden)]
pub mod words;
