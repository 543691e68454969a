//! Mechanism → System.
//!
//! The textbook view: Φ(q, t) in absolute coordinates, rows in written order, with Φ_q, Φ_t and γ by differentiation alone.
//! Afterwards the Jacobian lists exactly the entries that are not identically zero, row by row, and every point has its
//! position, velocity and acceleration as expressions of q, q̇, q̈; every direction that a statement asks for has its column
//! ∂Φ/∂δ; where forces are wanted, every coordinate has its load. Deliberately unknown here: joint kinds, and how the equations are
//! solved.

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

/// The equations of a mechanism.
#[derive(Clone, Debug)]
pub struct System {
    /// The mechanism; its graph holds every expression below.
    pub mechanism: Mechanism,
    /// q: x, y, φ of every moving body in written order, then the contact parameters of the joints in written order.
    pub coordinates: Settled<Vec<Unknown>>,
    /// Φ and what is derived from it, a row per scalar equation, in written order.
    pub rows: Settled<Vec<Row>>,
    /// Rows of joints marked `redundant` that repeat what `rows` say: not solved, but watched. In written order.
    pub monitored: Settled<Vec<Row>>,
    /// The motion of every declared point.
    pub outputs: Settled<Vec<Output>>,
    /// What the pose is moved along besides time, where a statement asks for it.
    pub directions: Settled<Vec<Direction>>,
    /// (Φ_q q̇ + Φ_t)_q row by row, where a sensitivity is asked for.
    pub rate_jacobian: Settled<Vec<Vec<Entry>>>,
    /// The pressure angles of cams and their followers.
    pub pressures: Settled<Vec<Pressure>>,
    /// What acts on the bodies, where forces are wanted.
    pub forces: Option<Forces>,
    /// The same constraints in vector form.
    pub vector_form: VectorForm,
    /// The lengths whose largest is what lengths are judged against, where parameters change one of them; else none, and it is
    /// the drawing's largest coordinate.
    pub lengths: Settled<Vec<ExprId>>,
    /// What each symbol of the graph is, by [`SymbolId::index`].
    pub roles: Settled<Vec<SymbolRole>>,
    /// The bound that the equations or their solution passed, where they did: what is behind it is not derived.
    pub exceeded: Settled<Option<Exceeded>>,
}

/// A bound that was passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exceeded {
    /// The statement with which it was.
    pub at: Span,
    /// Which one.
    pub bound: Bound,
}

/// What bounds a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The room and the work of the graph.
    Graph(Excess),
    /// How many unknowns may have to be found at once: so many would have to be.
    Together(usize),
}

/// What a symbol stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SymbolRole {
    /// The coordinate q_k; the auxiliary unknowns of the vector form are numbered after the coordinates.
    Position(usize),
    /// The rate q̇_k.
    Rate(usize),
    /// The acceleration q̈_k.
    Acceleration(usize),
    /// A component of an arm of the vector form.
    Arm(usize),
    /// A value that is computed on the way.
    Intermediate,
    /// What a symbol was in the last frame.
    Last(SymbolId),
    /// The time t.
    Time,
    /// A parameter of the mechanism.
    Parameter(usize),
    /// An input of the mechanism: its value at level 0, its rate at level 1, its acceleration at level 2.
    Input {
        /// Index into the mechanism's inputs.
        input: usize,
        /// 0 for the value, 1 for the rate, 2 for the acceleration.
        level: usize,
    },
}

/// What an unknown says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Described {
    /// Where a body is, or how it is turned.
    Pose {
        /// An index into the mechanism's bodies.
        body: usize,
        /// 0 for x, 1 for y, 2 for φ.
        axis: usize,
    },
    /// Where a joint touches its curve: an artificial coordinate (Nikravesh 1988, section 4.2.4).
    Contact {
        /// An index into the mechanism's joints.
        joint: usize,
    },
    /// What the vector form of a joint has beside the coordinates.
    Auxiliary,
}

impl Described {
    /// The body whose pose it belongs to.
    pub fn body(self) -> Option<usize> {
        match self {
            Described::Pose { body, .. } => Some(body),
            Described::Contact { .. } | Described::Auxiliary => None,
        }
    }
}

/// What is solved for, with its derivatives: a coordinate, or what the vector form has beside them.
#[derive(Clone, Debug)]
pub struct Unknown {
    /// `x1`, `phi_c1`, `length_n_m`.
    pub name: String,
    /// The unknown q_k.
    pub position: SymbolId,
    /// Its rate q̇_k.
    pub rate: SymbolId,
    /// Its acceleration q̈_k.
    pub acceleration: SymbolId,
    /// What it says.
    pub describes: Described,
    /// Whether it is a length (x, y, ℓ) or an angle (φ); a contact parameter is what the description measures it in.
    pub quantity: Quantity,
    /// Its value in the drawing.
    pub estimate: ExprId,
}

/// One scalar equation Φ_i(q, t) = 0.
#[derive(Clone, Debug)]
pub struct Row {
    /// The joint or driver it comes from: an index into the mechanism's joints.
    pub joint: usize,
    /// A unique name in lower case: `p_x`, `drive_phi_1`.
    pub name: String,
    /// What the residual is measured in.
    pub quantity: Quantity,
    /// Φ_i.
    pub residual: ExprId,
    /// The entries ∂Φ_i/∂q_k that are not identically zero, by ascending coordinate.
    pub jacobian: Vec<Entry>,
    /// ∂Φ_i/∂t, and what the rates of inputs add: the rate of Φ_i with the coordinates held.
    pub time_derivative: ExprId,
    /// γ_i = −((Φ_q q̇)_q q̇ + 2 Φ_qt q̇ + Φ_tt)_i (Haug 1989, eq. 3.6.11); inputs count as functions of t.
    pub gamma: ExprId,
    /// The bodies it mentions in the order in which the joint names them; printing follows it.
    pub bodies: Vec<usize>,
}

/// One entry of Φ_q.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Index into the coordinates.
    pub coordinate: usize,
    /// ∂Φ_i/∂q_k.
    pub value: ExprId,
}

/// The motion of a point in terms of q, q̇, q̈.
#[derive(Clone, Debug)]
pub struct Output {
    /// Name of the point.
    pub name: String,
    /// r + R s, in m.
    pub position: [ExprId; 2],
    /// Its rate, in m/s.
    pub velocity: [ExprId; 2],
    /// Its second rate, in m/s².
    pub acceleration: [ExprId; 2],
}

impl System {
    /// A row by its number: the solved ones first, then the monitored ones.
    pub fn row(&self, index: usize) -> &Row {
        match index.checked_sub(self.rows.len()) {
            None => &self.rows[index],
            Some(place) => &self.monitored[place],
        }
    }

    /// Notes that a bound is passed; the first one that is counts.
    pub fn exceed(&mut self, exceeded: Exceeded) {
        self.exceeded.write().get_or_insert(exceeded);
    }

    /// What arms are that were made for angles that follow others.
    pub fn note_arms(&mut self) {
        let roles = self.roles.write();
        roles.resize(
            self.mechanism.graph.symbol_count(),
            SymbolRole::Intermediate,
        );
        self.vector_form.note_roles(roles, self.coordinates.len());
    }

    /// A new symbol for a value that is computed on the way. Equal names are told apart by what follows the space.
    pub fn intermediate(&mut self, name: &str) -> SymbolId {
        let number = self.mechanism.graph.symbol_count();
        let symbol = self.mechanism.graph.symbol(&format!("{name} {number}"));
        self.roles
            .write()
            .resize(symbol.index() + 1, SymbolRole::Intermediate);
        symbol
    }

    /// What a symbol was in the last frame; what keeps its value is what it was.
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

    /// What an expression was in the last frame.
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

    /// The arm R(φ) s of a local vector in the orientation of the unknown `angle`, and what its symbols are.
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

    /// The name of an unknown: a coordinate, or an auxiliary unknown of the vector form.
    pub fn unknown_name(&self, unknown: usize) -> &str {
        &self.vector_form.unknowns[unknown].name
    }

    /// Whether a symbol is a coordinate, its rate or its acceleration.
    pub fn is_coordinate(&self, symbol: SymbolId) -> bool {
        match self.roles[symbol.index()] {
            SymbolRole::Position(unknown)
            | SymbolRole::Rate(unknown)
            | SymbolRole::Acceleration(unknown) => unknown < self.coordinates.len(),
            _ => false,
        }
    }

    /// The plain name of a symbol: `phi_c3`, `phi_c3_rate`, `l_c3_x`.
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

    /// The name of a symbol that is no coordinate and no time: an arm, a parameter, an input or a value computed on the way.
    /// What follows a space only tells equal names apart.
    pub fn local_name(&self, symbol: SymbolId) -> &str {
        let name = self.mechanism.graph.symbol_name(symbol);
        name.split(' ').next().unwrap_or(name)
    }
}
