//! Bounds functions of one bounded value, from the magnitude of their derivatives.

use super::{Enclosure, Enclosures};
use crate::expr::{ExprId, Number, Rational, SplineId};
use crate::pool::Pool;
use crate::system::System;

impl Enclosures {
    pub(super) fn of_arctangent(
        &mut self,
        y: ExprId,
        x: ExprId,
        pool: &mut Pool,
        system: &System,
    ) -> Enclosure {
        let [of_y, of_x] = [y, x].map(|part| self.of(part, pool, system));
        let graph = &mut pool.graph;
        let squares = [y, x].map(|part| graph.multiply(part, part));
        let square = graph.sum(&squares);
        let distance = graph.sqrt(square);
        let radius = graph.add(of_y.radius, of_x.radius);
        let least = graph.subtract(distance, radius);
        self.required.push(least);
        // If x is negative, y must keep its sign, since the angle jumps at y = 0.
        let left = graph.subtract(x, of_x.radius);
        let size = graph.magnitude(y);
        let kept = graph.subtract(size, of_y.radius);
        let one = graph.one();
        let jumps = graph.choose(left, kept, one);
        self.required.push(jumps);
        let slopes = [-1, -2].map(|power| graph.power(least, Rational::integer(power)));
        let deviation = graph.add(of_y.deviation, of_x.deviation);
        self.composed(Enclosure { radius, deviation }, slopes, pool)
    }

    pub(super) fn of_spline(
        &mut self,
        spline: SplineId,
        order: u8,
        argument: ExprId,
        pool: &mut Pool,
        system: &System,
    ) -> Enclosure {
        let inner = self.of(argument, pool, system);
        let steepest = pool.graph.spline_of(spline).largest_derivatives();
        let graph = &mut pool.graph;
        let [first, second, third] = steepest.map(|value| graph.number(Number::float(value)));
        match order {
            0 => self.composed(inner, [first, second], pool),
            1 => self.composed(inner, [second, third], pool),
            // The second derivative has kinks, the third one jumps.
            2 => {
                let radius = graph.multiply(third, inner.radius);
                Enclosure {
                    radius,
                    deviation: radius,
                }
            }
            _ => {
                let radius = graph.add(third, third);
                Enclosure {
                    radius,
                    deviation: radius,
                }
            }
        }
    }

    /// Bounds f(x), with these bounds on its first and second derivative over the window.
    pub(super) fn composed(
        &self,
        inner: Enclosure,
        [first, second]: [ExprId; 2],
        pool: &mut Pool,
    ) -> Enclosure {
        let graph = &mut pool.graph;
        let remainder = graph.variable(self.window.remainder);
        let moved = graph.multiply(first, inner.deviation);
        let curved = graph.product(&[second, remainder, inner.radius, inner.radius]);
        Enclosure {
            radius: graph.multiply(first, inner.radius),
            deviation: graph.add(moved, curved),
        }
    }

    /// Returns the smallest value over the window, and requires that it is positive.
    pub(super) fn least(&mut self, x: ExprId, inner: Enclosure, pool: &mut Pool) -> ExprId {
        let least = pool.graph.subtract(x, inner.radius);
        self.required.push(least);
        least
    }
}
