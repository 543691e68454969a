//! Names bodies and links that rotate with an angle, and finds their ends.
//!
//! An angle rotates a link of joints without a body, or a body with all bodies that slide on it or keep an angle to it. Two such
//! links that meet in a point may be collinear; others may only be parallel.

use super::known::Known;
use super::phrase::{Phrase, Piece, phrase};
use crate::joint::Auxiliary;
use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::model::Joint;
use crate::pool::Pool;
use crate::structure::SolvedBlock;
use crate::system::{Described, System};

/// Connection of a rotating body or link to something else.
#[derive(Clone, Debug)]
pub(super) struct End {
    /// Name in the description.
    pub name: String,
    /// Body of the rotating link at this end; `None` for a link without a body.
    here: Option<BodyId>,
    /// Body on the other side.
    pub beyond: BodyId,
}

impl End {
    /// True if the body on the other side rotates with an angle.
    pub fn is_beyond_on(
        &self,
        angle: usize,
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> bool {
        turns_with(self.beyond, angle, block, pool, system)
    }
}

/// Link from a known end to its apex with another link.
#[derive(Clone, Debug)]
pub(super) struct Span {
    /// Outer end.
    pub outer: End,
    /// Point between both links.
    pub apex: End,
}

impl Known {
    /// Returns the ends of the body or link of an angle.
    pub(super) fn ends(
        &self,
        angle: usize,
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> Vec<End> {
        if let Some(marks) = bare_link(angle, pool, system) {
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
            let turning = bodies.map(|body| turns_with(body, angle, block, pool, system));
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

    /// Returns both links from their outer ends to their common point. `None` if they do not meet, or if their ends are
    /// ambiguous.
    pub(super) fn meeting(
        &self,
        angles: [usize; 2],
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> Option<[Span; 2]> {
        let ends = angles.map(|angle| self.ends(angle, block, pool, system));
        let mut apexes = Vec::new();
        for side in [0, 1] {
            for end in &ends[side] {
                if turns_with(end.beyond, angles[1 - side], block, pool, system) {
                    apexes.push((side, end.clone()));
                }
            }
        }
        match &apexes[..] {
            // A link without a body ends on the other link, which has no end of its own there.
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

    /// Returns pin and body if a vector in the orientation of an angle joins a known pin of a body to the body's origin. The
    /// direction is arbitrary.
    pub(super) fn pin_opposite_origin(
        &self,
        angle: usize,
        local: Vector,
        pool: &mut Pool,
        system: &System,
    ) -> Option<(String, BodyId)> {
        let pins = self.known_pins(angle, system);
        pins.into_iter().find_map(|(pin, there)| {
            let here = pin.marks.into_iter().find(|mark| *mark != there)?;
            let graph = &mut pool.graph;
            let backward = here.local.map(|part| graph.negate(part));
            let (leader, _) = system.vector_form.orientations.leader(here.frame.body);
            let is_own = leader == here.frame.body;
            (is_own && (local == here.local || local == backward))
                .then_some((pin.name, here.frame.body))
        })
    }
}

/// True if a body rotates as much as an angle does, by its orientation or by the definition of its angle.
fn turns_with(
    body: BodyId,
    angle: usize,
    block: &SolvedBlock,
    pool: &mut Pool,
    system: &System,
) -> bool {
    if body == BodyId::GROUND {
        return false;
    }
    let form = &system.vector_form;
    let (leader, _) = form.orientations.leader(body);
    if leader == BodyId::GROUND {
        return false;
    }
    let body_angle = form.angle_of(leader.0);
    if body_angle == angle {
        return true;
    }
    let position = form.unknowns[angle].position;
    let mut definitions = block.definitions.iter();
    let Some(definition) = definitions.find(|it| it.unknown == body_angle) else {
        return false;
    };
    let graph = &mut pool.graph;
    graph.derivative(definition.value, position) == graph.one()
}

/// Returns the points of a link without a body; `None` if the angle is not that of such a link.
fn bare_link(angle: usize, pool: &Pool, system: &System) -> Option<[Mark; 2]> {
    let marks = &joint_of(angle, pool, system)?.operands.marks;
    (marks.len() == 2).then(|| [marks[0], marks[1]])
}

/// Returns the joint whose auxiliary unknown this is; `None` for a coordinate.
fn joint_of<'a>(unknown: usize, pool: &Pool, system: &'a System) -> Option<&'a Joint> {
    let symbol = system.vector_form.unknowns[unknown].position;
    let graph = &pool.graph;
    let mut joints = system.mechanism.joints.iter();
    joints.find(|joint| {
        let mut auxiliaries = joint.operands.auxiliaries.iter();
        auxiliaries.any(|it| graph.symbols(it.value).contains(&symbol))
    })
}

/// Returns the name of a point of a body or of the ground, as in the description.
pub(super) fn mark_name(mark: &Mark, system: &System) -> Option<String> {
    let mechanism = &system.mechanism;
    let body = &mechanism.bodies[mark.frame.body.0];
    let named = body.marks.iter().find(|it| it.mark.local == mark.local);
    let point = || mechanism.points.iter().find(|it| it.mark == *mark);
    named
        .map(|it| it.name.clone())
        .or_else(|| point().map(|it| it.name.clone()))
}

/// Names a link from one end to the other: `coupler`, `the actuator c8-c7`, `the link U-S`, `A-C`.
pub(super) fn span_words(angle: usize, span: &Span, pool: &Pool, system: &System) -> Phrase {
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
        _ => turning_words(angle, pool, system),
    }
}

/// Names the body or link that rotates with an angle.
pub(super) fn turning_words(angle: usize, pool: &Pool, system: &System) -> Phrase {
    let Some(joint) = joint_of(angle, pool, system) else {
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

/// Names the line along which a displacement is measured: `the line G-S`.
pub(super) fn line_words(slide: usize, pool: &Pool, system: &System) -> Phrase {
    match line_name(slide, pool, system) {
        Some(line) => phrase!["the line ", line],
        None => phrase!["the line of ", Piece::Unknown(slide)],
    }
}

/// Names a line: `G-S`, or the joint of the line.
pub(super) fn line_name(slide: usize, pool: &Pool, system: &System) -> Option<Phrase> {
    let joint = joint_of(slide, pool, system)?;
    let line = joint.label.split_once(" along ");
    let name = |name: &str| Piece::Name(name.to_string());
    Some(match line.and_then(|(_, line)| line.split_once(" -> ")) {
        Some((from, to)) => phrase![name(from), "-", name(to)],
        None => phrase!["of ", name(&joint.label)],
    })
}

/// Returns the points of the joint between which a displacement is measured; the point on the line comes first.
pub(super) fn measured_points(slide: usize, pool: &Pool, system: &System) -> Option<[Mark; 2]> {
    let joint = joint_of(slide, pool, system)?;
    let (_, line, other) = joint.operands.along()?;
    Some([line, other])
}

/// True if a joint keeps two bodies on a common line.
fn slide_on_one_another(one: BodyId, other: BodyId, system: &System) -> bool {
    system.mechanism.joints.iter().any(|joint| {
        let marks = &joint.operands.marks;
        let bodies: Vec<BodyId> = marks.iter().map(|mark| mark.frame.body).collect();
        joint.operands.axis.is_some() && (bodies == [one, other] || bodies == [other, one])
    })
}

/// Names a body: `c2`, `body 2`.
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

/// Names the body, link, slide or contact point that a free unknown moves.
pub(super) fn movable(unknown: usize, pool: &Pool, system: &System) -> Phrase {
    match system.vector_form.unknowns[unknown].describes {
        Described::Contact { joint } => {
            let label = &system.mechanism.joints[joint].label;
            // In `roller (2.P, rim)`, the curve is the last operand.
            let operands = label
                .rsplit_once('(')
                .and_then(|(_, it)| it.split_once(')'));
            let curve = operands.and_then(|(operands, _)| operands.rsplit_once(", "));
            let curve = curve.map_or(label.as_str(), |(_, curve)| curve);
            phrase!["the point of contact on ", Piece::Name(curve.to_string())]
        }
        Described::Pose { .. } => turning_words(unknown, pool, system),
        Described::Auxiliary => match line_name(unknown, pool, system) {
            Some(line) if measured_points(unknown, pool, system).is_some() => {
                phrase!["the slide along the line ", line]
            }
            _ => turning_words(unknown, pool, system),
        },
    }
}
