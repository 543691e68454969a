//! Constant parts of expressions → literals and named constants.

use std::collections::{HashMap, HashSet};

use linkwright_math::double;

use super::costs::Computed;
use crate::expr::{ExprId, Factor, Graph, Node, Number, Term};
use crate::program::function::Function;
use crate::system::System;

/// The longest name of a constant, in characters; others are written as literals.
const LONGEST_NAME: usize = 28;

/// A constant part: what one multiplication or addition of generated code takes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ConstantPart {
    /// A sum of constant terms, the first one positive.
    Sum(Vec<Term>),
    /// A positive number times powers of constant expressions.
    Product(Number, Vec<Factor>),
}

/// A named constant of the generated module.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// `SQRT_3`.
    pub name: String,
    /// What it stands for, exactly.
    pub part: ConstantPart,
    /// Its value, rounded.
    pub value: f64,
}

/// The constants of a module in the order of their first use.
#[derive(Clone, Debug, Default)]
pub struct Constants {
    list: Vec<Constant>,
    // Looked up, never iterated.
    places: HashMap<ConstantPart, usize>,
    names: HashSet<String>,
    unnamed: usize,
}

impl ConstantPart {
    /// The exact number, if the part is nothing else.
    fn number(&self, graph: &Graph) -> Option<Number> {
        match self {
            ConstantPart::Sum(terms) => match terms.as_slice() {
                [Term { coefficient, expr }] if *expr == graph.one() => Some(*coefficient),
                _ => None,
            },
            ConstantPart::Product(number, factors) => factors.is_empty().then_some(*number),
        }
    }

    /// The value as a literal: only numbers whose decimal digits end are written in place.
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

    /// The rounded value.
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

    /// A name that says what it is: `SQRT_3_OVER_2`, `PI_OVER_6`; none for longer expressions.
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
        let mut words = Vec::new();
        if pi {
            words.push("PI".to_string());
        }
        if radicand != 1 {
            words.push(format!("SQRT_{radicand}"));
        }
        if words.is_empty() {
            words.push(format!("RATIO_{numerator}"));
        } else if numerator != 1 {
            words.push(format!("TIMES_{numerator}"));
        }
        if denominator != 1 {
            words.push(format!("OVER_{denominator}"));
        }
        let name = words.join("_");
        (name.len() <= LONGEST_NAME).then_some(name)
    }
}

impl Constants {
    /// The constants in the order of their first use.
    pub fn list(&self) -> &[Constant] {
        &self.list
    }

    /// Place of a part in [`Constants::list`]; `None` if the part is a literal.
    pub fn place_of(&self, part: &ConstantPart) -> Option<usize> {
        self.places.get(part).copied()
    }

    /// Names the constants that a function is written with.
    pub(in crate::program) fn note(&mut self, function: &Function, system: &System) {
        let computed = Computed { function, system };
        computed.addends(&mut |parts| {
            for constant in parts.iter().filter_map(|part| part.constant.as_ref()) {
                self.add(constant, &system.mechanism.graph);
            }
        });
    }

    /// Gives a part its name, unless it is a literal or has one.
    fn add(&mut self, part: &ConstantPart, graph: &Graph) {
        if self.places.contains_key(part) || part.literal(graph).is_some() {
            return;
        }
        let speaking = part
            .speaking_name(graph)
            .filter(|name| !self.names.contains(name));
        let name = speaking.unwrap_or_else(|| {
            self.unnamed += 1;
            format!("CONSTANT_{}", self.unnamed)
        });
        self.names.insert(name.clone());
        self.places.insert(part.clone(), self.list.len());
        self.list.push(Constant {
            name,
            part: part.clone(),
            value: part.value(graph),
        });
    }
}
