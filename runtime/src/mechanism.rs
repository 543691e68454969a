//! Declares what all types of mechanisms have in common.

use crate::blocks::Blocks;
use crate::shell::Shell;

/// Any mechanism: a type of its own around a [`Shell`], with its own names for the shell's functions.
///
/// Code for this trait works with every generated and every interpreted mechanism:
///
/// ```
/// use linkwright::{Blocks, Mechanism};
///
/// /// Largest speed (m/s) of the points that frames offer.
/// fn largest_speed<M: Mechanism>(mechanism: &M) -> f64
/// where
///     M::Blocks: Blocks<Scalar = f64>,
/// {
///     let (blocks, frame) = (mechanism.shell().blocks(), mechanism.shell().frame());
///     let points = (0..).map_while(|index| blocks.point(frame, index));
///     points.map(|point| point.velocity[0].hypot(point.velocity[1])).fold(0.0, f64::max)
/// }
///
/// linkwright_macros::mechanism! {
///     mechanism crank {
///         point O = (0, 0);
///         body arm at O { O, A: (2, 0), B: (1, 0) }
///         revolute O(ground, arm);
///         drive phi(arm) = 3*t;
///     }
/// }
/// let crank = crank::Crank::assemble(0.0)?;
/// assert!((largest_speed(&crank) - 6.0).abs() < 1e-12);
/// # Ok::<(), linkwright::Failure>(())
/// ```
pub trait Mechanism: Sized {
    /// Equations of the mechanism.
    type Blocks: Blocks;

    /// Returns the mechanism in this state.
    fn from_shell(shell: Shell<Self::Blocks>) -> Self;

    /// State of the mechanism.
    fn shell(&self) -> &Shell<Self::Blocks>;

    /// Mutable state of the mechanism.
    fn shell_mut(&mut self) -> &mut Shell<Self::Blocks>;
}

impl<B: Blocks> Mechanism for Shell<B> {
    type Blocks = B;

    fn from_shell(shell: Shell<B>) -> Self {
        shell
    }

    fn shell(&self) -> &Shell<B> {
        self
    }

    fn shell_mut(&mut self) -> &mut Shell<B> {
        self
    }
}
