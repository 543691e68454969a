//! Describes singular poses in words, by points and by bodies.
//!
//! The words state the equation det = 0 of a solution method: two links are collinear, a link is parallel to its measured line,
//! or a line is perpendicular to the vector that its slide closes. Points are preferred if they have names, since a link is a
//! line between two of its points, whatever its body's shape. A singular pose need not occur in the motion.

use super::ends::{
    Span, line_name, line_words, mark_name, measured_points, movable, span_words, turning_words,
};
use super::known::Known;
use super::phrase::{Phrase, Piece, phrase};
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::pool::{Arm, Pool};
use crate::structure::SolvedBlock;
use crate::system::System;

/// Function that vanishes in the singular poses of a solution method. Angles and displacements are unknowns of the vector form;
/// vectors are constant in the orientation of their angle.
#[derive(Clone, Debug, PartialEq)]
pub enum Singular {
    /// Coefficient of an unknown in its equation.
    Coefficient(usize),
    /// Derivative of an equation in its one angle.
    Slope {
        /// Angle.
        angle: usize,
        /// Equation in terms of rotated vectors.
        equation: ExprId,
    },
    /// Cross product of two rotated links.
    Links {
        /// Angles of the links.
        angles: [usize; 2],
        /// Vectors of the links.
        links: [Vector; 2],
    },
    /// Scalar product of a rotated link and a line.
    LinkAlongLine {
        /// Angle of the link.
        angle: usize,
        /// Displacement along the line.
        slide: usize,
        /// Vector of the link.
        link: Vector,
    },
    /// Component of a known vector along a rotating line.
    TurningLine {
        /// Angle of the line.
        angle: usize,
        /// Displacement along the line.
        slide: usize,
        /// Start of the line.
        start: Vector,
        /// Direction of the line.
        direction: Vector,
    },
    /// Cross product of two lines.
    Lines {
        /// Displacements along the lines.
        slides: [usize; 2],
    },
    /// Determinant of several equations.
    Jacobian(Vec<usize>),
}

/// Description of a singular pose.
#[derive(Clone, Debug)]
pub struct SingularWords {
    /// Description by points: `A-B and B-C are collinear`.
    pub points: Phrase,
    /// Description by bodies: `crank and coupler are collinear`.
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
    /// Describes the poses of this block in which the determinant of a solution method is zero.
    pub fn singular_words(
        &self,
        singular: &Singular,
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> SingularWords {
        match singular {
            Singular::Coefficient(unknown) => SingularWords {
                points: phrase![Piece::Unknown(*unknown), " drops out of its equation"],
                bodies: phrase!["nothing determines ", movable(*unknown, pool, system)],
            },
            Singular::Slope { angle, equation } => self.of_slope(*angle, *equation, pool, system),
            Singular::Links { angles, links } => {
                self.of_links(*angles, *links, block, pool, system)
            }
            Singular::LinkAlongLine { angle, slide, link } => {
                let line = line_words(*slide, pool, system);
                let across = |link| phrase![link, " is perpendicular to ", &line];
                let [points, bodies] = self.link_words(*angle, *link, pool, system).map(across);
                SingularWords { points, bodies }
            }
            Singular::TurningLine {
                angle,
                slide,
                start,
                direction,
            } => {
                let line = [*start, *direction];
                SingularWords::both(self.of_turning_line(*angle, *slide, line, pool, system))
            }
            Singular::Lines { slides } => {
                let [first, second] = slides.map(|slide| {
                    let name = line_name(slide, pool, system);
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
            Singular::Jacobian(unknowns) => self.of_coupled(unknowns, block, pool, system),
        }
    }

    fn of_links(
        &self,
        angles: [usize; 2],
        links: [Vector; 2],
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> SingularWords {
        let meeting = self.meeting(angles, block, pool, system);
        let points = self.corners(angles, links, meeting.as_ref(), pool, system);
        let [one, other] = match &meeting {
            Some(spans) => [0, 1].map(|side| span_words(angles[side], &spans[side], pool, system)),
            None => angles.map(|angle| turning_words(angle, pool, system)),
        };
        let Some(names) = points else {
            // Two vectors of a closed sum need not have a common point.
            return SingularWords::both(phrase![one, " and ", other, " are parallel"]);
        };
        let [a, apex, b] = names.map(|name| Phrase::from(Piece::Name(name)));
        SingularWords {
            points: phrase![a, "-", &apex, " and ", &apex, "-", b, " are collinear"],
            bodies: phrase![one, " and ", other, " are collinear"],
        }
    }

    /// Returns the outer end of the first link, the common point of both, and the outer end of the second. `None` if one of these
    /// has no name.
    fn corners(
        &self,
        angles: [usize; 2],
        links: [Vector; 2],
        meeting: Option<&[Span; 2]>,
        pool: &mut Pool,
        system: &System,
    ) -> Option<[String; 3]> {
        // Vectors of the plan lie between the pins if these are known exactly.
        match (self.triangle(angles, links, pool, system), meeting) {
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

    /// Returns the pins of the loop of two rotated links, from one end to the other; `None` for other solution methods.
    pub fn loop_pins(
        &self,
        singular: &Singular,
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> Option<[String; 3]> {
        let Singular::Links { angles, links } = singular else {
            return None;
        };
        let meeting = self.meeting(*angles, block, pool, system);
        self.corners(*angles, *links, meeting.as_ref(), pool, system)
    }

    /// Describes a line that begins at p with the direction u, in the orientation of the angle.
    fn of_turning_line(
        &self,
        angle: usize,
        slide: usize,
        [p, u]: [Vector; 2],
        pool: &mut Pool,
        system: &System,
    ) -> Phrase {
        let zero = pool.graph.zero();
        let measured = measured_points(slide, pool, system);
        // The line begins at the center of rotation.
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
        // The vector that the rotating line closes lies between the two known points.
        let pins = self.known_pins(angle, system).into_iter();
        let mut known: Vec<String> = pins.map(|(pin, _)| pin.name).collect();
        for mark in measured.into_iter().flatten() {
            if self.is_known(mark.frame.body, system) {
                known.extend(mark_name(&mark, system));
            }
        }
        known.sort();
        known.dedup();
        let line = line_words(slide, pool, system);
        let offset = {
            let graph = &mut pool.graph;
            let [forward, backward] = [graph.multiply(u[0], p[1]), graph.multiply(u[1], p[0])];
            graph.subtract(forward, backward)
        };
        match &known[..] {
            [from, to] => {
                let [from, to] = [from, to].map(|name| Piece::Name(name.clone()));
                // If the line runs through both points, they can only coincide.
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

    /// An equation measures a rotated vector along one direction, and is stationary if both are parallel.
    fn of_slope(
        &self,
        angle: usize,
        equation: ExprId,
        pool: &mut Pool,
        system: &System,
    ) -> SingularWords {
        let arms: Vec<Arm> = pool.arms_of(angle).cloned().collect();
        let zero = pool.graph.zero();
        let mut measured = Vec::new();
        for arm in arms {
            let graph = &mut pool.graph;
            let slopes = arm.symbols.map(|symbol| graph.derivative(equation, symbol));
            if slopes != [zero, zero] {
                measured.push((arm.local, slopes));
            }
        }
        // If slopes contain the angle itself or functions of other angles, a fixed direction does not exist.
        let describes = system.vector_form.unknowns[angle].describes;
        let is_angle = describes
            .body()
            .is_some_and(|it| system.mechanism.bodies[it].is_angle());
        let mentions_angle = |slope: &ExprId| {
            let graph = &pool.graph;
            pool.mentions(*slope, angle) || is_angle && !graph.is_fixed(*slope)
        };
        if measured
            .iter()
            .any(|(_, slopes)| slopes.iter().any(mentions_angle))
        {
            measured.clear();
        }
        let &[(local, slopes)] = &measured[..] else {
            let rest = " is at an end of its range, where its two solutions meet";
            return SingularWords {
                points: phrase![Piece::Unknown(angle), rest],
                bodies: phrase![turning_words(angle, pool, system), rest],
            };
        };
        let direction = match slopes.map(|slope| slope == zero) {
            [false, true] => Phrase::from("the x axis"),
            [true, false] => Phrase::from("the y axis"),
            _ => phrase!["the direction ", Piece::Pair(slopes)],
        };
        let along = |link| phrase![link, " is parallel to ", &direction];
        let [points, bodies] = self.link_words(angle, local, pool, system).map(along);
        SingularWords { points, bodies }
    }

    /// Returns `K-L` and `K-L of rod`, or the name of the body or link if its ends have no names.
    fn link_words(&self, angle: usize, p: Vector, pool: &mut Pool, system: &System) -> [Phrase; 2] {
        if let Some(link) = self.link(angle, p, |_, _| true, pool, system) {
            let [from, to] = [link.from, link.to].map(|pin| Piece::Name(pin.name));
            let words = phrase![from, "-", to];
            let of = phrase![&words, " of ", turning_words(angle, pool, system)];
            return [words, of];
        }
        let words = match self.pin_opposite_origin(angle, p, pool, system) {
            Some((pin, body)) => phrase![
                "the line from ",
                Piece::Name(pin),
                " to the origin of ",
                super::ends::body_words(body, system)
            ],
            None => {
                let turning = turning_words(angle, pool, system);
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
