//! What turns with an angle → the points at which it ends, and what a person calls it.
//!
//! An angle turns a body, a body with those that slide on it or are held at an angle to it, or a link that joints make without
//! a body. Whether two such links meet in a point decides what can be said of them: in line, or parallel only. The module does
//! not know where a step is singular.

use std::rc::Rc;

use super::writer::Writer;
use crate::joint::Auxiliary;
use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::structure::SolvedBlock;

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

/// Where a link starts that is known, and where it meets the other one.
#[derive(Clone, Debug)]
pub(super) struct Span {
    /// The outer end.
    pub outer: End,
    /// The point between both links.
    pub apex: End,
}

impl Writer<'_> {
    /// Whether a body turns as much as an angle does, by its orientation or as the block defines its angle.
    fn turns_with(&mut self, body: BodyId, angle: usize, block: &SolvedBlock) -> bool {
        if body.0 == 0 {
            return false;
        }
        let form = &self.system.vector_form;
        let (leader, _) = form.orientations.leader(body);
        if leader.0 == 0 {
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
        let slope = self
            .system
            .mechanism
            .graph
            .derivative(definition.value, position);
        slope == self.graph().one()
    }

    /// The ends of what turns with an angle.
    pub(super) fn ends(&mut self, angle: usize, block: &SolvedBlock) -> Vec<End> {
        if let Some(marks) = self.bare_link(angle) {
            let named = marks.into_iter().filter_map(|mark| {
                let name = self.mark_name(&mark)?;
                let (here, beyond) = (None, mark.frame.body);
                Some(End { name, here, beyond })
            });
            return named.collect();
        }
        let mut ends = Vec::new();
        for pin in Rc::clone(&self.pins).iter() {
            let bodies = pin.marks.map(|mark| mark.frame.body);
            let turning = bodies.map(|body| self.turns_with(body, angle, block));
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

    /// The points between which a link without a body lies, where an angle is that of one.
    fn bare_link(&self, angle: usize) -> Option<[Mark; 2]> {
        let joint = self.joint_of(angle)?;
        let marks = &joint.operands.marks;
        (marks.len() == 2).then(|| [marks[0], marks[1]])
    }

    /// The joint whose own unknown this is, other than a coordinate.
    fn joint_of(&self, unknown: usize) -> Option<&crate::model::Joint> {
        let symbol = self.system.vector_form.unknowns[unknown].position;
        let graph = &self.system.mechanism.graph;
        let mut joints = self.system.mechanism.joints.iter();
        joints.find(|joint| {
            let mut own = joint.operands.auxiliaries.iter();
            own.any(|it| graph.symbols(it.value).contains(&symbol))
        })
    }

    /// What the description calls a point of a body, or of the ground.
    pub(super) fn mark_name(&self, mark: &Mark) -> Option<String> {
        let mechanism = &self.system.mechanism;
        let body = &mechanism.bodies[mark.frame.body.0];
        let own = body.marks.iter().find(|it| it.mark.local == mark.local);
        let point = || mechanism.points.iter().find(|it| it.mark == *mark);
        own.map(|it| it.name.clone())
            .or_else(|| point().map(|it| it.name.clone()))
    }

    /// Both links from their outer ends to the point in which they meet; `None` where they do not, or where it is not clear
    /// between which points they lie.
    pub(super) fn meeting(&mut self, angles: [usize; 2], block: &SolvedBlock) -> Option<[Span; 2]> {
        let ends = angles.map(|angle| self.ends(angle, block));
        let mut apexes = Vec::new();
        for side in [0, 1] {
            for end in &ends[side] {
                if self.turns_with(end.beyond, angles[1 - side], block) {
                    apexes.push((side, end.clone()));
                }
            }
        }
        let [(side, apex)] = &apexes[..] else {
            return self.meeting_twice(&apexes, ends);
        };
        // A link without a body ends on the other one, which has no end of its own there.
        let mut across = apex.clone();
        (across.here, across.beyond) = (Some(apex.beyond), apex.here.unwrap_or(apex.beyond));
        let apex_of = |place: usize| {
            if place == *side {
                apex.clone()
            } else {
                across.clone()
            }
        };
        self.outer(ends, [apex_of(0), apex_of(1)])
    }

    /// A pin between two bodies is an end of both.
    fn meeting_twice(&mut self, apexes: &[(usize, End)], ends: [Vec<End>; 2]) -> Option<[Span; 2]> {
        match apexes {
            [(0, first), (1, second)] if first.name == second.name => {
                self.outer(ends, [first.clone(), second.clone()])
            }
            _ => None,
        }
    }

    fn outer(&mut self, ends: [Vec<End>; 2], apexes: [End; 2]) -> Option<[Span; 2]> {
        let mut spans = Vec::new();
        for (ends, apex) in ends.into_iter().zip(apexes) {
            let mut known: Vec<End> = ends
                .into_iter()
                .filter(|end| end.name != apex.name && self.is_known(end.beyond))
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

    /// `coupler`, `the actuator c8-c7`, `the link U-S`, `A-C`: a link from one end to the other.
    pub(super) fn span_words(&self, angle: usize, span: &Span) -> String {
        let [outer, apex] = [&span.outer, &span.apex];
        match (outer.here, apex.here) {
            (Some(from), Some(to)) if from == to => self.body_words(from),
            (Some(from), Some(to)) if self.slide_on_one_another(from, to) => {
                let [from, to] = [from, to].map(|body| self.body_name(body));
                format!("the actuator {from}-{to}")
            }
            (Some(_), Some(_)) => {
                format!(
                    "{}-{}",
                    self.script.word(&outer.name),
                    self.script.word(&apex.name)
                )
            }
            _ => self.turning_words(angle),
        }
    }

    /// What turns with an angle: a body, or a link without one.
    pub(super) fn turning_words(&self, angle: usize) -> String {
        let Some(joint) = self.joint_of(angle) else {
            let coordinate = self.system.coordinates.get(angle);
            let body = coordinate.and_then(|coordinate| coordinate.describes.body());
            return match body {
                Some(body) => self.body_words(BodyId(body)),
                None => self.named(angle),
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
            .filter_map(|mark| self.mark_name(mark))
            .collect();
        match &names[..] {
            [from, to] => format!(
                "the {what} {}-{}",
                self.script.word(from),
                self.script.word(to)
            ),
            _ => format!("the {what} of {}", self.script.word(&joint.label)),
        }
    }

    /// `the line G-S`: along which a displacement is measured.
    pub(super) fn line_words(&self, slide: usize) -> String {
        match self.line_name(slide) {
            Some(line) => format!("the line {line}"),
            None => format!("the line of {}", self.named(slide)),
        }
    }

    /// `G-S`, or the joint whose line it is.
    pub(super) fn line_name(&self, slide: usize) -> Option<String> {
        let joint = self.joint_of(slide)?;
        let line = joint.label.split_once(" along ");
        Some(match line.and_then(|(_, line)| line.split_once(" -> ")) {
            Some((from, to)) => format!("{}-{}", self.script.word(from), self.script.word(to)),
            None => format!("of {}", self.script.word(&joint.label)),
        })
    }

    /// The two points of the joint that a displacement is measured between, that on the line first.
    pub(super) fn measured_points(&self, slide: usize) -> Option<[Mark; 2]> {
        let joint = self.joint_of(slide)?;
        let (_, line, other) = joint.operands.along()?;
        Some([line, other])
    }

    /// Whether a joint keeps two bodies on a common line.
    fn slide_on_one_another(&self, one: BodyId, other: BodyId) -> bool {
        self.system.mechanism.joints.iter().any(|joint| {
            let marks = &joint.operands.marks;
            let bodies: Vec<BodyId> = marks.iter().map(|mark| mark.frame.body).collect();
            joint.operands.axis.is_some() && (bodies == [one, other] || bodies == [other, one])
        })
    }

    /// `c2`, `body 2`.
    pub(super) fn body_words(&self, body: BodyId) -> String {
        let name = self.body_name(body);
        match name.starts_with(|first: char| first.is_ascii_digit()) {
            true => format!("body {name}"),
            false => name,
        }
    }

    fn body_name(&self, body: BodyId) -> String {
        self.script.word(&self.system.mechanism.bodies[body.0].name)
    }

    /// Whether a vector in the orientation of an angle leads from a known pin of its body to the body's origin, or back.
    pub(super) fn pin_opposite_origin(
        &mut self,
        angle: usize,
        local: Vector,
    ) -> Option<(String, BodyId)> {
        let pins = self.known_pins(angle);
        pins.into_iter().find_map(|(pin, there)| {
            let here = pin.marks.into_iter().find(|mark| *mark != there)?;
            let backward = here.local.map(|part| self.graph().negate(part));
            let (leader, _) = self.system.vector_form.orientations.leader(here.frame.body);
            let own = leader == here.frame.body;
            (own && (local == here.local || local == backward))
                .then_some((pin.name, here.frame.body))
        })
    }
}
