//! Derives the equations of a mechanism in the textbook formulation.
//!
//! Φ(q, t) is in absolute coordinates, with rows in written order; Φ_q, Φ_t and γ come from differentiation alone. The Jacobian
//! lists the entries that are not identically zero, row by row. Points have position, velocity and acceleration in terms of q,
//! q̇, q̈. Each requested direction has its column ∂Φ/∂δ. If forces are requested, each coordinate has its load.

mod assemble;
mod auxiliary;
mod carried;
mod direction;
mod drawn;
mod forces;
mod length;
mod mark_names;
mod orientation;
mod own_columns;
mod pressure;
mod rate;
mod row_name;
mod settled;
mod tooth_force;
mod turned;
mod vector_form;
mod vector_sum;
mod wishes;
mod written_order;

pub use assemble::{assemble, assemble_without};
pub use carried::{Carried, Component};
pub use direction::{Cause, Direction};
pub use forces::{Forces, Passing, Weight};
pub use pressure::Pressure;
pub use settled::Settled;
pub use tooth_force::ToothForce;
pub use vector_form::{Arm, VectorForm};
pub use vector_sum::VectorTerm;
pub use written_order::WrittenOrder;

use crate::diagnostic::Span;
use crate::expr::{Excess, ExprId, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::model::Mechanism;

/// Equations of a mechanism.
#[derive(Clone, Debug)]
pub struct System {
    /// Mechanism; its graph holds every expression below.
    pub mechanism: Mechanism,
    /// q: x, y, φ of every moving body in written order, then the contact parameters of the joints in written order.
    pub coordinates: Settled<Vec<Unknown>>,
    /// Φ and its derivatives, one row per scalar equation, in written order.
    pub rows: Settled<Vec<Row>>,
    /// Rows of joints marked `redundant` that repeat `rows`, in written order. These rows are monitored and not solved.
    pub monitored: Settled<Vec<Row>>,
    /// Motion of every declared point.
    pub outputs: Settled<Vec<Output>>,
    /// Requested directions of motion besides time.
    pub directions: Settled<Vec<Direction>>,
    /// (Φ_q q̇ + Φ_t)_q row by row; empty if no sensitivity is requested.
    pub rate_jacobian: Settled<Vec<Vec<Entry>>>,
    /// Pressure angles of cams and their followers.
    pub pressures: Settled<Vec<Pressure>>,
    /// Loads and energies; `None` if no forces are requested.
    pub forces: Option<Forces>,
    /// Constraints in vector form.
    pub vector_form: VectorForm,
    /// Lengths whose maximum is the scale of lengths. Empty if no parameter changes them; the scale is then the largest design
    /// coordinate.
    pub lengths: Settled<Vec<ExprId>>,
    /// Role of each symbol of the graph, by [`SymbolId::index`].
    pub roles: Settled<Vec<SymbolRole>>,
    /// Limit that the derivation exceeded, if any: expressions behind that statement are not derived.
    pub exceeded: Settled<Option<Exceeded>>,
}

/// Limit that was exceeded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exceeded {
    /// Statement that exceeded the limit.
    pub at: Span,
    /// Exceeded limit.
    pub bound: Bound,
}

/// Limits on a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Limit on memory or work of the graph.
    Graph(Excess),
    /// Limit on unknowns that are solved simultaneously; the value is their number in this system.
    Together(usize),
}

/// Role of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SymbolRole {
    /// Coordinate q_k; the auxiliary unknowns of the vector form are numbered after the coordinates.
    Position(usize),
    /// Rate q̇_k.
    Rate(usize),
    /// Acceleration q̈_k.
    Acceleration(usize),
    /// Component of a rotated local vector of the vector form.
    Arm(usize),
    /// Intermediate value.
    Intermediate,
    /// Value of a symbol in the last frame.
    Last(SymbolId),
    /// Time t.
    Time,
    /// Parameter of the mechanism.
    Parameter(usize),
    /// Input of the mechanism.
    Input {
        /// Index into the mechanism's inputs.
        input: usize,
        /// 0 for the value, 1 for the rate, 2 for the acceleration.
        level: usize,
    },
}

/// Meaning of an unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Described {
    /// Position or orientation of a body.
    Pose {
        /// Index into the mechanism's bodies.
        body: usize,
        /// 0 for x, 1 for y, 2 for φ.
        axis: usize,
    },
    /// Contact point of a joint on its curve: an artificial coordinate (Nikravesh 1988, section 4.2.4).
    Contact {
        /// Index into the mechanism's joints.
        joint: usize,
    },
    /// Auxiliary unknown of a joint's vector form.
    Auxiliary,
}

impl Described {
    /// Returns the body whose pose the unknown describes; `None` if the unknown is not of a pose.
    pub fn body(self) -> Option<usize> {
        match self {
            Described::Pose { body, .. } => Some(body),
            Described::Contact { .. } | Described::Auxiliary => None,
        }
    }
}

/// Unknown with its derivatives: a coordinate, or an auxiliary unknown of the vector form.
#[derive(Clone, Debug)]
pub struct Unknown {
    /// Name such as `x1`, `phi_c1` or `length_n_m`.
    pub name: String,
    /// Unknown q_k.
    pub position: SymbolId,
    /// Rate q̇_k.
    pub rate: SymbolId,
    /// Acceleration q̈_k.
    pub acceleration: SymbolId,
    /// Meaning of the unknown.
    pub describes: Described,
    /// Length (x, y, ℓ) or angle (φ); a contact parameter has the quantity of its description.
    pub quantity: Quantity,
    /// Value in the design configuration.
    pub estimate: ExprId,
}

/// Scalar equation Φ_i(q, t) = 0.
#[derive(Clone, Debug)]
pub struct Row {
    /// Joint or driver of the equation: an index into the mechanism's joints.
    pub joint: usize,
    /// Unique name in lower case: `p_x`, `drive_phi_1`.
    pub name: String,
    /// Quantity of the residual.
    pub quantity: Quantity,
    /// Φ_i.
    pub residual: ExprId,
    /// Entries ∂Φ_i/∂q_k that are not identically zero, by ascending coordinate.
    pub jacobian: Vec<Entry>,
    /// ∂Φ_i/∂t with the rates of inputs: the rate of Φ_i while the coordinates are constant.
    pub time_derivative: ExprId,
    /// γ_i = −((Φ_q q̇)_q q̇ + 2 Φ_qt q̇ + Φ_tt)_i (Haug 1989, eq. 3.6.11); inputs count as functions of t.
    pub gamma: ExprId,
    /// Bodies of the equation in the order in which the joint names them; printed terms follow this order.
    pub bodies: Vec<usize>,
}

/// Entry of Φ_q.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Index into the coordinates.
    pub coordinate: usize,
    /// ∂Φ_i/∂q_k.
    pub value: ExprId,
}

/// Motion of a point in terms of q, q̇, q̈.
#[derive(Clone, Debug)]
pub struct Output {
    /// Name of the point.
    pub name: String,
    /// r + R s, in m.
    pub position: [ExprId; 2],
    /// Velocity, in m/s.
    pub velocity: [ExprId; 2],
    /// Acceleration, in m/s².
    pub acceleration: [ExprId; 2],
}

impl System {
    /// Returns a row by its number: solved rows first, then monitored rows.
    pub fn row(&self, index: usize) -> &Row {
        match index.checked_sub(self.rows.len()) {
            None => &self.rows[index],
            Some(place) => &self.monitored[place],
        }
    }

    /// Records an exceeded limit; the first one is kept.
    pub fn exceed(&mut self, exceeded: Exceeded) {
        self.exceeded.write().get_or_insert(exceeded);
    }

    /// Records roles of rotated local vectors that were made for angles that follow others.
    pub fn note_arms(&mut self) {
        let roles = self.roles.write();
        roles.resize(
            self.mechanism.graph.symbol_count(),
            SymbolRole::Intermediate,
        );
        self.vector_form.note_roles(roles, self.coordinates.len());
    }

    /// Returns a new symbol for an intermediate value. Text after a space in `name` only distinguishes equal names.
    pub fn intermediate(&mut self, name: &str) -> SymbolId {
        let number = self.mechanism.graph.symbol_count();
        let symbol = self.mechanism.graph.symbol(&format!("{name} {number}"));
        self.roles
            .write()
            .resize(symbol.index() + 1, SymbolRole::Intermediate);
        symbol
    }

    /// Returns the symbol of a value in the last frame; constant values keep their symbol.
    pub fn last(&mut self, symbol: SymbolId) -> SymbolId {
        let graph = &mut self.mechanism.graph;
        if graph.nominal(symbol).is_some() {
            return symbol;
        }
        let name = format!("last {}", graph.symbol_name(symbol));
        let last = graph.symbol(&name);
        if self.roles.len() <= last.index() {
            self.roles
                .write()
                .resize(last.index() + 1, SymbolRole::Intermediate);
        }
        self.roles.write()[last.index()] = SymbolRole::Last(symbol);
        last
    }

    /// Returns an expression with the values of the last frame.
    pub fn in_last_frame(&mut self, expr: ExprId) -> ExprId {
        let symbols = self.mechanism.graph.symbols(expr).to_vec();
        let replaced: Vec<(SymbolId, ExprId)> = symbols
            .into_iter()
            .map(|symbol| {
                let last = self.last(symbol);
                (symbol, self.mechanism.graph.variable(last))
            })
            .collect();
        self.mechanism.graph.substitute(expr, &replaced)
    }

    /// Returns the rotated local vector R(φ) s in the orientation of the unknown `angle`, and records the roles of its symbols.
    pub fn arm(&mut self, angle: usize, local: Vector, name: &str) -> Vector {
        let graph = &mut self.mechanism.graph;
        let arm = self.vector_form.arm(angle, local, name, graph);
        if let Some(place) = self.vector_form.place_of_arm(angle, local) {
            for symbol in self.vector_form.arms[place].symbols {
                if self.roles.len() <= symbol.index() {
                    self.roles
                        .write()
                        .resize(symbol.index() + 1, SymbolRole::Intermediate);
                }
                self.roles.write()[symbol.index()] = SymbolRole::Arm(place);
            }
        }
        arm
    }

    /// Returns the name of an unknown: a coordinate, or an auxiliary unknown of the vector form.
    pub fn unknown_name(&self, unknown: usize) -> &str {
        &self.vector_form.unknowns[unknown].name
    }

    /// True if a symbol is a coordinate, a rate or an acceleration.
    pub fn is_coordinate(&self, symbol: SymbolId) -> bool {
        match self.roles[symbol.index()] {
            SymbolRole::Position(unknown)
            | SymbolRole::Rate(unknown)
            | SymbolRole::Acceleration(unknown) => unknown < self.coordinates.len(),
            _ => false,
        }
    }

    /// Returns the plain name of a symbol: `phi_c3`, `phi_c3_rate`, `l_c3_x`.
    pub fn symbol_name(&self, symbol: SymbolId) -> String {
        match self.roles[symbol.index()] {
            SymbolRole::Position(unknown) => self.unknown_name(unknown).to_string(),
            SymbolRole::Rate(unknown) => format!("{}_rate", self.unknown_name(unknown)),
            SymbolRole::Acceleration(unknown) => {
                format!("{}_acceleration", self.unknown_name(unknown))
            }
            SymbolRole::Time => "t".to_string(),
            SymbolRole::Last(symbol) => format!("last_{}", self.symbol_name(symbol)),
            SymbolRole::Arm(_)
            | SymbolRole::Intermediate
            | SymbolRole::Parameter(_)
            | SymbolRole::Input { .. } => self.local_name(symbol).to_string(),
        }
    }

    /// Returns the name of an arm, a parameter, an input or an intermediate value. Text after a space only distinguishes equal
    /// names.
    pub fn local_name(&self, symbol: SymbolId) -> &str {
        let name = self.mechanism.graph.symbol_name(symbol);
        name.split(' ').next().unwrap_or(name)
    }
}
