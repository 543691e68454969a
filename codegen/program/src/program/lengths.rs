//! Finds the lengths whose maximum scales all lengths of some equations.
//!
//! These lengths are in the equations: vectors of links, amplitudes of sines, added lengths. Other parts of the design
//! configuration have no effect.

use std::collections::HashSet;

use super::function::Function;
use super::lower::shared;
use crate::expr::{ExprId, Graph, Node, Rational};
use crate::joint::Quantity;
use crate::pool::{Pool, SymbolRole};
use crate::system::System;

/// Lengths, in m; the largest is the scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Lengths {
    /// Largest length at the nominal values of the parameters, positive.
    pub nominal: f64,
    /// Largest constant length, if any, and all lengths that depend on parameters; `None` if no length does.
    pub following: Option<Function>,
}

impl Lengths {
    /// Returns the lengths of the whole mechanism, which scale the textbook formulation.
    pub(super) fn of_system(pool: &mut Pool, system: &System) -> Lengths {
        let nominal = system.characteristic_length(pool);
        let following = system.lengths.to_vec();
        Lengths {
            nominal,
            following: (!following.is_empty()).then(|| shared(following, pool, system)),
        }
    }

    /// Returns the lengths that scale the residuals and the unknowns of a block.
    ///
    /// Unknowns change by fractions of the links. Rounding of residuals is proportional to their largest terms, which are larger
    /// in loops far from the origin.
    pub fn of_block(
        residuals: &[ExprId],
        quantities: &[Quantity],
        pool: &mut Pool,
        system: &System,
    ) -> [Lengths; 2] {
        let mut collected = Collected::default();
        for (&residual, quantity) in residuals.iter().zip(quantities) {
            let one = pool.graph.one();
            match quantity.power_of_length() {
                1 => collected.collect(residual, one, false, pool, system),
                2 => {
                    let mut areas = Collected::default();
                    areas.collect(residual, one, false, pool, system);
                    let graph = &mut pool.graph;
                    let sides = areas.added.iter().filter_map(|&area| side(area, graph));
                    collected.added.extend(sides);
                }
                _ => {}
            }
        }
        let Collected { arms, added } = collected;
        let graph = &pool.graph;
        let mut columns = Largest::of(&arms, graph);
        if columns.nominal(graph) == 0.0 {
            columns = Largest::of(&added, graph);
        }
        let every: Vec<ExprId> = arms.iter().chain(&added).copied().collect();
        let rows = Largest::of(&every, graph);
        // An estimate may not follow a change of parameters.
        let place = match rows.following.is_empty() {
            true => largest_drawn(residuals, pool, system),
            false => 0.0,
        };
        let otherwise = system.characteristic_length(pool);
        [(rows, place), (columns, 0.0)].map(|(lengths, place)| {
            let largest = lengths.nominal(&pool.graph).max(place);
            let nominal = if largest > 0.0 { largest } else { otherwise };
            let following = match lengths.following.is_empty() {
                true => None,
                false => Some(shared(lengths.all(), pool, system)),
            };
            Lengths { nominal, following }
        })
    }

    /// Returns the scale of a quantity, at the nominal values of the parameters.
    pub fn scale(&self, quantity: Quantity) -> f64 {
        self.nominal.powi(quantity.power_of_length())
    }
}

/// Lengths of equations.
#[derive(Default)]
struct Collected {
    /// Rotated lengths, and amplitudes of sines.
    arms: Vec<ExprId>,
    /// Added lengths that neither rotate nor oscillate.
    added: Vec<ExprId>,
}

/// Kind of a factor.
enum Part {
    /// Number or parameter.
    Fixed(ExprId),
    /// Sine or cosine, at most 1.
    Wave,
    /// Component of a rotated vector, an index into the vector form.
    Arm(usize),
    /// Sum.
    Sum(ExprId),
    Other,
}

impl Collected {
    /// Collects lengths from `factor` times an expression; `swings` is true if the factor has a sine.
    fn collect(
        &mut self,
        expr: ExprId,
        factor: ExprId,
        swings: bool,
        pool: &mut Pool,
        system: &System,
    ) {
        match part(expr, pool) {
            Part::Fixed(value) => {
                let value = pool.graph.multiply(factor, value);
                let list = if swings {
                    &mut self.arms
                } else {
                    &mut self.added
                };
                list.push(value);
            }
            Part::Wave => self.arms.push(factor),
            Part::Arm(place) => {
                let local = pool.arms()[place].local;
                let graph = &mut pool.graph;
                self.arms.extend(local.map(|it| graph.multiply(factor, it)));
            }
            Part::Sum(sum) => {
                let Node::Sum(terms) = pool.graph.node(sum) else {
                    return;
                };
                for term in terms.clone().iter() {
                    let factor = pool.graph.scale(term.coefficient, factor);
                    self.collect(term.expr, factor, swings, pool, system);
                }
            }
            Part::Other => self.collect_product(expr, factor, swings, pool, system),
        }
    }

    /// Collects lengths from a product of sines and at most one vector component or sum. Other products need not be lengths.
    fn collect_product(
        &mut self,
        expr: ExprId,
        factor: ExprId,
        swings: bool,
        pool: &mut Pool,
        system: &System,
    ) {
        let Node::Product(factors) = pool.graph.node(expr) else {
            return;
        };
        let (mut factor, mut swings, mut carrier) = (factor, swings, None);
        for own in factors.clone().iter() {
            match part(own.base, pool) {
                Part::Fixed(value) => {
                    let graph = &mut pool.graph;
                    let power = graph.power(value, own.exponent);
                    factor = graph.multiply(factor, power);
                }
                Part::Wave => swings = true,
                Part::Arm(_) | Part::Sum(_)
                    if carrier.is_none() && own.exponent == Rational::ONE =>
                {
                    carrier = Some(own.base);
                }
                _ => return,
            }
        }
        match carrier {
            Some(carrier) => self.collect(carrier, factor, swings, pool, system),
            None => self.arms.push(factor),
        }
    }
}

fn part(expr: ExprId, pool: &Pool) -> Part {
    let graph = &pool.graph;
    if graph.is_fixed(expr) {
        return Part::Fixed(expr);
    }
    match graph.node(expr) {
        Node::Sin(_) | Node::Cos(_) => Part::Wave,
        Node::Sum(_) => Part::Sum(expr),
        Node::Symbol(symbol) => match pool.role(*symbol) {
            SymbolRole::Arm(place) => Part::Arm(place),
            _ => Part::Other,
        },
        _ => Part::Other,
    }
}

/// Returns the side of a square of this area; `None` if parameters decide whether the area is positive.
fn side(area: ExprId, graph: &mut Graph) -> Option<ExprId> {
    let value = graph.constant_value(area)?;
    let area = if value < 0.0 {
        graph.negate(area)
    } else {
        area
    };
    let side = graph.sqrt(area);
    graph.is_finite(side).then_some(side)
}

/// Returns the largest distance from the origin of the expressions' points in the design configuration.
fn largest_drawn(expressions: &[ExprId], pool: &Pool, system: &System) -> f64 {
    let graph = &pool.graph;
    let symbols = expressions.iter().flat_map(|&it| graph.symbols(it));
    let places = symbols.filter_map(|symbol| match pool.role(*symbol) {
        SymbolRole::Position(unknown) => Some(unknown),
        _ => None,
    });
    let unknowns = &system.vector_form.unknowns;
    let lengths = places.filter(|&it| unknowns[it].quantity == Quantity::Length);
    lengths
        .map(|it| system.drawn_unknown(it, pool).abs())
        .filter(|it| it.is_finite())
        .fold(0.0, f64::max)
}

/// Largest constant length, and each length that depends on parameters once.
struct Largest {
    constant: Option<ExprId>,
    following: Vec<ExprId>,
}

impl Largest {
    fn of(lengths: &[ExprId], graph: &Graph) -> Largest {
        let value = |expr: ExprId| graph.constant_value(expr).map(f64::abs);
        let mut largest = Largest {
            constant: None,
            following: Vec::new(),
        };
        let mut known = HashSet::new();
        for &length in lengths.iter().filter(|&&it| graph.is_fixed(it)) {
            if !graph.is_constant(length) {
                if known.insert(length) {
                    largest.following.push(length);
                }
            } else if value(length) > largest.constant.and_then(value).or(Some(0.0)) {
                largest.constant = Some(length);
            }
        }
        largest
    }

    fn all(&self) -> Vec<ExprId> {
        self.constant
            .iter()
            .chain(&self.following)
            .copied()
            .collect()
    }

    fn nominal(&self, graph: &Graph) -> f64 {
        let values = self.all();
        let values = values.iter().filter_map(|&it| graph.constant_value(it));
        values
            .map(f64::abs)
            .filter(|it| it.is_finite())
            .fold(0.0, f64::max)
    }
}
