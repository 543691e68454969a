//! What turns with an angle → the points at which it ends, and what a person calls it.
//!
//! An angle turns a body, a body with those that slide on it or are held at an angle to it, or a link that joints make without
//! a body. Whether two such links meet in a point decides what can be said of them: in line, or parallel only. The module does
//! not know where a step is singular.

use super::known::Known;
use super::phrase::{Phrase, Piece, phrase};
use crate::joint::Auxiliary;
use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::model::Joint;
use crate::structure::SolvedBlock;
use crate::system::{Described, System};

/// A point at which what turns with an angle is connected to something else.
#[derive(Clone, Debug)]
pub(super) struct End {
    /// As the description writes it.
    pub name: String,
    /// The body that carries it and turns; `None` for a link without a body.
    here: Option<BodyId>,
    /// The body on the other side.
    pub beyond: BodyId,
}

impl End {
    /// Whether what is on the other side turns with an angle.
    pub fn is_beyond_on(&self, angle: usize, block: &SolvedBlock, system: &mut System) -> bool {
        turns_with(self.beyond, angle, block, system)
    }
}

/// Where a link starts that is known, and where it meets the other one.
#[derive(Clone, Debug)]
pub(super) struct Span {
    /// The outer end.
    pub outer: End,
    /// The point between both links.
    pub apex: End,
}

impl Known {
    /// The ends of what turns with an angle.
    pub(super) fn ends(&self, angle: usize, block: &SolvedBlock, system: &mut System) -> Vec<End> {
        if let Some(marks) = bare_link(angle, system) {
            let named = marks.into_iter().filter_map(|mark| {
                let name = mark_name(&mark, system)?;
                let (here, beyond) = (None, mark.frame.body);
                Some(End { name, here, beyond })
            });
            return named.collect();
        }
        let mut ends = Vec::new();
        let mut angles = vec![angle];
        angles.extend(block.definitions.iter().map(|it| it.unknown));
        for pin in self.pins_on(&angles) {
            let bodies = pin.marks.map(|mark| mark.frame.body);
            let turning = bodies.map(|body| turns_with(body, angle, block, system));
            let (here, beyond) = match turning {
                [true, false] => (bodies[0], bodies[1]),
                [false, true] => (bodies[1], bodies[0]),
                _ => continue,
            };
            ends.push(End {
                name: pin.name.clone(),
                here: Some(here),
                beyond,
            });
        }
        ends
    }

    /// Both links from their outer ends to the point in which they meet; `None` where they do not, or where it is not clear
    /// between which points they lie.
    pub(super) fn meeting(
        &self,
        angles: [usize; 2],
        block: &SolvedBlock,
        system: &mut System,
    ) -> Option<[Span; 2]> {
        let ends = angles.map(|angle| self.ends(angle, block, system));
        let mut apexes = Vec::new();
        for side in [0, 1] {
            for end in &ends[side] {
                if turns_with(end.beyond, angles[1 - side], block, system) {
                    apexes.push((side, end.clone()));
                }
            }
        }
        match &apexes[..] {
            // A link without a body ends on the other one, which has no end of its own there.
            [(side, apex)] => {
                let mut across = apex.clone();
                (across.here, across.beyond) =
                    (Some(apex.beyond), apex.here.unwrap_or(apex.beyond));
                let both = match side {
                    0 => [apex.clone(), across],
                    _ => [across, apex.clone()],
                };
                self.outer(ends, both, system)
            }
            // A pin between two bodies is an end of both.
            [(0, first), (1, second)] if first.name == second.name => {
                self.outer(ends, [first.clone(), second.clone()], system)
            }
            _ => None,
        }
    }

    fn outer(&self, ends: [Vec<End>; 2], apexes: [End; 2], system: &System) -> Option<[Span; 2]> {
        let mut spans = Vec::new();
        for (ends, apex) in ends.into_iter().zip(apexes) {
            let mut known: Vec<End> = ends
                .into_iter()
                .filter(|end| end.name != apex.name && self.is_known(end.beyond, system))
                .collect();
            known.dedup_by(|a, b| a.name == b.name);
            let [outer] = &known[..] else { return None };
            spans.push(Span {
                outer: outer.clone(),
                apex,
            });
        }
        spans.try_into().ok()
    }

    /// Whether a vector in the orientation of an angle leads from a known pin of its body to the body's origin, or back.
    pub(super) fn pin_opposite_origin(
        &self,
        angle: usize,
        local: Vector,
        system: &mut System,
    ) -> Option<(String, BodyId)> {
        let pins = self.known_pins(angle, system);
        pins.into_iter().find_map(|(pin, there)| {
            let here = pin.marks.into_iter().find(|mark| *mark != there)?;
            let graph = &mut system.mechanism.graph;
            let backward = here.local.map(|part| graph.negate(part));
            let (leader, _) = system.vector_form.orientations.leader(here.frame.body);
            let own = leader == here.frame.body;
            (own && (local == here.local || local == backward))
                .then_some((pin.name, here.frame.body))
        })
    }
}

/// Whether a body turns as much as an angle does, by its orientation or as the block defines its angle.
fn turns_with(body: BodyId, angle: usize, block: &SolvedBlock, system: &mut System) -> bool {
    if body == BodyId::GROUND {
        return false;
    }
    let form = &system.vector_form;
    let (leader, _) = form.orientations.leader(body);
    if leader == BodyId::GROUND {
        return false;
    }
    let own = form.angle_of(leader.0);
    if own == angle {
        return true;
    }
    let position = form.unknowns[angle].position;
    let mut definitions = block.definitions.iter();
    let Some(definition) = definitions.find(|it| it.unknown == own) else {
        return false;
    };
    let graph = &mut system.mechanism.graph;
    graph.derivative(definition.value, position) == graph.one()
}

/// The points between which a link without a body lies, where an angle is that of one.
fn bare_link(angle: usize, system: &System) -> Option<[Mark; 2]> {
    let marks = &joint_of(angle, system)?.operands.marks;
    (marks.len() == 2).then(|| [marks[0], marks[1]])
}

/// The joint whose own unknown this is, other than a coordinate.
fn joint_of(unknown: usize, system: &System) -> Option<&Joint> {
    let symbol = system.vector_form.unknowns[unknown].position;
    let graph = &system.mechanism.graph;
    let mut joints = system.mechanism.joints.iter();
    joints.find(|joint| {
        let mut own = joint.operands.auxiliaries.iter();
        own.any(|it| graph.symbols(it.value).contains(&symbol))
    })
}

/// What the description calls a point of a body, or of the ground.
pub(super) fn mark_name(mark: &Mark, system: &System) -> Option<String> {
    let mechanism = &system.mechanism;
    let body = &mechanism.bodies[mark.frame.body.0];
    let own = body.marks.iter().find(|it| it.mark.local == mark.local);
    let point = || mechanism.points.iter().find(|it| it.mark == *mark);
    own.map(|it| it.name.clone())
        .or_else(|| point().map(|it| it.name.clone()))
}

/// `coupler`, `the actuator c8-c7`, `the link U-S`, `A-C`: a link from one end to the other.
pub(super) fn span_words(angle: usize, span: &Span, system: &System) -> Phrase {
    let [outer, apex] = [&span.outer, &span.apex];
    match (outer.here, apex.here) {
        (Some(from), Some(to)) if from == to => body_words(from, system),
        (Some(from), Some(to)) if slide_on_one_another(from, to, system) => {
            let [from, to] = [from, to].map(|body| body_name(body, system));
            phrase!["the actuator ", from, "-", to]
        }
        (Some(_), Some(_)) => phrase![
            Piece::Name(outer.name.clone()),
            "-",
            Piece::Name(apex.name.clone())
        ],
        _ => turning_words(angle, system),
    }
}

/// What turns with an angle: a body, or a link without one.
pub(super) fn turning_words(angle: usize, system: &System) -> Phrase {
    let Some(joint) = joint_of(angle, system) else {
        return match system.vector_form.unknowns[angle].describes.body() {
            Some(body) => body_words(BodyId(body), system),
            None => Piece::Unknown(angle).into(),
        };
    };
    let is_driven = joint
        .operands
        .auxiliaries
        .iter()
        .any(|it| it.kind == Auxiliary::Distance);
    let what = if is_driven { "actuator" } else { "link" };
    let names: Vec<String> = joint
        .operands
        .marks
        .iter()
        .filter_map(|mark| mark_name(mark, system))
        .collect();
    match &names[..] {
        [from, to] => phrase![
            format!("the {what} "),
            Piece::Name(from.clone()),
            "-",
            Piece::Name(to.clone())
        ],
        _ => phrase![format!("the {what} of "), Piece::Name(joint.label.clone())],
    }
}

/// `the line G-S`: along which a displacement is measured.
pub(super) fn line_words(slide: usize, system: &System) -> Phrase {
    match line_name(slide, system) {
        Some(line) => phrase!["the line ", line],
        None => phrase!["the line of ", Piece::Unknown(slide)],
    }
}

/// `G-S`, or the joint whose line it is.
pub(super) fn line_name(slide: usize, system: &System) -> Option<Phrase> {
    let joint = joint_of(slide, system)?;
    let line = joint.label.split_once(" along ");
    let name = |name: &str| Piece::Name(name.to_string());
    Some(match line.and_then(|(_, line)| line.split_once(" -> ")) {
        Some((from, to)) => phrase![name(from), "-", name(to)],
        None => phrase!["of ", name(&joint.label)],
    })
}

/// The two points of the joint that a displacement is measured between, that on the line first.
pub(super) fn measured_points(slide: usize, system: &System) -> Option<[Mark; 2]> {
    let joint = joint_of(slide, system)?;
    let (_, line, other) = joint.operands.along()?;
    Some([line, other])
}

/// Whether a joint keeps two bodies on a common line.
fn slide_on_one_another(one: BodyId, other: BodyId, system: &System) -> bool {
    system.mechanism.joints.iter().any(|joint| {
        let marks = &joint.operands.marks;
        let bodies: Vec<BodyId> = marks.iter().map(|mark| mark.frame.body).collect();
        joint.operands.axis.is_some() && (bodies == [one, other] || bodies == [other, one])
    })
}

/// `c2`, `body 2`.
pub(super) fn body_words(body: BodyId, system: &System) -> Phrase {
    let numbered = |first: char| first.is_ascii_digit();
    let name = &system.mechanism.bodies[body.0].name;
    match name.starts_with(numbered) {
        true => phrase!["body ", body_name(body, system)],
        false => body_name(body, system).into(),
    }
}

fn body_name(body: BodyId, system: &System) -> Piece {
    Piece::Name(system.mechanism.bodies[body.0].name.clone())
}

/// What can move where an unknown is free: a body, a link, a slide, a point of contact.
pub(super) fn movable(unknown: usize, system: &System) -> Phrase {
    match system.vector_form.unknowns[unknown].describes {
        Described::Contact { joint } => {
            let label = &system.mechanism.joints[joint].label;
            // `roller (2.P, rim)`: the curve is the last operand.
            let operands = label
                .rsplit_once('(')
                .and_then(|(_, it)| it.split_once(')'));
            let curve = operands.and_then(|(operands, _)| operands.rsplit_once(", "));
            let curve = curve.map_or(label.as_str(), |(_, curve)| curve);
            phrase!["the point of contact on ", Piece::Name(curve.to_string())]
        }
        Described::Pose { .. } => turning_words(unknown, system),
        Described::Auxiliary => match line_name(unknown, system) {
            Some(line) if measured_points(unknown, system).is_some() => {
                phrase!["the slide along the line ", line]
            }
            _ => turning_words(unknown, system),
        },
    }
}
