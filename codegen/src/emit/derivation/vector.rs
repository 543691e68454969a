//! Two components → a sum of vectors: positions of origins, turned local vectors, constants; and a vector by name.

use super::document::Equation;
use super::writer::Writer;
use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::joint::geometry::Vector;

impl Writer<'_> {
    /// The two expressions as one vector: `r_c3 + R(phi_c3) (0.3, 0.2) - (0.4, -0.2)`; as a pair of components where they are no
    /// such sum.
    pub(super) fn vector_sum(&mut self, pair: Vector) -> String {
        let Some(mut terms) = self.terms(pair) else {
            let pair = pair.map(|part| self.written_out(part));
            return self.pair_text(pair);
        };
        let minus = self.script.minus();
        let mut text = String::new();
        // A sum does not begin with a minus where that can be avoided.
        if let Some(first) = terms.iter().position(|(negative, _)| !negative) {
            terms[..=first].rotate_right(1);
        }
        for (place, (negative, term)) in terms.iter().enumerate() {
            text.push_str(&match (place, negative) {
                (0, false) => String::new(),
                (0, true) => minus.to_string(),
                (_, false) => " + ".to_string(),
                (_, true) => format!(" {minus} "),
            });
            text.push_str(term);
        }
        text
    }

    /// Whether the two expressions are the components of such a sum.
    pub(super) fn is_vector_sum(&mut self, pair: Vector) -> bool {
        self.terms(pair).is_some()
    }

    /// The terms and whether each is subtracted.
    fn terms(&mut self, pair: Vector) -> Option<Vec<(bool, String)>> {
        let mut terms: Vec<(bool, String)> = Vec::new();
        let mut rest = pair;
        for body in 1..self.system.mechanism.bodies.len() {
            let place = 3 * (body - 1);
            let unknowns = [place, place + 1];
            let symbols = unknowns.map(|it| self.system.vector_form.unknowns[it].position);
            if let Some(factor) = self.take_factor(&mut rest, symbols) {
                let name = &self.system.mechanism.bodies[body].name;
                let origin = self.script.origin(name);
                terms.push(self.scaled(factor, origin));
            }
            self.take_arms(
                self.system.vector_form.angle_of(body),
                &mut rest,
                &mut terms,
            );
        }
        for auxiliary in self.system.coordinates.len()..self.system.vector_form.unknowns.len() {
            self.take_arms(auxiliary, &mut rest, &mut terms);
        }
        let graph = self.graph();
        let zero = graph.zero();
        if !rest.iter().all(|&part| graph.is_fixed(part)) {
            return None;
        }
        if rest != [zero, zero] || terms.is_empty() {
            terms.push((false, self.pair_text(rest)));
        }
        Some(terms)
    }

    /// Takes the vectors that an angle turns out of a sum.
    fn take_arms(&mut self, angle: usize, rest: &mut Vector, terms: &mut Vec<(bool, String)>) {
        let arms: Vec<_> = self.system.vector_form.arms_of(angle).cloned().collect();
        for arm in arms {
            if let Some(factor) = self.take_factor(rest, arm.symbols) {
                let angle = self.unknown(angle);
                let turned = self.turned_text(&angle, arm.local);
                terms.push(self.scaled(factor, turned));
            }
        }
    }

    /// `R(phi) (a, b)`.
    pub(super) fn turned_text(&mut self, angle: &str, local: Vector) -> String {
        format!("{} {}", self.script.rotation(angle), self.pair_text(local))
    }

    /// `(a, b)`.
    pub(super) fn pair_text(&self, pair: Vector) -> String {
        let [x, y] = pair.map(|part| self.formula(part));
        self.script.pair(&x, &y)
    }

    /// Takes a vector whose components are these symbols out of a sum and returns its factor, where it is the same in both
    /// components.
    fn take_factor(&mut self, rest: &mut Vector, symbols: [SymbolId; 2]) -> Option<ExprId> {
        let graph = self.graph();
        let zero = graph.zero();
        let own = [0, 1].map(|axis| graph.derivative(rest[axis], symbols[axis]));
        let other = [0, 1].map(|axis| graph.derivative(rest[axis], symbols[1 - axis]));
        if own[0] != own[1] || own[0] == zero || other != [zero, zero] {
            return None;
        }
        *rest = rest.map(|part| graph.substitute(part, &symbols.map(|it| (it, zero))));
        Some(own[0])
    }

    /// A vector times a factor, and whether it is subtracted.
    fn scaled(&mut self, factor: ExprId, vector: String) -> (bool, String) {
        let graph = self.graph();
        let (one, minus) = (graph.one(), graph.negate(factor));
        if factor == one {
            return (false, vector);
        }
        if minus == one {
            return (true, vector);
        }
        let negative = self.formula(factor).starts_with(['-', '−']);
        let size = self.formula(if negative { minus } else { factor });
        (negative, format!("{size}{}{vector}", self.script.times()))
    }

    /// φ = atan2(p × w, p · w), the angle that turns p into w.
    pub(super) fn angle_equation(
        &mut self,
        angle: usize,
        local: Vector,
        turned: Vector,
        note: &str,
    ) -> Equation {
        let local = self.short(local);
        let (along, across) = (self.dot(local, turned), self.cross(local, turned));
        let value = self.graph().atan2(across, along);
        let variable = self.variable(angle);
        self.equation(variable, value, note)
    }

    /// A constant vector along an axis as a unit vector: its length does not change the angle.
    fn short(&mut self, local: Vector) -> Vector {
        let graph = self.graph();
        let zero = graph.zero();
        if !local.contains(&zero) {
            return local;
        }
        // The sign of a parameter is not known.
        let number = |part: ExprId, graph: &Graph| {
            graph
                .is_constant(part)
                .then(|| graph.constant_value(part))
                .flatten()
        };
        local.map(|part| match number(part, graph) {
            Some(value) if value > 0.0 => graph.one(),
            Some(value) if value < 0.0 => {
                let one = graph.one();
                graph.negate(one)
            }
            _ => part,
        })
    }

    /// A vector by its components: the numbers themselves, or new names for them with their equations.
    pub(super) fn named_vector(
        &mut self,
        name: &str,
        value: Vector,
        equations: &mut Vec<Equation>,
    ) -> Vector {
        let value = value.map(|part| self.with_numbers(part));
        let graph = self.graph();
        if value.iter().all(|&part| graph.is_fixed(part)) {
            equations.push(Equation {
                left: self.script.vector(name),
                right: self.pair_text(value),
                note: String::new(),
            });
            return value;
        }
        let components = self.components(name);
        for axis in [0, 1] {
            equations.push(self.equation(components[axis], value[axis], ""));
        }
        // What is a number or a symbol already needs no other name.
        [0, 1].map(|axis| {
            let graph = &self.system.mechanism.graph;
            match graph.node(value[axis]) {
                Node::Symbol(_) => value[axis],
                _ if graph.is_fixed(value[axis]) => value[axis],
                _ => components[axis],
            }
        })
    }
}
