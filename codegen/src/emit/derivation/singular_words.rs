//! A step of the plan → what its singular poses look like, said of points and said of bodies.
//!
//! The words are the equation det = 0 of the closed form: two links are in line, a link is parallel to what it is measured
//! along, a line is perpendicular to the vector that its slide closes. Points are said where the description names them, since
//! a link is a line between two of its points whatever the shape of its body.

use super::words::enumerated;
use super::writer::Writer;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::structure::{SolvedBlock, Step};
use crate::system::{Arm, Described};

/// What is said of a singular pose.
pub(super) struct Words {
    /// `A-B and B-C are in line`.
    pub points: String,
    /// `crank and coupler are in line`.
    pub bodies: String,
}

impl Words {
    fn both(sentence: String) -> Words {
        Words {
            points: sentence.clone(),
            bodies: sentence,
        }
    }
}

impl Writer<'_> {
    /// What a step is like where its determinant is zero.
    pub(super) fn singular_words(&mut self, step: &Step, block: &SolvedBlock) -> Words {
        match step {
            Step::Linear { unknown, .. } => Words {
                points: format!("{} drops out of its equation", self.named(*unknown)),
                bodies: format!("nothing determines {}", self.movable(*unknown)),
            },
            Step::OneAngle {
                unknown, equation, ..
            } => self.words_of_one_angle(*unknown, *equation),
            Step::TwoRotations {
                first,
                second,
                p,
                q,
                ..
            } => self.words_of_two_rotations([*first, *second], [*p, *q], block),
            Step::RotationAndSlide {
                angle, slide, p, ..
            } => {
                let [points, bodies] = self.link_words(*angle, *p);
                let line = self.line_words(*slide);
                Words {
                    points: format!("{points} is perpendicular to {line}"),
                    bodies: format!("{bodies} is perpendicular to {line}"),
                }
            }
            Step::TurningSlide {
                angle, slide, p, u, ..
            } => Words::both(self.words_of_turning_slide(*angle, *slide, [*p, *u])),
            Step::TwoSlides { first, second, .. } => {
                let lines = [*first, *second].map(|slide| {
                    let name = self.line_name(slide);
                    name.unwrap_or_else(|| format!("of {}", self.named(slide)))
                });
                Words::both(format!(
                    "the lines {} and {} are parallel",
                    lines[0], lines[1]
                ))
            }
            Step::Newton { unknowns, .. } => {
                let names: Vec<String> = unknowns.iter().map(|&it| self.named(it)).collect();
                let mut movable: Vec<String> =
                    unknowns.iter().map(|&it| self.movable(it)).collect();
                movable.dedup();
                let stands = match names.len() {
                    1 => "everything before it",
                    _ => "everything before them",
                };
                Words {
                    points: format!(
                        "{} can move although {stands} stands still",
                        enumerated(&names)
                    ),
                    bodies: format!(
                        "{} can move although the drivers stand still",
                        enumerated(&movable)
                    ),
                }
            }
        }
    }

    fn words_of_two_rotations(
        &mut self,
        angles: [usize; 2],
        links: [Vector; 2],
        block: &SolvedBlock,
    ) -> Words {
        let meeting = self.meeting(angles, block);
        // The vectors of the plan are those between the pins, where these are known exactly.
        let points = match (self.triangle(angles, links), &meeting) {
            (Some(triangle), _) => {
                let [a, b] = [0, 1].map(|side| triangle.outer[side].0.name.clone());
                Some([a, triangle.apex.name, b])
            }
            (None, Some([first, second])) => {
                let names = [&first.outer, &first.apex, &second.outer];
                Some(names.map(|end| end.name.clone()))
            }
            (None, None) => None,
        };
        let bodies = match &meeting {
            Some(spans) => [0, 1].map(|side| self.span_words(angles[side], &spans[side])),
            None => angles.map(|angle| self.turning_words(angle)),
        };
        let Some(names) = points else {
            // Two vectors of a closed sum, which need not have a point in common.
            return Words::both(format!("{} and {} are parallel", bodies[0], bodies[1]));
        };
        let [a, apex, b] = names.map(|name| self.script.word(&name));
        Words {
            points: format!("{a}-{apex} and {apex}-{b} are in line"),
            bodies: format!("{} and {} are in line", bodies[0], bodies[1]),
        }
    }

    /// The line begins at p and has the direction u, in the orientation of the angle.
    fn words_of_turning_slide(
        &mut self,
        angle: usize,
        slide: usize,
        [p, u]: [Vector; 2],
    ) -> String {
        let zero = self.graph().zero();
        let measured = self.measured_points(slide);
        // The turning point is where the line begins.
        if p == [zero, zero] {
            let names = measured.map(|marks| marks.map(|mark| self.mark_name(&mark)));
            return match names {
                Some([Some(from), Some(to)]) => {
                    let [from, to] = [from, to].map(|name| self.script.word(&name));
                    format!("{from} and {to} coincide")
                }
                _ => format!(
                    "the points between which {} is measured coincide",
                    self.named(slide)
                ),
            };
        }
        // The vector that the turning line closes lies between the two points of it that are known.
        let mut known: Vec<String> = Vec::new();
        let pins = self.known_pins(angle).into_iter().map(|(pin, _)| pin.name);
        known.extend(pins);
        for mark in measured.into_iter().flatten() {
            if self.is_known(mark.frame.body) {
                known.extend(self.mark_name(&mark));
            }
        }
        known.sort();
        known.dedup();
        let line = self.line_words(slide);
        let offset = {
            let graph = self.graph();
            let [forward, backward] = [graph.multiply(u[0], p[1]), graph.multiply(u[1], p[0])];
            graph.subtract(forward, backward)
        };
        match &known[..] {
            [from, to] => {
                let [from, to] = [from, to].map(|name| self.script.word(name));
                // On a line through both points they can only come together.
                if offset == zero {
                    format!("{from} and {to} coincide")
                } else {
                    format!("{from}-{to} is perpendicular to {line}")
                }
            }
            _ => format!(
                "the line that {} turns is perpendicular to the vector between the two points that {} keeps on it",
                self.named(angle),
                self.named(slide)
            ),
        }
    }

    /// An equation measures a turned vector along one direction; it is stationary where both are parallel.
    fn words_of_one_angle(&mut self, unknown: usize, equation: ExprId) -> Words {
        let arms: Vec<Arm> = self.system.vector_form.arms_of(unknown).cloned().collect();
        let zero = self.graph().zero();
        let mut measured = Vec::new();
        for arm in arms {
            let slopes = arm
                .symbols
                .map(|symbol| self.graph().derivative(equation, symbol));
            if slopes != [zero, zero] {
                measured.push((arm.local, slopes));
            }
        }
        let &[(local, slopes)] = &measured[..] else {
            let (name, words) = (self.named(unknown), self.turning_words(unknown));
            let rest = "is at an end of its range, where its two solutions meet";
            return Words {
                points: format!("{name} {rest}"),
                bodies: format!("{words} {rest}"),
            };
        };
        let [points, bodies] = self.link_words(unknown, local);
        let direction = match slopes.map(|slope| slope == zero) {
            [false, true] => "the x axis".to_string(),
            [true, false] => "the y axis".to_string(),
            _ => {
                let slopes = slopes.map(|slope| self.with_numbers(slope));
                let pair = self.pair_text(slopes);
                format!("the direction {}", self.script.inline(&pair))
            }
        };
        Words {
            points: format!("{points} is parallel to {direction}"),
            bodies: format!("{bodies} is parallel to {direction}"),
        }
    }

    /// `K-L` and `K-L of rod`, or what turns with the angle where the ends have no names.
    fn link_words(&mut self, angle: usize, p: Vector) -> [String; 2] {
        if let Some((link, _, _)) = self.link(angle, p, |_, _| true) {
            let ends = [&link.from.name, &link.to.name].map(|name| self.script.word(name));
            let words = ends.join("-");
            let of = format!("{words} of {}", self.turning_words(angle));
            return [words, of];
        }
        let words = match self.pin_opposite_origin(angle, p) {
            Some((pin, body)) => format!(
                "the line from {} to the origin of {}",
                self.script.word(&pin),
                self.body_words(body)
            ),
            None => {
                let turning = self.turning_words(angle);
                match self.known_pins(angle).first() {
                    Some((pin, _)) => {
                        format!("the link of {turning} from {}", self.script.word(&pin.name))
                    }
                    None => turning,
                }
            }
        };
        [words.clone(), words]
    }

    /// What can move where an unknown is free: a body, a link, a slide, a point of contact.
    fn movable(&self, unknown: usize) -> String {
        let coordinate = self.system.coordinates.get(unknown);
        match coordinate.map(|coordinate| &coordinate.describes) {
            Some(Described::Contact { joint }) => {
                let label = &self.system.mechanism.joints[*joint].label;
                // `roller (2.P, rim)`: the curve is the last operand.
                let operands = label
                    .rsplit_once('(')
                    .and_then(|(_, it)| it.split_once(')'));
                let curve = operands.and_then(|(operands, _)| operands.rsplit_once(", "));
                let curve = curve.map_or(label.as_str(), |(_, curve)| curve);
                format!("the point of contact on {}", self.script.word(curve))
            }
            Some(Described::Pose { .. }) => self.turning_words(unknown),
            None => match self.line_name(unknown) {
                Some(line) if self.measured_points(unknown).is_some() => {
                    format!("the slide along the line {line}")
                }
                _ => self.turning_words(unknown),
            },
        }
    }
}
