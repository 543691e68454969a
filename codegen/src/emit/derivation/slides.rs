//! Steps with displacements along known directions: a circle and a line, two lines.

use super::document::Equation;
use super::writer::Writer;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;

/// What the velocities of a step are found from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// What is found.
    pub unknowns: [usize; 2],
    /// The loop written out, zero.
    pub whole: Vector,
    /// What the loop's rate holds as factors of the two rates.
    pub columns: [Vector; 2],
    /// Their determinant.
    pub determinant: ExprId,
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
                let [center, end] = [&link.from, &link.to].map(|pin| self.script.word(&pin.name));
                let place = self.whereabouts(known);
                self.paragraph(format!(
                    "{center}, {place}, is known. Sought is {end} on a circle about {center} and on a line of known direction."
                ));
                format!("from the circle of {end} about {center} and a line")
            }
            None => "from a circle and a line".to_string(),
        };
        let whole = self.slide_loop([angle, slide], p, direction, closure);
        self.paragraph("The part of the known vector across the line is that of the link too; so the part along the line is a square root (Pythagoras):");
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
        self.paragraph(format!(
            "The sign of {k_name} is the assembly mode: whether the link points along the line or against it."
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
        let tail = [0, 1].map(|axis| {
            let graph = self.graph();
            let slid = graph.multiply(length, direction[axis]);
            graph.add(slid, closure[axis])
        });
        let name = self.unknown(angle);
        let link = self.turned_text(&name, p);
        let tail = self.vector_sum(tail);
        let minus = self.script.minus();
        let left = match tail.strip_prefix(minus) {
            Some(rest) => format!("{link} {minus} {rest}"),
            None => format!("{link} + {tail}"),
        };
        self.loop_text(left, whole);
        whole
    }

    fn loop_text(&mut self, vectors: String, whole: Vector) {
        self.paragraph("The loop closes, as vectors and by components:");
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
    pub(super) fn root(&mut self, scale: ExprId, n: ExprId, positive: bool) -> ExprId {
        let square = self.square(n);
        let graph = self.graph();
        let excess = graph.subtract(scale, square);
        let root = graph.sqrt(excess);
        if positive { root } else { graph.negate(root) }
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
        let vectors = [0, 1].map(|axis| {
            let slid =
                [0, 1].map(|side| self.graph().multiply(lengths[side], directions[side][axis]));
            self.graph().sum(&[slid[0], slid[1], closure[axis]])
        });
        let vectors = self.vector_sum(vectors);
        self.loop_text(vectors, whole);
        self.paragraph("Two lines of known direction meet. By Cramer's rule:");
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
    pub(super) fn slide_motion(&mut self, motion: Motion) {
        let determinant = self.formula(motion.determinant);
        let [v, a] = ["v", "a"].map(|name| self.script.inline(&self.script.vector(name)));
        let [first, second] = motion.unknowns.map(|unknown| self.rate_of(unknown));
        self.paragraph(format!(
            "Velocity: the loop differentiated is a linear system for {} and {} with the determinant {}; {v} is what the loop does \
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
        equations.extend(self.by_columns([first, second], name, &motion));
        self.equations(equations);
        self.paragraph(format!(
            "Acceleration: the same system with {a} in the place of {v}; {a} is the second rate of the loop while both rates stay as \
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
        let accelerations = motion.unknowns.map(|unknown| self.acceleration_of(unknown));
        equations.extend(self.by_columns(accelerations, name, &motion));
        self.equations(equations);
    }

    /// [d, e] (u, w) = −v by Cramer's rule: u = (e × v)/(d × e), w = (v × d)/(d × e).
    fn by_columns(&mut self, sought: [ExprId; 2], v: Vector, motion: &Motion) -> [Equation; 2] {
        let [d, e] = motion.columns;
        let numerators = [self.cross(e, v), self.cross(v, d)];
        [0, 1].map(|side| {
            let value = self.graph().divide(numerators[side], motion.determinant);
            self.equation(sought[side], value, "")
        })
    }
}
