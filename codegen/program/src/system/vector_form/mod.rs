//! The same constraints in vector form: what the solved view starts from.
//!
//! Every turned local vector R s is a pair of symbols, an *arm*, so that the rows are linear in positions and arms, and a
//! sliding joint has its displacement ℓ as an unknown, a link without a body its angle ψ. Afterwards an unknown has a constant coefficient wherever a person
//! would eliminate it by inspection. Time derivatives follow from the rule that an arm turns with its body: d(R s)/dt = φ̇ Ω R s.

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

/// The vector form of a mechanism.
#[derive(Clone, Debug)]
pub struct VectorForm {
    /// The coordinates in their order, then the auxiliary unknowns of the joints.
    pub unknowns: Settled<Vec<Unknown>>,
    /// As many rows as unknowns where the mechanism is driven.
    pub rows: Settled<Vec<VectorRow>>,
    /// Every turned local vector that occurs, in order of first use.
    pub arms: Settled<Vec<Arm>>,
    /// Which bodies share their sine and cosine.
    pub orientations: Settled<Orientations>,
    /// r + arm of each declared point, in the mechanism's order.
    pub points: Settled<Vec<Vector>>,
    naming: &'static Naming,
    /// Which of the textbook's rows of each joint are monitored and not solved.
    pub(super) dropped: Vec<Vec<bool>>,
    // The angle of each body; none for the ground.
    angles: Vec<Option<usize>>,
    /// d/dt of each symbol that moves.
    pub(super) rates: HashMap<SymbolId, ExprId>,
    // Looked up, never iterated.
    arm_places: HashMap<(usize, Vector), usize>,
    // The names of unknowns and arms; only looked up.
    pub(super) taken_names: HashSet<String>,
    // Of a name the number up to which all are taken; only looked up.
    name_numbers: HashMap<String, usize>,
    // Which arms each angle turns.
    arms_of: HashMap<usize, Vec<usize>>,
    // Which unknown a symbol is, or which arm it belongs to; only looked up.
    pub(super) roles: HashMap<SymbolId, SymbolRole>,
    pub(super) mark_names: MarkNames,
}

/// One scalar equation of the vector form.
#[derive(Clone, Copy, Debug)]
pub struct VectorRow {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Zero when satisfied.
    pub residual: ExprId,
    /// What the residual is measured in.
    pub quantity: Quantity,
    /// Which of the joint's rows it is: `x`, `angle`; empty where there is only one.
    pub component: &'static str,
}

impl VectorForm {
    /// States how a symbol that was made later moves.
    pub fn set_rate(&mut self, symbol: SymbolId, rate: ExprId) {
        self.rates.insert(symbol, rate);
    }

    /// The unknown angle of a body.
    pub fn angle_of(&self, body: usize) -> usize {
        let Some(angle) = self.angles[body] else {
            unreachable!("the ground has no angle")
        };
        angle
    }

    /// Whether a body turns with the angle `unknown`.
    pub fn turns(&self, body: BodyId, unknown: usize) -> bool {
        let (leader, _) = self.orientations.leader(body);
        leader != BodyId::GROUND && self.angle_of(leader.0) == unknown
    }

    /// The unknown that a symbol is.
    pub fn place_of_unknown(&self, symbol: SymbolId) -> Option<usize> {
        match self.roles.get(&symbol) {
            Some(&SymbolRole::Position(place)) => Some(place),
            _ => None,
        }
    }

    /// The unknowns that an expression mentions, themselves or through the arms that they turn: ascending.
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

    /// What the symbols of the vector form are.
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
