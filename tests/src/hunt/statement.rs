//! Writes joints and drivers of a constructed mechanism as statements.
//!
//! All numbers are measured in the poses of the construction.

use super::joint::{Joint, name};
use super::law::Law;
use super::mechanism::{GROUND, Mechanism, difference, length};

/// Names of the axes.
const AXES: [&str; 2] = ["x", "y"];

impl Joint {
    /// The statement.
    pub fn text(&self, mechanism: &Mechanism) -> String {
        let point = |p: usize| written_point(mechanism, p);
        let first = |p: usize| mechanism.points[p].place;
        let gap = |p: usize, q: usize| difference(first(q), first(p));
        if let Some((quantity, base, law)) = self.driver(mechanism) {
            return format!("drive {quantity} = {}", law.text(base));
        }
        match *self {
            Joint::Revolute(p, q) => format!("revolute ({}, {})", point(p), point(q)),
            Joint::Translational(p, q) => {
                let bodies = [p, q].map(|it| name(mechanism.points[it].body));
                format!(
                    "translational ({}, {}) along {} -> {}",
                    bodies[0],
                    bodies[1],
                    point(p),
                    point(q)
                )
            }
            Joint::Weld(i, j) => format!("weld ({}, {})", name(i), name(j)),
            Joint::Absolute(p, axis) => {
                let value = first(p)[axis];
                format!("absolute_{}({}) = {value:?}", AXES[axis], point(p))
            }
            Joint::AbsoluteAngle(i) => {
                format!("absolute_angle({}) = {:?}", name(i), mechanism.bodies[i][2])
            }
            Joint::Relative(p, q, axis) => format!(
                "relative_{} ({}, {}) = {:?}",
                AXES[axis],
                point(p),
                point(q),
                gap(p, q)[axis]
            ),
            Joint::RelativeAngle(i, j) => format!(
                "relative_angle ({}, {}) = {:?}",
                name(i),
                name(j),
                mechanism.bodies[j][2] - mechanism.bodies[i][2]
            ),
            Joint::Distance(p, q) => {
                let value = length(gap(p, q));
                // Only a drawn point of the ground has a circle about it.
                if mechanism.points[q].body == GROUND {
                    format!("absolute_distance ({}, P{q}) = {value:?}", point(p))
                } else {
                    format!("relative_distance ({}, {}) = {value:?}", point(p), point(q))
                }
            }
            Joint::Line(p, [a, b]) => {
                let body = name(mechanism.points[a].body);
                let direction = gap(a, b);
                let offset =
                    (direction[0] * gap(a, p)[1] - direction[1] * gap(a, p)[0]) / length(direction);
                let along = format!("along {} -> {}", point(a), point(b));
                format!(
                    "revolute_translational ({body}, {}) {along} = {offset:?}",
                    point(p)
                )
            }
            Joint::Gear {
                wheels: [i, j],
                carrier,
                ratio,
                opposite,
                belt,
            } => {
                let word = match (belt, opposite) {
                    (false, true) => "external_gear",
                    (false, false) => "internal_gear",
                    (true, true) => "crossed_belt",
                    (true, false) => "belt",
                };
                let carrier = if carrier == GROUND {
                    String::new()
                } else {
                    format!(", {}", name(carrier))
                };
                format!("{word} ({}, {}{carrier}) = {ratio:?}", name(i), name(j))
            }
            Joint::Rack {
                centre,
                line: [a, b],
                radius,
            } => {
                let body = name(mechanism.points[a].body);
                format!(
                    "rack ({}, {body}) along {} -> {} = {radius:?}",
                    point(centre),
                    point(a),
                    point(b)
                )
            }
            Joint::DrivePhi(..)
            | Joint::DriveRelativeAngle(..)
            | Joint::DriveLength(..)
            | Joint::Drive(..)
            | Joint::DriveRelative(..)
            | Joint::DriveDistance(..) => unreachable!("written as drivers"),
        }
    }

    /// Driven quantity, its value at t = 0 and its law; `None` for a joint.
    pub fn driver(&self, mechanism: &Mechanism) -> Option<(String, f64, Law)> {
        let point = |p: usize| written_point(mechanism, p);
        let first = |p: usize| mechanism.points[p].place;
        let gap = |p: usize, q: usize| difference(first(q), first(p));
        Some(match *self {
            Joint::DrivePhi(i, law) => (format!("phi({})", name(i)), mechanism.bodies[i][2], law),
            Joint::DriveRelativeAngle(i, j, law) => (
                format!("relative_angle({}, {})", name(i), name(j)),
                mechanism.bodies[j][2] - mechanism.bodies[i][2],
                law,
            ),
            Joint::DriveLength(p, q, law) => {
                let quantity = format!("length({}, {})", point(p), point(q));
                (quantity, length(gap(p, q)), law)
            }
            Joint::Drive(p, axis, law) => {
                (format!("{}({})", AXES[axis], point(p)), first(p)[axis], law)
            }
            Joint::DriveRelative(p, q, axis, law) => {
                let quantity = format!("relative_{}({}, {})", AXES[axis], point(p), point(q));
                (quantity, gap(p, q)[axis], law)
            }
            Joint::DriveDistance(p, q, law) => {
                let quantity = format!("distance({}, {})", point(p), point(q));
                (quantity, length(gap(p, q)), law)
            }
            _ => return None,
        })
    }
}

/// A point as statements mention it.
fn written_point(mechanism: &Mechanism, point: usize) -> String {
    format!("{}.P{point}", name(mechanism.points[point].body))
}
