//! Solves the equations of a planar mechanism for its pose, velocity and acceleration at a time.
//!
//! This is the runtime that generated mechanisms call: sines, cosines and angles, Newton-Raphson, linear solves and
//! typed failures. It needs neither `std` nor an allocator, contains no unsafe code, and no panic path survives in an
//! optimized build. An `Ok` never holds NaN or an unconverged pose, and the work of a call is bounded.
//!
//! Bodies, joints and names are compiled away, or interpreted, on the other side of [`Equations`]. Most users never
//! implement that trait; they write a description, and [`include_mechanism!`] includes the module that
//! `linkwright_codegen::build` generated from it.
//!
//! A generated mechanism is solved block by block. For a block with a closed form, the generated code calls
//! [`closed_form`] and [`math`]: a [`Branch`] selects one of the block's two assembly modes, and links that do not meet
//! are [`FailureKind::OutOfReach`]. The other blocks implement [`Equations`] and are solved by [`advance`]. So is the
//! textbook formulation, all equations as one dense system, through the type `Textbook` of the generated module. The
//! scalar is f64 or f32.
//!
//! [`advance`] takes the pose to which Newton-Raphson converges. [`follow`] takes only one that is on the same path and
//! branch, in as many steps as needed, and names the time at which a path ends. [`assemble`] is for good estimates,
//! [`assemble_from_rough_estimate`] for poor ones.
//!
//! A [`Shell`] contains the blocks of a mechanism: it assembles, keeps the last frame and the next one, and takes
//! parameters and inputs. It advances from frame to frame on one smooth path, which a [`Guard`] verifies, in as many
//! steps as needed. Every generated type is a [`Mechanism`], so code can be written for any of them. All tolerances and
//! limits are on one page, [`thresholds`].
//!
//! # By hand
//!
//! A slider on the x axis hangs on a crank of length 1 by a rod of length 2; the crank turns as φ = t. The position s
//! of the slider is the one coordinate, and Φ = (s - cos t)² + sin² t - 4.
//!
//! ```
//! use linkwright::nalgebra::{Const, SMatrix, SVector};
//! use linkwright::{Equations, Settings, advance, assemble, math};
//!
//! struct Slider;
//!
//! impl Equations<f64, Const<1>> for Slider {
//!     fn dimension(&self) -> Const<1> {
//!         Const
//!     }
//!     fn residual(&self, q: &SVector<f64, 1>, t: f64, phi: &mut SVector<f64, 1>) {
//!         let (sin, cos) = math::sin_cos(t);
//!         phi[0] = (q[0] - cos) * (q[0] - cos) + sin * sin - 4.0;
//!     }
//!     fn jacobian(&self, q: &SVector<f64, 1>, t: f64, phi_q: &mut SMatrix<f64, 1, 1>) {
//!         phi_q[0] = 2.0 * (q[0] - math::cos(t));
//!     }
//!     fn time_derivative(&self, q: &SVector<f64, 1>, t: f64, phi_t: &mut SVector<f64, 1>) {
//!         phi_t[0] = 2.0 * q[0] * math::sin(t);
//!     }
//!     fn gamma(&self, q: &SVector<f64, 1>, qd: &SVector<f64, 1>, t: f64, gamma: &mut SVector<f64, 1>) {
//!         let (sin, cos) = math::sin_cos(t);
//!         gamma[0] = -(2.0 * qd[0] * qd[0] + 4.0 * qd[0] * sin + 2.0 * q[0] * cos);
//!     }
//!     fn row_scale(&self, _row: usize) -> f64 {
//!         4.0 // the square of the rod's length
//!     }
//!     fn coordinate_scale(&self, _column: usize) -> f64 {
//!         2.0
//!     }
//! }
//!
//! # fn main() -> Result<(), linkwright::Failure> {
//! let settings = Settings::default();
//! let mut frame = assemble(&Slider, &SVector::<f64, 1>::new(2.5), 0.0, &settings)?;
//! assert!((frame.q[0] - 3.0).abs() < 1e-14);
//! for step in 1..=100 {
//!     // On failure `frame` would still be the last valid one.
//!     frame = advance(&Slider, &frame, 0.01 * f64::from(step), &settings)?;
//! }
//! let exact = math::cos(1.0) + math::sqrt(4.0 - math::sin(1.0_f64) * math::sin(1.0));
//! assert!((frame.q[0] - exact).abs() < 1e-14);
//! # Ok(())
//! # }
//! ```
#![doc(html_root_url = "https://docs.rs/linkwright/0.1.0")]
#![no_std]

pub mod assembly;
pub mod block;
pub mod block_equations;
pub mod blocks;
mod chain;
pub mod chain_isolation;
mod clock;
pub mod closed_form;
pub mod contact;
mod continuation;
mod crossing;
pub mod damped;
mod deviations;
pub mod equations;
mod factored_inverse;
pub mod failure;
pub mod failure_message;
mod generated;
pub mod guard;
mod inverse;
pub mod isolation;
pub mod kinematics;
pub mod least_squares;
pub mod linear;
pub mod math;
pub mod motion;
pub mod multipliers;
pub mod newton;
pub mod normalized_determinant;
mod passage;
pub mod path;
mod progress;
mod regularity;
pub mod scale;
pub mod settings;
pub mod shell;
pub mod signal;
pub mod substeps;
pub mod table;
pub mod thresholds;
pub mod time_window;
pub mod torn;
mod vector;
mod watch;
mod way;

pub use nalgebra;

pub use assembly::assemble_from_rough_estimate;
pub use block::Start;
pub use block_equations::BlockEquations;
pub use blocks::{Blocks, Conditions, Signals, Values};
pub use chain_isolation::isolate_chain;
pub use closed_form::{Branch, Mode};
pub use equations::Equations;
pub use failure::{Failure, FailureKind};
pub use failure_message::{BlockName, FailureMessage};
pub use guard::{Guard, Pair};
pub use isolation::{Chord, isolate};
pub use kinematics::{Frame, advance, assemble};
pub use linear::{Factorization, Measure};
pub use math::Real;
pub use motion::PointMotion;
pub use newton::{Convergence, Step};
pub use normalized_determinant::NormalizedDeterminant;
pub use path::{branch_of, follow};
pub use scale::Scales;
pub use settings::Settings;
pub use shell::{Mechanism, Shell};
pub use signal::Signal;
pub use substeps::{Broken, in_steps};
pub use table::Table;
pub use time_window::{PathEnclosure, TimeWindow};
pub use torn::Torn;

// Declared here, so that documentation elsewhere links to the items in this crate.
generated::precision!(
    /// Types and functions of generated modules in f64.
    double,
    f64
);
generated::precision!(
    /// Types and functions of generated modules in f32.
    single,
    f32
);

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
