//! Solves the motion of a description immediately, without a compile step.
//!
//! [`interpreted`] runs the blocks of the generated code in the same shell, and so with the same bits, modes, path and failures.
//! [`dense`] solves the textbook formulation as one system. Further modules find assemblies, closest approaches to singular poses,
//! residuals and trajectories. The package also builds for `wasm32-unknown-unknown`.

#![doc(html_root_url = "https://docs.rs/linkwright-solver/0.1.0")]

pub mod approach;
pub mod assemblies;
pub mod check;
pub mod comparison;
pub mod condition;
pub mod dense;
pub mod derivatives;
pub mod diagnosis;
pub mod dormand_prince;
pub mod drawn;
pub mod every_pose;
pub mod first_step;
pub mod forces;
pub mod instant;
pub mod interpreted;
mod known_poses;
pub mod measures;
pub mod mode_selection;
mod newton;
pub mod not_finite;
pub mod number;
pub mod observable;
pub mod open_loop;
mod operation;
mod path;
pub mod pressure;
pub mod proof;
pub mod radau;
pub mod rates;
pub mod reader;
pub mod residuals;
pub mod schedule;
pub mod search;
pub mod simulation;
pub mod singular_participants;
pub mod supplied;
pub mod textbook;
pub mod tolerances;
mod torn;
pub mod trajectory;
pub mod view;
pub mod warnings;
