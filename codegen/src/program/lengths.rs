//! Equations → the lengths that say how large their mechanism is, which lengths are scaled by.
//!
//! Only what the equations contain counts: the arms of their links, the amplitudes of their sines, the lengths added to them.
//! What is drawn elsewhere changes nothing. The module does not know what is decided with the scaled lengths.

use std::collections::HashSet;

use super::function::Function;
use super::lower::shared;
use crate::expr::{ExprId, Graph, Node};
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::system::{SymbolRole, System};

/// Lengths, in m, the largest of which others are scaled by.
#[derive(Clone, Debug, PartialEq)]
pub struct Lengths {
    /// The largest at the nominal values of the parameters, positive.
    pub nominal: f64,
    /// The largest that no parameter changes, where there is one, and all that parameters change; none where they change none.
    pub following: Option<Function>,
}

impl Lengths {
    /// Those of the whole mechanism, which the textbook view is scaled by.
    pub(super) fn of_system(system: &mut System) -> Lengths {
        let nominal = system.characteristic_length();
        let following = system.lengths.clone();
        Lengths {
            nominal,
            following: (!following.is_empty()).then(|| shared(following, system)),
        }
    }

    /// Those by which the residuals and the unknowns of a block are scaled.
    ///
    /// Unknowns change by parts of the arms. Residuals are rounded as their largest terms are, which is more where a loop is
    /// closed far from the origin.
    pub fn of_block(
        residuals: &[ExprId],
        quantities: &[Quantity],
        system: &mut System,
    ) -> [Lengths; 2] {
        let mut arms: Vec<ExprId> = arms(residuals, system).into_iter().flatten().collect();
        let mut added = Vec::new();
        let graph = &mut system.mechanism.graph;
        for (&residual, quantity) in residuals.iter().zip(quantities) {
            match quantity.power_of_length() {
                1 => collect(residual, &mut arms, &mut added, graph),
                2 => {
                    let mut areas = Vec::new();
                    collect(residual, &mut Vec::new(), &mut areas, graph);
                    added.extend(areas.iter().filter_map(|&area| side(area, graph)));
                }
                _ => {}
            }
        }
        let mut columns = Largest::of(&arms, graph);
        if columns.nominal(graph) == 0.0 {
            columns = Largest::of(&added, graph);
        }
        let every: Vec<ExprId> = arms.iter().chain(&added).copied().collect();
        let rows = Largest::of(&every, graph);
        // An estimate may stay behind when parameters change.
        let place = match rows.following.is_empty() {
            true => largest_drawn(residuals, system),
            false => 0.0,
        };
        let otherwise = system.characteristic_length();
        [(rows, place), (columns, 0.0)].map(|(lengths, place)| {
            let found = lengths.nominal(&system.mechanism.graph).max(place);
            let nominal = if found > 0.0 { found } else { otherwise };
            let following = match lengths.following.is_empty() {
                true => None,
                false => Some(shared(lengths.all(), system)),
            };
            Lengths { nominal, following }
        })
    }

    /// What values of a quantity are scaled by, at the nominal values of the parameters.
    pub fn scale(&self, quantity: Quantity) -> f64 {
        self.nominal.powi(quantity.power_of_length())
    }
}

/// The arms that occur in expressions, in their bodies.
fn arms(expressions: &[ExprId], system: &System) -> Vec<Vector> {
    let graph = &system.mechanism.graph;
    let symbols = expressions.iter().flat_map(|&it| graph.symbols(it));
    let places = symbols.filter_map(|symbol| match system.roles.get(symbol.index()) {
        Some(SymbolRole::Arm(place)) => Some(*place),
        _ => None,
    });
    let mut known = HashSet::new();
    places
        .filter(|place| known.insert(*place))
        .map(|place| system.vector_form.arms[place].local)
        .collect()
}

/// What multiplies sines and cosines in a sum, and what is added to it.
fn collect(
    residual: ExprId,
    amplitudes: &mut Vec<ExprId>,
    added: &mut Vec<ExprId>,
    graph: &mut Graph,
) {
    if graph.is_fixed(residual) {
        added.push(residual);
        return;
    }
    let Node::Sum(terms) = graph.node(residual) else {
        return;
    };
    for term in terms.clone() {
        if graph.is_fixed(term.expr) {
            added.push(graph.scale(term.coefficient, term.expr));
            continue;
        }
        let (mut fixed, mut turned) = (Vec::new(), false);
        match graph.node(term.expr) {
            Node::Sin(_) | Node::Cos(_) => turned = true,
            Node::Product(factors) => {
                let factors = factors.clone();
                turned = factors.iter().all(|factor| {
                    let wave = matches!(graph.node(factor.base), Node::Sin(_) | Node::Cos(_));
                    wave || graph.is_fixed(factor.base)
                });
                for factor in factors.iter().filter(|it| graph.is_fixed(it.base)) {
                    fixed.push((factor.base, factor.exponent));
                }
            }
            _ => {}
        }
        if turned {
            let fixed: Vec<ExprId> = fixed
                .into_iter()
                .map(|(base, exponent)| graph.power(base, exponent))
                .collect();
            let product = graph.product(&fixed);
            amplitudes.push(graph.scale(term.coefficient, product));
        }
    }
}

/// The side of a square of this area; `None` where parameters decide whether there is one.
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

/// How far from the origin the drawing places what expressions hold.
fn largest_drawn(expressions: &[ExprId], system: &System) -> f64 {
    let graph = &system.mechanism.graph;
    let symbols = expressions.iter().flat_map(|&it| graph.symbols(it));
    let places = symbols.filter_map(|symbol| match system.roles.get(symbol.index()) {
        Some(SymbolRole::Position(unknown)) => Some(*unknown),
        _ => None,
    });
    let unknowns = &system.vector_form.unknowns;
    let lengths = places.filter(|&it| unknowns[it].quantity == Quantity::Length);
    lengths
        .map(|it| system.drawn_unknown(it).abs())
        .filter(|it| it.is_finite())
        .fold(0.0, f64::max)
}

/// The largest constant of some lengths, and those that follow parameters, each once.
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
