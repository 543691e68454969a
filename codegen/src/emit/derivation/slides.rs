//! Steps with displacements: a circle and a line, a turning line through a point, two lines.

use super::document::Equation;
use super::writer::Writer;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;

/// What the velocities of a step are found from.
#[derive(Clone, Copy, Debug)]
struct Motion {
    unknowns: [usize; 2],
    /// The loop written out, zero.
    whole: Vector,
    /// What the loop's rate holds as factors of the two rates.
    columns: [Vector; 2],
    /// Their determinant.
    determinant: ExprId,
}

impl Writer<'_> {
    /// R(φ) p + ℓ d + c = 0: a circle about a known point meets a line of known direction.
    pub(super) fn rotation_and_slide(
        &mut self,
        [angle, slide]: [usize; 2],
        p: Vector,
        direction: Vector,
        closure: Vector,
    ) -> String {
        let link = self.link(angle, p, |_, _| true);
        let source = match &link {
            Some((link, known, _)) => {
                let (center, end) = (link.from.name.clone(), link.to.name.clone());
                let place = self.whereabouts(known);
                self.sentence(&format!(
                    "{center} is known, {place}. Sought is {end} on a circle about {center} and on a line of known direction."
                ));
                format!("from the circle of {end} about {center} and a line")
            }
            None => "from a circle and a line".to_string(),
        };
        let whole = self.slide_loop([angle, slide], p, direction, closure);
        self.sentence("with the part of the known vector that lies across the line,");
        let mut equations = Vec::new();
        let d = self.named_vector("d", direction, &mut equations);
        let c = self.named_vector("c", closure, &mut equations);
        let offset = self.cross(c, d);
        let (n, k) = (self.name("n"), self.name("k"));
        equations.push(self.equation(n, offset, self.script.inline(&self.script.cross("c", "d"))));
        let [p_square, d_square] = [p, d].map(|vector| self.dot(vector, vector));
        let scale = self.graph().multiply(p_square, d_square);
        let positive = {
            let turned = self.turn(angle, p).map(|part| self.drawn(part));
            let line = direction.map(|part| self.drawn(part));
            turned[0] * line[0] + turned[1] * line[1] >= 0.0
        };
        let root = self.root(scale, n, positive);
        equations.push(self.equation(k, root, "with the sign of the drawing"));
        let w = self.components("w");
        for axis in [0, 1] {
            let graph = self.graph();
            let along = graph.multiply(k, d[axis]);
            let across = graph.multiply(n, d[1 - axis]);
            let sum = if axis == 0 {
                graph.subtract(along, across)
            } else {
                graph.add(along, across)
            };
            let value = graph.divide(sum, d_square);
            equations.push(self.equation(w[axis], value, ""));
        }
        equations.push(self.angle_equation(angle, p, w, ""));
        let along = self.dot(c, d);
        let length = {
            let graph = self.graph();
            let sum = graph.add(along, k);
            let ratio = graph.divide(sum, d_square);
            graph.negate(ratio)
        };
        let variable = self.variable(slide);
        equations.push(self.equation(variable, length, ""));
        self.equations(equations);
        let k_name = self.script.inline("k");
        self.sentence(&format!(
            "the sign of {k_name} is the assembly mode: whether the link points along the line or against it."
        ));
        let graph = self.graph();
        let turned = [graph.negate(w[1]), w[0]];
        let determinant = graph.negate(k);
        self.slide_motion(Motion {
            unknowns: [angle, slide],
            whole,
            columns: [turned, d],
            determinant,
        });
        source
    }

    /// The loop R(φ) p + ℓ d + c = 0 as vectors and by components; returns it written out.
    fn slide_loop(
        &mut self,
        [angle, slide]: [usize; 2],
        p: Vector,
        direction: Vector,
        closure: Vector,
    ) -> Vector {
        let turned = self.turn(angle, p);
        let length = self.variable(slide);
        let whole = [0, 1].map(|axis| {
            let slid = self.graph().multiply(length, direction[axis]);
            let sum = self.graph().sum(&[turned[axis], slid, closure[axis]]);
            self.with_numbers(sum)
        });
        let name = self.unknown(angle);
        let times = self.script.times();
        let line = self.vector_sum(direction);
        let closing = self.vector_sum(closure);
        let left = format!(
            "{} + {}{times}{line} + {closing}",
            self.turned_text(&name, p),
            self.unknown(slide)
        );
        self.loop_text(left, whole);
        whole
    }

    fn loop_text(&mut self, vectors: String, whole: Vector) {
        self.sentence("the loop closes, as vectors and by components:");
        let mut equations = vec![Equation {
            left: vectors,
            right: "0".to_string(),
            note: String::new(),
        }];
        for axis in [0, 1] {
            equations.push(self.vanishing(whole[axis], ["x", "y"][axis]));
        }
        self.equations(equations);
    }

    /// ±√(scale − n²).
    fn root(&mut self, scale: ExprId, n: ExprId, positive: bool) -> ExprId {
        let square = self.square(n);
        let graph = self.graph();
        let excess = graph.subtract(scale, square);
        let root = graph.sqrt(excess);
        if positive { root } else { graph.negate(root) }
    }

    /// R(φ) (p + ℓ u) + c = 0: a line that turns passes through a known point.
    pub(super) fn turning_slide(
        &mut self,
        [angle, slide]: [usize; 2],
        p: Vector,
        u: Vector,
        closure: Vector,
    ) -> String {
        let (m_name, source) = self.open_turning_line(angle, closure);
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
        self.sentence("the loop closes, as vectors and by components:");
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
        self.sentence(
            "both sides have the same length, and the line keeps its distance from the pin it turns about; so the part along the line is \
             a square root (Pythagoras):",
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
        self.sentence(&format!(
            "the sign of {k_name} is the assembly mode: on which side of its foot the point lies on the line."
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

    /// The two known points that the turning body passes; returns the name of the known vector and the heading.
    fn open_turning_line(&mut self, angle: usize, closure: Vector) -> (String, String) {
        let known = self.known_pins(angle);
        let [(first, first_end), (second, second_end)] = &known[..] else {
            return ("m".to_string(), "from a turning line".to_string());
        };
        let places = [first_end, second_end].map(|mark| self.whereabouts(mark));
        self.sentence(&format!(
            "{}, {}, and {}, {}, are known. Sought is the direction of the line that slides along {} while it turns about {}.",
            first.name, places[0], second.name, places[1], second.name, first.name
        ));
        let ends = [first_end, second_end].map(|mark| self.drawn_position(*mark));
        let drawn = closure.map(|part| -self.drawn(part));
        let along = drawn[0] * (ends[1][0] - ends[0][0]) + drawn[1] * (ends[1][1] - ends[0][1]);
        let name = if along >= 0.0 {
            format!("{}{}", first.name, second.name)
        } else {
            format!("{}{}", second.name, first.name)
        };
        let length = self.script.inline(&self.script.length(&name));
        (
            name,
            format!(
                "from the line that passes {} and {} with {length} known",
                first.name, second.name
            ),
        )
    }

    /// ℓ_a d_a + ℓ_b d_b + c = 0: two lines meet.
    pub(super) fn two_slides(
        &mut self,
        unknowns: [usize; 2],
        directions: [Vector; 2],
        closure: Vector,
    ) -> String {
        let lengths = unknowns.map(|unknown| self.variable(unknown));
        let whole = [0, 1].map(|axis| {
            let slid =
                [0, 1].map(|side| self.graph().multiply(lengths[side], directions[side][axis]));
            let sum = self.graph().sum(&[slid[0], slid[1], closure[axis]]);
            self.with_numbers(sum)
        });
        let times = self.script.times();
        let terms = [0, 1].map(|side| {
            let line = self.vector_sum(directions[side]);
            format!("{}{times}{line}", self.unknown(unknowns[side]))
        });
        let closing = self.vector_sum(closure);
        self.loop_text(format!("{} + {} + {closing}", terms[0], terms[1]), whole);
        self.sentence("two lines of known direction meet; by Cramer's rule");
        let mut equations = Vec::new();
        let [d, e] = [("d", directions[0]), ("e", directions[1])]
            .map(|(name, vector)| self.named_vector(name, vector, &mut equations));
        let c = self.named_vector("c", closure, &mut equations);
        let value = self.cross(d, e);
        let determinant = self.name("D");
        equations.push(self.equation(
            determinant,
            value,
            self.script.inline(&self.script.cross("d", "e")),
        ));
        let numerators = [self.cross(e, c), self.cross(c, d)];
        for side in [0, 1] {
            let value = self.graph().divide(numerators[side], determinant);
            equations.push(self.equation(lengths[side], value, ""));
        }
        self.equations(equations);
        self.slide_motion(Motion {
            unknowns,
            whole,
            columns: [d, e],
            determinant,
        });
        "from two lines".to_string()
    }

    /// Velocity and acceleration by Cramer's rule.
    fn slide_motion(&mut self, motion: Motion) {
        let determinant = self.formula(motion.determinant);
        let [v, a] = ["v", "a"].map(|name| self.script.inline(&self.script.vector(name)));
        let [first, second] = motion.unknowns.map(|unknown| self.rate_of(unknown));
        self.sentence(&format!(
            "velocity: the loop differentiated is a linear system for {} and {} with the determinant {}; {v} is what the loop does \
             while both rest.",
            self.script.inline(&self.formula(first)),
            self.script.inline(&self.formula(second)),
            self.script.inline(&determinant),
        ));
        let rates = motion.whole.map(|part| self.derivative(part));
        let drift = rates.map(|part| self.without(part, &motion.unknowns));
        let mut equations = Vec::new();
        let name = self.components("v");
        for axis in [0, 1] {
            equations.push(self.equation(name[axis], drift[axis], ""));
        }
        // [d, e] (u, w) = −v: u = (v × e)/(e × d), by Cramer's rule.
        let [d, e] = motion.columns;
        let numerators = [self.cross(e, name), self.cross(name, d)];
        for (side, left) in [first, second].into_iter().enumerate() {
            let value = self.graph().divide(numerators[side], motion.determinant);
            equations.push(self.equation(left, value, ""));
        }
        self.equations(equations);
        self.sentence(&format!(
            "acceleration: the same system with {a} in the place of {v}; {a} is the second rate of the loop while both rates stay as \
             they are:"
        ));
        let mut equations = Vec::new();
        let name = self.components("a");
        let symbols = motion
            .unknowns
            .map(|unknown| self.system.vector_form.unknowns[unknown].acceleration);
        for axis in [0, 1] {
            let second = self.derivative(rates[axis]);
            let zero = self.graph().zero();
            let steady = self
                .graph()
                .substitute(second, &symbols.map(|symbol| (symbol, zero)));
            equations.push(self.equation(name[axis], steady, ""));
        }
        self.equations(equations);
    }
}
