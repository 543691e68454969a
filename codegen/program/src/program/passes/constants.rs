//! Writes constant parts of expressions as literals and named constants.
//!
//! The name of a constant is the quantity that the constant is in the description or in the derivation of its block. Other
//! numbers are literals, except for short roots and multiples of π.

use std::collections::HashMap;

use linkwright_math::double;

use super::costs::Computed;
use crate::expr::{ExprId, Factor, Graph, Node, Number, SymbolId, Term};
use crate::pool::{Pool, SymbolRole};
use crate::program::addends::Addend;
use crate::program::function::Function;
use crate::program::quantities::{Described, Quantities, Quantity, upper};
use crate::system::System;

/// Length of the longest name of a root, in characters; others are written as literals.
const LONGEST_NAME: usize = 28;

/// Constant part: one operand of a multiplication or addition in generated code.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ConstantPart {
    /// Sum of constant terms, the first one positive.
    Sum(Vec<Term>),
    /// Positive number times powers of constant expressions.
    Product(Number, Vec<Factor>),
}

/// Named constant of the generated module.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// Name such as `COUPLER_LENGTH` or `SQRT_3`.
    pub name: String,
    /// Quantity in the names of the description: `|BC|`; `None` if the name says the value.
    pub meaning: Option<String>,
    /// Exact value.
    pub part: ConstantPart,
    /// Rounded value.
    pub value: f64,
}

/// Constants of a module in the order of their first use.
#[derive(Clone, Debug, Default)]
pub struct Constants {
    list: Vec<Constant>,
    described: Described,
    /// Names of the unknowns.
    unknowns: Vec<String>,
    // Looked up, never iterated: places by preferred name and value.
    places: HashMap<(String, ConstantPart), usize>,
    // Values by name.
    taken: HashMap<String, u64>,
}

/// Occurrence of a constant.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) struct Occurrence<'a> {
    function: &'a Function,
    /// Angle whose sine or cosine the constant multiplies, if any.
    angle: Option<usize>,
    /// Name of the target of the statement; empty if there is none.
    target: &'a str,
    /// True if the constant is a whole term.
    is_term: bool,
    /// Unknown whose value has the constant as a term, if any.
    unknown: Option<usize>,
}

impl ConstantPart {
    /// Returns the exact number; `None` if the part has other terms or factors.
    fn number(&self, graph: &Graph) -> Option<Number> {
        match self {
            ConstantPart::Sum(terms) => match terms.as_slice() {
                [Term { coefficient, expr }] if *expr == graph.one() => Some(*coefficient),
                _ => None,
            },
            ConstantPart::Product(number, factors) => factors.is_empty().then_some(*number),
        }
    }

    /// Returns the value as a literal; `None` if the number is not a terminating decimal.
    pub fn literal(&self, graph: &Graph) -> Option<f64> {
        match self.number(graph)? {
            Number::Float(value) => Some(value),
            number @ Number::Exact {
                rational,
                radicand: 1,
            } => {
                let mut rest = rational.denominator();
                for prime in [2, 5] {
                    while rest % prime == 0 {
                        rest /= prime;
                    }
                }
                (rest == 1).then(|| number.to_f64())
            }
            Number::Exact { .. } => None,
        }
    }

    /// Returns the rounded value.
    pub fn value(&self, graph: &Graph) -> f64 {
        // Every constant was found to be finite when it was read.
        let of = |expr: ExprId| graph.constant_value(expr).unwrap_or(f64::NAN);
        match self {
            ConstantPart::Sum(terms) => terms
                .iter()
                .map(|term| term.coefficient.to_f64() * of(term.expr))
                .sum(),
            ConstantPart::Product(number, factors) => factors
                .iter()
                .map(|factor| double::powf(of(factor.base), factor.exponent.to_f64()))
                .fold(number.to_f64(), |product, factor| product * factor),
        }
    }

    /// Returns a name that says the value: `SQRT_3_OVER_2`, `PI_OVER_6`, `ANGLE_40_DEGREES`; `None` if digits say as much.
    fn speaking_name(&self, graph: &Graph) -> Option<String> {
        let (number, pi) = match self {
            ConstantPart::Sum(terms) => match terms.as_slice() {
                [Term { coefficient, expr }] if *expr == graph.one() => (*coefficient, false),
                [Term { coefficient, expr }] if *graph.node(*expr) == Node::Pi => {
                    (*coefficient, true)
                }
                _ => return None,
            },
            ConstantPart::Product(number, factors) if factors.is_empty() => (*number, false),
            ConstantPart::Product(..) => return None,
        };
        let Number::Exact { rational, radicand } = number else {
            return None;
        };
        let (numerator, denominator) = (rational.numerator(), rational.denominator());
        let half_turn = 180;
        let name = match (pi, radicand) {
            (true, 1) if numerator == 1 => format!("PI_{}", over(denominator)),
            (true, 1) if half_turn % denominator == 0 => {
                format!("ANGLE_{}_DEGREES", numerator * (half_turn / denominator))
            }
            (false, 2..) if numerator == 1 => format!("SQRT_{radicand}_{}", over(denominator)),
            (false, 2..) => format!("SQRT_{radicand}_TIMES_{numerator}_{}", over(denominator)),
            _ => return None,
        };
        let name = name.trim_end_matches('_').to_string();
        (name.len() <= LONGEST_NAME).then_some(name)
    }
}

fn over(denominator: i128) -> String {
    match denominator {
        1 => String::new(),
        _ => format!("OVER_{denominator}"),
    }
}

impl<'a> Occurrence<'a> {
    /// Returns the occurrence of the constant factor of an addend in the value of `target`.
    pub fn of(
        addend: &Addend,
        target: Option<SymbolId>,
        function: &'a Function,
        pool: &'a Pool,
    ) -> Occurrence<'a> {
        let graph = &pool.graph;
        let unknown = |symbol: SymbolId| match pool.role(symbol) {
            SymbolRole::Position(unknown) => Some(unknown),
            _ => None,
        };
        let turning = |base: ExprId| match *graph.node(base) {
            Node::Sin(angle) | Node::Cos(angle) => match *graph.node(angle) {
                Node::Symbol(symbol) => unknown(symbol),
                _ => None,
            },
            _ => None,
        };
        let of_arm = |target: SymbolId| match pool.role(target) {
            SymbolRole::Arm(place) => Some(pool.arms()[place].angle),
            _ => None,
        };
        let angle = addend.factors.iter().find_map(|it| turning(it.base));
        let is_term = addend.factors.is_empty() && addend.divisors.is_empty();
        Occurrence {
            function,
            angle: angle.or_else(|| of_arm(target?)),
            target: target.map_or("", |target| pool.local_name(target)),
            is_term,
            unknown: target.and_then(unknown).filter(|_| is_term),
        }
    }
}

impl Constants {
    /// Returns no constants yet, with the quantities that may name them.
    pub(in crate::program) fn new(pool: &Pool, system: &System) -> Constants {
        Constants {
            described: Described::of(pool, system),
            unknowns: system
                .vector_form
                .unknowns
                .iter()
                .map(|it| it.name.clone())
                .collect(),
            ..Constants::default()
        }
    }

    /// Returns the constants in the order of their first use.
    pub fn list(&self) -> &[Constant] {
        &self.list
    }

    /// Returns the index of a part in [`Constants::list`]; `None` if the part is a literal.
    pub(in crate::program) fn place_of(
        &self,
        part: &ConstantPart,
        occurrence: Occurrence<'_>,
        graph: &Graph,
    ) -> Option<usize> {
        let (name, _) = self.name_of(part, occurrence, graph)?;
        self.places.get(&(name, part.clone())).copied()
    }

    /// Names the constants of a function.
    pub(in crate::program) fn note(&mut self, function: &Function, pool: &Pool, system: &System) {
        let computed = Computed {
            function,
            pool,
            system,
        };
        computed.addends(&mut |target, parts| {
            for addend in parts {
                if let Some(constant) = &addend.constant {
                    let occurrence = Occurrence::of(addend, target, function, pool);
                    self.add(constant, occurrence, &pool.graph);
                }
            }
        });
    }

    /// Returns the preferred name of a part with its meaning; `None` if the part is a literal.
    fn name_of(
        &self,
        part: &ConstantPart,
        occurrence: Occurrence<'_>,
        graph: &Graph,
    ) -> Option<(String, Option<String>)> {
        if let Some(quantity) = self.quantity(part, occurrence, graph) {
            return Some((quantity.name(), Some(quantity.words())));
        }
        if part.literal(graph).is_some() {
            return None;
        }
        if let Some(unknown) = occurrence.unknown {
            let name = &self.unknowns[unknown];
            let stem = upper(name);
            return Some((
                format!("{stem}_OFFSET"),
                Some(format!("constant term of {name}")),
            ));
        }
        part.speaking_name(graph).map(|name| (name, None))
    }

    /// Returns the quantity that a part is; `None` if none is known.
    fn quantity(
        &self,
        part: &ConstantPart,
        occurrence: Occurrence<'_>,
        graph: &Graph,
    ) -> Option<Quantity> {
        let value = part.value(graph);
        let described = &self.described;
        let of_body =
            |lists: &HashMap<usize, Quantities>| lists.get(&occurrence.angle?)?.find(value);
        let quantities = &occurrence.function.quantities;
        let known =
            of_body(&described.rods).or_else(|| quantities.find_within(value, occurrence.target));
        // A short decimal may occur with another meaning.
        if known.is_some() || part.literal(graph).is_some() {
            return known;
        }
        if let Some(known) = quantities.find(value) {
            return Some(known);
        }
        let of_term = || described.terms.find(value).filter(|_| occurrence.is_term);
        of_body(&described.coordinates)
            .or_else(of_term)
            .or_else(|| described.general.find(value))
    }

    /// Names a part, unless it is a literal or has a name.
    fn add(&mut self, part: &ConstantPart, occurrence: Occurrence<'_>, graph: &Graph) {
        let Some((preferred, meaning)) = self.name_of(part, occurrence, graph) else {
            return;
        };
        let key = (preferred, part.clone());
        if self.places.contains_key(&key) {
            return;
        }
        let value = part.value(graph);
        let mut name = key.0.clone();
        let mut number = 2;
        while self
            .taken
            .get(&name)
            .is_some_and(|bits| *bits != value.to_bits())
        {
            name = format!("{}_{number}", key.0);
            number += 1;
        }
        let place = match self.taken.insert(name.clone(), value.to_bits()) {
            None => {
                self.list.push(Constant {
                    name,
                    meaning,
                    part: part.clone(),
                    value,
                });
                self.list.len() - 1
            }
            Some(_) => self.list.iter().position(|it| it.name == name).unwrap_or(0),
        };
        self.places.insert(key, place);
    }
}
