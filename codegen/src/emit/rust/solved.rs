//! The solved view: one function per block, and the type that runs them.

mod block;
mod closeness;
mod explained;
mod frame;
mod names;
mod newton;
mod sensitivity;
mod solver;
mod transmission;

pub(super) use block::blocks;
pub(super) use closeness::closeness;
pub(super) use explained::explained;
pub(super) use frame::{branches, frame_fields, frame_values, output_frame};
pub(super) use newton::newton_blocks;
pub(super) use sensitivity::{sensitivities, structures};
pub(super) use solver::mechanism;
pub(super) use transmission::{responded, transmissions};
