//! Bounds the change of expressions over a window of time, and their deviation from the chord.
//!
//! The window contains the last frame and this one. Every value runs along the chord through both frames, up to a deviation. The
//! *radius* bounds its distance from its value in this frame, the *deviation* its distance from the chord. Both bounds are
//! rigorous expressions, by the mean value theorem and the remainder of linear interpolation, for smooth functions; values that
//! must be positive for smoothness are recorded.

mod arithmetic;
mod arms;
mod choices;
mod functions;

use std::collections::HashMap;

use crate::expr::{ExprId, Graph, Node, Rational, SymbolId};
use crate::pool::Pool;
use crate::system::System;
use arms::{Amplitude, arm, base, length};

/// Bounds of one value, both at least zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) struct Enclosure {
    /// Bound on the distance from the value in this frame.
    pub radius: ExprId,
    /// Bound on the distance from the chord.
    pub deviation: ExprId,
}

/// Properties of the window, as symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeWindow {
    /// Largest distance in time from this frame, in s.
    pub time: SymbolId,
    /// Largest distance in steps: 1 if the window ends with the frames.
    pub steps: SymbolId,
    /// Factor of a squared radius in the remainder of linear interpolation, for a second derivative of 1.
    pub remainder: SymbolId,
    /// Indicator: 1 if the window extends beyond the frames, otherwise 0.
    pub beyond: SymbolId,
    /// Largest rounding error of values in frames, relative to their magnitude.
    pub rounding: SymbolId,
}

/// Known bounds.
pub(in crate::program) struct Enclosures {
    window: TimeWindow,
    known: HashMap<SymbolId, Enclosure>,
    found: HashMap<ExprId, Enclosure>,
    /// Expressions whose bounds depend on those of a symbol; an angle represents the vectors that it rotates.
    resting: HashMap<SymbolId, Vec<ExprId>>,
    /// Values that must not be negative for the bounds to hold.
    pub required: Vec<ExprId>,
}

impl Enclosures {
    /// Starts with moving time alone.
    pub fn new(window: TimeWindow, pool: &mut Pool, system: &System) -> Enclosures {
        let graph = &mut pool.graph;
        let time = Enclosure {
            radius: graph.variable(window.time),
            deviation: graph.zero(),
        };
        Enclosures {
            window,
            known: HashMap::from([(system.mechanism.time, time)]),
            found: HashMap::new(),
            resting: HashMap::new(),
            required: Vec::new(),
        }
    }

    /// Records the bounds of a symbol.
    pub fn know(&mut self, symbol: SymbolId, enclosure: Enclosure) {
        self.known.insert(symbol, enclosure);
        for expr in self.resting.remove(&symbol).unwrap_or_default() {
            self.found.remove(&expr);
        }
    }

    /// Keeps bounds until those on which they depend change.
    fn keep(&mut self, expr: ExprId, enclosure: Enclosure, pool: &Pool) {
        self.found.insert(expr, enclosure);
        let mut bases: Vec<SymbolId> = pool
            .graph
            .symbols(expr)
            .iter()
            .map(|&it| base(it, pool))
            .collect();
        bases.sort_unstable();
        bases.dedup();
        for symbol in bases {
            self.resting.entry(symbol).or_default().push(expr);
        }
    }

    /// Bounds an expression.
    pub fn of(&mut self, expr: ExprId, pool: &mut Pool, system: &System) -> Enclosure {
        if let Some(&known) = self.found.get(&expr) {
            return known;
        }
        let graph = &mut pool.graph;
        let enclosure = match graph.node(expr).clone() {
            _ if graph.is_fixed(expr) => still(graph),
            Node::Number(_) | Node::Pi => still(graph),
            Node::Symbol(symbol) => self.of_symbol(symbol, pool, system),
            Node::Sum(terms) => self.of_sum(&terms, pool, system),
            Node::Product(factors) => self.of_product(&factors, pool, system),
            Node::Sin(x) | Node::Cos(x) => {
                let inner = self.of(x, pool, system);
                let one = pool.graph.one();
                self.composed(inner, [one, one], pool)
            }
            Node::Exp(x) => {
                let inner = self.of(x, pool, system);
                let graph = &mut pool.graph;
                let largest = graph.add(x, inner.radius);
                let slope = graph.exp(largest);
                self.composed(inner, [slope, slope], pool)
            }
            Node::Ln(x) => {
                let inner = self.of(x, pool, system);
                let least = self.least(x, inner, pool);
                let graph = &mut pool.graph;
                let slopes = [-1, -2].map(|power| graph.power(least, Rational::integer(power)));
                self.composed(inner, slopes, pool)
            }
            Node::Atan2(y, x) => self.of_arctangent(y, x, pool, system),
            Node::Floor(x) => {
                let inner = self.of(x, pool, system);
                self.require_between_integers(x, inner.radius, pool);
                still(&pool.graph)
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => match graph.magnitude_of(expr) {
                Some(x) => self.of_magnitude(x, pool, system),
                None => self.of_choice(expr, [condition, below, otherwise], pool, system),
            },
            Node::Spline {
                spline,
                order,
                argument,
            } => self.of_spline(spline, order, argument, pool, system),
        };
        self.keep(expr, enclosure, pool);
        enclosure
    }

    fn of_symbol(&mut self, symbol: SymbolId, pool: &mut Pool, system: &System) -> Enclosure {
        if let Some(&known) = self.known.get(&symbol) {
            return known;
        }
        let Some((angle, amplitude)) = arm(symbol, pool) else {
            unreachable!("`{}` has no bounds", pool.graph.symbol_name(symbol))
        };
        self.of_turned(angle, amplitude, pool, system)
    }

    /// Bounds a wave a cos φ + b sin φ, whose derivatives in φ are at most √(a² + b²).
    fn of_turned(
        &mut self,
        angle: usize,
        amplitude: Amplitude,
        pool: &mut Pool,
        system: &System,
    ) -> Enclosure {
        let turning = system.vector_form.unknowns[angle].position;
        let turning = self.of_symbol(turning, pool, system);
        let length = length(amplitude, &mut pool.graph);
        self.composed(turning, [length, length], pool)
    }
}

fn still(graph: &Graph) -> Enclosure {
    Enclosure {
        radius: graph.zero(),
        deviation: graph.zero(),
    }
}
