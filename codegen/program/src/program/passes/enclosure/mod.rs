//! An expression → how far it can be from where it is, and from a straight line, while what it is made of moves.
//!
//! A mechanism is looked at over a window of time that holds its last frame and this one. Every value runs along a straight line through
//! both, up to a deviation: the *radius* bounds its distance from its value in this frame, the *deviation* its distance from the line. Both
//! are expressions that bound it rigorously, by the mean value theorem and the remainder of linear interpolation, as far as functions
//! are smooth; what must be positive for that is listed. Deliberately unknown here: what is done with the bounds.

mod arithmetic;
mod arms;
mod choices;
mod functions;

use std::collections::HashMap;

use crate::expr::{ExprId, Graph, Node, Rational, SymbolId};
use crate::system::System;
use arms::{Amplitude, arm, base, length};

/// Bounds of one value, both at least zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) struct Enclosure {
    /// How far the value is from where it is in this frame.
    pub radius: ExprId,
    /// How far it is from the straight line.
    pub deviation: ExprId,
}

/// What the window is like, as symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeWindow {
    /// How far the time goes from this frame, in s.
    pub time: SymbolId,
    /// The same in steps: 1 where the window ends with the frames.
    pub steps: SymbolId,
    /// What the square of a radius is multiplied by in the remainder of linear interpolation, for a second derivative of 1.
    pub remainder: SymbolId,
    /// Whether the window goes beyond the frames: 1, or else 0.
    pub beyond: SymbolId,
    /// How far rounding leaves what frames hold from what it stands for, as a part of its size.
    pub rounding: SymbolId,
}

/// The bounds that are known so far.
pub(in crate::program) struct Enclosures {
    window: TimeWindow,
    known: HashMap<SymbolId, Enclosure>,
    found: HashMap<ExprId, Enclosure>,
    /// What has been found with the bounds of a symbol, by that symbol: the angle in the place of the arms that it turns.
    resting: HashMap<SymbolId, Vec<ExprId>>,
    /// What must not be negative for the bounds to hold.
    pub required: Vec<ExprId>,
}

impl Enclosures {
    /// Time alone moves.
    pub fn new(window: TimeWindow, system: &mut System) -> Enclosures {
        let graph = &mut system.mechanism.graph;
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

    /// States the bounds of a symbol.
    pub fn know(&mut self, symbol: SymbolId, enclosure: Enclosure) {
        self.known.insert(symbol, enclosure);
        for expr in self.resting.remove(&symbol).unwrap_or_default() {
            self.found.remove(&expr);
        }
    }

    /// Keeps what has been found until bounds that it rests on change.
    fn keep(&mut self, expr: ExprId, found: Enclosure, system: &System) {
        self.found.insert(expr, found);
        let mut bases: Vec<SymbolId> = system
            .mechanism
            .graph
            .symbols(expr)
            .iter()
            .map(|&it| base(it, system))
            .collect();
        bases.sort_unstable();
        bases.dedup();
        for symbol in bases {
            self.resting.entry(symbol).or_default().push(expr);
        }
    }

    /// The bounds of an expression.
    pub fn of(&mut self, expr: ExprId, system: &mut System) -> Enclosure {
        if let Some(&found) = self.found.get(&expr) {
            return found;
        }
        let graph = &mut system.mechanism.graph;
        let found = match graph.node(expr).clone() {
            _ if graph.is_fixed(expr) => still(graph),
            Node::Number(_) | Node::Pi => still(graph),
            Node::Symbol(symbol) => self.of_symbol(symbol, system),
            Node::Sum(terms) => self.of_sum(&terms, system),
            Node::Product(factors) => self.of_product(&factors, system),
            Node::Sin(x) | Node::Cos(x) => {
                let inner = self.of(x, system);
                let one = system.mechanism.graph.one();
                self.composed(inner, [one, one], system)
            }
            Node::Exp(x) => {
                let inner = self.of(x, system);
                let graph = &mut system.mechanism.graph;
                let largest = graph.add(x, inner.radius);
                let slope = graph.exp(largest);
                self.composed(inner, [slope, slope], system)
            }
            Node::Ln(x) => {
                let inner = self.of(x, system);
                let least = self.least(x, inner, system);
                let graph = &mut system.mechanism.graph;
                let slopes = [-1, -2].map(|power| graph.power(least, Rational::integer(power)));
                self.composed(inner, slopes, system)
            }
            Node::Atan2(y, x) => self.of_arctangent(y, x, system),
            Node::Floor(x) => {
                let inner = self.of(x, system);
                self.require_between_integers(x, inner.radius, system);
                still(&system.mechanism.graph)
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => match graph.magnitude_of(expr) {
                Some(x) => self.of_magnitude(x, system),
                None => self.of_choice(expr, [condition, below, otherwise], system),
            },
            Node::Spline {
                spline,
                order,
                argument,
            } => self.of_spline(spline, order, argument, system),
        };
        self.keep(expr, found, system);
        found
    }

    fn of_symbol(&mut self, symbol: SymbolId, system: &mut System) -> Enclosure {
        if let Some(&known) = self.known.get(&symbol) {
            return known;
        }
        let Some((angle, amplitude)) = arm(symbol, system) else {
            unreachable!(
                "`{}` has no bounds",
                system.mechanism.graph.symbol_name(symbol)
            )
        };
        self.of_turned(angle, amplitude, system)
    }

    /// A wave a cos φ + b sin φ, whose derivatives in φ are at most √(a² + b²).
    fn of_turned(&mut self, angle: usize, amplitude: Amplitude, system: &mut System) -> Enclosure {
        let turning = system.vector_form.unknowns[angle].position;
        let turning = self.of_symbol(turning, system);
        let length = length(amplitude, &mut system.mechanism.graph);
        self.composed(turning, [length, length], system)
    }
}

fn still(graph: &Graph) -> Enclosure {
    Enclosure {
        radius: graph.zero(),
        deviation: graph.zero(),
    }
}
