//! Expressions → what they use, and how often.
//!
//! Afterwards it is known which expressions deserve a name in straight-line code. Deliberately unknown here: the names.

use super::costs::{is_function, written_operands};
use crate::expr::{ExprId, Graph, IdMap, Node, SplineId};
use crate::program::function::Function;

/// The sine and the cosine node of an angle, as far as both occur.
pub(super) type Pair = (Option<ExprId>, Option<ExprId>);

/// A table's value and its derivatives at one place, as far as they occur.
pub(super) type Orders = [Option<ExprId>; 4];

/// What expressions use, and how often.
pub(super) struct Usage {
    /// Every expression that is not constant, operands first.
    pub ordered: Vec<ExprId>,
    uses: IdMap<ExprId, usize>,
    /// How often a choice is an arm of another one.
    as_arm: IdMap<ExprId, usize>,
    /// By angle.
    pub sine_cosine: IdMap<ExprId, Pair>,
    /// By table and argument.
    pub splines: IdMap<(SplineId, ExprId), Orders>,
}

impl Usage {
    /// What these expressions use beside what `known` has named already.
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
                    // A power is written as a product, so its base is used as often.
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

    /// Whether an expression is what a choice chooses.
    pub fn is_arm(&self, expr: ExprId) -> bool {
        self.as_arm.contains_key(&expr)
    }

    /// Functions always get a name, unless they are a choice that continues another one; other expressions when they are used
    /// again and take more than one operation.
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
