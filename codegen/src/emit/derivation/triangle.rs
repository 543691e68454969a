//! Two links between two known points → the triangle that they make, by the names of its pins.

use super::geometry::{Link, Pin};
use super::words::enumerated;
use super::writer::Writer;
use crate::joint::geometry::{Mark, Vector};
use crate::model::Role;

/// What the two links and the known vector are called.
#[derive(Clone, Debug)]
pub(super) struct Names {
    /// The links, in the order of the angles.
    pub links: [String; 2],
    /// From the beginning of the first to the end of the second.
    pub base: String,
}

/// Two known pins and the sought one.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    /// The known pins at the beginning of the first link and the end of the second, each with the mark of the known body.
    pub outer: [(Pin, Mark); 2],
    /// The pin between the links.
    pub apex: Pin,
    /// Whether p leads from the first outer pin to the apex, and not back.
    pub forward: bool,
}

impl Writer<'_> {
    /// The pins of the triangle that the links make with the known vector.
    pub(super) fn triangle(&mut self, angles: [usize; 2], links: [Vector; 2]) -> Option<Triangle> {
        let turns = |angle: usize| {
            move |writer: &Writer<'_>, mark: &Mark| {
                let form = &writer.system.vector_form;
                let (leader, _) = form.orientations.leader(mark.frame.body);
                leader.0 != 0 && form.angle_of(leader.0) == angle
            }
        };
        let (first, first_end, forward) = self.link(angles[0], links[0], turns(angles[1]))?;
        let (second, second_end, back) = self.link(angles[1], links[1], turns(angles[0]))?;
        let Link { from, to } = first;
        // The second vector leads from the apex to its known pin where the first leads to the apex.
        (to.name == second.to.name && forward != back).then_some(Triangle {
            outer: [(from, first_end), (second.from, second_end)],
            apex: to,
            forward,
        })
    }

    /// Says what is known of the triangle; returns the names of its sides and what the heading says.
    pub(super) fn open_triangle(
        &mut self,
        triangle: &Triangle,
        links: [Vector; 2],
    ) -> (Names, String) {
        let [a, b] = [0, 1].map(|side| triangle.outer[side].0.name.clone());
        let apex = triangle.apex.name.clone();
        let names = Names {
            links: [format!("{a}{apex}"), format!("{apex}{b}")],
            base: format!("{a}{b}"),
        };
        let places = [0, 1].map(|side| self.whereabouts(&triangle.outer[side].1));
        let mut heading = Vec::new();
        let mut lengths = Vec::new();
        for side in [0, 1] {
            let name = [format!("{a}{apex}"), format!("{b}{apex}")][side].clone();
            let length = self.script.inline(&self.script.length(&name));
            if let Some((value, reason, driven)) = self.known_length(links[side]) {
                lengths.push(format!("{length} is {value}, {reason}"));
                if driven {
                    heading.push(length);
                }
            }
        }
        let condition = match heading[..] {
            [] => String::new(),
            _ => format!(" with {} known from the driver", enumerated(&heading)),
        };
        let [a, b, apex] = [a, b, apex].map(|name| self.script.word(&name));
        let known = if places[0] == places[1] {
            format!("{a} and {b}, {}, are known", places[0])
        } else {
            format!("{a}, {}, and {b}, {}, are known", places[0], places[1])
        };
        let lengths = match lengths[..] {
            [] => String::new(),
            _ => format!(" {}.", lengths.join("; ")),
        };
        self.paragraph(format!(
            "{known}. Sought is {apex}, the third point of the triangle.{lengths}"
        ));
        (
            names,
            format!("from the triangle {a}-{b}-{apex}{condition}"),
        )
    }

    /// The same where the links do not lie between three pins.
    pub(super) fn open_loop(&mut self) -> (Names, String) {
        let names = Names {
            links: ["p".to_string(), "q".to_string()],
            base: "d".to_string(),
        };
        (names, "from a loop of two turning links".to_string())
    }

    /// The length of a link, why it is known, and whether a driver says it; `None` where it is no number and no displacement.
    fn known_length(&mut self, local: Vector) -> Option<(String, String, bool)> {
        let square = self.dot(local, local);
        let square = self.with_numbers(square);
        if self.graph().is_fixed(square) {
            let length = self.graph().sqrt(square);
            let length = self.script.inline(&self.formula(length));
            return Some((length, "a fixed length".to_string(), false));
        }
        for unknown in 0..self.system.vector_form.unknowns.len() {
            let variable = self.variable(unknown);
            if self.square(variable) != square {
                continue;
            }
            let joints = &self.system.mechanism.joints;
            let driver = joints.iter().find(|joint| {
                let mut auxiliaries = joint.operands.auxiliaries.iter();
                joint.role == Role::Driver && auxiliaries.any(|it| it.value == variable)
            });
            let block = self.found_in[unknown].map_or(0, |block| block + 1);
            let reason = match driver {
                Some(driver) => format!("known from {}", self.script.word(&driver.label)),
                None => format!("known from block {block}"),
            };
            return Some((self.named(unknown), reason, driver.is_some()));
        }
        None
    }
}
