//! Finds the pins of a mechanism: points that two bodies share.

use crate::joint::geometry::Mark;
use crate::model::Mechanism;

/// Point that two bodies share.
#[derive(Clone, Debug)]
pub struct Pin {
    /// Name in the description.
    pub name: String,
    /// Mark of the point on each of the two bodies.
    pub marks: [Mark; 2],
}

/// Returns the pins of a mechanism: points that a joint keeps together, and points on the ground.
pub(super) fn pins(mechanism: &Mechanism) -> Vec<Pin> {
    let joints = &mechanism.joints;
    let mut pins = Vec::new();
    for joint in joints {
        let marks = &joint.operands.marks;
        if joint.kind.joins_points && marks.len() == 2 {
            pins.extend(pin(mechanism, [marks[0], marks[1]]));
        }
        // The x and y of one point are two statements; together they fix or drive the point.
        let partner = |keywords: [&str; 2]| {
            joints.iter().any(|other| {
                keywords.contains(&other.kind.keyword)
                    && other.operands.marks[0].local == marks[0].local
                    && other.operands.marks[0].frame.body == marks[0].frame.body
            })
        };
        let is_x = ["absolute_x", "x"].contains(&joint.kind.keyword);
        if is_x && partner(["absolute_y", "y"]) {
            let ground = mechanism.bodies[0].frame;
            let held = Mark {
                frame: ground,
                ..marks[0]
            };
            pins.extend(pin(mechanism, [held, marks[0]]));
        }
    }
    pins
}

/// Returns the pin of two marks; `None` if neither has a name.
pub fn pin(mechanism: &Mechanism, marks: [Mark; 2]) -> Option<Pin> {
    let name = marks.iter().find_map(|mark| {
        let body = &mechanism.bodies[mark.frame.body.0];
        let named = body.marks.iter().find(|it| it.mark.local == mark.local);
        named.map(|named| named.name.clone())
    });
    name.map(|name| Pin { name, marks })
}
