//! What a form says of its singular poses → words, said of points and said of bodies.
//!
//! The words are the equation det = 0 of the form: two links are in line, a link is parallel to what it is measured along, a line
//! is perpendicular to the vector that its slide closes. Points are said where the description names them, since a link is a line
//! between two of its points whatever the shape of its body. Which of these poses a motion comes to is not known here.

use super::ends::{
    Span, line_name, line_words, mark_name, measured_points, movable, span_words, turning_words,
};
use super::known::Known;
use super::phrase::{Phrase, Piece, phrase};
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::structure::SolvedBlock;
use crate::system::{Arm, System};

/// What vanishes where a form is singular. Angles and displacements are unknowns of the vector form; vectors are constant in the
/// orientation of their angle.
#[derive(Clone, Debug, PartialEq)]
pub enum Singular {
    /// The coefficient of an unknown in its equation.
    Coefficient(usize),
    /// The derivative of an equation in its one angle.
    Slope {
        /// The angle.
        angle: usize,
        /// The equation, in arms.
        equation: ExprId,
    },
    /// The cross product of two turned links.
    Links {
        /// What turns them.
        angles: [usize; 2],
        /// The links.
        links: [Vector; 2],
    },
    /// The scalar product of a turned link and a line.
    LinkAlongLine {
        /// What turns the link.
        angle: usize,
        /// What is measured along the line.
        slide: usize,
        /// The link.
        link: Vector,
    },
    /// The part of a known vector along a line that turns.
    TurningLine {
        /// What turns the line.
        angle: usize,
        /// What is measured along it.
        slide: usize,
        /// Where it begins.
        start: Vector,
        /// Its direction.
        direction: Vector,
    },
    /// The cross product of two lines.
    Lines {
        /// What is measured along them.
        slides: [usize; 2],
    },
    /// The determinant of several equations.
    Jacobian(Vec<usize>),
}

/// What is said of a singular pose.
#[derive(Clone, Debug)]
pub struct SingularWords {
    /// `A-B and B-C are in line`.
    pub points: Phrase,
    /// `crank and coupler are in line`.
    pub bodies: Phrase,
}

impl SingularWords {
    pub(super) fn both(sentence: Phrase) -> SingularWords {
        SingularWords {
            points: sentence.clone(),
            bodies: sentence,
        }
    }
}

impl Known {
    /// What a form of this block is like where its determinant is zero.
    pub fn singular_words(
        &self,
        singular: &Singular,
        block: &SolvedBlock,
        system: &mut System,
    ) -> SingularWords {
        match singular {
            Singular::Coefficient(unknown) => SingularWords {
                points: phrase![Piece::Unknown(*unknown), " drops out of its equation"],
                bodies: phrase!["nothing determines ", movable(*unknown, system)],
            },
            Singular::Slope { angle, equation } => self.of_slope(*angle, *equation, system),
            Singular::Links { angles, links } => self.of_links(*angles, *links, block, system),
            Singular::LinkAlongLine { angle, slide, link } => {
                let line = line_words(*slide, system);
                let across = |link| phrase![link, " is perpendicular to ", &line];
                let [points, bodies] = self.link_words(*angle, *link, system).map(across);
                SingularWords { points, bodies }
            }
            Singular::TurningLine {
                angle,
                slide,
                start,
                direction,
            } => {
                let line = [*start, *direction];
                SingularWords::both(self.of_turning_line(*angle, *slide, line, system))
            }
            Singular::Lines { slides } => {
                let [first, second] = slides.map(|slide| {
                    let name = line_name(slide, system);
                    name.unwrap_or_else(|| phrase!["of ", Piece::Unknown(slide)])
                });
                SingularWords::both(phrase![
                    "the lines ",
                    first,
                    " and ",
                    second,
                    " are parallel"
                ])
            }
            Singular::Jacobian(unknowns) => self.of_coupled(unknowns, block, system),
        }
    }

    fn of_links(
        &self,
        angles: [usize; 2],
        links: [Vector; 2],
        block: &SolvedBlock,
        system: &mut System,
    ) -> SingularWords {
        let meeting = self.meeting(angles, block, system);
        let points = self.corners(angles, links, meeting.as_ref(), system);
        let [one, other] = match &meeting {
            Some(spans) => [0, 1].map(|side| span_words(angles[side], &spans[side], system)),
            None => angles.map(|angle| turning_words(angle, system)),
        };
        let Some(names) = points else {
            // Two vectors of a closed sum, which need not have a point in common.
            return SingularWords::both(phrase![one, " and ", other, " are parallel"]);
        };
        let [a, apex, b] = names.map(|name| Phrase::from(Piece::Name(name)));
        SingularWords {
            points: phrase![a, "-", &apex, " and ", &apex, "-", b, " are in line"],
            bodies: phrase![one, " and ", other, " are in line"],
        }
    }

    /// The outer end of the first link, the point in which both meet, and the outer end of the second one; `None` where one of
    /// these has no name.
    fn corners(
        &self,
        angles: [usize; 2],
        links: [Vector; 2],
        meeting: Option<&[Span; 2]>,
        system: &mut System,
    ) -> Option<[String; 3]> {
        // The vectors of the plan are those between the pins, where these are known exactly.
        match (self.triangle(angles, links, system), meeting) {
            (Some(triangle), _) => {
                let [a, b] = [0, 1].map(|side| triangle.outer[side].0.name.clone());
                Some([a, triangle.apex.name, b])
            }
            (None, Some([first, second])) => {
                let names = [&first.outer, &first.apex, &second.outer];
                Some(names.map(|end| end.name.clone()))
            }
            (None, None) => None,
        }
    }

    /// Names of the pins of the loop that two turned links close, from one end to the other; `None` for other forms.
    pub fn loop_pins(
        &self,
        singular: &Singular,
        block: &SolvedBlock,
        system: &mut System,
    ) -> Option<[String; 3]> {
        let Singular::Links { angles, links } = singular else {
            return None;
        };
        let meeting = self.meeting(*angles, block, system);
        self.corners(*angles, *links, meeting.as_ref(), system)
    }

    /// The line begins at p and has the direction u, in the orientation of the angle.
    fn of_turning_line(
        &self,
        angle: usize,
        slide: usize,
        [p, u]: [Vector; 2],
        system: &mut System,
    ) -> Phrase {
        let zero = system.mechanism.graph.zero();
        let measured = measured_points(slide, system);
        // The turning point is where the line begins.
        if p == [zero, zero] {
            let names = measured.map(|marks| marks.map(|mark| mark_name(&mark, system)));
            return match names {
                Some([Some(from), Some(to)]) => {
                    phrase![Piece::Name(from), " and ", Piece::Name(to), " coincide"]
                }
                _ => phrase![
                    "the points between which ",
                    Piece::Unknown(slide),
                    " is measured coincide"
                ],
            };
        }
        // The vector that the turning line closes lies between the two points of it that are known.
        let pins = self.known_pins(angle, system).into_iter();
        let mut known: Vec<String> = pins.map(|(pin, _)| pin.name).collect();
        for mark in measured.into_iter().flatten() {
            if self.is_known(mark.frame.body, system) {
                known.extend(mark_name(&mark, system));
            }
        }
        known.sort();
        known.dedup();
        let line = line_words(slide, system);
        let offset = {
            let graph = &mut system.mechanism.graph;
            let [forward, backward] = [graph.multiply(u[0], p[1]), graph.multiply(u[1], p[0])];
            graph.subtract(forward, backward)
        };
        match &known[..] {
            [from, to] => {
                let [from, to] = [from, to].map(|name| Piece::Name(name.clone()));
                // On a line through both points they can only come together.
                match offset == zero {
                    true => phrase![from, " and ", to, " coincide"],
                    false => phrase![from, "-", to, " is perpendicular to ", line],
                }
            }
            _ => phrase![
                line,
                " is perpendicular to the vector between the two points that are kept on it"
            ],
        }
    }

    /// An equation measures a turned vector along one direction; it is stationary where both are parallel.
    fn of_slope(&self, angle: usize, equation: ExprId, system: &mut System) -> SingularWords {
        let arms: Vec<Arm> = system.vector_form.arms_of(angle).cloned().collect();
        let zero = system.mechanism.graph.zero();
        let mut measured = Vec::new();
        for arm in arms {
            let graph = &mut system.mechanism.graph;
            let slopes = arm.symbols.map(|symbol| graph.derivative(equation, symbol));
            if slopes != [zero, zero] {
                measured.push((arm.local, slopes));
            }
        }
        // Where the angle itself, or a formula of others, is in the slopes there is no direction to speak of.
        let describes = system.vector_form.unknowns[angle].describes;
        let is_angle = describes
            .body()
            .is_some_and(|it| system.mechanism.bodies[it].is_angle());
        let own = |slope: &ExprId| {
            let graph = &system.mechanism.graph;
            system.vector_form.mentions(*slope, angle, graph) || is_angle && !graph.is_fixed(*slope)
        };
        if measured.iter().any(|(_, slopes)| slopes.iter().any(own)) {
            measured.clear();
        }
        let &[(local, slopes)] = &measured[..] else {
            let rest = " is at an end of its range, where its two solutions meet";
            return SingularWords {
                points: phrase![Piece::Unknown(angle), rest],
                bodies: phrase![turning_words(angle, system), rest],
            };
        };
        let direction = match slopes.map(|slope| slope == zero) {
            [false, true] => Phrase::from("the x axis"),
            [true, false] => Phrase::from("the y axis"),
            _ => phrase!["the direction ", Piece::Pair(slopes)],
        };
        let along = |link| phrase![link, " is parallel to ", &direction];
        let [points, bodies] = self.link_words(angle, local, system).map(along);
        SingularWords { points, bodies }
    }

    /// `K-L` and `K-L of rod`, or what turns with the angle where the ends have no names.
    fn link_words(&self, angle: usize, p: Vector, system: &mut System) -> [Phrase; 2] {
        if let Some(link) = self.link(angle, p, |_, _| true, system) {
            let [from, to] = [link.from, link.to].map(|pin| Piece::Name(pin.name));
            let words = phrase![from, "-", to];
            let of = phrase![&words, " of ", turning_words(angle, system)];
            return [words, of];
        }
        let words = match self.pin_opposite_origin(angle, p, system) {
            Some((pin, body)) => phrase![
                "the line from ",
                Piece::Name(pin),
                " to the origin of ",
                super::ends::body_words(body, system)
            ],
            None => {
                let turning = turning_words(angle, system);
                match self.known_pins(angle, system).into_iter().next() {
                    Some((pin, _)) => {
                        phrase!["the link of ", turning, " from ", Piece::Name(pin.name)]
                    }
                    None => turning,
                }
            }
        };
        [words.clone(), words]
    }
}
