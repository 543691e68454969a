//! States what friction does in joints: the load of a unit, the rate of sliding, and the coefficient of a reaction.

use super::System;
use crate::expr::{ExprId, Graph, Number, Rational};
use crate::force::moment;
use crate::joint::geometry::{BodyId, Mark, Vector, dot, perpendicular, subtract};
use crate::model::{Friction, Surfaces};
use crate::pool::Pool;

/// Reciprocal of the largest rate of sliding that is rounding, relative to the rates of both bodies.
const AT_REST: i128 = 1 << 40;

/// Friction in a joint, on its second body: a force on the surface of a pin, or along a slide.
#[derive(Clone, Debug)]
pub struct Resisting {
    /// Generalized forces of 1 N of friction, by coordinate.
    pub load: Vec<(usize, ExprId)>,
    /// Friction on the second body of 1 N: the radius of a pin, and 1 of a slide.
    pub lever: ExprId,
    /// Velocity with which the surface of the second body slides on the first, in m/s.
    pub rate: ExprId,
    /// Sum of the magnitudes of the velocities of both bodies, in m/s.
    pub scale: ExprId,
    /// Coefficient of friction.
    pub factor: ExprId,
}

impl Resisting {
    /// Returns the coefficient of friction with the sign of what resists sliding. Zero without sliding.
    pub fn coefficient(&self, graph: &mut Graph) -> ExprId {
        let sliding = sign(self.rate, self.scale, graph);
        let resisting = graph.multiply(sliding, self.factor);
        graph.negate(resisting)
    }
}

/// Rates of a body: of its origin, and of its angle.
struct Rates {
    origin: Vector,
    angle: ExprId,
}

impl System {
    /// Returns what friction does in a joint; `None` if the joint has no line to slide along.
    pub fn resisting(&self, friction: &Friction, pool: &mut Pool) -> Option<Resisting> {
        let mechanism = &self.mechanism;
        let form = &self.vector_form;
        let operands = &mechanism.joints[friction.joint].operands;
        let operands = form.with_arms(operands, &mechanism.bodies, pool);
        let graph = &mut pool.graph;
        let (first, second, direction) = match (friction.is_pin(), operands.along()) {
            (false, Some((axis, first, second))) => (first, second, Some(axis.turned)),
            (false, None) => return None,
            (true, _) => match operands.marks[..] {
                [first, second, ..] => (first, second, None),
                _ => return None,
            },
        };
        let lever = match friction.surfaces {
            Surfaces::Pin(radius) => radius,
            Surfaces::Slide(_) => graph.one(),
        };
        let [before, after] = [first, second].map(|mark| self.rates_of(mark.frame.body, graph));
        let (load, rate) = match direction {
            None => (
                self.turning([first, second], lever, graph),
                graph.subtract(after.angle, before.angle),
            ),
            Some(direction) => {
                let place = second.position(graph);
                let arm = subtract(place, first.frame.origin, graph);
                let load = self.sliding([first, second], arm, direction, graph);
                let [on_second, on_first] = [(&after, second.arm), (&before, arm)]
                    .map(|(rates, arm)| velocity(rates, arm, graph));
                let relative = subtract(on_second, on_first, graph);
                (load, dot(direction, relative, graph))
            }
        };
        let rate = match mechanism.forces.at_rest {
            true => graph.zero(),
            false => rate,
        };
        let scale = self.scale_of(&[before, after], friction.is_pin(), graph);
        let [rate, scale] = [rate, scale].map(|it| graph.multiply(lever, it));
        Some(Resisting {
            load,
            lever,
            rate,
            scale,
            factor: friction.coefficient,
        })
    }

    /// Returns the rates of a body; those of the ground are zero.
    fn rates_of(&self, body: BodyId, graph: &mut Graph) -> Rates {
        let coordinates = self.mechanism.bodies[body.0].coordinates;
        let [x, y, angle] = coordinates.map(|coordinate| match coordinate {
            Some(it) => graph.variable(self.vector_form.unknowns[it.place].rate),
            None => graph.zero(),
        });
        Rates {
            origin: [x, y],
            angle,
        }
    }

    /// Returns the load of a moment on the second body, and of its opposite on the first.
    fn turning(&self, marks: [Mark; 2], moment: ExprId, graph: &mut Graph) -> Vec<(usize, ExprId)> {
        let moments = [graph.negate(moment), moment];
        let coordinates = marks.map(|it| self.mechanism.bodies[it.frame.body.0].coordinates[2]);
        let pairs = coordinates.into_iter().zip(moments);
        pairs
            .filter_map(|(it, moment)| Some((it?.place, moment)))
            .collect()
    }

    /// Returns the load of a unit force along a line on the second body, and of its opposite on the first, which acts at `arm` from
    /// its origin.
    fn sliding(
        &self,
        [first, second]: [Mark; 2],
        arm: Vector,
        direction: Vector,
        graph: &mut Graph,
    ) -> Vec<(usize, ExprId)> {
        let opposite = direction.map(|part| graph.negate(part));
        let ends = [
            (first.frame.body, arm, opposite),
            (second.frame.body, second.arm, direction),
        ];
        let mut load = Vec::new();
        for (body, arm, force) in ends {
            let parts = [force[0], force[1], moment(arm, force, graph)];
            let coordinates = self.mechanism.bodies[body.0].coordinates;
            let pairs = coordinates.into_iter().zip(parts);
            load.extend(pairs.filter_map(|(it, part)| Some((it?.place, part))));
        }
        load
    }

    /// Returns the sum of the magnitudes of the rates of both bodies, as an angular rate for a pin and as a velocity for a slide.
    fn scale_of(&self, rates: &[Rates; 2], is_pin: bool, graph: &mut Graph) -> ExprId {
        let length = self.mechanism.characteristic_length;
        let length = Number::parse(&format!("{length:e}"));
        let length = length.map_or(graph.one(), |it| graph.number(it));
        let magnitudes = |values: Vec<ExprId>, graph: &mut Graph| {
            let magnitudes = values.into_iter().map(|it| graph.magnitude(it));
            let magnitudes: Vec<ExprId> = magnitudes.collect();
            graph.sum(&magnitudes)
        };
        let turning = magnitudes(rates.iter().map(|it| it.angle).collect(), graph);
        let moving = magnitudes(rates.iter().flat_map(|it| it.origin).collect(), graph);
        match is_pin {
            true => {
                let moving = graph.divide(moving, length);
                graph.add(turning, moving)
            }
            false => {
                let turning = graph.multiply(turning, length);
                graph.add(turning, moving)
            }
        }
    }
}

/// Returns the velocity of a point of a body at `arm` from its origin.
fn velocity(rates: &Rates, arm: Vector, graph: &mut Graph) -> Vector {
    let across = perpendicular(arm, graph);
    [0, 1].map(|axis| {
        let turned = graph.multiply(rates.angle, across[axis]);
        graph.add(rates.origin[axis], turned)
    })
}

/// Returns the sign of a rate, and zero if it is rounding of `scale`.
fn sign(rate: ExprId, scale: ExprId, graph: &mut Graph) -> ExprId {
    let (zero, one) = (graph.zero(), graph.one());
    if rate == zero {
        return zero;
    }
    let rounding = Rational::new(1, AT_REST).unwrap_or(Rational::ONE);
    let rounding = graph.scale(Number::rational(rounding), scale);
    let backward = graph.add(rate, rounding);
    let at_most = graph.subtract(rounding, rate);
    let minus = graph.negate(one);
    let forward = graph.choose(at_most, one, zero);
    graph.choose(backward, minus, forward)
}
