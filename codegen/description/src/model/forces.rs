//! What bodies weigh, what acts on them, and which of the forces that follow are wanted.

use std::sync::Arc;

use super::teeth::Teeth;
use crate::diagnostic::Span;
use crate::expr::ExprId;
use crate::force::Element;
use crate::joint::geometry::{Mark, Vector};

/// The forces of a mechanism.
#[derive(Clone, Debug, Default)]
pub struct Forces {
    /// The bodies that have a mass, in written order, each once.
    pub masses: Vec<Mass>,
    /// The acceleration of what falls, in m/s².
    pub gravity: Option<Vector>,
    /// Springs, dampers, forces and torques, in written order.
    pub loads: Vec<Load>,
    /// The gears whose bearings carry the force of the teeth, in written order.
    pub teeth: Vec<Teeth>,
    /// The coordinates that forces move, in written order.
    pub free: Vec<Free>,
    /// Whether an `effort` statement asks what the drivers exert.
    pub efforts: bool,
    /// The joints whose reactions are asked for: indices into the joints, ascending, each once.
    pub reactions: Vec<usize>,
    /// Whether a `least_norm` statement says what redundant joints carry: of all that balances what acts, what is smallest.
    pub least_norm: bool,
    /// Whether rates and accelerations count as zero: what holds the mechanism where it is.
    pub at_rest: bool,
    /// Whether an `energy` statement asks for the work that is stored.
    pub energy: bool,
}

/// What a body weighs.
#[derive(Clone, Copy, Debug)]
pub struct Mass {
    /// An index into the bodies.
    pub body: usize,
    /// In kg.
    pub mass: ExprId,
    /// The center of mass.
    pub center: Mark,
    /// The moment of inertia about the center of mass, in kg·m².
    pub inertia: ExprId,
    /// The statement.
    pub span: Span,
}

/// A coordinate that forces move.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    /// The driver that holds it: an index into the joints.
    pub joint: usize,
    /// The signal that the driver follows: an index into the inputs.
    pub input: usize,
    /// The statement.
    pub span: Span,
}

/// Something that acts on bodies.
#[derive(Clone, Debug)]
pub struct Load {
    /// What it is, and on what.
    pub element: Arc<dyn Element>,
    /// How messages name it: `spring main`, `force on 1.P`.
    pub label: String,
    /// The statement.
    pub span: Span,
}

impl Forces {
    /// Whether any force is wanted, so that what acts has to be known.
    pub fn are_wanted(&self) -> bool {
        self.need_multipliers() || self.energy
    }

    /// Whether what drivers exert or joints carry is wanted.
    pub fn need_multipliers(&self) -> bool {
        self.need_efforts() || !self.reactions.is_empty()
    }

    /// Whether the work along the values of drivers is wanted.
    pub fn need_efforts(&self) -> bool {
        self.efforts || !self.free.is_empty()
    }
}
