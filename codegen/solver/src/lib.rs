//! Solves the motion of a description immediately, without a compile step.
//!
//! [`Interpreted`] runs the blocks of generated code in the shell of the runtime, with the same bits, modes, path and
//! failures. All quantities are in SI units: m, rad, s.
//!
//! ```
//! use linkwright::{Blocks, Mechanism, Settings, Shell};
//! use linkwright_codegen::Source;
//! use linkwright_solver::{Interpreted, View};
//!
//! let text = "
//!     mechanism crank {
//!         point O = (0, 0);
//!         body arm at O { O, A: (2, 0) }
//!         revolute O(ground, arm);
//!         drive phi(arm) = 3*t;
//!     }";
//! let source = Source::new("crank.mech", text);
//! let read = linkwright_codegen::read(&source).map_err(|errors| errors.render(&source))?;
//! let blocks = Interpreted::new(&read.motions[0]).ok_or("the equations do not determine the motion")?;
//!
//! let (parameters, laws) = (blocks.nominal_parameters(), blocks.input_laws());
//! let (pose, modes) = (blocks.drawn_pose(&parameters), blocks.drawn_branches());
//! let settings = Settings::default();
//! let mut crank = Shell::assemble(blocks, &parameters, &pose, modes, 0.0, &laws.at(0.0), settings)?;
//! let instant = crank.advance(0.5, &laws.at(0.5))?;
//! assert_eq!((instant.q()[2], instant.qd()[2]), (1.5, 3.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - [`Opened`] goes from the text of a description to a mechanism that can be solved.
//! - [`View`] is what both formulations provide. [`Dense`] is the other one, the textbook formulation as one system.
//! - [`Moved`] moves the program that is written out, and computes beside it what an `output` omits.
//! - [`follow`] moves a mechanism over the times of a [`Schedule`] and finds the end of its motion.
//! - [`Batch`] solves many sets of parameters at once, in sixteen lanes and on several threads.
//! - [`Check`] looks for assemblies and singular poses over a schedule.
//! - [`Simulation`] integrates the motion of free coordinates under forces.
//! - [`Observable`] names a quantity of a frame, and [`Comparison`] compares its values with measured ones.
//!
//! The package also builds for `wasm32-unknown-unknown`.

#![doc(html_root_url = "https://docs.rs/linkwright-solver/0.1.0")]

mod batch;
mod emitted;
mod explained;
mod forces;
mod friction;
mod instant;
mod interpreted;
mod known_poses;
mod mode_selection;
mod moved;
mod newton;
mod operation;
mod product;
mod ranges;
mod schedule;
mod supplied;
mod trajectory;
mod view;

// Items that the command, the fits and the tests of this repository call; they may change with every release.
#[doc(hidden)]
pub mod approach;
#[doc(hidden)]
pub mod assemblies;
#[doc(hidden)]
pub mod check;
#[doc(hidden)]
pub mod checked_part;
#[doc(hidden)]
pub mod comparison;
#[doc(hidden)]
pub mod condition;
#[doc(hidden)]
pub mod data;
#[doc(hidden)]
pub mod dense;
#[doc(hidden)]
pub mod derivatives;
#[doc(hidden)]
pub mod dormand_prince;
#[doc(hidden)]
pub mod drawn;
#[doc(hidden)]
pub mod equilibrium;
#[doc(hidden)]
pub mod every_pose;
#[doc(hidden)]
pub mod first_step;
#[doc(hidden)]
pub mod full_turn;
#[doc(hidden)]
pub mod losses;
#[doc(hidden)]
pub mod measure_watch;
#[doc(hidden)]
pub mod measures;
#[doc(hidden)]
pub mod motors;
#[doc(hidden)]
pub mod not_finite;
#[doc(hidden)]
pub mod number;
#[doc(hidden)]
pub mod observable;
#[doc(hidden)]
pub mod open_loop;
#[doc(hidden)]
pub mod opened;
#[doc(hidden)]
pub mod pressure;
#[doc(hidden)]
pub mod proof;
#[doc(hidden)]
pub mod radau;
#[doc(hidden)]
pub mod rates;
#[doc(hidden)]
pub mod reader;
#[doc(hidden)]
pub mod reported;
#[doc(hidden)]
pub mod residuals;
#[doc(hidden)]
pub mod search;
#[doc(hidden)]
pub mod sets;
#[doc(hidden)]
pub mod simulation;
#[doc(hidden)]
pub mod singular_participants;
#[doc(hidden)]
pub mod stack_up;
#[doc(hidden)]
pub mod textbook;
#[doc(hidden)]
pub mod tolerances;
#[doc(hidden)]
pub mod travel;
#[doc(hidden)]
pub mod warnings;

pub use assemblies::{Assemblies, Assembly};
pub use batch::{Batch, Outcome, WrongLength};
pub use check::Check;
pub use comparison::Comparison;
pub use dense::Dense;
pub use instant::Instant;
pub use interpreted::Interpreted;
pub use mode_selection::{ModeSelection, Unassembled};
pub use moved::{Moved, Unmoved};
pub use observable::Observable;
pub use opened::{Opened, Unopened};
pub use schedule::{Leg, Schedule};
pub use simulation::{Method, Simulation, SimulationOptions, Stop};
pub use supplied::{InputLaws, InputSignals, Modes, Numbers};
pub use tolerances::Tolerances;
pub use trajectory::{End, Movable, follow};
pub use view::View;
