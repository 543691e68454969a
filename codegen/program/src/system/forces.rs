//! Derives generalized forces, energies and the transfer of forces through joints.
//!
//! With the mass matrix M and the generalized forces Q of everything but joints and drivers, joints and drivers balance Q − M q̈:
//! Φ_qᵀ λ = Q − M q̈ (Haug 1989, section 11.2). The equations of every body are about the origin of its frame.
//!
//! Everything is in terms of the vector form, whose rotated vectors the solved formulation has anyway. Every load is a sum over
//! bodies; equations are not solved here. If no force is requested, the result is empty.

use std::collections::BTreeMap;

use super::carried::Carried;
use super::measures::measures;
use super::{System, VectorForm, VectorRow};
use crate::expr::{ExprId, Number, Rational, SymbolId};
use crate::force::{Place, Rated, moment};
use crate::joint::Feature;
use crate::joint::geometry::{BodyId, Mark, Vector, dot, length, perpendicular, subtract};
use crate::model::Mechanism;
use crate::pool::Pool;

/// Forces of a mechanism in terms of its vector form.
#[derive(Clone, Debug)]
pub struct Forces {
    /// Q − M q̈ of every coordinate of a pose, in N and N·m.
    pub loads: Vec<ExprId>,
    /// Bodies that have a mass.
    pub weights: Vec<Weight>,
    /// Kinetic energy, in J.
    pub kinetic: ExprId,
    /// Potential energy of gravity and springs, in J.
    pub potential: ExprId,
    /// Power of dampers, forces and torques, in W.
    pub added: ExprId,
    /// Symbols and values of the lengths of springs and dampers, in m. These lengths must not vanish.
    pub lengths: Vec<(SymbolId, ExprId)>,
    /// Indices of the loads with these lengths, in the order of `lengths`.
    pub sprung: Vec<usize>,
    /// Formulas whose rates enter loads.
    pub rated: Vec<Rated>,
    /// Components of the forces and torques of each load, in the order of the loads.
    pub exerted: Vec<Vec<ExprId>>,
}

/// Body that has a mass.
#[derive(Clone, Copy, Debug)]
pub struct Weight {
    /// Index into the bodies.
    pub body: usize,
    /// Unknowns x, y and φ of its frame.
    pub unknowns: [usize; 3],
    /// Mass, in kg.
    pub mass: ExprId,
    /// Moment of inertia about the center of mass, in kg·m².
    pub inertia: ExprId,
    /// Moment of inertia about the origin of the frame, in kg·m².
    pub about_origin: ExprId,
    /// Vector from the origin of the frame to the center of mass.
    pub arm: Vector,
}

/// Forces that a joint transmits to the bodies that it joins.
#[derive(Clone, Debug)]
pub struct Passing {
    /// Derivatives of each of the joint's rows of the vector form in the unknowns; every body rotates independently.
    pub rows: Vec<(usize, BTreeMap<usize, ExprId>)>,
    /// Derivatives of the joint's monitored rows, by their index among the monitored rows.
    pub monitored: Vec<(usize, BTreeMap<usize, ExprId>)>,
    /// Body on which the joint's force acts: the second body, or the first body if the second is the ground.
    pub body: BodyId,
    /// True if the second body is the ground, so that the reaction is opposite to the force on `body`.
    pub is_opposite: bool,
    /// Vector from the origin of the body's frame to the point about which moments are taken.
    pub arm: Vector,
    /// Meaning of the force.
    pub carried: Carried,
}

/// Derives the loads and energies; `None` if they are not requested.
pub(super) fn forces(mechanism: &Mechanism, form: &VectorForm, pool: &mut Pool) -> Option<Forces> {
    if !mechanism.forces.are_wanted() {
        return None;
    }
    let zero = pool.graph.zero();
    let count = mechanism.bodies.iter().map(|body| body.places().len());
    let mut loads = vec![zero; count.sum()];
    let mut exert = |body: BodyId, parts: [ExprId; 3], pool: &mut Pool| {
        let coordinates = mechanism.bodies[body.0].coordinates;
        for (coordinate, part) in coordinates.into_iter().zip(parts) {
            let Some(own) = coordinate.map(|it| &mut loads[it.place]) else {
                continue;
            };
            *own = pool.graph.add(*own, part);
        }
    };
    let [mut kinetic, mut potential, mut added] = [zero; 3];
    let half = Number::rational(Rational::HALF);
    let gravity = mechanism.forces.gravity;
    let mut weights = Vec::new();
    for mass in &mechanism.forces.masses {
        let body = BodyId(mass.body);
        let center = form.mark_with_arm(&mass.center, &mechanism.bodies, pool);
        let graph = &mut pool.graph;
        let angle = form.angle_of(mass.body);
        let of_body = [angle - 2, angle - 1, angle].map(|at| &form.unknowns[at]);
        let [vx, vy, turning] = of_body.map(|it| graph.variable(it.rate));
        let [ax, ay, spin] = of_body.map(|it| graph.variable(it.acceleration));
        // About the origin (Steiner): I + m s².
        let offset = dot(mass.center.local, mass.center.local, graph);
        let offset = graph.multiply(mass.mass, offset);
        let inertia = graph.add(mass.inertia, offset);
        weights.push(Weight {
            body: mass.body,
            unknowns: [angle - 2, angle - 1, angle],
            mass: mass.mass,
            inertia: mass.inertia,
            about_origin: inertia,
            arm: center.arm,
        });
        let falling = match gravity {
            Some(gravity) => subtract(gravity, [ax, ay], graph),
            None => [graph.negate(ax), graph.negate(ay)],
        };
        let square = graph.multiply(turning, turning);
        let across = perpendicular(center.arm, graph);
        let force = [0, 1].map(|axis| {
            let radial = graph.multiply(square, center.arm[axis]);
            let tangential = graph.multiply(spin, across[axis]);
            let turned = graph.subtract(radial, tangential);
            let total = graph.add(falling[axis], turned);
            graph.multiply(mass.mass, total)
        });
        let about_origin = moment(center.arm, falling, graph);
        let about_origin = graph.multiply(mass.mass, about_origin);
        let turned = graph.multiply(inertia, spin);
        let torque = graph.subtract(about_origin, turned);
        // v² of the center is ṙ² + 2 φ̇ (R s × ṙ) + s² φ̇².
        let moving = dot([vx, vy], [vx, vy], graph);
        let mixed = moment(center.arm, [vx, vy], graph);
        let mixed = graph.multiply(turning, mixed);
        let moving = graph.sum(&[moving, mixed, mixed]);
        let moving = graph.multiply(mass.mass, moving);
        let spinning = graph.multiply(inertia, square);
        let twice = graph.add(moving, spinning);
        let energy = graph.scale(half, twice);
        kinetic = graph.add(kinetic, energy);
        if let Some(gravity) = gravity {
            let place = center.position(graph);
            let height = dot(gravity, place, graph);
            let work = graph.multiply(mass.mass, height);
            potential = graph.subtract(potential, work);
        }
        exert(body, [force[0], force[1], torque], pool);
    }
    let (mut lengths, mut sprung) = (Vec::new(), Vec::new());
    let (mut rated, mut all_exerted) = (Vec::new(), Vec::new());
    for (number, load) in mechanism.forces.loads.iter().enumerate() {
        let marks = load.element.marks();
        let places: Vec<Place> = marks
            .iter()
            .map(|mark| {
                let mark = form.mark_with_arm(mark, &mechanism.bodies, pool);
                placed(mark, form, mechanism, pool)
            })
            .collect();
        // Text after the space only distinguishes equal names.
        let symbol = pool.graph.symbol(&format!("distance of load {number}"));
        let length = pool.graph.variable(symbol);
        let exerted = load.element.exerted(&places, length, &mut pool.graph);
        let forces = exerted.forces.iter().flat_map(|(_, force)| *force);
        let torques = exerted.torques.iter().map(|(_, torque)| *torque);
        all_exerted.push(forces.chain(torques).collect());
        for (mark, force) in exerted.forces {
            let torque = moment(mark.arm, force, &mut pool.graph);
            exert(mark.frame.body, [force[0], force[1], torque], pool);
        }
        for (body, torque) in exerted.torques {
            exert(body, [zero, zero, torque], pool);
        }
        let graph = &mut pool.graph;
        potential = exerted
            .stored
            .map_or(potential, |it| graph.add(potential, it));
        added = exerted.added.map_or(added, |it| graph.add(added, it));
        sprung.extend(exerted.length.map(|_| number));
        lengths.extend(exerted.length.map(|length| (symbol, length)));
        rated.extend(exerted.rated);
    }
    Some(Forces {
        loads,
        weights,
        kinetic,
        potential,
        added,
        lengths,
        sprung,
        rated,
        exerted: all_exerted,
    })
}

/// A point with its velocity.
fn placed(mark: Mark, form: &VectorForm, mechanism: &Mechanism, pool: &mut Pool) -> Place {
    let graph = &mut pool.graph;
    let coordinates = mechanism.bodies[mark.frame.body.0].coordinates;
    let rates = coordinates.map(|it| Some(graph.variable(form.unknowns[it?.place].rate)));
    Place::moving(mark, rates, graph)
}

impl System {
    /// Returns the system with the forces of a mechanism at rest at every instant, with zero rates and accelerations.
    pub fn at_rest(mut self, pool: &mut Pool) -> System {
        self.mechanism.forces.at_rest = true;
        let Some(forces) = &mut self.forces else {
            return self;
        };
        let graph = &mut pool.graph;
        let zero = graph.zero();
        let moving = self.coordinates.iter();
        let moving = moving.flat_map(|it| [it.rate, it.acceleration]);
        let inputs = self.mechanism.inputs.iter();
        let inputs = inputs.flat_map(|it| [it.symbols[1], it.symbols[2]]);
        let still: Vec<(SymbolId, ExprId)> = moving.chain(inputs).map(|it| (it, zero)).collect();
        for value in forces
            .loads
            .iter_mut()
            .chain([&mut forces.kinetic, &mut forces.added])
        {
            *value = graph.substitute(*value, &still);
        }
        if !self.mechanism.motors.is_empty() {
            self.measures = measures(&self, pool);
        }
        self
    }

    /// Returns the forces that a joint or driver transmits, in terms of these rows of the vector form.
    pub fn passing(&self, joint: usize, rows: &[VectorRow], pool: &mut Pool) -> Passing {
        let System {
            mechanism,
            vector_form: form,
            monitored,
            ..
        } = self;
        let rows = form.own_columns(joint, rows, mechanism, pool);
        let places = monitored.iter().enumerate();
        let places = places.filter(|(_, row)| row.joint == joint);
        let places: Vec<usize> = places.map(|(place, _)| place).collect();
        let monitored = match places.is_empty() {
            true => Vec::new(),
            false => form.monitored_columns(joint, mechanism, pool),
        };
        let monitored = places.into_iter().zip(monitored).collect();
        let declared = &mechanism.joints[joint];
        let operands = form.with_arms(&declared.operands, &mechanism.bodies, pool);
        let graph = &mut pool.graph;
        let feature = declared.kind.feature(&declared.operands, graph);
        let marks = &operands.marks;
        let across = |graph: &mut crate::expr::Graph| {
            let turned = operands.axis.map(|axis| axis.turned);
            turned.map(|turned| perpendicular(turned, graph))
        };
        let between = |graph: &mut crate::expr::Graph| {
            let [from, to] = [1, 0].map(|at| marks[at].position(graph));
            let gap = subtract(to, from, graph);
            let length = length(gap, graph);
            gap.map(|part| graph.divide(part, length))
        };
        let carried = match feature {
            Some(Feature::Pin) => Carried::Force,
            Some(Feature::Weld) => Carried::ForceAndMoment,
            Some(Feature::Slide) => {
                across(graph).map_or(Carried::ForceAndMoment, Carried::NormalAndMoment)
            }
            Some(Feature::Slot(_)) => across(graph).map_or(Carried::Force, Carried::Normal),
            Some(Feature::Coordinate(axis) | Feature::Offset(axis)) => Carried::Component(axis),
            Some(Feature::Orientation | Feature::RelativeOrientation) => Carried::Moment,
            Some(Feature::Wheels(..)) => match declared.pressure_angle {
                Some(_) => Carried::Teeth,
                None => Carried::WheelMoment,
            },
            Some(Feature::Link) => Carried::Tension(between(graph)),
            Some(Feature::Pinion(_)) => operands
                .axis
                .map_or(Carried::Force, |axis| Carried::Tooth(axis.turned)),
            Some(Feature::Contact(_)) => operands.curve.map_or(Carried::Force, |curve| {
                let normal = curve.normal(graph);
                Carried::Pressure(curve.rotate(normal, graph))
            }),
            // The equation is in squares of lengths: a distance that grows by δ changes it by 2 ℓ δ.
            Some(Feature::Written) | None => match operands.length() {
                Some(length) => {
                    let two = graph.integer(2);
                    Carried::Rod(graph.multiply(two, length))
                }
                None => Carried::Multiplier,
            },
        };
        // A force that presses on a curve acts on the curve's body; all others act on the second body.
        let [first, second] = match (&marks[..], carried) {
            ([], _) => [None; 2],
            ([only], _) => [None, Some(*only)],
            ([follower, curve, ..], Carried::Pressure(_)) => [Some(*curve), Some(*follower)],
            ([first, second, ..], _) => [Some(*first), Some(*second)],
        };
        let is_ground = |mark: Option<Mark>| mark.is_none_or(|it| it.frame.body == BodyId::GROUND);
        let is_opposite = is_ground(second);
        let meant = if is_opposite { first } else { second };
        let body = meant.map_or(BodyId::GROUND, |it| it.frame.body);
        let zero = graph.zero();
        let arm = match (second, meant) {
            (Some(place), Some(mark)) => {
                let place = place.position(graph);
                match body == mark.frame.body && !is_opposite {
                    true => mark.arm,
                    false => subtract(place, mark.frame.origin, graph),
                }
            }
            _ => [zero; 2],
        };
        Passing {
            rows,
            monitored,
            body,
            is_opposite,
            arm,
            carried,
        }
    }
}
