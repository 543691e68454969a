//! Defines loads on bodies: their forces, torques, stored energy and power.
//!
//! Each kind is one file. A kind states its points and its forces; generalized forces, driving forces, reactions and energies
//! follow from these.

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
use crate::joint::geometry::{BodyId, Mark, Vector, add, perpendicular};

/// A moving point of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The point, with its rotated local vector R s as in the equations.
    pub mark: Mark,
    /// Velocity, in m/s.
    pub velocity: Vector,
    /// Angular velocity of the body, in rad/s.
    pub turning: ExprId,
}

impl Place {
    /// Creates a point of a body with these rates of x, y and φ; `None` is zero.
    pub fn moving(mark: Mark, rates: [Option<ExprId>; 3], graph: &mut Graph) -> Place {
        let zero = graph.zero();
        let [x, y, turning] = rates.map(|rate| rate.unwrap_or(zero));
        let velocity = if mark.frame.body == BodyId::GROUND {
            [zero; 2]
        } else {
            let across = perpendicular(mark.arm, graph);
            let turned = across.map(|part| graph.multiply(turning, part));
            add([x, y], turned, graph)
        };
        Place {
            mark,
            velocity,
            turning,
        }
    }
}

/// Forces, torques and energy of an element.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exerted {
    /// Points of application and forces in global components, in N.
    pub forces: Vec<(Mark, Vector)>,
    /// Bodies and torques, in N·m.
    pub torques: Vec<(BodyId, ExprId)>,
    /// Stored energy, in J; `None` if nothing is stored.
    pub stored: Option<ExprId>,
    /// Power added to the mechanism beyond the stored energy, in W, negative for a damper; `None` if there is none.
    pub added: Option<ExprId>,
    /// Value in m of the distance symbol passed to the element; it must not vanish. `None` if the element uses no distance.
    pub length: Option<ExprId>,
    /// Formulas whose rates determine the forces.
    pub rated: Vec<Rated>,
}

/// A formula whose rate determines a load.
#[derive(Clone, Debug, PartialEq)]
pub struct Rated {
    /// Formula of coordinates, t, inputs, parameters and symbols of rotated local vectors.
    pub formula: ExprId,
    /// Values of these symbols.
    pub arms: Vec<(SymbolId, ExprId)>,
}

/// Symbol of an element in pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A coil between the first two points.
    Spring,
    /// A dashpot between the first two points.
    Damper,
    /// A spiral about the joint of the bodies of the first two points.
    TorsionSpring,
    /// A dashpot about the joint of the bodies of the first two points.
    TorsionDamper,
    /// An arrow at the first point.
    Force,
    /// A curved arrow on the body of the first point.
    Torque,
}

/// A load on bodies.
pub trait Element: Debug + Send + Sync {
    /// Returns the symbol in pictures.
    fn shape(&self) -> Shape;
    /// Returns the points of the load; for a torque, the origin of the body's frame.
    fn marks(&self) -> Vec<Mark>;
    /// Returns forces, torques and energy at these places, which are in the order of `marks`. `length` is the symbol of the
    /// distance between the ends, if the element uses it.
    fn exerted(&self, places: &[Place], length: ExprId, graph: &mut Graph) -> Exerted;
    /// Returns the expressions that must not be negative for any values of the parameters, and their names in messages if they
    /// must be positive.
    fn not_negative(&self) -> Vec<(ExprId, &'static str)> {
        Vec::new()
    }
}

/// Returns v_x w_y − v_y w_x: the moment of w at the end of v.
pub fn moment(v: Vector, w: Vector, graph: &mut Graph) -> ExprId {
    let [forward, backward] = [graph.multiply(v[0], w[1]), graph.multiply(v[1], w[0])];
    graph.subtract(forward, backward)
}

/// Returns factor · v.
fn scaled(v: Vector, factor: ExprId, graph: &mut Graph) -> Vector {
    v.map(|component| graph.multiply(component, factor))
}

/// Returns −v.
fn opposite(v: Vector, graph: &mut Graph) -> Vector {
    v.map(|component| graph.negate(component))
}
