//! Counts the uses of expressions.
//!
//! The counts decide which expressions deserve a name in straight-line code.

use super::costs::{is_function, written_operands};
use crate::expr::{ExprId, Graph, IdMap, Node, SplineId};
use crate::program::function::Function;

/// Sine and cosine of an angle, as far as both occur.
pub(super) type Pair = (Option<ExprId>, Option<ExprId>);

/// Value of a table and its derivatives at one argument, as far as they occur.
pub(super) type Orders = [Option<ExprId>; 4];

/// Parts of expressions, with their numbers of uses.
pub(super) struct Usage {
    /// Every expression that is not constant, operands first.
    pub ordered: Vec<ExprId>,
    uses: IdMap<ExprId, usize>,
    /// Number of times that a choice is a branch of another choice.
    as_arm: IdMap<ExprId, usize>,
    /// Sines and cosines by angle.
    pub sine_cosine: IdMap<ExprId, Pair>,
    /// Values by table and argument.
    pub splines: IdMap<(SplineId, ExprId), Orders>,
}

impl Usage {
    /// Returns the parts of these expressions that `known` does not name yet.
    pub fn of(roots: &[ExprId], graph: &Graph, known: &Function) -> Usage {
        let mut usage = Usage {
            ordered: Vec::new(),
            uses: IdMap::default(),
            as_arm: IdMap::default(),
            sine_cosine: IdMap::default(),
            splines: IdMap::default(),
        };
        for root in roots {
            usage.visit(*root, 1, graph, known);
        }
        for &expr in &usage.ordered {
            match *graph.node(expr) {
                Node::Sin(angle) => usage.sine_cosine.entry(angle).or_default().0 = Some(expr),
                Node::Cos(angle) => usage.sine_cosine.entry(angle).or_default().1 = Some(expr),
                Node::Spline {
                    spline,
                    order,
                    argument,
                } => {
                    let orders = usage.splines.entry((spline, argument)).or_default();
                    orders[usize::from(order)] = Some(expr);
                }
                _ => {}
            }
        }
        usage
    }

    fn visit(&mut self, expr: ExprId, weight: usize, graph: &Graph, known: &Function) {
        if graph.is_constant(expr) || known.name_of(expr).is_some() {
            return;
        }
        if let Some(uses) = self.uses.get_mut(&expr) {
            *uses += weight;
            return;
        }
        self.uses.insert(expr, weight);
        match graph.node(expr) {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum(terms) => terms
                .iter()
                .for_each(|term| self.visit(term.expr, 1, graph, known)),
            Node::Product(factors) => {
                for factor in factors.iter() {
                    // A power is written as a product, so its base has as many uses.
                    let exponent = factor.exponent;
                    let whole = if exponent.denominator() == 1 {
                        exponent.numerator().unsigned_abs()
                    } else {
                        1
                    };
                    self.visit(
                        factor.base,
                        usize::try_from(whole).unwrap_or(usize::MAX),
                        graph,
                        known,
                    );
                }
            }
            Node::Choose {
                below, otherwise, ..
            } => {
                for arm in [*below, *otherwise] {
                    *self.as_arm.entry(arm).or_default() += 1;
                }
                self.visit_all(written_operands(expr, graph), graph, known);
            }
            Node::Sin(_)
            | Node::Cos(_)
            | Node::Exp(_)
            | Node::Ln(_)
            | Node::Floor(_)
            | Node::Spline { .. }
            | Node::Atan2(..) => self.visit_all(graph.operands(expr), graph, known),
        }
        self.ordered.push(expr);
    }

    fn visit_all(&mut self, operands: Vec<ExprId>, graph: &Graph, known: &Function) {
        for operand in operands {
            self.visit(operand, 1, graph, known);
        }
    }

    /// True if an expression is a branch of a choice.
    pub fn is_arm(&self, expr: ExprId) -> bool {
        self.as_arm.contains_key(&expr)
    }

    /// True for function calls, unless they are a choice that continues another one. True for other expressions of several uses
    /// and more than one operation.
    pub fn deserves_name(&self, expr: ExprId, graph: &Graph) -> bool {
        let node = graph.node(expr);
        let operations = match node {
            Node::Sum(terms) => terms.len() - 1 + terms.iter().filter(|term| scaled(term)).count(),
            Node::Product(factors) => factors.len(),
            _ => 0,
        };
        let uses = self.uses.get(&expr).copied();
        let continues = matches!(node, Node::Choose { .. })
            && uses == Some(1)
            && self.as_arm.get(&expr) == Some(&1);
        if graph.magnitude_of(expr).is_some() {
            return uses.is_some_and(|uses| uses >= 2);
        }
        (is_function(node) && !continues) || (operations >= 2 && uses.is_some_and(|uses| uses >= 2))
    }
}

fn scaled(term: &crate::expr::Term) -> bool {
    !term.coefficient.is_one() && !term.coefficient.neg().is_one()
}
