//! Describes the constraint of a joint or driver, as a sentence without a full stop.
//!
//! The words follow the joint's sign in pictures, so that every kind has its own.

use super::phrase::{Phrase, Piece, phrase};
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::Mark;
use crate::joint::{Feature, Follower, Mesh};
use crate::model::{Mechanism, Role};

/// Describes the constraint of a joint, given by index; returns its statement if operands are incomplete.
pub fn constraint(mechanism: &Mechanism, joint: usize, graph: &mut Graph) -> Phrase {
    let declared = &mechanism.joints[joint];
    let marks = &declared.operands.marks;
    let feature = declared.kind.feature(&declared.operands, graph);
    let written = || phrase![Piece::Name(declared.label.clone())];
    let (Some(feature), Some(first)) = (feature, marks.first()) else {
        return written();
    };
    let second = marks.get(1).unwrap_or(first);
    let zero = graph.zero();
    let value = match declared.operands.value {
        Some(value) => Phrase::from(Piece::Formula(value)),
        None => "what the drawing says".into(),
    };
    let is = match declared.role {
        Role::Driver => " is driven as ",
        Role::Constraint => " is always ",
    };
    let [a, b] = [first, second].map(|mark| point(mechanism, mark, zero));
    let [body, other] = [first, second].map(|mark| body(mechanism, mark));
    let axis_owner = declared.operands.axis.map_or(0, |axis| axis.owner);
    // The owner of the line, and the point or body on the line.
    let (guide, rider, rider_body) = match axis_owner {
        0 => (body.clone(), b.clone(), other.clone()),
        _ => (other.clone(), a.clone(), body.clone()),
    };
    match feature {
        Feature::Pin => phrase![a, " and ", b, " always coincide"],
        Feature::Weld => phrase![
            a,
            " and ",
            b,
            " always coincide, and ",
            other,
            " does not turn against ",
            body
        ],
        Feature::Slide if declared.role == Role::Driver => {
            phrase![
                "the displacement from ",
                a,
                " to ",
                b,
                " along the line",
                is,
                value
            ]
        }
        Feature::Slide => phrase![
            rider_body,
            " slides along a line of ",
            guide,
            " and does not turn against it"
        ],
        Feature::Slot(_) => phrase![rider, " stays on a line of ", guide],
        Feature::Coordinate(axis) => phrase!["the ", ["x", "y"][axis], " of ", a, is, value],
        Feature::Orientation => phrase!["the angle of ", body, is, value],
        Feature::Link => phrase!["the distance of ", a, " and ", b, is, value],
        Feature::Offset(axis) => phrase![
            "the difference in ",
            ["x", "y"][axis],
            " of ",
            a,
            " and ",
            b,
            is,
            value
        ],
        Feature::RelativeOrientation => {
            phrase!["the angle between ", body, " and ", other, is, value]
        }
        Feature::Wheels(mesh, ratio) => {
            let carrier = marks.get(2).map(|mark| self::body(mechanism, mark));
            let angle = declared.pressure_angle.map(|it| it.value);
            wheels([body, other], carrier, mesh, ratio, angle)
        }
        Feature::Pinion(radius) => phrase![
            "a wheel of radius ",
            Piece::Formula(radius),
            " about ",
            rider,
            " rolls on a line of ",
            guide
        ],
        Feature::Contact(follower) => {
            let curve = declared.operands.curve.map(|it| it.frame.body.0);
            let of = curve.map_or(Phrase::default(), |it| {
                phrase![" of ", named(mechanism, it)]
            });
            touch(follower, [a, body], of)
        }
        Feature::Written => phrase!["the equation ", written(), " holds"],
    }
}

/// Describes the ratio between two wheels.
fn wheels(
    [body, other]: [Phrase; 2],
    carrier: Option<Phrase>,
    mesh: Mesh,
    ratio: ExprId,
    pressure_angle: Option<ExprId>,
) -> Phrase {
    let how = match mesh {
        Mesh::External => " mesh as external gears",
        Mesh::Internal => " mesh, one inside the other",
        Mesh::Belt => " are turned by one belt",
        Mesh::CrossedBelt => " are turned by one crossed belt",
    };
    let angle = pressure_angle.map_or(Phrase::default(), |it| {
        phrase![" and the pressure angle ", Piece::Formula(it)]
    });
    let seen = carrier.map_or(Phrase::default(), |it| phrase![", seen from ", it]);
    phrase![
        body,
        " and ",
        other,
        how,
        " with the ratio of radii ",
        Piece::Formula(ratio),
        angle,
        seen
    ]
}

/// Describes the contact of a point or a body with a curve of a body.
fn touch(follower: Follower, [a, body]: [Phrase; 2], of: Phrase) -> Phrase {
    match follower {
        Follower::Point => phrase![a, " stays on the curve", of],
        Follower::Roller(radius) => phrase![
            "a roller of radius ",
            Piece::Formula(radius),
            " about ",
            a,
            " stays on the curve",
            of
        ],
        Follower::Face => phrase!["a face of ", body, " touches the curve", of],
    }
}

/// Returns a point by its name on the body.
fn point(mechanism: &Mechanism, mark: &Mark, zero: ExprId) -> Phrase {
    let carried = &mechanism.bodies[mark.frame.body.0].marks;
    let named = carried.iter().find(|it| it.mark.local == mark.local);
    let of = body(mechanism, mark);
    match named {
        Some(named) => phrase![Piece::Name(named.name.clone()), " of ", of],
        None if mark.local == [zero; 2] => phrase!["the origin of ", of],
        None => {
            let [x, y] = mark.local.map(Piece::Formula);
            phrase!["the point (", x, ", ", y, ") of ", of]
        }
    }
}

fn body(mechanism: &Mechanism, mark: &Mark) -> Phrase {
    named(mechanism, mark.frame.body.0)
}

fn named(mechanism: &Mechanism, body: usize) -> Phrase {
    match body {
        0 => "the ground".into(),
        _ => {
            let declared = &mechanism.bodies[body];
            let kind = if declared.is_angle() {
                "angle "
            } else {
                "body "
            };
            phrase![kind, Piece::Name(declared.name.clone())]
        }
    }
}
