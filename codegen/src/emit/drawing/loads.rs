//! Loads of a system in numbers: their points, and the forces and torques in a pose.

use super::numbers::Numbers;
use super::plane::{Point, scaled};
use super::pose::{At, Pose};
use crate::expr::{ExprId, Graph};
use crate::force::{Element, Place, Shape};
use crate::joint::geometry::Mark;
use crate::pool::Pool;
use crate::system::System;

/// Length of the shortest arrow beside the longest: shorter ones are invisible.
const SHORTEST: f64 = 0.4;

/// Relative magnitude that counts as zero.
const ZERO: f64 = 1e-9;

/// A load in numbers.
#[derive(Clone, Debug)]
pub(super) struct Load {
    /// Label in messages: `spring main`, `force on 1.P`.
    pub label: String,
    pub shape: Shape,
    /// Points on which it acts.
    pub marks: Vec<At>,
    /// Angle of its second body to the first one in the design configuration, in rad.
    pub drawn: f64,
}

/// Points of a load as bodies and indices among the numbers, and the indices of its force or torque.
#[derive(Clone, Debug)]
struct Numbered {
    label: String,
    shape: Shape,
    marks: Vec<(usize, [usize; 2])>,
    /// Angles of its first and its last body in the design configuration.
    drawn: [usize; 2],
    vector: [usize; 2],
}

/// Loads of a system and its gravity, by their indices among numbers.
#[derive(Clone, Debug)]
pub(super) struct NumberedLoads {
    loads: Vec<Numbered>,
    gravity: Option<[usize; 2]>,
}

impl NumberedLoads {
    /// Adds the loads of a system to the numbers of a picture.
    pub fn new(system: &System, graph: &mut Graph, numbers: &mut Numbers) -> NumberedLoads {
        let forces = &system.mechanism.forces;
        let zero = graph.zero();
        let loads = forces.loads.iter().map(|load| {
            let element = &*load.element;
            let vector = vector(system, element, graph);
            let marks = element.marks();
            let ends = match element.shape() {
                Shape::Force | Shape::Torque => &marks[..1],
                _ => &marks[..2],
            };
            let bodies = [ends.first(), ends.last()];
            let drawn = bodies.map(|it| {
                it.map_or(zero, |it| {
                    system.mechanism.bodies[it.frame.body.0].drawn.angle
                })
            });
            Numbered {
                label: load.label.clone(),
                shape: element.shape(),
                drawn: numbers.pair(drawn),
                marks: ends
                    .iter()
                    .map(|mark| (mark.frame.body.0, numbers.pair(mark.local)))
                    .collect(),
                vector: numbers.pair(vector),
            }
        });
        NumberedLoads {
            loads: loads.collect(),
            gravity: forces.gravity.map(|gravity| numbers.pair(gravity)),
        }
    }

    /// Returns the loads for these values.
    pub fn loads(&self, value: &[f64]) -> Vec<Load> {
        let loads = self.loads.iter().map(|load| Load {
            label: load.label.clone(),
            shape: load.shape,
            drawn: {
                let [first, second] = load.drawn;
                value[second] - value[first]
            },
            marks: load
                .marks
                .iter()
                .map(|&(body, [x, y])| At {
                    body,
                    local: [value[x], value[y]],
                })
                .collect(),
        });
        loads.collect()
    }

    /// Returns the vector of each load: a force, or a torque as the first component.
    pub fn vectors(&self, value: &[f64]) -> Vec<Point> {
        let loads = self.loads.iter();
        loads.map(|it| it.vector.map(|at| value[at])).collect()
    }

    /// Gravitational acceleration, in m/s²; `None` without gravity.
    pub fn gravity(&self, value: &[f64]) -> Option<Point> {
        let gravity = self.gravity?.map(|at| value[at]);
        (gravity != [0.0; 2]).then_some(gravity)
    }

    /// Returns the arrows of these vectors of all poses, relative to the longest of their kind.
    pub fn arrows(&self, vectors: &[Vec<Point>]) -> Vec<Vec<Point>> {
        let magnitude = |[x, y]: Point| x.hypot(y);
        let largest = |shape: Shape| {
            let all = vectors
                .iter()
                .flat_map(|of_pose| self.loads.iter().zip(of_pose));
            let of_shape = all.filter(|(load, _)| load.shape == shape);
            let sizes = of_shape.map(|(_, vector)| magnitude(*vector));
            sizes.filter(|it| it.is_finite()).fold(0.0, f64::max)
        };
        let [force, torque] = [Shape::Force, Shape::Torque].map(largest);
        let arrow = |(load, vector): (&Numbered, &Point)| {
            let largest = match load.shape {
                Shape::Force => force,
                Shape::Torque => torque,
                _ => return [0.0; 2],
            };
            let size = magnitude(*vector);
            match size > ZERO * largest && size.is_finite() {
                true => scaled(*vector, (size / largest).max(SHORTEST) / size),
                false => [0.0; 2],
            }
        };
        let of_pose = |of_pose: &Vec<Point>| self.loads.iter().zip(of_pose).map(arrow).collect();
        vectors.iter().map(of_pose).collect()
    }
}

/// Returns the force of an applied force, the torque of an applied torque as the first component, and zero for other elements.
fn vector(system: &System, element: &dyn Element, graph: &mut Graph) -> [ExprId; 2] {
    let zero = graph.zero();
    if !matches!(element.shape(), Shape::Force | Shape::Torque) {
        return [zero; 2];
    }
    let marks = element.marks();
    let places: Vec<Place> = marks
        .into_iter()
        .map(|mark| placed(system, mark, graph))
        .collect();
    let exerted = element.exerted(&places, zero, graph);
    let force = exerted.forces.first().map(|(_, force)| *force);
    let torque = exerted.torques.first().map(|(_, torque)| [*torque, zero]);
    force.or(torque).unwrap_or([zero; 2])
}

/// Returns a point with its velocity, in terms of coordinates and rates.
fn placed(system: &System, mark: Mark, graph: &mut Graph) -> Place {
    let coordinates = system.mechanism.bodies[mark.frame.body.0].coordinates;
    let rates = coordinates.map(|it| Some(graph.variable(system.coordinates[it?.place].rate)));
    Place::moving(mark, rates, graph)
}

/// Forces and torques of a system in any pose.
#[derive(Debug)]
pub struct ActingLoads {
    graph: Graph,
    numbers: Numbers,
    loads: NumberedLoads,
}

impl ActingLoads {
    /// Prepares the loads of a system.
    pub fn new(pool: &Pool, system: &System) -> ActingLoads {
        let mut graph = pool.graph.clone();
        let mut numbers = Numbers::default();
        let loads = NumberedLoads::new(system, &mut graph, &mut numbers);
        ActingLoads {
            graph,
            numbers,
            loads,
        }
    }

    /// Returns the arrow of each load in each pose, relative to the longest: along the force, or a torque as the
    /// first component, positive counterclockwise. Loads without an arrow have zeros.
    pub fn arrows<'a>(&self, poses: impl IntoIterator<Item = &'a Pose>) -> Vec<Vec<Point>> {
        let values = poses
            .into_iter()
            .map(|pose| pose.evaluated(&self.graph, &self.numbers));
        let vectors: Vec<Vec<Point>> = values.map(|value| self.loads.vectors(&value)).collect();
        self.loads.arrows(&vectors)
    }
}
