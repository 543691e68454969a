//! The links of a step → the pins at their ends, by name.

use super::writer::Writer;
use crate::expr::ExprId;
use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::model::Mechanism;

/// A point that two bodies share.
#[derive(Clone, Debug)]
pub(super) struct Pin {
    /// As the description writes it.
    pub name: String,
    /// The point as each of the two carries it.
    pub marks: [Mark; 2],
}

/// A link between two pins that turns with one angle.
#[derive(Clone, Debug)]
pub(super) struct Link {
    /// Where its vector begins.
    pub from: Pin,
    /// Where it ends.
    pub to: Pin,
}

/// The pins of a mechanism: points that a joint keeps together, and points that are held on the ground.
pub(super) fn pins(mechanism: &Mechanism) -> Vec<Pin> {
    let joints = &mechanism.joints;
    let mut pins = Vec::new();
    for joint in joints {
        let marks = &joint.operands.marks;
        if joint.kind.joins_points() && marks.len() == 2 {
            pins.extend(pin(mechanism, [marks[0], marks[1]]));
        }
        // x and y of one point are two statements; together they hold it, or lead it.
        let partner = |keywords: [&str; 2]| {
            joints.iter().any(|other| {
                keywords.contains(&other.kind.keyword())
                    && other.operands.marks[0].local == marks[0].local
                    && other.operands.marks[0].frame.body == marks[0].frame.body
            })
        };
        let is_x = ["absolute_x", "x"].contains(&joint.kind.keyword());
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

/// The pin of two marks, where one of them has a name.
pub(super) fn pin(mechanism: &Mechanism, marks: [Mark; 2]) -> Option<Pin> {
    let name = marks.iter().find_map(|mark| {
        let body = &mechanism.bodies[mark.frame.body.0];
        let named = body.marks.iter().find(|it| it.mark.local == mark.local);
        named.map(|named| named.name.clone())
    });
    name.map(|name| Pin { name, marks })
}

impl Writer<'_> {
    /// Whether the pose of a body is known at this point of the derivation.
    pub(super) fn is_known(&self, body: BodyId) -> bool {
        match body.0 {
            0 => true,
            body => (3 * body - 3..3 * body).all(|unknown| self.found_in[unknown].is_some()),
        }
    }

    /// The pins on a body that turns with this angle, with what is on their other side: the mark here, the mark there.
    fn pins_turning(&self, angle: usize) -> Vec<(Pin, Mark, Mark)> {
        let form = &self.system.vector_form;
        let turns = |mark: &Mark| {
            let (leader, _) = form.orientations.leader(mark.frame.body);
            leader.0 != 0 && form.angle_of(leader.0) == angle
        };
        let turning = self.pins.iter().filter_map(|pin| {
            let [first, second] = pin.marks;
            match [turns(&first), turns(&second)] {
                [true, false] => Some((pin.clone(), first, second)),
                [false, true] => Some((pin.clone(), second, first)),
                _ => None,
            }
        });
        turning.collect()
    }

    /// The pins that connect what turns with this angle to bodies that are known, each with the mark of the known body.
    pub(super) fn known_pins(&self, angle: usize) -> Vec<(Pin, Mark)> {
        self.pins_turning(angle)
            .into_iter()
            .filter(|(_, _, there)| self.is_known(there.frame.body))
            .map(|(pin, _, there)| (pin, there))
            .collect()
    }

    /// The link from a known pin whose vector in the body is `local`, or against it: the sign is the last result. `to` says
    /// which pins it may end at.
    pub(super) fn link(
        &mut self,
        angle: usize,
        local: Vector,
        to: impl Fn(&Writer<'_>, &Mark) -> bool,
    ) -> Option<(Link, Mark, bool)> {
        let turning = self.pins_turning(angle);
        for (from, here, known) in &turning {
            if !self.is_known(known.frame.body) {
                continue;
            }
            for (end, at, beyond) in &turning {
                if end.name == from.name || !to(self, beyond) {
                    continue;
                }
                if let Some(forward) = self.spans(*here, *at, angle, local) {
                    let link = Link {
                        from: from.clone(),
                        to: end.clone(),
                    };
                    return Some((link, *known, forward));
                }
            }
        }
        None
    }

    /// Whether a vector in the orientation of `angle` leads from one mark to another, `true` for forwards. Marks on one body
    /// are compared exactly; between bodies that slide along one another the vector must hold a displacement.
    fn spans(&mut self, from: Mark, to: Mark, angle: usize, local: Vector) -> Option<bool> {
        if from.frame.body == to.frame.body {
            let difference = [0, 1].map(|axis| {
                let graph = self.graph();
                graph.subtract(to.local[axis], from.local[axis])
            });
            let (_, offset) = self.system.vector_form.orientations.leader(from.frame.body);
            let frame = crate::joint::geometry::Frame {
                angle: offset,
                ..from.frame
            };
            let difference = frame.rotate(difference, self.graph());
            let backward = local.map(|part| self.graph().negate(part));
            return if difference == local {
                Some(true)
            } else if difference == backward {
                Some(false)
            } else {
                None
            };
        }
        if local.iter().all(|&part| self.graph().is_fixed(part)) {
            return None;
        }
        let turned = self.turn(angle, local).map(|part| self.drawn(part));
        let [from, to] = [from, to].map(|mark| self.drawn_position(mark));
        let along = turned[0] * (to[0] - from[0]) + turned[1] * (to[1] - from[1]);
        Some(along > 0.0)
    }

    /// Where a mark is in the drawing.
    pub(super) fn drawn_position(&mut self, mark: Mark) -> [f64; 2] {
        let drawn = self.system.mechanism.bodies[mark.frame.body.0].drawn;
        let position: [ExprId; 2] = {
            let graph = self.graph();
            Mark::new(drawn, mark.local, graph).position(graph)
        };
        position.map(|part| self.drawn(part))
    }

    /// Where a known point is, in words: `on the ground`, `led by the drivers`, `on c3 (block 2)`.
    pub(super) fn whereabouts(&self, mark: &Mark) -> String {
        let body = mark.frame.body.0;
        if body == 0 {
            let mut joints = self.system.mechanism.joints.iter();
            let led = joints.any(|joint| {
                let is_led = ["x", "y"].contains(&joint.kind.keyword());
                is_led && joint.operands.marks[0].local == mark.local
            });
            let place = if led {
                "led by the drivers"
            } else {
                "on the ground"
            };
            return place.to_string();
        }
        let name = self.script.word(&self.system.mechanism.bodies[body].name);
        let latest = (3 * body - 3..3 * body).filter_map(|unknown| self.found_in[unknown]);
        match latest.max() {
            Some(block) => format!("on {name} (block {})", block + 1),
            None => format!("on {name}"),
        }
    }
}
