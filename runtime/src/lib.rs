//! Moves planar mechanisms on a device: pose, velocity and acceleration at a time, or a typed failure.
//!
//! This is the runtime that generated mechanisms call. It needs neither `std` nor an allocator, contains no unsafe code,
//! and no panic path survives in an optimized build. An `Ok` never holds NaN or an unconverged pose, and the work of a
//! call is bounded. The scalar is f64 or f32.
//!
//! # A control loop
//!
//! A description becomes a module when the crate is built: `linkwright_codegen::build` generates it in `build.rs`, and
//! [`include_mechanism!`] includes it. Small descriptions can stand in the code, in a macro of the crate
//! `linkwright-macros`, as here:
//!
//! ```
//! use linkwright::Failure;
//!
//! linkwright_macros::mechanism! {
//!     mechanism arm {
//!         input angle = 0;
//!         point O = (0, 0);
//!         body boom at O { O, P: (2, 0) }
//!         revolute O(ground, boom);
//!         drive phi(boom) = angle;
//!     }
//! }
//! use arm::{Arm, Inputs};
//! use linkwright::Signal;
//!
//! fn control() -> Result<(), Failure> {
//!     let mut arm = Arm::assemble(0.0, &Inputs::INITIAL)?;
//!     for step in 1..=100 {
//!         let t = 0.01 * f64::from(step);
//!         // The angle turns with 0.5 rad/s; a measured signal has its rate and acceleration too.
//!         let inputs = Inputs { angle: Signal::new(0.5 * t, 0.5, 0.0) };
//!         // On failure the arm would still be in its last frame.
//!         let tip = arm.advance(t, &inputs)?.point_p();
//!         assert!((tip.velocity[0].hypot(tip.velocity[1]) - 1.0).abs() < 1e-12);
//!     }
//!     Ok(())
//! }
//! # control().unwrap();
//! ```
//!
//! [`Failure`] gives the cause in plain numbers, and [`FailureMessage`] in a sentence with the names of the mechanism. A [`Branch`] selects one of two assembly modes of a loop. [`Settings`] hold the tolerances that a caller
//! may choose; all other thresholds are on the page [`thresholds`].
//!
//! # Any mechanism
//!
//! Every generated type is a [`Mechanism`]: a [`Shell`] around the [`Blocks`] of its equations, with names of its own.
//! Code for this trait works with each of them. The shell advances from frame to frame on one smooth path, in as many
//! steps as needed, or returns the time at which the path ends.
//!
//! # Equations written by hand
//!
//! [`Equations`] are Φ and its derivatives, as one dense system; the type `Textbook` of a generated module implements
//! them. [`Frame::assemble`] finds a pose near a good estimate, [`Frame::assemble_from_rough_estimate`] from a poor one.
//! [`Frame::advance`] takes the pose to which Newton-Raphson converges. [`Frame::follow`] takes only one that is on the
//! same path and branch, and names the time at which a path ends.
#![doc(html_root_url = "https://docs.rs/linkwright/0.1.0")]
#![no_std]

mod assembly;
mod block;
mod block_equations;
mod blocks;
mod chain;
mod chain_isolation;
mod clock;
mod closed_form;
mod contact;
mod continuation;
mod crossing;
mod damped;
mod deviations;
mod equations;
mod factored_inverse;
mod failure;
mod failure_message;
mod friction;
#[doc(hidden)]
pub mod generated;
mod guard;
mod inverse;
mod isolation;
mod kinematics;
pub mod lanes;
mod least_squares;
mod linear;
pub mod math;
mod mechanism;
mod motion;
mod multipliers;
mod newton;
mod normalized_determinant;
mod passage;
mod path;
mod progress;
mod regularity;
mod scale;
mod settings;
mod shell;
mod signal;
pub mod single;
mod substeps;
mod table;
pub mod thresholds;
mod time_window;
mod torn;
mod value_range;
mod vector;
mod watch;
mod way;

pub use nalgebra;

pub use blocks::{Blocks, Values};
pub use closed_form::Branch;
pub use equations::Equations;
pub use failure::{Failure, FailureKind};
pub use failure_message::{BlockName, FailureMessage};
pub use kinematics::Frame;
pub use mechanism::Mechanism;
pub use motion::PointMotion;
pub use newton::Step;
pub use normalized_determinant::NormalizedDeterminant;
pub use settings::Settings;
pub use shell::Shell;
pub use signal::Signal;
pub use value_range::ValueRange;

/// Includes the module that `linkwright_codegen::build` generated for the mechanism `$name`.
///
/// In a module with a name, `rustdoc` shows the picture and the derivation below the caller's documentation:
/// ```ignore
/// linkwright::include_mechanism! {
///     /// The arm.
///     pub mod excavator;
/// }
/// ```
/// The name of the mechanism alone includes the module's contents in place:
/// ```ignore
/// mod arm {
///     linkwright::include_mechanism!(excavator);
/// }
/// ```
#[macro_export]
macro_rules! include_mechanism {
    ($(#[$attribute:meta])* $visibility:vis mod $name:ident;) => {
        $(#[$attribute])*
        #[cfg_attr(
            doc,
            doc = include_str!(concat!(
                env!("OUT_DIR"),
                "/linkwright/",
                stringify!($name),
                ".md"
            ))
        )]
        #[allow(clippy::pedantic, clippy::nursery)]
        $visibility mod $name {
            $crate::include_mechanism!($name);
        }
    };
    ($name:ident) => {
        include!(env!(
            concat!("LINKWRIGHT_", stringify!($name)),
            concat!(
                "no mechanism is named `",
                stringify!($name),
                "`: ",
                env!(
                    "LINKWRIGHT_MECHANISMS",
                    "nothing is generated; call `linkwright_codegen::build` in build.rs"
                )
            )
        ));
    };
}
