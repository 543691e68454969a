//! Defines the quantities of `measure` statements.
//!
//! A value is a formula of coordinates, t, inputs and parameters, and of symbols that stand for what the equations determine:
//! rotated local vectors, rates, forces, and earlier measures.

use super::Dimension;
use crate::diagnostic::Span;
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::Mark;

/// Symbols of the components of a rotated local vector R s; `None` if they do not occur.
pub type ArmSymbols = Option<[SymbolId; 2]>;

/// A named quantity of the motion.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// Name as written: the column in tables of frames.
    pub name: String,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Value in SI units.
    pub value: ExprId,
    /// Symbol of the value in later measures.
    pub symbol: SymbolId,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// Highest order of differentiation in time: 0 for positions, 1 for rates, 2 for accelerations, 3 for forces.
    pub order: usize,
    /// Points in the value.
    pub marks: Vec<(Mark, ArmSymbols)>,
    /// Symbols in the value and in other terms; a term comes before those that contain its symbol.
    pub terms: Vec<(SymbolId, MeasureTerm)>,
    /// Source location of the name.
    pub span: Span,
}

/// Meaning of a symbol in a measure.
#[derive(Clone, Debug, PartialEq)]
pub enum MeasureTerm {
    /// Rate of a formula.
    Rate(ExprId),
    /// Length of a vector.
    Length {
        /// Stem of names in generated code: `o_b`, `speed_k`.
        name: String,
        /// Components of the vector.
        components: Vec<ExprId>,
    },
    /// Force, torque, power or energy.
    Force(ForceTerm),
}

/// Force, torque, power or energy in a measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceTerm {
    /// Force or torque of a driver: an index into the mechanism's joints.
    Effort(usize),
    /// Power of a driver: an index into the mechanism's joints.
    Power(usize),
    /// Part of the reaction of a joint: an index into the mechanism's joints.
    Reaction(usize, ReactionPart),
    /// Kinetic energy of all masses.
    KineticEnergy,
    /// Potential energy of gravity and springs.
    PotentialEnergy,
}

/// Part of a reaction on the second body of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReactionPart {
    /// Component of the force along x.
    X,
    /// Component of the force along y.
    Y,
    /// Moment about the point of the joint.
    Moment,
}

impl Measurement {
    /// Returns the forces in the measure.
    pub fn forces(&self) -> impl Iterator<Item = ForceTerm> {
        self.terms.iter().filter_map(|(_, term)| match term {
            MeasureTerm::Force(force) => Some(*force),
            MeasureTerm::Rate(_) | MeasureTerm::Length { .. } => None,
        })
    }

    /// Returns the unit in tables of frames: `m/s`, `N`, `rad`; empty for plain numbers.
    pub fn unit(&self) -> String {
        self.dimension.column_unit()
    }
}
