//! R(φ) (p + ℓ u) + c = 0: a line that turns passes through a known point.
//!
//! With a = p · u and b = u × p the known vector m = −c has the length √((a + ℓ)² + b²), so k = a + ℓ = ±√(m² − b²).

use super::document::Equation;
use super::slides::Motion;
use super::writer::Writer;
use crate::joint::geometry::Vector;

/// The known vector that a turning line spans.
#[derive(Clone, Debug)]
struct Line {
    /// What it is called.
    name: String,
    /// What the heading says.
    source: String,
    /// Whether the plan's vector leads the same way.
    forward: bool,
}

impl Writer<'_> {
    /// R(φ) (p + ℓ u) + c = 0: a line that turns passes through a known point.
    pub(super) fn turning_slide(
        &mut self,
        [angle, slide]: [usize; 2],
        p: Vector,
        u: Vector,
        closure: Vector,
    ) -> String {
        let opened = self.open_turning_line([angle, slide], closure);
        let [p, u, closure] = [p, u, closure].map(|vector| {
            if opened.forward {
                vector
            } else {
                vector.map(|part| self.graph().negate(part))
            }
        });
        let Line {
            name: m_name,
            source,
            ..
        } = opened;
        let (name, length) = (self.unknown(angle), self.variable(slide));
        let local = [0, 1].map(|axis| {
            let slid = self.graph().multiply(length, u[axis]);
            self.graph().add(p[axis], slid)
        });
        let minus = closure.map(|part| self.graph().negate(part));
        let turned = self.turn(angle, local);
        let whole = [0, 1].map(|axis| {
            let sum = self.graph().add(turned[axis], closure[axis]);
            self.with_numbers(sum)
        });
        let text = self.turned_text(&name, local);
        let closing = self.vector_sum(minus);
        self.paragraph("The loop closes, as vectors and by components:");
        let mut equations = vec![Equation {
            left: text,
            right: closing,
            note: self.script.inline(&self.script.vector(&m_name)),
        }];
        for axis in [0, 1] {
            equations.push(self.vanishing(whole[axis], ["x", "y"][axis]));
        }
        self.equations(equations);
        let (a, b) = (self.dot(p, u), self.cross(u, p));
        self.paragraph(
            "Both sides have the same length, and what lies across the turning line does not change; so the part k along it is a \
             square root (Pythagoras):",
        );
        let mut equations = Vec::new();
        let m = self.named_vector(&m_name, minus, &mut equations);
        let m_square = self.dot(m, m);
        let k = self.name("k");
        let positive = {
            let sum = self.graph().add(a, length);
            self.drawn(sum) >= 0.0
        };
        let root = self.root(m_square, b, positive);
        equations.push(self.equation(k, root, "with the sign of the drawing"));
        let value = self.graph().subtract(k, a);
        equations.push(self.equation(length, value, ""));
        // p + ℓ u = k u + b u⊥.
        let graph = self.graph();
        let [kx, ky] = u.map(|part| graph.multiply(k, part));
        let [bx, by] = [graph.multiply(b, u[1]), graph.multiply(b, u[0])];
        let fixed = [graph.subtract(kx, bx), graph.add(ky, by)];
        equations.push(self.angle_equation(angle, fixed, m, ""));
        self.equations(equations);
        let k_name = self.script.inline("k");
        self.paragraph(format!(
            "The sign of {k_name} is the assembly mode: on which side of its foot the point lies on the line."
        ));
        let line = self.turn(angle, u);
        let graph = self.graph();
        let across = [graph.negate(m[1]), m[0]];
        let determinant = graph.negate(k);
        self.slide_motion(Motion {
            unknowns: [angle, slide],
            whole,
            columns: [across, line],
            determinant,
        });
        source
    }

    /// The two known points between which the turning line lies.
    fn open_turning_line(&mut self, unknowns: [usize; 2], closure: Vector) -> Line {
        let known = self.known_pins(unknowns[0]);
        let [(first, first_end), (second, second_end)] = &known[..] else {
            return Line {
                name: "m".to_string(),
                source: "from a line that turns and slides".to_string(),
                forward: true,
            };
        };
        let places = [first_end, second_end].map(|mark| self.whereabouts(mark));
        let [a, b] = [first, second].map(|pin| self.script.word(&pin.name));
        let [turning, slide] = unknowns.map(|unknown| self.named(unknown));
        self.paragraph(format!(
            "{a}, {}, and {b}, {}, are known. Between them lies a line that turns by {turning} and on which {slide} is the part in \
             use.",
            places[0], places[1]
        ));
        let ends = [first_end, second_end].map(|mark| self.drawn_position(*mark));
        let drawn = closure.map(|part| -self.drawn(part));
        let along = drawn[0] * (ends[1][0] - ends[0][0]) + drawn[1] * (ends[1][1] - ends[0][1]);
        let name = format!("{}{}", first.name, second.name);
        let length = self.script.inline(&self.script.length(&name));
        Line {
            name,
            source: format!("from the sliding line between {a} and {b} with {length} known"),
            forward: along >= 0.0,
        }
    }
}
