//! What acts on bodies → forces at points, torques, and the work that is stored, lost and supplied.
//!
//! One file per kind. A kind says which points it needs and what it exerts; everything else follows from these: generalized forces,
//! efforts, reactions, energies. Deliberately unknown here: names, units, and what the forces are wanted for.

mod applied;
mod damper;
mod spring;
mod torsion;

pub use applied::{AppliedForce, AppliedTorque, Terms};
pub use damper::Damper;
pub use spring::Spring;
pub use torsion::{TorsionDamper, TorsionSpring};

use std::fmt::Debug;

use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::geometry::{BodyId, Mark, Vector};

/// A point of a body as it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The point, with its arm R s as the equations have it.
    pub mark: Mark,
    /// Its velocity, in m/s.
    pub velocity: Vector,
    /// The rate of its body's angle, in rad/s.
    pub turning: ExprId,
}

/// What an element exerts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exerted {
    /// Forces in global components, in N, and the points that they act on.
    pub forces: Vec<(Mark, Vector)>,
    /// Torques, in N·m, and the bodies that they act on.
    pub torques: Vec<(BodyId, ExprId)>,
    /// The work that is stored, in J.
    pub stored: Option<ExprId>,
    /// The power that it adds to the mechanism beside what it has stored, in W: negative for a damper.
    pub added: Option<ExprId>,
    /// What the length is that stands for itself in all of this, in m: it must not vanish.
    pub length: Option<ExprId>,
    /// The formulas whose rates decide what it exerts.
    pub rated: Vec<Rated>,
}

/// A formula whose rate decides what a load exerts.
#[derive(Clone, Debug, PartialEq)]
pub struct Rated {
    /// Of coordinates, t, inputs, parameters and symbols that stand for arms.
    pub formula: ExprId,
    /// What these symbols stand for.
    pub arms: Vec<(SymbolId, ExprId)>,
}

/// Sign of an element in a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A coil between its first two points.
    Spring,
    /// A dashpot between its first two points.
    Damper,
    /// A spiral about the joint of the bodies of its first two points.
    TorsionSpring,
    /// A dashpot about that joint.
    TorsionDamper,
    /// An arrow at its first point.
    Force,
    /// A bent arrow on the body of its first point.
    Torque,
}

/// Something that acts on bodies.
pub trait Element: Debug + Send + Sync {
    /// Its sign in a drawing.
    fn shape(&self) -> Shape;
    /// The points that it needs; for what turns a body, the origin of the body's frame.
    fn marks(&self) -> Vec<Mark>;
    /// What it exerts when the points are there, each as `marks` lists them; `length` stands for the distance between its ends, where
    /// it has one.
    fn exerted(&self, places: &[Place], length: ExprId, graph: &mut Graph) -> Exerted;
    /// What must not be negative whatever the parameters are, and what it is called where it must be positive.
    fn not_negative(&self) -> Vec<(ExprId, &'static str)> {
        Vec::new()
    }
}

/// v_x w_y − v_y w_x: the moment of w at the end of v.
pub fn moment(v: Vector, w: Vector, graph: &mut Graph) -> ExprId {
    let [forward, backward] = [graph.multiply(v[0], w[1]), graph.multiply(v[1], w[0])];
    graph.subtract(forward, backward)
}

/// The components times a factor.
fn scaled(v: Vector, factor: ExprId, graph: &mut Graph) -> Vector {
    v.map(|component| graph.multiply(component, factor))
}

/// −v.
fn opposite(v: Vector, graph: &mut Graph) -> Vector {
    v.map(|component| graph.negate(component))
}
