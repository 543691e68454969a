//! Scene of a pose: everything that a picture shows, in m and rad.
//!
//! No expressions are left: every body has its place, every joint its sign with marks, line and numbers.

use super::dial;
use super::loads::{Load, NumberedLoads};
use super::numbers::{Numbers, sampled};
use super::plane::{Place, Point, left_of};
use crate::expr::{Graph, SymbolId};
use crate::joint::geometry::Mark;
use crate::joint::{Feature, Follower};
use crate::model::Role;
use crate::pool::Pool;
use crate::system::System;

/// Largest gap of a closed curve, relative to its size: descriptions have six digits.
const CLOSED: f64 = 1e-6;

/// The values of all symbols at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    values: Vec<f64>,
}

impl Pose {
    /// Pose with these values of symbols; all others have that of their declaration, or zero.
    pub fn new(pool: &Pool, given: impl IntoIterator<Item = (SymbolId, f64)>) -> Pose {
        let graph = &pool.graph;
        let mut values = vec![0.0; graph.symbol_count()];
        graph.fill_nominal(&mut values);
        for (symbol, value) in given {
            values[symbol.index()] = value;
        }
        Pose { values }
    }

    /// Design configuration of the description.
    pub fn drawn(pool: &Pool, system: &System) -> Pose {
        let graph = &pool.graph;
        let estimates = system.coordinates.iter().filter_map(|coordinate| {
            let value = graph.constant_value(coordinate.estimate)?;
            Some((coordinate.position, value))
        });
        Pose::new(pool, estimates)
    }

    /// All numbers in this pose.
    pub(super) fn evaluated(&self, graph: &Graph, numbers: &Numbers) -> Vec<f64> {
        numbers.evaluate(graph, &self.values)
    }
}

/// A point of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct At {
    pub body: usize,
    pub local: Point,
}

/// The line of a joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// Indices of the mark that carries the line, and of the other one.
    pub owner: usize,
    pub other: usize,
    /// Unit vector along the line in the frame of the owner's body.
    pub along: Point,
}

/// A curve in the frame of its body.
#[derive(Clone, Debug)]
pub(super) struct Drawn {
    pub body: usize,
    pub points: Vec<Point>,
    pub is_closed: bool,
}

/// A joint in numbers.
#[derive(Clone, Debug)]
pub(super) struct Sign {
    /// Unique id.
    pub slug: String,
    /// Label in messages.
    pub label: String,
    pub feature: Feature,
    pub is_driver: bool,
    /// True if a driven quantity decreases.
    pub is_falling: bool,
    pub marks: Vec<At>,
    pub line: Option<Line>,
    pub curve: Option<Drawn>,
    /// Number in its feature, or zero.
    pub number: f64,
}

/// A body in numbers.
#[derive(Clone, Debug)]
pub(super) struct Carried {
    pub name: String,
    pub place: Place,
    /// The points it carries, in its frame.
    pub points: Vec<Point>,
    /// Their names.
    pub names: Vec<String>,
    /// True for an angle without a body: a pointer from the first point to the second.
    pub is_dial: bool,
}

/// A point with its name.
#[derive(Clone, Debug)]
pub(super) struct Entitled {
    /// Name among all points.
    pub name: String,
    /// Name on its body, which several points may have.
    pub written: String,
    pub at: At,
}

/// Mechanism in one pose, in numbers.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    pub bodies: Vec<Carried>,
    pub signs: Vec<Sign>,
    /// Points with a name, each once.
    pub points: Vec<Entitled>,
    /// Characteristic length of the picture.
    pub size: f64,
    /// Positions of the bodies in each pose of the picture.
    pub motion: Vec<Vec<Place>>,
    /// Springs, dampers, forces and torques, in written order.
    pub loads: Vec<Load>,
    /// Arrow of each load in each of these poses, relative to the longest.
    pub arrows: Vec<Vec<Point>>,
    /// Gravitational acceleration, in m/s²; `None` without gravity.
    pub gravity: Option<Point>,
}

impl Scene {
    /// Scene of a pose; lengths of guides follow from the other poses as well.
    pub fn new(pool: &Pool, system: &System, shown: &Pose, others: &[Pose]) -> Scene {
        Scene::with_curves(pool, system, shown, others, None)
    }

    /// Scene whose curves lie within `deviation` (m) of their chords, if there is one.
    pub fn with_curves(
        pool: &Pool,
        system: &System,
        shown: &Pose,
        others: &[Pose],
        deviation: Option<f64>,
    ) -> Scene {
        let mechanism = &system.mechanism;
        let mut graph = pool.graph.clone();
        let mut numbers = Numbers::default();
        let places = numbers.places(system);
        let bodies: Vec<Vec<[usize; 2]>> = mechanism
            .bodies
            .iter()
            .map(|body| {
                body.marks
                    .iter()
                    .map(|it| numbers.pair(it.mark.local))
                    .collect()
            })
            .collect();
        let points: Vec<(usize, [usize; 2])> = mechanism
            .points
            .iter()
            .map(|it| (it.mark.frame.body.0, numbers.pair(it.mark.local)))
            .collect();
        let mut signs = Vec::new();
        for joint in &mechanism.joints {
            let operands = &joint.operands;
            let Some(feature) = joint.kind.feature(operands, &mut graph) else {
                continue;
            };
            let zero = graph.zero();
            let number = numbers.one(match feature {
                Feature::Link => operands.value.unwrap_or(zero),
                Feature::Slot(number)
                | Feature::Wheels(_, number)
                | Feature::Pinion(number)
                | Feature::Contact(Follower::Roller(number)) => number,
                _ => zero,
            });
            let rate = match (joint.role, operands.value) {
                (Role::Driver, Some(value)) => graph.derivative(value, mechanism.time),
                _ => zero,
            };
            let marks: Vec<(usize, [usize; 2])> = operands
                .marks
                .iter()
                .map(|mark: &Mark| (mark.frame.body.0, numbers.pair(mark.local)))
                .collect();
            let line = operands
                .axis
                .map(|axis| ([axis.owner, axis.other], numbers.pair(axis.direction)));
            signs.push((joint, feature, number, numbers.one(rate), marks, line));
        }
        let loads = NumberedLoads::new(system, &mut graph, &mut numbers);
        let poses = std::iter::once(shown).chain(others);
        let values: Vec<Vec<f64>> = poses.map(|it| it.evaluated(&graph, &numbers)).collect();
        let value = &values[0];
        let both = |[x, y]: [usize; 2]| [value[x], value[y]];
        let place_in = |value: &[f64], [x, y, angle]: [usize; 3]| Place {
            origin: [value[x], value[y]],
            angle: value[angle],
        };
        let at = |(body, local): &(usize, [usize; 2])| At {
            body: *body,
            local: both(*local),
        };
        let signs = signs
            .iter()
            .map(|(joint, feature, number, rate, marks, line)| Sign {
                slug: joint.slug.clone(),
                label: joint.label.clone(),
                feature: *feature,
                is_driver: joint.role == Role::Driver,
                is_falling: value[*rate] < 0.0,
                marks: marks.iter().map(at).collect(),
                line: line.map(|([owner, other], along)| Line {
                    owner,
                    other,
                    along: both(along),
                }),
                curve: joint.operands.curve.map(|curve| {
                    let [from, to] = curve.range;
                    Drawn {
                        body: curve.frame.body.0,
                        points: sampled(
                            &graph,
                            curve.point,
                            curve.parameter,
                            [from, to],
                            &shown.values,
                            deviation,
                        ),
                        is_closed: false,
                    }
                    .closed_if_it_returns()
                }),
                number: value[*number],
            });
        let signs = signs.collect();
        let motion = values
            .iter()
            .map(|value| places.iter().map(|&place| place_in(value, place)).collect());
        let vectors: Vec<Vec<Point>> = values.iter().map(|it| loads.vectors(it)).collect();
        let mut scene = Scene {
            signs,
            motion: motion.collect(),
            loads: loads.loads(value),
            arrows: loads.arrows(&vectors),
            gravity: loads.gravity(value),
            bodies: mechanism
                .bodies
                .iter()
                .zip(&bodies)
                .zip(&places)
                .map(|((body, points), place)| Carried {
                    name: body.name.clone(),
                    place: place_in(value, *place),
                    points: points.iter().map(|&point| both(point)).collect(),
                    names: body.marks.iter().map(|it| it.name.clone()).collect(),
                    is_dial: false,
                })
                .collect(),
            points: mechanism
                .points
                .iter()
                .zip(&points)
                .map(|(point, place)| {
                    let marks = &mechanism.bodies[point.mark.frame.body.0].marks;
                    let entitled = marks.iter().find(|it| {
                        it.mark.local == point.mark.local && point.name.starts_with(&it.name)
                    });
                    Entitled {
                        name: point.name.clone(),
                        written: entitled
                            .map_or(&point.name, |entitled| &entitled.name)
                            .clone(),
                        at: at(place),
                    }
                })
                .collect(),
            size: mechanism.characteristic_length,
        };
        let numbered = mechanism.bodies.iter().enumerate();
        let angles: Vec<usize> = numbered
            .filter(|(_, body)| body.is_angle())
            .map(|(at, _)| at)
            .collect();
        dial::arrange(&angles, &mut scene.bodies, &mut scene.motion, scene.size);
        scene
    }

    /// True if only the ground has a position.
    pub fn is_of_angles_alone(&self) -> bool {
        self.bodies[1..].iter().all(|body| body.is_dial)
    }

    /// Position of a point of a body.
    pub fn global(&self, at: At) -> Point {
        self.bodies[at.body].place.globally(at.local)
    }

    /// The point of the picture in the frame of another body.
    pub fn carried_by(&self, body: usize, global: Point) -> At {
        At {
            body,
            local: self.bodies[body].place.locally(global),
        }
    }

    /// Line of a sign in global components: a unit vector.
    pub fn along(&self, sign: &Sign, line: Line) -> Point {
        let body = sign.marks[line.owner].body;
        self.bodies[body].place.rotate(line.along)
    }

    /// Travel of the other mark of a sign along its line, and its current distance to the left.
    pub fn travel(&self, sign: &Sign, line: Line) -> Travel {
        let [owner, other] = [line.owner, line.other].map(|mark| sign.marks[mark]);
        let reached = |places: &[Place]| {
            let global = places[other.body].globally(other.local);
            let local = places[owner.body].locally(global);
            let gap = [local[0] - owner.local[0], local[1] - owner.local[1]];
            [
                gap[0] * line.along[0] + gap[1] * line.along[1],
                gap[0] * left_of(line.along)[0] + gap[1] * left_of(line.along)[1],
            ]
        };
        let all: Vec<f64> = self
            .motion
            .iter()
            .map(|places| reached(places)[0])
            .collect();
        let [now, aside] = reached(&self.motion[0]);
        Travel {
            now,
            aside,
            least: all.iter().copied().fold(now, f64::min),
            most: all.iter().copied().fold(now, f64::max),
        }
    }
}

/// Displacement over all poses, in m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Travel {
    pub now: f64,
    pub aside: f64,
    pub least: f64,
    pub most: f64,
}

impl Drawn {
    fn closed_if_it_returns(mut self) -> Drawn {
        if let [first, .., last] = self.points[..] {
            let size = super::plane::Bounds::of(self.points.iter().copied()).size();
            if super::plane::distance(first, last) <= CLOSED * (size[0] + size[1]) {
                self.points.pop();
                self.is_closed = true;
            }
        }
        self
    }
}
