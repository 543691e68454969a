//! Bounds sums, products and powers, from the bounds of their operands.

use super::arms::{Amplitude, arm, constant_size};
use super::{Enclosure, Enclosures, still};
use crate::expr::{ExprId, Factor, Node, Number, Rational, Term};
use crate::pool::Pool;
use crate::system::System;

/// Largest number of factors of a product that is bounded factor by factor; longer ones are bounded by halves.
const LONGEST_FLAT: usize = 8;

impl Enclosures {
    /// Bounds a sum. Vectors that rotate with the same angle count as one vector.
    pub(super) fn of_sum(&mut self, terms: &[Term], pool: &mut Pool, system: &System) -> Enclosure {
        let (mut radii, mut deviations) = (Vec::new(), Vec::new());
        let mut turned: Vec<(usize, Amplitude)> = Vec::new();
        let mut bounds: Vec<Enclosure> = Vec::new();
        for term in terms {
            if let Node::Symbol(symbol) = *pool.graph.node(term.expr)
                && let Some((angle, amplitude)) = arm(symbol, pool)
            {
                let graph = &mut pool.graph;
                let scaled = amplitude.map(|part| graph.scale(term.coefficient, part));
                match turned.iter_mut().find(|(other, _)| *other == angle) {
                    Some((_, sum)) => *sum = [0, 1].map(|part| graph.add(sum[part], scaled[part])),
                    None => turned.push((angle, scaled)),
                }
                continue;
            }
            let of_term = self.of(term.expr, pool, system);
            let size = match term.coefficient.is_negative() {
                true => term.coefficient.neg(),
                false => term.coefficient,
            };
            let graph = &mut pool.graph;
            bounds.push(Enclosure {
                radius: graph.scale(size, of_term.radius),
                deviation: graph.scale(size, of_term.deviation),
            });
        }
        for (angle, amplitude) in turned {
            bounds.push(self.of_turned(angle, amplitude, pool, system));
        }
        for bound in bounds {
            radii.push(bound.radius);
            deviations.push(bound.deviation);
        }
        let graph = &mut pool.graph;
        Enclosure {
            radius: graph.sum(&radii),
            deviation: graph.sum(&deviations),
        }
    }

    /// Returns the largest magnitude of a value over the window.
    fn largest(&self, value: ExprId, bounds: Enclosure, pool: &mut Pool) -> ExprId {
        match constant_size(value, pool) {
            Some(size) => size,
            None => {
                let graph = &mut pool.graph;
                let size = graph.magnitude(value);
                graph.add(size, bounds.radius)
            }
        }
    }

    /// Bounds a product factor by factor, and a long one by halves, since bounds of a partial product mention all its factors.
    pub(super) fn of_product(
        &mut self,
        factors: &[Factor],
        pool: &mut Pool,
        system: &System,
    ) -> Enclosure {
        self.of_factors(factors, pool, system).1
    }

    /// Returns the product of one factor or more, and its bounds.
    fn of_factors(
        &mut self,
        factors: &[Factor],
        pool: &mut Pool,
        system: &System,
    ) -> (ExprId, Enclosure) {
        if factors.len() > LONGEST_FLAT {
            let (first, second) = factors.split_at(factors.len() / 2);
            let [first, second] = [first, second].map(|half| self.of_factors(half, pool, system));
            let bounds = self.multiplied(first, second, pool);
            return (pool.graph.multiply(first.0, second.0), bounds);
        }
        let graph = &pool.graph;
        let mut product = (graph.one(), still(graph));
        for (place, factor) in factors.iter().enumerate() {
            let value = pool.graph.power(factor.base, factor.exponent);
            let factor_bounds = (value, self.of_power(factor, pool, system));
            product = match place {
                0 => factor_bounds,
                _ => {
                    let bounds = self.multiplied(product, factor_bounds, pool);
                    (pool.graph.multiply(product.0, value), bounds)
                }
            };
        }
        product
    }

    /// Bounds a · b.
    fn multiplied(
        &mut self,
        (a, of_a): (ExprId, Enclosure),
        (b, of_b): (ExprId, Enclosure),
        pool: &mut Pool,
    ) -> Enclosure {
        let [largest_a, largest_b] =
            [(a, of_a), (b, of_b)].map(|(value, of)| self.largest(value, of, pool));
        let size_b = constant_size(b, pool).unwrap_or_else(|| pool.graph.magnitude(b));
        let graph = &mut pool.graph;
        let moved = [
            graph.multiply(largest_a, of_b.radius),
            graph.multiply(size_b, of_a.radius),
        ];
        let remainder = graph.variable(self.window.remainder);
        let curved = graph.product(&[remainder, of_a.radius, of_b.radius]);
        let bent = [
            graph.multiply(largest_a, of_b.deviation),
            graph.multiply(largest_b, of_a.deviation),
            graph.multiply(of_a.deviation, of_b.deviation),
            curved,
            curved,
        ];
        Enclosure {
            radius: graph.sum(&moved),
            deviation: graph.sum(&bent),
        }
    }

    fn of_power(&mut self, factor: &Factor, pool: &mut Pool, system: &System) -> Enclosure {
        let Factor { base, exponent } = *factor;
        let inner = self.of(base, pool, system);
        if exponent == Rational::ONE || inner == still(&pool.graph) {
            return match exponent == Rational::ONE {
                true => inner,
                false => still(&pool.graph),
            };
        }
        // |x| over the window, at the end where the derivative is largest.
        let is_whole = exponent.denominator() == 1;
        let graph = &mut pool.graph;
        let size = if is_whole {
            graph.magnitude(base)
        } else {
            base
        };
        let largest = graph.add(size, inner.radius);
        let least = graph.subtract(size, inner.radius);
        let mut slope = |order: i64, before: Rational| {
            // n (n − 1) … |x|^(n − order)
            let left = exponent
                .checked_sub(Rational::integer(order))
                .unwrap_or(exponent);
            let coefficient = match order {
                1 => exponent.absolute(),
                _ => exponent
                    .absolute()
                    .checked_mul(before.absolute())
                    .unwrap_or(before),
            };
            if coefficient.is_zero() {
                return graph.zero();
            }
            let place = if left.is_negative() { least } else { largest };
            let power = graph.power(place, left);
            graph.scale(Number::rational(coefficient), power)
        };
        let before = exponent.checked_sub(Rational::ONE).unwrap_or(exponent);
        let slopes = [slope(1, before), slope(2, before)];
        if !is_whole || exponent.is_negative() {
            self.required.push(least);
        }
        self.composed(inner, slopes, pool)
    }
}
