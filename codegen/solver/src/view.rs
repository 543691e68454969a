//! What can be solved and reported on, whichever equations it is solved by.

use linkwright::{Blocks, Failure, PointMotion};
use linkwright_codegen::stages::emit::derivation::SingularPose;
use linkwright_codegen::stages::system::System;

use crate::instant::{Instant, Layout};
use crate::measures::Measures;
use crate::supplied::{InputLaws, InputSignals, ModeName, Modes, ParameterValues, Pose};

/// A way of solving a described mechanism: block by block, or all equations at once.
pub trait View:
    Clone
    + Blocks<
        Scalar = f64,
        Frame = Instant,
        Coordinates = Pose,
        Branches = Modes,
        Parameters = ParameterValues,
        Inputs = InputSignals,
    >
{
    /// The equations of the mechanism.
    fn system(&self) -> &System;

    /// Where instants keep what.
    fn layout(&self) -> &Layout;

    /// The names of the assembly modes that can be chosen: first those of closed forms, then the others.
    fn mode_names(&self) -> Vec<ModeName>;

    /// How many Newton-Raphson steps were taken so far, and by how many solves.
    fn newton_steps(&self) -> [u64; 2];

    /// The motion of all points of the description, in its order.
    fn points(&self, instant: &Instant) -> Vec<PointMotion>;

    /// What `transmission` and `sensitivity` statements ask for, in the order of [`crate::derivatives::names`];
    /// `None` where the equations are singular.
    fn derivatives(&self, instant: &Instant) -> Option<Vec<f64>>;

    /// What `effort`, `reaction` and `energy` statements ask for, in the order of [`crate::forces::names`]; `None` where the equations
    /// are singular.
    fn forces(&self, instant: &Instant) -> Option<Vec<f64>>;

    /// How far its parts are from singular; `None` where that is not known part by part.
    fn measures(&self) -> Option<Measures>;

    /// Where its parts are singular, in words; nothing where that is not known part by part.
    fn singular_poses(&self) -> &[SingularPose];

    /// That and why the mechanism cannot be assembled in the modes of its drawing.
    fn not_assembled(&self, failure: &Failure) -> String;

    /// Where and why a motion ends whose last instant this is.
    fn ended(&self, failure: &Failure, last: &Instant) -> String;

    /// The laws of the inputs.
    fn input_laws(&self) -> InputLaws {
        InputLaws::of(self.system())
    }
}
