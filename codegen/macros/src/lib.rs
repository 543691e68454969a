//! Planar mechanisms described in the middle of Rust code: [`mechanism!`] becomes the module that moves them.
//!
//! It is for small mechanisms, tests, examples and documentation. A larger one is better off in a file of its own: a build script
//! generates its module once (`linkwright_codegen::build`), a macro whenever the crate is compiled. Module and errors are the same.
//!
//! A crate names both in its manifest; the module calls the runtime.
//!
//! ```toml
//! [dependencies]
//! linkwright = "0.1"
//! linkwright-macros = "0.1"
//! ```
//!
//! # A four-bar
//!
//! ```
//! linkwright_macros::mechanism! {
//!     /// Crank, coupler and rocker of 40, 120 and 80 mm on a ground link of 100 mm.
//!     mechanism four_bar {
//!         point A = (0, 0), D = (100mm, 0);
//!
//!         body crank   at (0, 0, 40deg)       { A: (0, 0), B: (40mm, 0) }
//!         body coupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (120mm, 0), P: (60mm, 40mm) }
//!         body rocker  at (100mm, 0, 57deg)   { D: (0, 0), C: (80mm, 0) }
//!
//!         revolute A(ground, crank);
//!         revolute B(crank, coupler);
//!         revolute C(coupler, rocker);
//!         revolute D(ground, rocker);
//!
//!         drive phi(crank) = 40deg + 3*t;
//!     }
//! }
//! use four_bar::FourBar;
//!
//! let mut linkage = FourBar::assemble(0.0)?;
//! for step in 1..=100 {
//!     let frame = linkage.advance(f64::from(step) / 50.0)?;
//!     let (position, velocity) = (frame.point_p().position, frame.point_p().velocity);
//!     assert!(position[1] > 0.0 && velocity[0].hypot(velocity[1]) < 0.5);
//!
//!     // The law of cosines in the triangle of the pins B, C and D.
//!     let from_b_to_d = 0.04_f64.powi(2) + 0.1_f64.powi(2) - 2.0 * 0.04 * 0.1 * frame.q.phi_crank.cos();
//!     let cosine = (0.12_f64.powi(2) + 0.08_f64.powi(2) - from_b_to_d) / (2.0 * 0.12 * 0.08);
//!     let angle = frame.q.phi_rocker - frame.q.phi_coupler;
//!     assert!((angle.cos() - cosine).abs() < 1e-12);
//! }
//! # Ok::<(), linkwright::Failure>(())
//! ```
//!
//! # Errors
//!
//! Every error of the description is an error of the compiler at its tokens, and all of them are reported at once:
//!
//! ```text
//! error: K13: unknown function `sine`
//!        not a function of this language
//!        help: did you mean `sin`?
//!   --> src/lib.rs:16:27
//!    |
//! 16 |         drive phi(crank) = sine(3*t);
//!    |                            ^^^^
//! ```
//!
//! A macro cannot warn. A warning is therefore a deprecated constant with the text as its note: it points to the token,
//! every build repeats it, and `#[allow(deprecated)]` above the mechanism turns it off.

#![doc(html_root_url = "https://docs.rs/linkwright-macros/0.1.0")]

mod expansion;
mod findings;
mod head;
#[cfg(test)]
mod tests;
mod tokens;
mod written;

use std::sync::{Mutex, PoisonError};

use proc_macro::TokenStream;

/// Lock for one expansion at a time: tokens belong to the compiler or not for a whole process, and a compiler may
/// expand on several threads.
static EXPANDING: Mutex<()> = Mutex::new(());

/// Generates the module of a mechanism that is described between the braces, as in a file.
///
/// The module is named after the mechanism and takes the place of the macro, among the items of a module or of a
/// function. It is the module that `linkwright::include_mechanism! { mod NAME; }` includes after a build script: its
/// documentation is that of the description, and `rustdoc` shows the picture and the derivation. It is private unless
/// `pub` precedes the word `mechanism`. Attributes of the module, such as `#[cfg(test)]`, come first. Of several
/// mechanisms the last one becomes the module, and those above it can be its parts.
///
/// ```
/// mod linkages {
///     linkwright_macros::mechanism! {
///         #![scalar(f32)]
///         /// An arm that turns.
///         pub mechanism crank {
///             point O = (0, 0);
///             body arm at O { O, A: (40mm, 0) }
///             revolute O(ground, arm);
///             drive phi(arm) = 2*t;
///         }
///     }
/// }
/// let crank = linkages::crank::Crank::assemble(0.5)?;
/// assert_eq!(crank.frame().q.phi_arm, 1.0_f32);
/// # Ok::<(), linkwright::Failure<f32>>(())
/// ```
///
/// # Options
///
/// Options come first, and are those of `linkwright_codegen::Options`:
/// - `#![scalar(f32)]` computes in single precision.
/// - `#![math(crate::Plain)]` calls the functions of a type of this path, which implements
///   `linkwright::math::Functions`, in place of those of `linkwright::math`.
///
/// # Tables in files
///
/// The file of a `table` statement is relative to the folder of the file with the macro. When it changes, cargo builds
/// the crate again. If the compiler does not tell the file with the macro, paths are relative to the folder of the
/// package.
///
/// # Limits of tokens
///
/// A description has the tokens of Rust, so all of its language is possible here. Only characters that the compiler
/// refuses by itself, such as `°` or a bracket without its partner, are errors of the compiler.
#[proc_macro]
pub fn mechanism(input: TokenStream) -> TokenStream {
    let _one = EXPANDING.lock().unwrap_or_else(PoisonError::into_inner);
    expansion::expand(input.into()).into()
}
