//! Joints and drivers between points and bodies of a constructed mechanism, with their geometric conditions.
//!
//! [`Joint::violation`] follows from the meaning of each statement, on global points, and shares no code with the
//! generator. So a pose that violates nothing is one of the mechanism that was constructed.

use super::law::Law;
use super::mechanism::{GROUND, Mechanism, Pose, difference, dot, length, rotated};

/// Joint or driver. Points and bodies are indices into the mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// Two points coincide.
    Revolute(usize, usize),
    /// The second point's body slides along the line from the first point to the second.
    Translational(usize, usize),
    /// Two bodies are one.
    Weld(usize, usize),
    /// A point keeps its x (0) or y (1).
    Absolute(usize, usize),
    /// A body keeps its angle.
    AbsoluteAngle(usize),
    /// The second point keeps its x (0) or y (1) relative to the first.
    Relative(usize, usize, usize),
    /// Two bodies keep the angle between them.
    RelativeAngle(usize, usize),
    /// Two points keep their distance; the second may be on the ground.
    Distance(usize, usize),
    /// The first point keeps its distance from the line through the others, which is zero or not.
    Line(usize, [usize; 2]),
    /// Wheels i and j on a carrier turn in this ratio; `opposite` senses or not.
    Gear {
        /// Wheels.
        wheels: [usize; 2],
        /// Body that holds the wheels' axes.
        carrier: usize,
        /// r_i / r_j.
        ratio: f64,
        /// True if the wheels turn in opposite senses.
        opposite: bool,
        /// True for a belt, false for teeth.
        belt: bool,
    },
    /// A pinion with this centre rolls on a line of another body.
    Rack {
        /// Center, on the pinion.
        centre: usize,
        /// Two points of the line.
        line: [usize; 2],
        /// The radius.
        radius: f64,
    },
    /// The angle of a body is driven.
    DrivePhi(usize, Law),
    /// The angle between two bodies is driven.
    DriveRelativeAngle(usize, usize, Law),
    /// The length along a translational joint that was written before, from its first to its second point.
    DriveLength(usize, usize, Law),
    /// The x (0) or y (1) of a point is driven.
    Drive(usize, usize, Law),
    /// The x (0) or y (1) of the second point relative to the first is driven.
    DriveRelative(usize, usize, usize, Law),
    /// The distance of two points is driven.
    DriveDistance(usize, usize, Law),
}

impl Joint {
    /// Number of equations.
    pub fn equations(&self) -> usize {
        match self {
            Joint::Revolute(..) | Joint::Translational(..) => 2,
            Joint::Weld(..) => 3,
            _ => 1,
        }
    }

    /// Bodies whose design poses affect the joint.
    pub fn drawn(&self, mechanism: &Mechanism) -> Vec<usize> {
        let of = |point: usize| mechanism.points[point].body;
        match *self {
            Joint::Translational(p, q) => vec![of(p), of(q)],
            Joint::Weld(i, j) => vec![i, j],
            Joint::Gear {
                wheels: [i, j],
                carrier,
                ..
            } => vec![i, j, carrier],
            Joint::Rack { centre, line, .. } => vec![of(centre), of(line[0])],
            _ => Vec::new(),
        }
    }

    /// Bodies and points that the joint mentions.
    pub fn mentions(&self) -> (Vec<usize>, Vec<usize>) {
        match *self {
            Joint::Revolute(p, q)
            | Joint::Translational(p, q)
            | Joint::Relative(p, q, _)
            | Joint::Distance(p, q)
            | Joint::DriveLength(p, q, _)
            | Joint::DriveRelative(p, q, _, _)
            | Joint::DriveDistance(p, q, _) => (vec![], vec![p, q]),
            Joint::Absolute(p, _) | Joint::Drive(p, _, _) => (vec![], vec![p]),
            Joint::Line(p, [a, b]) => (vec![], vec![p, a, b]),
            Joint::Rack { centre, line, .. } => (vec![], vec![centre, line[0], line[1]]),
            Joint::Weld(i, j) | Joint::RelativeAngle(i, j) | Joint::DriveRelativeAngle(i, j, _) => {
                (vec![i, j], vec![])
            }
            Joint::AbsoluteAngle(i) | Joint::DrivePhi(i, _) => (vec![i], vec![]),
            Joint::Gear {
                wheels: [i, j],
                carrier,
                ..
            } => (vec![i, j, carrier], vec![]),
        }
    }

    /// Law of a driver.
    pub fn law_mut(&mut self) -> Option<&mut Law> {
        match self {
            Joint::DrivePhi(_, law)
            | Joint::DriveRelativeAngle(_, _, law)
            | Joint::DriveLength(_, _, law)
            | Joint::Drive(_, _, law)
            | Joint::DriveRelative(_, _, _, law)
            | Joint::DriveDistance(_, _, law) => Some(law),
            _ => None,
        }
    }

    /// Violation at time `t` in these poses of all bodies: lengths in m and angles in rad.
    pub fn violation(&self, mechanism: &Mechanism, poses: &[Pose], t: f64) -> (f64, f64) {
        let now = |point: usize| mechanism.place(point, poses);
        let first = |point: usize| mechanism.points[point].place;
        let of = |point: usize| mechanism.points[point].body;
        let turned = |body: usize| poses[body][2] - mechanism.bodies[body][2];
        let along = |p: usize, q: usize| difference(first(q), first(p));
        let distance = |a: [f64; 2], b: [f64; 2]| length(difference(a, b));
        // Current direction of a vector fixed in a body.
        let carried = |direction: [f64; 2], body: usize| rotated(direction, turned(body));
        let across = |d: [f64; 2]| {
            let l = length(d);
            [-d[1] / l, d[0] / l]
        };
        match *self {
            Joint::Revolute(p, q) => (distance(now(p), now(q)), 0.0),
            Joint::Translational(p, q) => {
                let normal = carried(across(along(p, q)), of(p));
                let lateral = dot(normal, difference(now(q), now(p)));
                (lateral, turned(of(p)) - turned(of(q)))
            }
            Joint::Weld(i, j) => {
                let offset = difference(
                    [mechanism.bodies[j][0], mechanism.bodies[j][1]],
                    [mechanism.bodies[i][0], mechanism.bodies[i][1]],
                );
                let offset = carried(offset, i);
                let offset_now = difference([poses[j][0], poses[j][1]], [poses[i][0], poses[i][1]]);
                (distance(offset_now, offset), turned(i) - turned(j))
            }
            Joint::Absolute(p, axis) => (now(p)[axis] - first(p)[axis], 0.0),
            Joint::AbsoluteAngle(i) => (0.0, turned(i)),
            Joint::Relative(p, q, axis) => {
                (difference(now(q), now(p))[axis] - along(p, q)[axis], 0.0)
            }
            Joint::RelativeAngle(i, j) => (0.0, turned(i) - turned(j)),
            Joint::Distance(p, q) => (distance(now(p), now(q)) - distance(first(p), first(q)), 0.0),
            Joint::Line(p, [a, b]) => {
                let normal = across(along(a, b));
                let before = dot(normal, along(a, p));
                let normal = carried(normal, of(a));
                (dot(normal, difference(now(p), now(a))) - before, 0.0)
            }
            Joint::Gear {
                wheels: [i, j],
                carrier,
                ratio,
                opposite,
                ..
            } => {
                let sign = if opposite { 1.0 } else { -1.0 };
                let on_carrier = |wheel: usize| turned(wheel) - turned(carrier);
                (0.0, on_carrier(j) + sign * ratio * on_carrier(i))
            }
            Joint::Rack {
                centre,
                line: [a, b],
                radius,
            } => {
                // The pinion rolls: its rim turns by the distance that its center moves along the line.
                let rack = of(a);
                let direction = along(a, b);
                let l = length(direction);
                let direction = [direction[0] / l, direction[1] / l];
                let side = dot(across(along(a, b)), along(a, centre)).signum();
                let before = dot(direction, along(a, centre));
                let after = dot(carried(direction, rack), difference(now(centre), now(a)));
                let rolled = side * radius * (turned(of(centre)) - turned(rack));
                (after - before + rolled, 0.0)
            }
            Joint::DrivePhi(i, law) => (0.0, turned(i) - law.at(t)),
            Joint::DriveRelativeAngle(i, j, law) => (0.0, turned(j) - turned(i) - law.at(t)),
            Joint::DriveLength(p, q, law) => {
                let l = length(along(p, q));
                let direction = carried([along(p, q)[0] / l, along(p, q)[1] / l], of(p));
                (
                    dot(direction, difference(now(q), now(p))) - l - law.at(t),
                    0.0,
                )
            }
            Joint::Drive(p, axis, law) => (now(p)[axis] - first(p)[axis] - law.at(t), 0.0),
            Joint::DriveRelative(p, q, axis, law) => (
                difference(now(q), now(p))[axis] - along(p, q)[axis] - law.at(t),
                0.0,
            ),
            Joint::DriveDistance(p, q, law) => (
                distance(now(p), now(q)) - distance(first(p), first(q)) - law.at(t),
                0.0,
            ),
        }
    }
}

/// Name of a body.
pub fn name(body: usize) -> String {
    if body == GROUND {
        "ground".to_string()
    } else {
        format!("b{body}")
    }
}
