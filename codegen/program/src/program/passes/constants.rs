//! Writes constant parts of expressions as literals and named constants.

use std::collections::{HashMap, HashSet};

use linkwright_math::double;

use super::costs::Computed;
use crate::expr::{ExprId, Factor, Graph, Node, Number, Term};
use crate::pool::Pool;
use crate::program::function::Function;
use crate::system::System;

/// Length of the longest name of a constant, in characters; others are written as literals.
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
    /// Name such as `SQRT_3`.
    pub name: String,
    /// Exact value.
    pub part: ConstantPart,
    /// Rounded value.
    pub value: f64,
}

/// Constants of a module in the order of their first use.
#[derive(Clone, Debug, Default)]
pub struct Constants {
    list: Vec<Constant>,
    // Looked up, never iterated.
    places: HashMap<ConstantPart, usize>,
    names: HashSet<String>,
    unnamed: usize,
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

    /// Returns a descriptive name: `SQRT_3_OVER_2`, `PI_OVER_6`; `None` for longer expressions.
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
    /// Returns the constants in the order of their first use.
    pub fn list(&self) -> &[Constant] {
        &self.list
    }

    /// Returns the index of a part in [`Constants::list`]; `None` if the part is a literal.
    pub fn place_of(&self, part: &ConstantPart) -> Option<usize> {
        self.places.get(part).copied()
    }

    /// Names the constants of a function.
    pub(in crate::program) fn note(&mut self, function: &Function, pool: &Pool, system: &System) {
        let computed = Computed {
            function,
            pool,
            system,
        };
        computed.addends(&mut |parts| {
            for constant in parts.iter().filter_map(|part| part.constant.as_ref()) {
                self.add(constant, &pool.graph);
            }
        });
    }

    /// Names a part, unless it is a literal or has a name.
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
