//! Lists the expressions of the equations as nodes, from which other algebra systems build theirs.

use std::collections::HashMap;

use linkwright_codegen::Derived;
use linkwright_codegen::stages::expr::{ExprId, Graph, Node, Number};
use linkwright_codegen::stages::pool::Draft;
use pyo3::prelude::*;

use crate::mechanism::Mechanism;

/// Node with its operands, which are indices of earlier nodes.
///
/// Operations: `symbol` (its name), `number` (an exact fraction or a float), `root` (an exact radicand), `pi`, `sum`, `product`,
/// `power` (base; the exponent as text), `sin`, `cos`, `atan2`, `exp`, `log`, `floor`, `choose` (condition, value if it is negative, value
/// otherwise) and `spline` (argument; its name and the order of its derivative as text).
type Listed = (&'static str, String, Vec<usize>);

/// Nodes and, among them, Φ, the entries of Φ_q with their rows and columns, Φ_t and γ.
type Expressions = (
    Vec<Listed>,
    Vec<usize>,
    Vec<(usize, usize, usize)>,
    Vec<usize>,
    Vec<usize>,
);

struct List<'a> {
    derived: &'a Derived,
    draft: Draft,
    nodes: Vec<Listed>,
    places: HashMap<ExprId, usize>,
}

impl List<'_> {
    fn add(&mut self, operation: &'static str, text: String, operands: Vec<usize>) -> usize {
        self.nodes.push((operation, text, operands));
        self.nodes.len() - 1
    }

    fn number(&mut self, number: Number) -> usize {
        match number {
            Number::Float(value) => self.add("number", format!("{value:?}"), Vec::new()),
            Number::Exact { rational, radicand } => {
                let text = format!("{}/{}", rational.numerator(), rational.denominator());
                let rational = self.add("number", text, Vec::new());
                if radicand == 1 {
                    return rational;
                }
                let root = self.add("root", radicand.to_string(), Vec::new());
                self.add("product", String::new(), vec![rational, root])
            }
        }
    }

    /// Lists an expression with its arms written out.
    fn written_out(&mut self, expr: ExprId) -> usize {
        let expr = self.draft.written_out(expr);
        self.list(expr)
    }

    fn list(&mut self, root: ExprId) -> usize {
        let mut waiting = vec![root];
        while let Some(&expr) = waiting.last() {
            if self.places.contains_key(&expr) {
                waiting.pop();
                continue;
            }
            let graph: &Graph = &self.draft.graph;
            let operands = graph.operands(expr);
            let missing: Vec<ExprId> = operands
                .into_iter()
                .filter(|it| !self.places.contains_key(it))
                .collect();
            if missing.is_empty() {
                let place = self.node(expr);
                self.places.insert(expr, place);
            }
            waiting.extend(missing);
        }
        self.places[&root]
    }

    /// Lists a node whose operands are listed.
    fn node(&mut self, expr: ExprId) -> usize {
        let node = self.draft.graph.node(expr).clone();
        let of = |list: &Self, expr: ExprId| list.places[&expr];
        let (operation, operands) = match node {
            Node::Number(number) => return self.number(number),
            Node::Pi => return self.add("pi", String::new(), Vec::new()),
            Node::Symbol(symbol) => {
                let name = self.derived.system.symbol_name(symbol, &self.draft);
                return self.add("symbol", name, Vec::new());
            }
            Node::Sum(terms) => {
                let mut places = Vec::new();
                for term in terms.iter() {
                    let place = of(self, term.expr);
                    places.push(match term.coefficient.is_one() {
                        true => place,
                        false => {
                            let number = self.number(term.coefficient);
                            self.add("product", String::new(), vec![number, place])
                        }
                    });
                }
                ("sum", places)
            }
            Node::Product(factors) => {
                let mut places = Vec::new();
                for factor in factors.iter() {
                    let place = of(self, factor.base);
                    let (above, below) =
                        (factor.exponent.numerator(), factor.exponent.denominator());
                    places.push(match (above, below) {
                        (1, 1) => place,
                        _ => self.add("power", format!("{above}/{below}"), vec![place]),
                    });
                }
                ("product", places)
            }
            Node::Sin(x) => ("sin", vec![of(self, x)]),
            Node::Cos(x) => ("cos", vec![of(self, x)]),
            Node::Atan2(y, x) => ("atan2", vec![of(self, y), of(self, x)]),
            Node::Exp(x) => ("exp", vec![of(self, x)]),
            Node::Ln(x) => ("log", vec![of(self, x)]),
            Node::Floor(x) => ("floor", vec![of(self, x)]),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => (
                "choose",
                [condition, below, otherwise]
                    .map(|it| of(self, it))
                    .to_vec(),
            ),
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let name = self.draft.graph.spline_of(spline).name.clone();
                let argument = of(self, argument);
                return self.add("spline", format!("{name}/{order}"), vec![argument]);
            }
        };
        self.add(operation, String::new(), operands)
    }
}

#[pymethods]
impl Mechanism {
    /// Lists the expressions of Φ, Φ_q, Φ_t and γ.
    fn expressions(&self, py: Python<'_>) -> Expressions {
        py.detach(|| {
            let mut list = List {
                derived: &self.derived,
                draft: self.derived.pool.draft(),
                nodes: Vec::new(),
                places: HashMap::new(),
            };
            let rows = &self.derived.system.rows;
            let residuals = rows
                .iter()
                .map(|it| list.written_out(it.residual))
                .collect();
            let mut entries = Vec::new();
            for (row, of_row) in rows.iter().enumerate() {
                for entry in &of_row.jacobian {
                    entries.push((row, entry.coordinate, list.written_out(entry.value)));
                }
            }
            let time = rows
                .iter()
                .map(|it| list.written_out(it.time_derivative))
                .collect();
            let gamma = rows.iter().map(|it| list.written_out(it.gamma)).collect();
            (list.nodes, residuals, entries, time, gamma)
        })
    }
}
