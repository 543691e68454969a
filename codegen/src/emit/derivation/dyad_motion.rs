//! Velocity and acceleration of two links between two known points: one linear system with two right-hand sides.

use super::document::Equation;
use super::triangle::Names;
use super::words::enumerated;
use super::writer::Writer;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;

impl Writer<'_> {
    /// Velocity and acceleration: one linear system with two right-hand sides.
    pub(super) fn dyad_motion(
        &mut self,
        angles: [usize; 2],
        links: [Vector; 2],
        closure: Vector,
        names: &Names,
        turned: [Vector; 2],
        twice_area: ExprId,
    ) {
        let columns = [0, 1].map(|side| self.script.perpendicular(&names.links[side]));
        let determinant = self.script.cross(&names.links[0], &names.links[1]);
        let area = self.formula(twice_area);
        self.paragraph(format!(
            "Velocity: the loop differentiated is a linear system with the determinant {}; {} is what the loop does while the two \
             angles rest.",
            self.script.inline(&format!("{determinant} = {area}")),
            self.script.inline(&self.script.vector("v")),
        ));
        let rates = angles.map(|angle| self.rate_of(angle));
        let formulas = rates.map(|rate| self.formula(rate));
        let times = self.script.times();
        let system = |right: &str| Equation {
            left: format!(
                "{}{times}{} + {}{times}{}",
                formulas[0], columns[0], formulas[1], columns[1]
            ),
            right: right.to_string(),
            note: String::new(),
        };
        let minus = self.script.minus();
        let mut equations = vec![system(&format!("{minus}{}", self.script.vector("v")))];
        let whole = [0, 1].map(|axis| {
            let [a, b] = [0, 1].map(|side| self.turn(angles[side], links[side])[axis]);
            let closing = self.with_numbers(closure[axis]);
            self.graph().sum(&[a, b, closing])
        });
        let first = whole.map(|part| self.derivative(part));
        let drift = first.map(|part| self.without(part, &angles));
        let zero = self.graph().zero();
        let v = if drift == [zero, zero] {
            drift
        } else {
            self.components("v")
        };
        if drift == [zero, zero] {
            equations.push(Equation {
                left: self.script.vector("v"),
                right: "0".to_string(),
                note: String::new(),
            });
        } else {
            for axis in [0, 1] {
                equations.push(self.equation(v[axis], drift[axis], ""));
            }
        }
        equations.extend(self.by_cramer(rates, v, turned, twice_area));
        self.equations(equations);
        self.dyad_acceleration(angles, drift, turned, twice_area);
    }

    /// The right-hand side of the accelerations: the drift's own rate, and what the turning links pull.
    fn dyad_acceleration(
        &mut self,
        angles: [usize; 2],
        drift: Vector,
        turned: [Vector; 2],
        twice_area: ExprId,
    ) {
        let [v, a] = ["v", "a"].map(|name| self.script.inline(&self.script.vector(name)));
        let names = angles.map(|angle| {
            let acceleration = self.acceleration_of(angle);
            self.script.inline(&self.formula(acceleration))
        });
        self.paragraph(format!(
            "Acceleration: the same system with {a} in the place of {v} gives {}:",
            enumerated(&names),
        ));
        let mut equations = Vec::new();
        let components = self.components("a");
        for axis in [0, 1] {
            let rate = self.derivative(drift[axis]);
            // The links turn: −φ̇² w. What the drift changes through the angles themselves comes once more from the links.
            let mut parts = vec![rate];
            let extra = self.stretching(angles, drift, axis);
            parts.push(extra);
            for side in [0, 1] {
                let rate = self.rate_of(angles[side]);
                let square = self.square(rate);
                let pull = self.graph().multiply(square, turned[side][axis]);
                parts.push(self.graph().negate(pull));
            }
            let value = self.graph().sum(&parts);
            equations.push(self.equation(components[axis], value, ""));
        }
        let accelerations = angles.map(|angle| self.acceleration_of(angle));
        equations.extend(self.by_cramer(accelerations, components, turned, twice_area));
        self.equations(equations);
    }

    /// [Ω w_a, Ω w_b] (u_a, u_b) = −v.
    fn by_cramer(
        &mut self,
        [first, second]: [ExprId; 2],
        v: Vector,
        turned: [Vector; 2],
        twice_area: ExprId,
    ) -> [Equation; 2] {
        let [along_first, along_second] = turned.map(|link| self.dot(v, link));
        let graph = self.graph();
        let ratio = graph.divide(along_second, twice_area);
        let for_first = graph.negate(ratio);
        let for_second = graph.divide(along_first, twice_area);
        [
            self.equation(first, for_first, ""),
            self.equation(second, for_second, ""),
        ]
    }

    /// Links that change their length while they turn contribute 2 φ̇ Ω R ṗ, of which the drift's rate holds one half.
    fn stretching(&mut self, angles: [usize; 2], drift: Vector, axis: usize) -> ExprId {
        let mut parts = Vec::new();
        for angle in angles {
            let symbol = self.system.vector_form.unknowns[angle].position;
            let rate = self.rate_of(angle);
            let slope = self.graph().derivative(drift[axis], symbol);
            parts.push(self.graph().multiply(slope, rate));
        }
        self.graph().sum(&parts)
    }
}
