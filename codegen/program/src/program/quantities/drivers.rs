//! Names the constants of drivers: initial values, rates, amplitudes and angular frequencies; and given positions.

use super::{Quantities, upper};
use crate::expr::{ExprId, Graph, Node, SymbolId, Term};
use crate::model::Role;
use crate::pool::Pool;
use crate::system::System;

/// Adds the constants of all drivers.
pub(super) fn add(list: &mut Quantities, pool: &Pool, system: &System) {
    let mechanism = &system.mechanism;
    for row in system.rows.iter() {
        let joint = &mechanism.joints[row.joint];
        if joint.role == Role::Driver || joint.kind.keyword.starts_with("absolute") {
            let driver = Driver {
                stem: stem(&row.name),
                label: &joint.label,
                time: mechanism.time,
                graph: &pool.graph,
            };
            driver.add(row.residual, list);
        }
    }
}

/// Returns the row's name as part of a constant's name: `PHI_CRANK` for `drive_phi_crank`.
fn stem(row: &str) -> String {
    let name = upper(row);
    let short = name.strip_prefix("DRIVE_").map(str::to_string);
    short.unwrap_or(name)
}

struct Driver<'a> {
    stem: String,
    label: &'a str,
    time: SymbolId,
    graph: &'a Graph,
}

impl Driver<'_> {
    fn add(&self, residual: ExprId, list: &mut Quantities) {
        let Node::Sum(terms) = self.graph.node(residual) else {
            return;
        };
        let (constant, others): (Vec<_>, Vec<_>) = terms
            .iter()
            .partition(|term| self.graph.is_constant(term.expr));
        let label = self.label;
        if !constant.is_empty() {
            let worth = |it: &&Term| {
                let value = self.graph.constant_value(it.expr).unwrap_or(f64::NAN);
                it.coefficient.to_f64() * value
            };
            let start: f64 = constant.iter().map(worth).sum();
            let mut timed = others.iter().filter(|term| self.is_timed(term.expr));
            let (suffix, words) = match timed.all(|term| self.starts_at_zero(term.expr)) {
                _ if others.iter().all(|term| !self.is_timed(term.expr)) => {
                    ("_POSITION", format!("position of {label}"))
                }
                true => ("_START", format!("initial value of {label}")),
                false => ("_DRIVE_OFFSET", format!("constant term of {label}")),
            };
            list.add(["", suffix], &self.stem, words, -start);
        }
        for term in others {
            let coefficient = -term.coefficient.to_f64();
            match self.graph.node(term.expr) {
                Node::Symbol(symbol) if *symbol == self.time => {
                    let words = format!("rate of {label}");
                    list.add(["", "_RATE"], &self.stem, words, coefficient);
                }
                Node::Sin(argument) | Node::Cos(argument) => {
                    self.add_wave(coefficient, *argument, list);
                }
                Node::Product(factors) => {
                    let (mut scale, mut wave) = (Some(coefficient), None);
                    for factor in factors.iter() {
                        let exponent = factor.exponent.to_f64();
                        match (
                            self.graph.node(factor.base),
                            self.graph.is_constant(factor.base),
                        ) {
                            (_, true) => {
                                let value = self.graph.constant_value(factor.base);
                                let value = value.map(|it| it.powf(exponent));
                                scale = scale.zip(value).map(|(a, b)| a * b);
                            }
                            (Node::Sin(argument) | Node::Cos(argument), _) if exponent == 1.0 => {
                                wave = Some(*argument);
                            }
                            (Node::Symbol(symbol), _)
                                if *symbol == self.time && exponent == 1.0 => {}
                            _ => scale = None,
                        }
                    }
                    let words = format!("rate of {label}");
                    match (scale, wave) {
                        (Some(scale), Some(argument)) => self.add_wave(scale, argument, list),
                        (Some(scale), None) => list.add(["", "_RATE"], &self.stem, words, scale),
                        _ => {}
                    }
                }
                _ => {}
            }
        }
    }

    /// Adds amplitude and angular frequency of a sine, with the amplitudes of rate and acceleration.
    fn add_wave(&self, amplitude: f64, argument: ExprId, list: &mut Quantities) {
        let Some(frequency) = self.slope(argument) else {
            return;
        };
        let label = self.label;
        let stem = &self.stem;
        list.add(
            ["", "_AMPLITUDE"],
            stem,
            format!("amplitude of {label}"),
            amplitude,
        );
        let words = format!("angular frequency of {label}");
        list.add(["", "_FREQUENCY"], stem, words, frequency);
        if let Node::Sum(terms) = self.graph.node(argument) {
            let constant = terms.iter().filter(|it| self.graph.is_constant(it.expr));
            let worth = |it: &Term| {
                let value = self.graph.constant_value(it.expr).unwrap_or(f64::NAN);
                it.coefficient.to_f64() * value
            };
            let phase = constant.map(worth).sum();
            list.add(["", "_PHASE"], stem, format!("phase of {label}"), phase);
        }
        let rate = amplitude * frequency;
        let words = format!("amplitude of the rate of {label}");
        list.add(["", "_RATE_AMPLITUDE"], stem, words, rate);
        let words = format!("amplitude of the acceleration of {label}");
        list.add(
            ["", "_ACCELERATION_AMPLITUDE"],
            stem,
            words,
            rate * frequency,
        );
        let words = format!("squared angular frequency of {label}");
        list.add(
            ["", "_FREQUENCY_SQUARED"],
            stem,
            words,
            frequency * frequency,
        );
    }

    /// Returns the factor of t in a linear function of t.
    fn slope(&self, argument: ExprId) -> Option<f64> {
        let of_term = |expr: ExprId| match self.graph.node(expr) {
            Node::Symbol(symbol) => (*symbol == self.time).then_some(1.0),
            Node::Product(factors) => {
                let mut slope = 1.0;
                for factor in factors.iter() {
                    let exponent = factor.exponent.to_f64();
                    if self.graph.is_constant(factor.base) {
                        slope *= self.graph.constant_value(factor.base)?.powf(exponent);
                    } else if *self.graph.node(factor.base) != Node::Symbol(self.time)
                        || exponent != 1.0
                    {
                        return None;
                    }
                }
                Some(slope)
            }
            _ => None,
        };
        match self.graph.node(argument) {
            Node::Sum(terms) => {
                let moving = terms
                    .iter()
                    .filter(|term| !self.graph.is_constant(term.expr));
                let mut moving =
                    moving.map(|term| Some(term.coefficient.to_f64() * of_term(term.expr)?));
                let slope = moving.next()??;
                moving.next().is_none().then_some(slope)
            }
            _ => of_term(argument),
        }
    }

    fn is_timed(&self, expr: ExprId) -> bool {
        self.graph.symbols(expr).contains(&self.time)
    }

    /// True if an expression vanishes at t = 0 for every value of its other symbols.
    fn starts_at_zero(&self, expr: ExprId) -> bool {
        match self.graph.node(expr) {
            Node::Symbol(symbol) => *symbol == self.time,
            Node::Sin(argument) => self.starts_at_zero(*argument),
            Node::Sum(terms) => terms.iter().all(|term| self.starts_at_zero(term.expr)),
            Node::Product(factors) => {
                let mut factors = factors.iter();
                factors.any(|it| it.exponent.to_f64() > 0.0 && self.starts_at_zero(it.base))
            }
            _ => false,
        }
    }
}
