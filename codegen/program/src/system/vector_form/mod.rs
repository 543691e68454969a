//! Derives constraints in vector form, the basis of the solved formulation.
//!
//! Every rotated local vector R s is a pair of symbols, an *arm*, so that rows are linear in positions and arms. A sliding joint
//! has its displacement ℓ as an unknown, a link without a body its angle φ.
//!
//! Unknowns that can be eliminated by inspection have constant coefficients. Time derivatives follow from the rotation of an arm
//! with its body: d(R s)/dt = φ̇ Ω R s.

mod arms;
pub(super) mod making;

pub use arms::Arm;

use std::collections::{HashMap, HashSet};

use super::mark_names::MarkNames;
use super::orientation::Orientations;
use super::{Settled, SymbolRole, Unknown};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::{BodyId, Vector};
use crate::model::Naming;

/// Vector form of a mechanism.
#[derive(Clone, Debug)]
pub struct VectorForm {
    /// Coordinates in their order, then the auxiliary unknowns of the joints.
    pub unknowns: Settled<Vec<Unknown>>,
    /// Rows, as many as unknowns if the mechanism is driven.
    pub rows: Settled<Vec<VectorRow>>,
    /// Rotated local vectors, in order of first use.
    pub arms: Settled<Vec<Arm>>,
    /// Bodies that share their sine and cosine.
    pub orientations: Settled<Orientations>,
    /// Position r + arm of each declared point, in the mechanism's order.
    pub points: Settled<Vec<Vector>>,
    naming: &'static Naming,
    /// For each joint, true for each textbook row that is monitored and not solved.
    pub(super) dropped: Vec<Vec<bool>>,
    // The angle of each body; `None` for the ground.
    angles: Vec<Option<usize>>,
    /// Rate d/dt of each symbol that moves.
    pub(super) rates: HashMap<SymbolId, ExprId>,
    // Looked up, never iterated.
    arm_places: HashMap<(usize, Vector), usize>,
    // Names of unknowns and arms; only looked up.
    pub(super) taken_names: HashSet<String>,
    // For each name, the last number that is taken; only looked up.
    name_numbers: HashMap<String, usize>,
    // Arms that each angle rotates.
    arms_of: HashMap<usize, Vec<usize>>,
    // Roles of symbols of unknowns and arms; only looked up.
    pub(super) roles: HashMap<SymbolId, SymbolRole>,
    pub(super) mark_names: MarkNames,
}

/// Scalar equation of the vector form.
#[derive(Clone, Copy, Debug)]
pub struct VectorRow {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Residual, zero if the equation is satisfied.
    pub residual: ExprId,
    /// Quantity of the residual.
    pub quantity: Quantity,
    /// Component of the joint's equation: `x`, `angle`; empty if there is only one.
    pub component: &'static str,
}

impl VectorForm {
    /// Records the rate of a symbol that was made later.
    pub fn set_rate(&mut self, symbol: SymbolId, rate: ExprId) {
        self.rates.insert(symbol, rate);
    }

    /// Returns the unknown angle of a body.
    pub fn angle_of(&self, body: usize) -> usize {
        let Some(angle) = self.angles[body] else {
            unreachable!("the ground has no angle")
        };
        angle
    }

    /// True if a body rotates with the angle `unknown`.
    pub fn turns(&self, body: BodyId, unknown: usize) -> bool {
        let (leader, _) = self.orientations.leader(body);
        leader != BodyId::GROUND && self.angle_of(leader.0) == unknown
    }

    /// Returns the index of the unknown that a symbol is; `None` if the symbol is not an unknown.
    pub fn place_of_unknown(&self, symbol: SymbolId) -> Option<usize> {
        match self.roles.get(&symbol) {
            Some(&SymbolRole::Position(place)) => Some(place),
            _ => None,
        }
    }

    /// Returns the unknowns that an expression mentions, directly or through arms that they rotate, ascending.
    pub fn mentioned(&self, expr: ExprId, graph: &Graph) -> Vec<usize> {
        let symbols = graph.symbols(expr).iter();
        let mut unknowns: Vec<usize> = symbols
            .filter_map(|&symbol| {
                let turned_by = |place: usize| self.arms[place].angle;
                let turning = || self.place_of_symbol(symbol).map(turned_by);
                self.place_of_unknown(symbol).or_else(turning)
            })
            .collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns
    }

    /// Records the roles of the symbols of the vector form.
    pub(super) fn note_roles(&self, roles: &mut Vec<SymbolRole>, coordinates: usize) {
        for (index, unknown) in self.unknowns.iter().enumerate().skip(coordinates) {
            set(roles, unknown.position, SymbolRole::Position(index));
            set(roles, unknown.rate, SymbolRole::Rate(index));
            set(roles, unknown.acceleration, SymbolRole::Acceleration(index));
        }
        for (index, arm) in self.arms.iter().enumerate() {
            for symbol in arm.symbols {
                set(roles, symbol, SymbolRole::Arm(index));
            }
        }
    }
}

fn set(roles: &mut Vec<SymbolRole>, symbol: SymbolId, role: SymbolRole) {
    if roles.len() <= symbol.index() {
        roles.resize(symbol.index() + 1, SymbolRole::Intermediate);
    }
    roles[symbol.index()] = role;
}
