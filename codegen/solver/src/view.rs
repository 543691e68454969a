//! Defines what a formulation of a mechanism provides for solutions and reports.

use linkwright::{Blocks, Failure, PointMotion};
use linkwright_codegen::stages::emit::derivation::SingularPose;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::{Derived, System};

use crate::emitted::Emitted;
use crate::instant::{Instant, Layout};
use crate::measures::Measures;
use crate::supplied::{InputLaws, InputSignals, ModeName, Modes, ParameterValues, Pose};

/// Formulation of a described mechanism: block by block, or all equations at once.
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
    /// Equations of the mechanism, with their expressions.
    fn derived(&self) -> &Derived;

    /// Expressions of the equations.
    fn pool(&self) -> &Pool {
        &self.derived().pool
    }

    /// Equations of the mechanism.
    fn system(&self) -> &System {
        &self.derived().system
    }

    /// Layout of the values of instants.
    fn layout(&self) -> &Layout;

    /// Program that is written out, if it omits some values of instants; `None` if these are its own.
    fn emitted(&self) -> Option<&Emitted<Self>> {
        None
    }

    /// Names of the assembly modes that can be selected: first those of closed forms, then the others.
    fn mode_names(&self) -> Vec<ModeName>;

    /// Number of Newton-Raphson steps so far, and of solves.
    fn newton_steps(&self) -> [u64; 2];

    /// Returns the motion of all points that instants offer, in the order of their names: those of the description, in its order, unless
    /// single outputs limit them.
    fn points(&self, instant: &Instant) -> Vec<PointMotion>;

    /// Returns the requested transmissions and sensitivities, in the order of [`crate::derivatives::names`];
    /// `None` if the equations are singular.
    fn derivatives(&self, instant: &Instant) -> Option<Vec<f64>>;

    /// Returns the requested driving forces, reactions and energies, in the order of [`crate::forces::names`]; `None` if the equations
    /// are singular.
    fn forces(&self, instant: &Instant) -> Option<Vec<f64>>;

    /// Returns the distances of its subsystems from singular; `None` if the formulation has no subsystems.
    fn measures(&self) -> Option<Measures>;

    /// Singular poses of its subsystems, in words; empty if the formulation has no subsystems.
    fn singular_poses(&self) -> &[SingularPose];

    /// Reports that the mechanism cannot be assembled in the modes of its design configuration, with the reason.
    fn not_assembled(&self, failure: &Failure) -> String;

    /// Reports the end of a motion with this last instant, with the reason.
    fn ended(&self, failure: &Failure, last: &Instant) -> String;

    /// Returns the laws of the inputs.
    fn input_laws(&self) -> InputLaws {
        InputLaws::of(self.pool(), self.system())
    }
}
