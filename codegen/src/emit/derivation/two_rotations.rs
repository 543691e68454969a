//! R(φ_a) p + R(φ_b) q + c = 0: two links between two known points, where two circles meet.
//!
//! With the known vector d = −c from the beginning of p to the end of q, and k = R(φ_a) p · R(φ_b) q, the law of cosines says
//! 2 k = d² − p² − q²; the links span twice the area h = √(p² q² − k²), and R(φ_a) p = ((p² + k) d ± h d⊥)/d². The determinant
//! of the velocities is R(φ_a) p × R(φ_b) q = ∓h.

use super::document::Equation;
use super::geometry::{Link, Pin};
use super::words::enumerated;
use super::writer::Writer;
use crate::expr::ExprId;
use crate::joint::geometry::{Mark, Vector};
use crate::model::Role;

/// What the two links and the known vector are called.
#[derive(Clone, Debug)]
struct Names {
    /// The links, in the order of the angles.
    links: [String; 2],
    /// From the beginning of the first to the end of the second.
    base: String,
}

/// Two known pins and the sought one.
#[derive(Clone, Debug)]
struct Triangle {
    outer: [(Pin, Mark); 2],
    apex: Pin,
    /// Whether p leads from the first outer pin to the apex, and not back.
    forward: bool,
}

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

    /// The pins of the triangle that the links make with the known vector.
    fn triangle(&mut self, angles: [usize; 2], links: [Vector; 2]) -> Option<Triangle> {
        let turns = |angle: usize| {
            move |writer: &Writer<'_>, mark: &Mark| {
                let form = &writer.system.vector_form;
                let (leader, _) = form.orientations.leader(mark.frame.body);
                leader.0 != 0 && form.angle_of(leader.0) == angle
            }
        };
        let (first, first_end, forward) = self.link(angles[0], links[0], turns(angles[1]))?;
        let (second, second_end, back) = self.link(angles[1], links[1], turns(angles[0]))?;
        let Link { from, to } = first;
        // The second vector leads from the apex to its known pin where the first leads to the apex.
        (to.name == second.to.name && forward != back).then_some(Triangle {
            outer: [(from, first_end), (second.from, second_end)],
            apex: to,
            forward,
        })
    }

    fn open_triangle(&mut self, triangle: &Triangle, links: [Vector; 2]) -> (Names, String) {
        let [a, b] = [0, 1].map(|side| triangle.outer[side].0.name.clone());
        let apex = triangle.apex.name.clone();
        let names = Names {
            links: [format!("{a}{apex}"), format!("{apex}{b}")],
            base: format!("{a}{b}"),
        };
        let places = [0, 1].map(|side| self.whereabouts(&triangle.outer[side].1));
        let known = if places[0] == places[1] {
            format!("{a} and {b} are known, {}", places[0])
        } else {
            format!("{a}, {}, and {b}, {}, are known", places[0], places[1])
        };
        self.sentence(&format!(
            "{known}. Sought is {apex}, the third point of the triangle."
        ));
        let mut heading = Vec::new();
        for side in [0, 1] {
            let name = [format!("{a}{apex}"), format!("{b}{apex}")][side].clone();
            let length = self.script.inline(&self.script.length(&name));
            if let Some((value, reason, driven)) = self.known_length(links[side]) {
                self.sentence(&format!("{length} = {value}, {reason}."));
                if driven {
                    heading.push(length);
                }
            }
        }
        let condition = match heading[..] {
            [] => String::new(),
            _ => format!(" with {} known from the driver", enumerated(&heading)),
        };
        (
            names,
            format!("from the triangle {a}-{b}-{apex}{condition}"),
        )
    }

    fn open_loop(&mut self) -> (Names, String) {
        let names = Names {
            links: ["p".to_string(), "q".to_string()],
            base: "d".to_string(),
        };
        (names, "from a loop of two turning links".to_string())
    }

    /// The length of a link, why it is known, and whether a driver says it; `None` where it is no number and no displacement.
    fn known_length(&mut self, local: Vector) -> Option<(String, String, bool)> {
        let square = self.dot(local, local);
        let square = self.with_numbers(square);
        if self.graph().is_constant(square) {
            let length = self.graph().sqrt(square);
            let length = self.script.inline(&self.formula(length));
            return Some((length, "a fixed length".to_string(), false));
        }
        for unknown in 0..self.system.vector_form.unknowns.len() {
            let variable = self.variable(unknown);
            if self.square(variable) != square {
                continue;
            }
            let joints = &self.system.mechanism.joints;
            let driver = joints.iter().find(|joint| {
                let axis = joint.operands.axis;
                joint.role == Role::Driver && axis.is_some_and(|axis| axis.displacement == variable)
            });
            let block = self.found_in[unknown].map_or(0, |block| block + 1);
            let reason = match driver {
                Some(driver) => format!("known from {}", self.script.word(&driver.label)),
                None => format!("known from block {block}"),
            };
            return Some((self.named(unknown), reason, driver.is_some()));
        }
        None
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
        self.sentence(&format!(
            "the loop {}:",
            match triangle {
                Some(found) => format!(
                    "{}-{}-{} closes, as vectors and by components",
                    found.outer[0].0.name, found.apex.name, found.outer[1].0.name
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
        self.sentence(&match triangle {
            Some(found) => format!(
                "two circles about {a} and {b} meet in two points. In the drawing {apex} lies to the {side} of the line from {a} to \
                 {b}, and this assembly mode is kept: it is the sign of {h} below. By the law of cosines",
                a = found.outer[0].0.name,
                b = found.outer[1].0.name,
                apex = found.apex.name,
                h = self.script.inline("h"),
            ),
            None => format!(
                "the equations have two solutions. In the drawing the first link points to the {side} of the sum of both, and \
                 this assembly mode is kept: it is the sign of {} below. By the law of cosines",
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
        let base_value = if self.graph().is_constant(base_square) {
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
        let product = self.script.inline(&product);
        equations.push(self.equation(k, value, product));
        let scale = self.graph().multiply(p_square, q_square);
        let k_square = self.square(k);
        let excess = self.graph().subtract(scale, k_square);
        let root = self.graph().sqrt(excess);
        equations.push(self.equation(h, root, "twice the area"));
        let signed = if positive { h } else { self.graph().negate(h) };
        let first = self.components(&names.links[0]);
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
            equations.push(self.angle_equation(angles[side], links[side], turned, ""));
        }
        self.equations(equations);
        // The determinant w_a × w_b is minus d × w_a.
        let area = self.graph().negate(signed);
        ([first, second], area)
    }

    /// φ = atan2(p × w, p · w), the angle that turns p into w.
    pub(super) fn angle_equation(
        &mut self,
        angle: usize,
        local: Vector,
        turned: Vector,
        note: &str,
    ) -> Equation {
        let (along, across) = (self.dot(local, turned), self.cross(local, turned));
        let value = self.graph().atan2(across, along);
        let variable = self.variable(angle);
        self.equation(variable, value, note)
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
        if value.iter().all(|&part| graph.is_constant(part)) {
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
        components
    }

    /// Velocity and acceleration: one linear system with two right-hand sides.
    fn dyad_motion(
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
        self.sentence(&format!(
            "velocity: the loop differentiated is a linear system with the determinant {}; {} is what the loop does while the two \
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
        for (side, factor) in [(0, turned[1]), (1, turned[0])] {
            let product = self.dot(v, factor);
            let ratio = self.graph().divide(product, twice_area);
            let value = if side == 0 {
                self.graph().negate(ratio)
            } else {
                ratio
            };
            equations.push(self.equation(rates[side], value, ""));
        }
        self.equations(equations);
        self.dyad_acceleration(angles, drift, turned);
    }

    /// The right-hand side of the accelerations: the drift's own rate, and what the turning links pull.
    fn dyad_acceleration(&mut self, angles: [usize; 2], drift: Vector, turned: [Vector; 2]) {
        let [v, a] = ["v", "a"].map(|name| self.script.inline(&self.script.vector(name)));
        let names = angles.map(|angle| {
            let acceleration = self.acceleration_of(angle);
            self.script.inline(&self.formula(acceleration))
        });
        self.sentence(&format!(
            "acceleration: the same system with {a} in the place of {v} gives {}:",
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
        self.equations(equations);
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
