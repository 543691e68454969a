//! Defines what a formulation of a mechanism provides for solutions and reports.

use linkwright::{Blocks, Failure, PointMotion};
use linkwright_codegen::stages::emit::derivation::SingularPose;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::{Derived, System};

use crate::emitted::Emitted;
use crate::instant::{Instant, Layout};
use crate::measures::Measures;
use crate::supplied::{InputLaws, InputSignals, ModeName, Modes, ParameterValues, Pose};

/// Formulation of a described mechanism: block by block in [`Interpreted`](crate::Interpreted), or all equations at once in
/// [`Dense`](crate::Dense).
///
/// ```
/// use linkwright::{Blocks, Settings, Shell};
/// use linkwright_codegen::{Source, read};
/// use linkwright_solver::{Dense, Interpreted, View};
///
/// /// x (m) of the second point at t = 0.5 s.
/// fn x_of<V: View>(view: V) -> Result<f64, linkwright::Failure> {
///     let (parameters, laws) = (view.nominal_parameters(), view.input_laws());
///     let (pose, modes) = (view.drawn_pose(&parameters), view.drawn_branches());
///     let mut shell = Shell::assemble(view, &parameters, &pose, modes, 0.0, &laws.at(0.0), Settings::default())?;
///     shell.advance(0.5, &laws.at(0.5))?;
///     Ok(shell.blocks().points(shell.frame())[1].position[0])
/// }
///
/// let text = "
///     mechanism crank {
///         point O = (0, 0);
///         body arm at O { O, A: (2, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///         output A;
///     }";
/// let read = read(&Source::new("crank.mech", text)).expect("no errors");
/// let derived = &read.motions[0];
/// let blocks = Interpreted::new(derived).expect("the equations determine the motion");
/// for x in [x_of(blocks)?, x_of(Dense::new(derived))?] {
///     assert!((x - 2.0 * 1.5_f64.cos()).abs() < 1e-12);
/// }
/// # Ok::<(), linkwright::Failure>(())
/// ```
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
    #[doc(hidden)]
    fn pool(&self) -> &Pool {
        &self.derived().pool
    }

    /// Equations of the mechanism.
    #[doc(hidden)]
    fn system(&self) -> &System {
        &self.derived().system
    }

    /// Layout of the values of instants.
    #[doc(hidden)]
    fn layout(&self) -> &Layout;

    /// Program that is written out, if it omits some values of instants; `None` if these are its own.
    fn emitted(&self) -> Option<&Emitted<Self>> {
        None
    }

    /// Names of the assembly modes that can be selected: first those of closed forms, then the others.
    #[doc(hidden)]
    fn mode_names(&self) -> Vec<ModeName>;

    /// Number of Newton-Raphson steps so far, and of solves.
    fn newton_steps(&self) -> [u64; 2];

    /// Returns the motion of all points that instants offer, in the order of their names: those of the description, in its order, unless
    /// single outputs limit them.
    fn points(&self, instant: &Instant) -> Vec<PointMotion>;

    /// Returns the requested transmissions and sensitivities, in the order of [`crate::derivatives::names`];
    /// `None` if the equations are singular.
    #[doc(hidden)]
    fn derivatives(&self, instant: &Instant) -> Option<Vec<f64>>;

    /// Returns the requested driving forces, reactions and energies, and the measures, in the order of [`crate::reported::names`];
    /// `None` if the equations are singular.
    #[doc(hidden)]
    fn reported(&self, instant: &Instant) -> Option<Vec<f64>>;

    /// Returns the distances of its subsystems from singular; `None` if the formulation has no subsystems.
    #[doc(hidden)]
    fn measures(&self) -> Option<Measures>;

    /// Singular poses of its subsystems, in words; empty if the formulation has no subsystems.
    #[doc(hidden)]
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
