//! R(φ_a) p + R(φ_b) q + c = 0: two links between two known points, where two circles meet.
//!
//! With the known vector d = −c from the beginning of p to the end of q, and k = R(φ_a) p · R(φ_b) q, the law of cosines says
//! 2 k = d² − p² − q²; the links span twice the area h = √(p² q² − k²), and R(φ_a) p = ((p² + k) d ± h d⊥)/d². The determinant
//! of the velocities is R(φ_a) p × R(φ_b) q = ∓h.

use super::document::Equation;
use super::triangle::{Names, Triangle};
use super::writer::Writer;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;

impl Writer<'_> {
    /// Writes the step and returns what the heading says that it is solved from.
    pub(super) fn two_rotations(
        &mut self,
        angles: [usize; 2],
        links: [Vector; 2],
        closure: Vector,
    ) -> String {
        let triangle = self.triangle(angles, links);
        let backward = triangle.as_ref().is_some_and(|found| !found.forward);
        let [p, q, closure] = [links[0], links[1], closure].map(|vector| {
            if backward {
                vector.map(|part| self.graph().negate(part))
            } else {
                vector
            }
        });
        let (names, source) = match &triangle {
            Some(found) => self.open_triangle(found, [p, q]),
            None => self.open_loop(),
        };
        self.loop_equations(angles, [p, q], closure, &names, triangle.as_ref());
        let (turned, twice_area) =
            self.solution(angles, [p, q], closure, &names, triangle.as_ref());
        self.dyad_motion(angles, [p, q], closure, &names, turned, twice_area);
        source
    }

    /// The loop as vectors and by components.
    fn loop_equations(
        &mut self,
        angles: [usize; 2],
        links: [Vector; 2],
        closure: Vector,
        names: &Names,
        triangle: Option<&Triangle>,
    ) {
        self.paragraph(format!(
            "The loop {}:",
            match triangle {
                Some(found) => format!(
                    "{}-{}-{} closes, as vectors and by components",
                    self.script.word(&found.outer[0].0.name),
                    self.script.word(&found.apex.name),
                    self.script.word(&found.outer[1].0.name)
                ),
                None => "closes, as vectors and by components".to_string(),
            }
        ));
        let turned = [0, 1].map(|side| {
            let angle = self.unknown(angles[side]);
            self.turned_text(&angle, links[side])
        });
        let [first, second] = [0, 1].map(|side| self.script.vector(&names.links[side]));
        let base = self.script.vector(&names.base);
        let closing = closure.map(|part| self.graph().negate(part));
        let closing = self.vector_sum(closing);
        let mut equations = vec![
            Equation {
                left: format!("{first} + {second}"),
                right: base.clone(),
                note: String::new(),
            },
            Equation {
                left: format!("{} + {}", turned[0], turned[1]),
                right: closing,
                note: String::new(),
            },
        ];
        let [a, b] = [0, 1].map(|side| self.turn(angles[side], links[side]));
        for axis in [0, 1] {
            let graph = self.graph();
            let sum = graph.add(a[axis], b[axis]);
            let minus = graph.negate(closure[axis]);
            let right = self.with_numbers(minus);
            equations.push(self.equation(sum, right, ["x", "y"][axis]));
        }
        self.equations(equations);
    }

    /// The law of cosines, the links and the angles. Returns the turned links and twice the area with its sign.
    fn solution(
        &mut self,
        angles: [usize; 2],
        links: [Vector; 2],
        closure: Vector,
        names: &Names,
        triangle: Option<&Triangle>,
    ) -> ([Vector; 2], ExprId) {
        let minus = closure.map(|part| self.graph().negate(part));
        let positive = {
            // d × w, with the link's angle of the drawing.
            let turned = self.turn(angles[0], links[0]).map(|part| self.drawn(part));
            let base = minus.map(|part| self.drawn(part));
            base[0] * turned[1] - base[1] * turned[0] >= 0.0
        };
        let side = if positive { "left" } else { "right" };
        self.paragraph(match triangle {
            Some(found) => format!(
                "Two circles about {a} and {b} meet in two points. In the drawing {apex} lies to the {side} of the line from {a} to \
                 {b}, and this assembly mode is kept: it is the sign of {h} below. By the law of cosines:",
                a = self.script.word(&found.outer[0].0.name),
                b = self.script.word(&found.outer[1].0.name),
                apex = self.script.word(&found.apex.name),
                h = self.script.inline("h"),
            ),
            None => format!(
                "The equations have two solutions. In the drawing the first link points to the {side} of the sum of both, and \
                 this assembly mode is kept: it is the sign of {} below. By the law of cosines:",
                self.script.inline("h"),
            ),
        });
        let mut equations = Vec::new();
        let base = self.named_vector(&names.base, minus, &mut equations);
        let base_square = self.dot(base, base);
        let size = format!("|{}|", names.base);
        let squares = [base_square]
            .into_iter()
            .chain(links.map(|link| self.dot(link, link)));
        let squares: Vec<ExprId> = squares.collect();
        let base_value = if self.graph().is_fixed(base_square) {
            base_square
        } else {
            let name = self.name(&size);
            let square = self.square(name);
            equations.push(self.equation(square, base_square, ""));
            square
        };
        let [p_square, q_square] = [squares[1], squares[2]];
        let sizes = self.graph().add(p_square, q_square);
        let twice = self.graph().subtract(base_value, sizes);
        let value = self.half(twice);
        let (k, h) = (self.name("k"), self.name("h"));
        let product = self.script.dot(&names.links[0], &names.links[1]);
        let minus = self.script.minus();
        let [d, p, q] = [&names.base, &names.links[0], &names.links[1]]
            .map(|name| self.script.square(&self.script.length(name)));
        equations.push(Equation {
            left: self.formula(k),
            right: format!("({d} {minus} {p} {minus} {q})/2"),
            note: self.script.inline(&product),
        });
        equations.push(self.equation(k, value, ""));
        let scale = self.graph().multiply(p_square, q_square);
        let k_square = self.square(k);
        let excess = self.graph().subtract(scale, k_square);
        let root = self.graph().sqrt(excess);
        equations.push(self.equation(h, root, "twice the area"));
        let signed = if positive { h } else { self.graph().negate(h) };
        let first = self.components(&names.links[0]);
        equations.push(Equation {
            left: self.script.vector(&names.links[0]),
            right: format!(
                "(({p} + {}){times}{} {sign} {}{times}{})/{d}",
                self.formula(k),
                self.script.vector(&names.base),
                self.formula(h),
                self.script.perpendicular(&names.base),
                times = self.script.times(),
                sign = if positive { "+" } else { minus },
            ),
            note: String::new(),
        });
        let forward = self.graph().add(p_square, k);
        for axis in [0, 1] {
            let graph = self.graph();
            let along = graph.multiply(forward, base[axis]);
            let across = graph.multiply(signed, base[1 - axis]);
            let sum = if axis == 0 {
                graph.subtract(along, across)
            } else {
                graph.add(along, across)
            };
            let value = graph.divide(sum, base_value);
            equations.push(self.equation(first[axis], value, ""));
        }
        let second = self.components(&names.links[1]);
        for axis in [0, 1] {
            let value = self.graph().subtract(base[axis], first[axis]);
            equations.push(self.equation(second[axis], value, ""));
        }
        for (side, turned) in [first, second].into_iter().enumerate() {
            let angle = self.unknown(angles[side]);
            let link = self.script.vector(&names.links[side]);
            let note = format!("{link} = {}", self.turned_text(&angle, links[side]));
            let note = self.script.inline(&note);
            equations.push(self.angle_equation(angles[side], links[side], turned, &note));
        }
        self.equations(equations);
        // The determinant w_a × w_b is minus d × w_a.
        let area = self.graph().negate(signed);
        ([first, second], area)
    }
}
