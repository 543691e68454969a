//! Counts the arithmetic operations of functions.

use std::ops::AddAssign;

use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::pool::Pool;
use crate::program::addends::{Addend, Compared, Power, addends, bases, compared};
use crate::program::block::Block;
use crate::program::function::{Function, Level, Statement};
use crate::system::{System, WrittenOrder};

/// Numbers of operations of straight-line code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Number of additions and subtractions.
    pub additions: usize,
    /// Number of multiplications.
    pub multiplications: usize,
    /// Number of divisions.
    pub divisions: usize,
    /// Number of square roots.
    pub square_roots: usize,
    /// Number of sines and cosines.
    pub sines: usize,
    /// Number of arctangents.
    pub arctangents: usize,
    /// Number of exponentials, logarithms and general powers.
    pub exponentials: usize,
    /// Number of choices between two values.
    pub choices: usize,
    /// Number of roundings to an integer.
    pub whole_parts: usize,
    /// Number of searches in tables.
    pub lookups: usize,
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Operations) {
        self.additions += other.additions;
        self.multiplications += other.multiplications;
        self.divisions += other.divisions;
        self.square_roots += other.square_roots;
        self.sines += other.sines;
        self.arctangents += other.arctangents;
        self.exponentials += other.exponentials;
        self.choices += other.choices;
        self.whole_parts += other.whole_parts;
        self.lookups += other.lookups;
    }
}

impl std::fmt::Display for Operations {
    /// Writes `12 additions, 1 square root`; `none` if all numbers are zero.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let counts = [
            (self.additions, "addition", "additions"),
            (self.multiplications, "multiplication", "multiplications"),
            (self.divisions, "division", "divisions"),
            (self.square_roots, "square root", "square roots"),
            (self.sines, "sine or cosine", "sines and cosines"),
            (self.arctangents, "arctangent", "arctangents"),
            (self.exponentials, "exponential", "exponentials"),
            (self.choices, "choice", "choices"),
            (self.whole_parts, "whole part", "whole parts"),
            (self.lookups, "table lookup", "table lookups"),
        ];
        let parts: Vec<String> = counts
            .into_iter()
            .filter(|(count, ..)| *count > 0)
            .map(|(count, one, several)| {
                format!("{count} {}", if count == 1 { one } else { several })
            })
            .collect();
        formatter.write_str(if parts.is_empty() { "none" } else { "" })?;
        formatter.write_str(&parts.join(", "))
    }
}

impl Operations {
    /// Returns the sum of all numbers.
    pub fn total(&self) -> usize {
        let arithmetic = self.additions + self.multiplications + self.divisions + self.square_roots;
        let functions = self.sines + self.arctangents + self.exponentials + self.whole_parts;
        arithmetic + functions + self.choices + self.lookups
    }

    /// Returns all numbers multiplied by a factor.
    pub(in crate::program) fn times(self, factor: usize) -> Operations {
        Operations {
            additions: self.additions * factor,
            multiplications: self.multiplications * factor,
            divisions: self.divisions * factor,
            square_roots: self.square_roots * factor,
            sines: self.sines * factor,
            arctangents: self.arctangents * factor,
            exponentials: self.exponentials * factor,
            choices: self.choices * factor,
            whole_parts: self.whole_parts * factor,
            lookups: self.lookups * factor,
        }
    }

    /// Returns the operations of the addends of one expression, without those of its operands.
    fn of_addends(addends: &[Addend]) -> Operations {
        let mut operations = Operations {
            additions: addends.len().saturating_sub(1),
            ..Operations::default()
        };
        for addend in addends {
            let above =
                operations.product(&addend.factors) + usize::from(addend.constant.is_some());
            operations.multiplications += above.saturating_sub(1);
            if !addend.divisors.is_empty() {
                let below = operations.product(&addend.divisors);
                operations.multiplications += below.saturating_sub(1);
                operations.divisions += 1;
            }
        }
        operations
    }

    /// Counts the operations of powers and returns the number of factors.
    fn product(&mut self, powers: &[Power]) -> usize {
        let mut factors = 0;
        for Power { exponent, .. } in powers {
            match (exponent.numerator(), exponent.denominator()) {
                (whole, 1) if whole <= LARGEST_PRODUCT => factors += whole.unsigned_abs() as usize,
                (odd, 2) if odd / 2 <= LARGEST_PRODUCT => {
                    self.square_roots += 1;
                    factors += 1 + (odd / 2).unsigned_abs() as usize;
                }
                _ => {
                    self.exponentials += 1;
                    factors += 1;
                }
            }
        }
        factors
    }

    /// Returns the operations of a function call, without those of its argument.
    pub(in crate::program) fn of_function(node: &Node) -> Operations {
        let mut operations = Operations::default();
        match node {
            Node::Sin(_) | Node::Cos(_) => operations.sines = 1,
            Node::Atan2(..) => operations.arctangents = 1,
            Node::Exp(_) | Node::Ln(_) => operations.exponentials = 1,
            Node::Floor(_) => operations.whole_parts = 1,
            Node::Choose { .. } => operations.choices = 1,
            Node::Spline { .. } => operations.lookups = 1,
            Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Sum(_) | Node::Product(_) => {}
        }
        operations
    }
}

/// Largest exponent of a power that is written as a product.
pub const LARGEST_PRODUCT: i128 = 8;

/// True if an expression is a function call, which always has a name.
pub(in crate::program) fn is_function(node: &Node) -> bool {
    matches!(
        node,
        Node::Sin(_)
            | Node::Cos(_)
            | Node::Atan2(..)
            | Node::Exp(_)
            | Node::Ln(_)
            | Node::Floor(_)
            | Node::Choose { .. }
            | Node::Spline { .. }
    )
}

/// Returns the operands of an expression as written: a condition has the terms of its comparison.
pub(in crate::program) fn written_operands(expr: ExprId, graph: &Graph) -> Vec<ExprId> {
    match *graph.node(expr) {
        Node::Choose {
            condition,
            below,
            otherwise,
        } => {
            let mut operands = match graph.node(condition) {
                Node::Sum(terms) => terms.iter().map(|term| term.expr).collect(),
                _ => vec![condition],
            };
            operands.extend([below, otherwise]);
            operands
        }
        _ => graph.operands(expr),
    }
}

/// True if an expression is a symbol.
pub(in crate::program) fn is_symbol(expr: ExprId, graph: &Graph) -> bool {
    matches!(graph.node(expr), Node::Symbol(_))
}

/// Evaluated expressions of a function, split into additions and multiplications, each as often as it is written.
pub(in crate::program) struct Computed<'a> {
    pub function: &'a Function,
    pub pool: &'a Pool,
    pub system: &'a System,
}

impl Computed<'_> {
    /// Returns the operations of one statement.
    pub fn statement(&self, statement: &Statement) -> Operations {
        let mut operations = Operations::default();
        match statement {
            Statement::Let { value, .. } => operations += self.defined(*value),
            // Values of a failure report are computed only for the failure.
            Statement::Reach { excess, scale, .. } => {
                operations += self.expression(*excess);
                operations += self.expression(*scale);
            }
            _ => {
                for value in statement.values() {
                    operations += self.expression(value);
                }
            }
        }
        match statement {
            Statement::SineCosine { .. } => operations.sines += 2,
            Statement::Lookup { .. } => operations.lookups += 1,
            Statement::Angle { .. } => operations.arctangents += 1,
            _ => {}
        }
        operations
    }

    /// Calls `each` with the addends of all expressions that the function writes, and with the target of the statement if it
    /// assigns one value.
    pub fn addends(&self, each: &mut dyn FnMut(Option<SymbolId>, &[Addend])) {
        for statement in &self.function.statements {
            match statement {
                Statement::Let { target, value, .. } => {
                    self.take_apart(*value, true, &mut |parts| each(Some(*target), parts));
                }
                _ => {
                    for value in statement.values() {
                        self.take_apart(value, false, &mut |parts| each(None, parts));
                    }
                }
            }
        }
        for result in &self.function.results {
            self.take_apart(result.expr, false, &mut |parts| each(None, parts));
        }
    }

    /// Returns the operations of the results.
    pub fn results(&self) -> Operations {
        let mut operations = Operations::default();
        for result in &self.function.results {
            operations += self.expression(result.expr);
        }
        operations
    }

    /// Returns the operations of an expression where it is used.
    fn expression(&self, expr: ExprId) -> Operations {
        let mut operations = Operations::default();
        let functions = self.take_apart(expr, false, &mut |parts| {
            operations += Operations::of_addends(parts)
        });
        operations += functions;
        operations
    }

    /// Returns the operations of an expression where it is named.
    fn defined(&self, expr: ExprId) -> Operations {
        let mut operations = Operations::default();
        let functions = self.take_apart(expr, true, &mut |parts| {
            operations += Operations::of_addends(parts)
        });
        operations += functions;
        operations
    }

    /// Calls `each` with the addends of an expression and of its parts, and returns the operations of function calls among them.
    fn take_apart(
        &self,
        expr: ExprId,
        is_defined: bool,
        each: &mut dyn FnMut(&[Addend]),
    ) -> Operations {
        let mut functions = Operations::default();
        let graph = &self.pool.graph;
        let order = WrittenOrder::new(self.pool, self.system, &[]);
        let named = |other: ExprId| self.function.name_of(other).is_some();
        let mut stack = vec![expr];
        let mut first = is_defined;
        while let Some(expr) = stack.pop() {
            let has_name = named(expr) && !std::mem::take(&mut first);
            if has_name || is_symbol(expr, graph) {
                continue;
            }
            first = false;
            if !graph.is_constant(expr) {
                functions += Operations::of_function(graph.node(expr));
            }
            match *graph.node(expr) {
                Node::Choose {
                    condition,
                    below,
                    otherwise,
                } => {
                    let Compared { left, right, .. } = compared(condition, graph, &order, &named);
                    for side in [left, right] {
                        each(&side);
                        stack.extend(bases(&side));
                    }
                    stack.extend([below, otherwise]);
                }
                ref node if is_function(node) && !graph.is_constant(expr) => {
                    stack.extend(graph.operands(expr));
                }
                _ => {
                    let parts = addends(expr, graph, &order, &named);
                    each(&parts);
                    stack.extend(bases(&parts).filter(|&base| base != expr));
                }
            }
        }
        functions
    }
}

/// Returns the operations of a function with its results.
pub(in crate::program) fn of_function(
    function: &Function,
    pool: &Pool,
    system: &System,
) -> Operations {
    let computed = Computed {
        function,
        pool,
        system,
    };
    let mut operations = Operations::default();
    for statement in &function.statements {
        operations += computed.statement(statement);
    }
    operations += computed.results();
    operations
}

/// Returns the operations of each level in all blocks, then those of all responses to drivers and to parameters, and of forces.
pub(in crate::program) fn by_level(
    blocks: &[Block],
    pool: &Pool,
    system: &System,
) -> [Operations; 6] {
    let mut levels = [Operations::default(); 6];
    for block in blocks {
        let mut level = 0;
        let function = &block.function;
        let computed = Computed {
            function,
            pool,
            system,
        };
        for statement in &function.statements {
            if let Statement::Section(section) = statement {
                level = match section {
                    Level::Position => 0,
                    Level::Velocity => 1,
                    Level::Acceleration => 2,
                    Level::Response(direction) | Level::ResponseRate(direction) => {
                        3 + usize::from(system.directions[*direction].is_parameter())
                    }
                    Level::Forces => 5,
                };
            }
            levels[level] += computed.statement(statement);
        }
    }
    levels
}
