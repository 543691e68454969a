//! Evaluation: *roots of a graph* → *a linear list of instructions, run for given values of the symbols*.
//!
//! Every node that the roots need is computed once, operands first. A tape is independent of its graph afterwards. It is
//! the interpreter of the symbolic core and the oracle of its tests; it does not know how code is emitted.

use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Factor, Node};
use super::number::float_power;
use super::rational::Rational;
use super::spline::Spline;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// A linear list of instructions that evaluates expressions.
#[derive(Clone, Debug)]
pub struct Tape {
    /// Instruction k writes slot k and reads earlier slots only.
    instructions: Vec<Instruction>,
    /// The terms of all sums, one after the other.
    addends: Vec<Addend>,
    /// The factors of all products, one after the other.
    powers: Vec<Power>,
    /// The splines of the graph, by id.
    splines: Vec<Arc<Spline>>,
    roots: Vec<u32>,
    symbol_count: usize,
}

#[derive(Clone, Copy, Debug)]
enum Instruction {
    Constant(f64),
    Symbol(u32),
    Sum {
        from: u32,
        to: u32,
    },
    Product {
        from: u32,
        to: u32,
    },
    Sin(u32),
    Cos(u32),
    Atan2(u32, u32),
    Exp(u32),
    Ln(u32),
    Floor(u32),
    Choose {
        condition: u32,
        below: u32,
        otherwise: u32,
    },
    Spline {
        spline: u32,
        order: u8,
        argument: u32,
    },
}

#[derive(Clone, Copy, Debug)]
struct Addend {
    coefficient: f64,
    slot: u32,
}

#[derive(Clone, Copy, Debug)]
struct Power {
    slot: u32,
    /// The magnitude of the exponent.
    exponent: Rational,
    is_divisor: bool,
}

impl Tape {
    /// The instructions for these roots, in their order.
    pub fn new(graph: &Graph, roots: &[ExprId]) -> Tape {
        let order = needed(graph, roots);
        let slots: HashMap<ExprId, u32, BuildExprHasher> =
            order.iter().copied().zip(0u32..).collect();
        let mut tape = Tape {
            instructions: Vec::with_capacity(order.len()),
            addends: Vec::new(),
            powers: Vec::new(),
            splines: graph.splines.clone(),
            roots: roots.iter().map(|root| slots[root]).collect(),
            symbol_count: 0,
        };
        for &expr in &order {
            let instruction = match graph.node(expr) {
                Node::Number(value) => Instruction::Constant(value.to_f64()),
                Node::Pi => Instruction::Constant(std::f64::consts::PI),
                Node::Symbol(symbol) => {
                    tape.symbol_count = tape.symbol_count.max(symbol.index() + 1);
                    Instruction::Symbol(symbol.0)
                }
                Node::Sum(terms) => {
                    let from = tape.addends.len() as u32;
                    tape.addends.extend(terms.iter().map(|term| Addend {
                        coefficient: term.coefficient.to_f64(),
                        slot: slots[&term.expr],
                    }));
                    let to = tape.addends.len() as u32;
                    Instruction::Sum { from, to }
                }
                Node::Product(factors) => {
                    let from = tape.powers.len() as u32;
                    tape.powers
                        .extend(factors.iter().map(|factor| power(factor, &slots)));
                    let to = tape.powers.len() as u32;
                    Instruction::Product { from, to }
                }
                Node::Sin(angle) => Instruction::Sin(slots[angle]),
                Node::Cos(angle) => Instruction::Cos(slots[angle]),
                Node::Atan2(y, x) => Instruction::Atan2(slots[y], slots[x]),
                Node::Exp(exponent) => Instruction::Exp(slots[exponent]),
                Node::Ln(argument) => Instruction::Ln(slots[argument]),
                Node::Floor(argument) => Instruction::Floor(slots[argument]),
                Node::Choose {
                    condition,
                    below,
                    otherwise,
                } => Instruction::Choose {
                    condition: slots[condition],
                    below: slots[below],
                    otherwise: slots[otherwise],
                },
                Node::Spline {
                    spline,
                    order,
                    argument,
                } => Instruction::Spline {
                    spline: spline.0,
                    order: *order,
                    argument: slots[argument],
                },
            };
            tape.instructions.push(instruction);
        }
        assert!(
            tape.addends.len() <= u32::MAX as usize && tape.powers.len() <= u32::MAX as usize,
            "terms are numbered with 32 bits"
        );
        tape
    }

    /// The value of each root. `symbols` holds a value for each symbol by [`SymbolId::index`](super::SymbolId::index), at
    /// least up to the last one that occurs; `results` has one place per root. The workspace may be used again for any
    /// tape; its content means nothing.
    ///
    /// # Panics
    /// Where `symbols` is too short or `results` has another length than the roots.
    pub fn evaluate(&self, symbols: &[f64], workspace: &mut Vec<f64>, results: &mut [f64]) {
        self.run(symbols, workspace, results.len());
        for (result, &root) in results.iter_mut().zip(&self.roots) {
            *result = workspace[root as usize];
        }
    }

    /// For each root the sum of the absolute values of its terms, by which a residual is scaled: for a root that is not a
    /// sum its absolute value. Arguments as for [`Tape::evaluate`].
    ///
    /// # Panics
    /// As [`Tape::evaluate`].
    pub fn magnitudes(&self, symbols: &[f64], workspace: &mut Vec<f64>, results: &mut [f64]) {
        self.run(symbols, workspace, results.len());
        for (result, &root) in results.iter_mut().zip(&self.roots) {
            *result = match self.instructions[root as usize] {
                Instruction::Sum { from, to } => self.addends[from as usize..to as usize]
                    .iter()
                    .map(|addend| (addend.coefficient * workspace[addend.slot as usize]).abs())
                    .sum(),
                _ => workspace[root as usize].abs(),
            };
        }
    }

    /// How many instructions there are.
    pub fn length(&self) -> usize {
        self.instructions.len()
    }

    fn run(&self, symbols: &[f64], slots: &mut Vec<f64>, result_count: usize) {
        assert!(
            symbols.len() >= self.symbol_count,
            "every symbol has a value"
        );
        assert!(
            result_count == self.roots.len(),
            "every root has a place for its result"
        );
        slots.clear();
        slots.reserve(self.instructions.len());
        for &instruction in &self.instructions {
            let value = match instruction {
                Instruction::Constant(value) => value,
                Instruction::Symbol(symbol) => symbols[symbol as usize],
                Instruction::Sum { from, to } => self.addends[from as usize..to as usize]
                    .iter()
                    .map(|addend| addend.coefficient * slots[addend.slot as usize])
                    .sum(),
                Instruction::Product { from, to } => {
                    product(&self.powers[from as usize..to as usize], slots)
                }
                Instruction::Sin(angle) => slots[angle as usize].sin(),
                Instruction::Cos(angle) => slots[angle as usize].cos(),
                Instruction::Atan2(y, x) => slots[y as usize].atan2(slots[x as usize]),
                Instruction::Exp(exponent) => slots[exponent as usize].exp(),
                Instruction::Ln(argument) => slots[argument as usize].ln(),
                Instruction::Floor(argument) => slots[argument as usize].floor(),
                Instruction::Choose {
                    condition,
                    below,
                    otherwise,
                } => {
                    let is_below = slots[condition as usize] < 0.0;
                    slots[if is_below { below } else { otherwise } as usize]
                }
                Instruction::Spline {
                    spline,
                    order,
                    argument,
                } => self.splines[spline as usize].at(slots[argument as usize])[order as usize],
            };
            slots.push(value);
        }
    }
}

/// The expressions that the roots need, operands first: operands have smaller ids, so the order of ids will do.
fn needed(graph: &Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let mut seen: HashSet<ExprId, BuildExprHasher> = HashSet::default();
    let mut order = Vec::new();
    let mut open = roots.to_vec();
    while let Some(expr) = open.pop() {
        if !seen.insert(expr) {
            continue;
        }
        order.push(expr);
        open.extend(graph.operands(expr));
    }
    order.sort_unstable();
    order
}

fn power(factor: &Factor, slots: &HashMap<ExprId, u32, BuildExprHasher>) -> Power {
    Power {
        slot: slots[&factor.base],
        exponent: factor.exponent.absolute(),
        is_divisor: factor.exponent.is_negative(),
    }
}

/// The factors with positive exponents over those with negative ones: one division, and one rounding less per quotient.
fn product(powers: &[Power], slots: &[f64]) -> f64 {
    let (mut above, mut below) = (1.0, 1.0);
    for power in powers {
        let base = slots[power.slot as usize];
        let value = match (power.exponent.numerator(), power.exponent.denominator()) {
            (1, 1) => base,
            (1, 2) => base.sqrt(),
            (odd, 2) => match Rational::new(odd / 2, 1) {
                Some(whole) => float_power(base, whole) * base.sqrt(),
                None => f64::NAN,
            },
            _ => float_power(base, power.exponent),
        };
        if power.is_divisor {
            below *= value;
        } else {
            above *= value;
        }
    }
    if below == 1.0 { above } else { above / below }
}
