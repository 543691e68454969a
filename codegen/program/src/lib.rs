//! Derives the constraint equations of described mechanisms and plans their solution.
//!
//! Each module imports only those named before it: `system`, `structure`, `words`, `program`, `solved`, `assemblies`, `closing`,
//! `finiteness`, `modes`. A [`program::Program`] defines every value before a statement uses the value. Modules are independent
//! of output languages.
//!
//! This is an internal package of `linkwright-codegen`; its items may change with every release.

#![doc(html_root_url = "https://docs.rs/linkwright-program/0.1.0")]

use linkwright_description::{diagnostic, expr, force, joint, model, pool, units};

pub mod assemblies;
pub mod closing;
pub mod finiteness;
pub mod modes;
pub mod program;
pub mod solved;
pub mod structure;
pub mod system;
pub mod words;
