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
mod friction;
mod length;
mod mark_names;
mod measures;
mod orientation;
mod own_columns;
mod pressure;
mod row_name;
mod tooth_force;
mod vector_form;
mod vector_sum;
mod wishes;
mod written_order;

pub use assemble::{assemble, assemble_without};
pub use carried::{Carried, Component};
pub use direction::{Cause, Direction};
pub use forces::{Forces, Passing, Weight};
pub use friction::Resisting;
pub use measures::{Definition, ForceColumn, Measures};
pub use pressure::Pressure;
pub use tooth_force::ToothForce;
pub use vector_form::{VectorForm, VectorRow};
pub use vector_sum::VectorTerm;
pub use written_order::WrittenOrder;

use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::model::Mechanism;
use crate::pool::{Pool, SymbolRole};

/// Equations of a mechanism; a [`Pool`] holds their expressions.
#[derive(Clone, Debug)]
pub struct System {
    /// Mechanism.
    pub mechanism: Mechanism,
    /// q: x, y, φ of every moving body in written order, then the contact parameters of the joints in written order.
    pub coordinates: Vec<Unknown>,
    /// Φ and its derivatives, one row per scalar equation, in written order.
    pub rows: Vec<Row>,
    /// Rows of joints marked `redundant` that repeat `rows`, in written order. These rows are monitored and not solved.
    pub monitored: Vec<Row>,
    /// Motion of every declared point.
    pub outputs: Vec<Output>,
    /// Requested directions of motion besides time.
    pub directions: Vec<Direction>,
    /// (Φ_q q̇ + Φ_t)_q row by row; empty if no sensitivity is requested.
    pub rate_jacobian: Vec<Vec<Entry>>,
    /// Pressure angles of cams and their followers.
    pub pressures: Vec<Pressure>,
    /// Loads and energies; `None` if no forces are requested.
    pub forces: Option<Forces>,
    /// Quantities of `measure` statements.
    pub measures: Measures,
    /// Constraints in vector form.
    pub vector_form: VectorForm,
    /// Lengths whose maximum is the scale of lengths. Empty if no parameter changes them; the scale is then the largest design
    /// coordinate.
    pub lengths: Vec<ExprId>,
}

/// Equations of a motion, with the pool of their expressions.
#[derive(Clone, Debug)]
pub struct Derived {
    /// Expressions and symbols of the equations.
    #[doc(hidden)]
    pub pool: Pool,
    /// Equations.
    #[doc(hidden)]
    pub system: System,
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

impl Unknown {
    /// Returns the symbols of the unknown, its rate and its acceleration.
    pub fn symbols(&self) -> [SymbolId; 3] {
        [self.position, self.rate, self.acceleration]
    }
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

    /// Returns the name of an unknown: a coordinate, or an auxiliary unknown of the vector form.
    pub fn unknown_name(&self, unknown: usize) -> &str {
        &self.vector_form.unknowns[unknown].name
    }

    /// True if a symbol is a coordinate, a rate or an acceleration.
    pub fn is_coordinate(&self, symbol: SymbolId, pool: &Pool) -> bool {
        match pool.role(symbol) {
            SymbolRole::Position(unknown)
            | SymbolRole::Rate(unknown)
            | SymbolRole::Acceleration(unknown) => unknown < self.coordinates.len(),
            _ => false,
        }
    }

    /// Returns the plain name of a symbol: `phi_c3`, `phi_c3_rate`, `l_c3_x`.
    pub fn symbol_name(&self, symbol: SymbolId, pool: &Pool) -> String {
        match pool.role(symbol) {
            SymbolRole::Position(unknown) => self.unknown_name(unknown).to_string(),
            SymbolRole::Rate(unknown) => format!("{}_rate", self.unknown_name(unknown)),
            SymbolRole::Acceleration(unknown) => {
                format!("{}_acceleration", self.unknown_name(unknown))
            }
            SymbolRole::Time => "t".to_string(),
            SymbolRole::Last(symbol) => format!("last_{}", self.symbol_name(symbol, pool)),
            SymbolRole::Arm(_)
            | SymbolRole::Intermediate
            | SymbolRole::Parameter(_)
            | SymbolRole::Input { .. } => pool.local_name(symbol).to_string(),
        }
    }
}
