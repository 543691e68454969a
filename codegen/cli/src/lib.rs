//! *The command line's arguments → what is printed and written, and an exit code.*
//!
//! Descriptions are interpreted here, without a compile step: [`interpreter::Interpreter`] evaluates a mechanism's equations,
//! [`trajectory::follow`] solves them over a [`schedule::Schedule`], [`singularity`] and [`diagnosis`] say what to look at,
//! [`report`] prints. The interpreter is also what generated code is tested against. Equations, derivatives and diagnostics
//! of descriptions come from `linkwright-codegen`, every numerical solve from `linkwright`: this package has neither.
//!
//! ```
//! use linkwright::{Settings, advance, assemble};
//! use linkwright_cli::interpreter::Interpreter;
//! use linkwright_codegen::diagnostic::Source;
//!
//! let text = "
//!     mechanism crank {
//!         body 1 at (0, 0, 0) { P: (2, 0) }
//!         absolute_x(1) = 0;
//!         absolute_y(1) = 0;
//!         drive phi(1) = 3*t;
//!     }";
//! let read = linkwright_codegen::read(&Source::new("crank.mech", text)).expect("a good description");
//! let system = read.only().expect("one motion");
//! linkwright_codegen::check(&system).expect("three equations for three coordinates");
//! let crank = Interpreter::new(&system);
//! let settings = Settings::default();
//! let frame = assemble(&crank, crank.estimate(), 0.0, &settings)?;
//! let frame = advance(&crank, &frame, 0.1, &settings)?;
//! assert_eq!(crank.point_names(), ["P"]);
//! let tip = crank.points(&frame)[0];
//! assert!((tip.velocity[0] + 6.0 * 0.3_f64.sin()).abs() < 1e-14);
//! # Ok::<(), linkwright::Failure>(())
//! ```

pub mod arguments;
pub mod assemblies;
pub mod branches;
pub mod check;
pub mod closeness;
pub mod command;
pub mod concerned;
pub mod condition;
pub mod counted;
pub mod dead_end;
pub mod derivatives;
pub mod diagnosis;
pub mod file;
pub mod interpreter;
pub mod monitor;
pub mod number;
pub mod pressure;
pub mod progress;
pub mod report;
pub mod residuals;
pub mod schedule;
pub mod singularity;
pub mod solution;
pub mod solved_interpreter;
pub mod trajectory;
