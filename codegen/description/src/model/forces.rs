//! Defines masses, loads and requested forces of a mechanism.

use std::sync::Arc;

use super::friction::Friction;
use super::teeth::Teeth;
use crate::diagnostic::Span;
use crate::expr::ExprId;
use crate::force::Element;
use crate::joint::geometry::{Mark, Vector};

/// Forces of a mechanism.
#[derive(Clone, Debug, Default)]
pub struct Forces {
    /// Masses of bodies, in source order, without duplicates.
    pub masses: Vec<Mass>,
    /// Acceleration of free fall, in m/s²; `None` without gravity.
    pub gravity: Option<Vector>,
    /// Springs, dampers, forces and torques, in source order.
    pub loads: Vec<Load>,
    /// Gears whose bearings carry the force of the teeth, in source order.
    pub teeth: Vec<Teeth>,
    /// Friction in joints: pins before slides, each in the order of the joints.
    pub frictions: Vec<Friction>,
    /// Coordinates moved by forces, in source order.
    pub free: Vec<Free>,
    /// True if an `effort` statement requests the driving forces and torques.
    pub efforts: bool,
    /// Indices of the joints whose reactions are requested, ascending, without duplicates.
    pub reactions: Vec<usize>,
    /// True if a `least_norm` statement selects the reactions of least norm for redundant joints.
    pub least_norm: bool,
    /// True if rates and accelerations count as zero, for static equilibrium.
    pub at_rest: bool,
    /// True if an `energy` statement requests the stored energy.
    pub energy: bool,
}

/// Mass of a body.
#[derive(Clone, Copy, Debug)]
pub struct Mass {
    /// Index of the body.
    pub body: usize,
    /// Mass, in kg.
    pub mass: ExprId,
    /// Center of mass.
    pub center: Mark,
    /// Moment of inertia about the center of mass, in kg·m².
    pub inertia: ExprId,
    /// Location of the statement.
    pub span: Span,
}

/// A coordinate moved by forces.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    /// Index of the joint that is its driver.
    pub joint: usize,
    /// Index of the input that the driver follows.
    pub input: usize,
    /// Location of the statement.
    pub span: Span,
}

/// A load on bodies.
#[derive(Clone, Debug)]
pub struct Load {
    /// Element with its points.
    pub element: Arc<dyn Element>,
    /// Label in messages: `spring main`, `force on 1.P`.
    pub label: String,
    /// Location of the statement.
    pub span: Span,
}

impl Forces {
    /// True if any force is requested, so that the loads must be evaluated.
    pub fn are_wanted(&self) -> bool {
        self.need_multipliers() || self.energy
    }

    /// True if driving forces or reactions are requested.
    pub fn need_multipliers(&self) -> bool {
        self.need_efforts() || !self.reactions.is_empty()
    }

    /// True if the generalized forces of the drivers are requested, or needed for free coordinates.
    pub fn need_efforts(&self) -> bool {
        self.efforts || !self.free.is_empty()
    }
}
