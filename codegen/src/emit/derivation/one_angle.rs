//! Steps with one equation: coefficient · u + rest = 0, and α cos φ + β sin φ = γ.

use super::document::Equation;
use super::words::enumerated;
use super::writer::Writer;
use crate::expr::ExprId;

impl Writer<'_> {
    /// Writes the step and returns what it is solved from.
    pub(super) fn linear(&mut self, unknown: usize, coefficient: ExprId, rest: ExprId) -> String {
        let [coefficient, rest] = [coefficient, rest].map(|part| self.with_numbers(part));
        let variable = self.variable(unknown);
        let name = self.named(unknown);
        let graph = self.graph();
        let moved = graph.multiply(coefficient, variable);
        let whole = graph.add(moved, rest);
        let ratio = graph.divide(rest, coefficient);
        let value = graph.negate(ratio);
        self.paragraph(format!("The equation is linear in {name}:"));
        let equations = vec![
            self.vanishing(whole, ""),
            self.equation(variable, value, ""),
        ];
        self.equations(equations);
        self.single_motion(unknown, whole);
        "from a linear equation".to_string()
    }

    /// Writes the step and returns what it is solved from.
    pub(super) fn one_angle(
        &mut self,
        unknown: usize,
        [cosine, sine, rest]: [ExprId; 3],
        equation: ExprId,
    ) -> String {
        let name = self.named(unknown);
        let source = self.opening(unknown, equation);
        let written = self.written_out(equation);
        let numbers = self.numbers_in(written);
        let whole = self.with_numbers(written);
        let [c, s, rest] = [cosine, sine, rest].map(|part| self.with_numbers(part));
        let target = self.graph().negate(rest);
        let zero = self.graph().zero();
        let turning = {
            // The derivative of the left side in φ is minus c sin φ − s cos φ: its sign tells the solutions apart.
            let symbol = self.system.vector_form.unknowns[unknown].position;
            let slope = self.graph().derivative(whole, symbol);
            -self.drawn(slope)
        };
        let known = match numbers[..] {
            [] => String::new(),
            _ => format!("With {}", enumerated(&numbers)),
        };
        if s == zero || c == zero {
            let function = if s == zero { "cosine" } else { "sine" };
            self.paragraph(match numbers[..] {
                [] => format!("It gives the {function} of {name}:"),
                _ => format!("{known} it gives the {function} of {name}:"),
            });
            self.one_function(unknown, [c, s, target], turning);
        } else {
            let form = "a cosine and a sine of one angle, which a square root separates";
            self.paragraph(match numbers[..] {
                [] => format!("It holds {form}:"),
                _ => format!("{known} it holds {form}:"),
            });
            self.both_functions(unknown, [c, s, target], turning);
        }
        self.single_motion(unknown, whole);
        source
    }

    /// The equation as it comes from its joint.
    fn opening(&mut self, unknown: usize, equation: ExprId) -> String {
        let name = self.named(unknown);
        let written = self.written_out(equation);
        let Some(row) = self.row_of(equation) else {
            self.paragraph(format!(
                "In what is left of the block's equations, {name} is the only unknown:"
            ));
            let equations = vec![self.vanishing(written, "")];
            self.equations(equations);
            return "from one equation".to_string();
        };
        let (words, note) = (self.row_words(row), self.row_note(row));
        let mut equations = Vec::new();
        if let Some(vectors) = self.vector_equation(row) {
            equations.push(Equation {
                left: vectors,
                right: "0".to_string(),
                note: "as vectors".to_string(),
            });
        }
        equations.push(self.vanishing(written, note));
        self.paragraph(format!("In {words}, {name} is the only unknown:"));
        self.equations(equations);
        format!("from {words}")
    }

    /// c cos φ = k, or s sin φ = k.
    fn one_function(&mut self, unknown: usize, [c, s, target]: [ExprId; 3], turning: f64) {
        let zero = self.graph().zero();
        let variable = self.variable(unknown);
        let graph = self.graph();
        let (cosine, sine) = (graph.cos(variable), graph.sin(variable));
        let by_cosine = s == zero;
        let (given, other, factor) = if by_cosine {
            (cosine, sine, c)
        } else {
            (sine, cosine, s)
        };
        let one = graph.one();
        let ratio = graph.divide(target, factor);
        let (below, above) = (graph.subtract(one, given), graph.add(one, given));
        let product = graph.multiply(below, above);
        let root = graph.sqrt(product);
        let positive = {
            let other = self.drawn(other);
            // The drawing's own sign where it is clear; the assembly mode follows the same function.
            if other == 0.0 {
                turning >= 0.0
            } else {
                other > 0.0
            }
        };
        let minus = self.graph().negate(root);
        let value = if positive { root } else { minus };
        let name = self.named(unknown);
        let mut equations = vec![
            self.equation(given, ratio, ""),
            self.equation(
                other,
                value,
                if positive {
                    "positive as in the drawing"
                } else {
                    "negative as in the drawing"
                },
            ),
        ];
        equations.push(self.by_both(unknown));
        self.equations(equations);
        self.paragraph(format!(
            "The sign is the assembly mode; the other one is the second solution for {name}."
        ));
    }

    /// φ from its sine and cosine.
    fn by_both(&mut self, unknown: usize) -> Equation {
        let variable = self.variable(unknown);
        let graph = self.graph();
        let (cosine, sine) = (graph.cos(variable), graph.sin(variable));
        let function = self
            .script
            .either("atan2", "atan2", "\\operatorname{atan2}");
        Equation {
            left: self.unknown(unknown),
            right: format!(
                "{function}({}, {})",
                self.formula(sine),
                self.formula(cosine)
            ),
            note: String::new(),
        }
    }

    /// c cos φ + s sin φ = k, with both.
    fn both_functions(&mut self, unknown: usize, parts: [ExprId; 3], turning: f64) {
        let names = ["a", "b", "c"].map(|name| self.name(name));
        let mut equations = Vec::new();
        let [a, b, c] = [0, 1, 2].map(|place| {
            if self.graph().is_fixed(parts[place]) {
                parts[place]
            } else {
                equations.push(self.equation(names[place], parts[place], ""));
                names[place]
            }
        });
        let variable = self.variable(unknown);
        let graph = self.graph();
        let (cosine, sine) = (graph.cos(variable), graph.sin(variable));
        let [along, across] = [graph.multiply(a, cosine), graph.multiply(b, sine)];
        let left = graph.add(along, across);
        equations.push(self.equation(left, c, ""));
        let [rho, h] = ["rho", "h"].map(|name| self.name(name));
        let [a_square, b_square] = [a, b].map(|part| self.square(part));
        let rho_square = self.graph().add(a_square, b_square);
        let radius = self.graph().sqrt(rho_square);
        let constant = self.graph().is_fixed(radius);
        let size = if constant { radius } else { rho };
        if !constant {
            equations.push(self.equation(rho, radius, ""));
        }
        let graph = self.graph();
        let (below, above) = (graph.subtract(size, c), graph.add(size, c));
        let product = graph.multiply(below, above);
        let root = graph.sqrt(product);
        let signed = if turning >= 0.0 {
            root
        } else {
            graph.negate(root)
        };
        equations.push(self.equation(h, signed, "with the sign of the drawing"));
        let graph = self.graph();
        let size_square = graph.multiply(size, size);
        let [ac, bh, bc, ah] = [(a, c), (b, h), (b, c), (a, h)].map(|(x, y)| graph.multiply(x, y));
        let sums = [graph.subtract(ac, bh), graph.add(bc, ah)];
        let [for_cosine, for_sine] = sums.map(|sum| graph.divide(sum, size_square));
        equations.push(self.equation(cosine, for_cosine, ""));
        equations.push(self.equation(sine, for_sine, ""));
        equations.push(self.by_both(unknown));
        self.equations(equations);
        let h = self.script.inline("h");
        self.paragraph(format!(
            "The sign of {h} is the assembly mode; the other one is the second solution."
        ));
    }

    /// The rate and the acceleration of an unknown from its own equation.
    fn single_motion(&mut self, unknown: usize, whole: ExprId) {
        let first = self.derivative(whole);
        let (rate, acceleration) = (self.rate_of(unknown), self.acceleration_of(unknown));
        let symbol = self.system.vector_form.unknowns[unknown].rate;
        let coefficient = self.graph().derivative(first, symbol);
        let drift = self.without(first, &[unknown]);
        let second = self.derivative(first);
        let second = {
            // Only the acceleration is sought now; the rate is known.
            let symbol = self.system.vector_form.unknowns[unknown].acceleration;
            let zero = self.graph().zero();
            self.graph().substitute(second, &[(symbol, zero)])
        };
        let factor = self.formula(coefficient);
        let factor = self.script.inline(&factor);
        self.paragraph(format!(
            "Velocity and acceleration: differentiated once and twice, the equation is linear with the coefficient {factor}:"
        ));
        let mut equations = Vec::new();
        for (left, right) in [(rate, drift), (acceleration, second)] {
            let graph = self.graph();
            let ratio = graph.divide(right, coefficient);
            let value = graph.negate(ratio);
            equations.push(self.equation(left, value, ""));
        }
        self.equations(equations);
    }
}
