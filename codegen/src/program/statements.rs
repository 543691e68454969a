//! Results → the statements that compute them.

use std::collections::{HashMap, HashSet};

use super::addends::{Addend, Compared, addends, bases, compared};
use super::constants::Constants;
use super::names::Names;
use super::operations::{Operations, is_function, is_symbol, written_operands};
use super::usage::{Orders, Usage};
use crate::expr::{ExprId, Graph, Node, SplineId};
use crate::system::{SymbolRole, System, WrittenOrder};

/// Straight-line code for one function.
#[derive(Clone, Debug)]
pub struct Straight {
    /// What it reads.
    pub inputs: Inputs,
    /// Definitions, each before its first use.
    pub statements: Vec<Statement>,
    /// What it returns, and the bodies in whose order each result is written.
    pub results: Vec<(ExprId, Vec<usize>)>,
    /// What it costs.
    pub operations: Operations,
    /// Only looked up, never iterated.
    names: HashMap<ExprId, String>,
}

/// Which arguments a function reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inputs {
    /// q.
    pub position: bool,
    /// q̇.
    pub rate: bool,
    /// q̈.
    pub acceleration: bool,
    /// t.
    pub time: bool,
    /// The parameters.
    pub parameters: bool,
    /// The signals.
    pub inputs: bool,
}

/// One definition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Statement {
    /// The sine and the cosine of an angle, together.
    SineCosine {
        /// The name of the sine.
        sine: String,
        /// The name of the cosine.
        cosine: String,
        /// Their argument.
        angle: ExprId,
    },
    /// A value that is used more than once, or the value of a function.
    Value {
        /// Its name.
        name: String,
        /// What it is.
        expr: ExprId,
    },
    /// Two or more of a table's value and its derivatives at one place, together.
    Lookup {
        /// The names, by the order of the derivative; none for what is not needed.
        names: [Option<String>; 4],
        /// The table.
        spline: SplineId,
        /// The place.
        argument: ExprId,
    },
}

impl Statement {
    /// What it defines.
    fn names(&self) -> Vec<&String> {
        match self {
            Statement::SineCosine { sine, cosine, .. } => vec![sine, cosine],
            Statement::Value { name, .. } => vec![name],
            Statement::Lookup { names, .. } => names.iter().flatten().collect(),
        }
    }
}

impl Straight {
    /// What the statements cost, their arguments and the results not counted.
    pub fn operations(&self, graph: &Graph) -> Operations {
        let mut operations = Operations::default();
        for statement in &self.statements {
            match statement {
                Statement::SineCosine { .. } => operations.sines += 2,
                Statement::Lookup { .. } => operations.lookups += 1,
                Statement::Value { expr, .. } => {
                    operations += Operations::of_function(graph.node(*expr));
                    operations.choices += self.further_pieces(*expr, graph).len();
                }
            }
        }
        operations
    }

    /// What one statement costs with its arguments.
    pub(super) fn operations_of(&self, statement: &Statement, system: &System) -> Operations {
        let alone = Straight {
            statements: vec![statement.clone()],
            results: Vec::new(),
            ..self.clone()
        };
        let mut operations = alone.operations(&system.mechanism.graph);
        for parts in alone.computed(&[], system) {
            operations += Operations::of_addends(&parts);
        }
        operations
    }

    /// The name that an expression was given in this function.
    pub fn name_of(&self, expr: ExprId) -> Option<&str> {
        self.names.get(&expr).map(String::as_str)
    }

    /// The statements that these results need, all with the names they have here. A sine whose cosine is not needed is computed alone.
    pub fn for_results(&self, results: &[ExprId], system: &System) -> Straight {
        let graph = &system.mechanism.graph;
        let mut needed: HashSet<ExprId> = HashSet::new();
        let mut stack = results.to_vec();
        while let Some(expr) = stack.pop() {
            if needed.insert(expr) {
                stack.extend(written_operands(expr, graph));
            }
        }
        let of_need = |statement: &Statement| match statement {
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let find = |wanted: Node| needed.iter().find(|&&it| *graph.node(it) == wanted);
                let found = [find(Node::Sin(*angle)), find(Node::Cos(*angle))];
                let alone = |name: &String, expr: &ExprId| Statement::Value {
                    name: name.clone(),
                    expr: *expr,
                };
                match found {
                    [Some(_), Some(_)] => Some(statement.clone()),
                    [Some(expr), None] => Some(alone(sine, expr)),
                    [None, Some(expr)] => Some(alone(cosine, expr)),
                    [None, None] => None,
                }
            }
            Statement::Value { expr, .. } => needed.contains(expr).then(|| statement.clone()),
            Statement::Lookup {
                names,
                spline,
                argument,
            } => {
                let find = |order: u8| {
                    let wanted = Node::Spline {
                        spline: *spline,
                        order,
                        argument: *argument,
                    };
                    needed.iter().copied().find(|&it| *graph.node(it) == wanted)
                };
                lookup(names, [0, 1, 2, 3].map(find), *spline, *argument)
            }
        };
        let statements = self.statements.iter().filter_map(of_need).collect();
        Straight {
            statements,
            ..self.clone()
        }
    }

    /// Which of the statements these results need: places in the list.
    pub(super) fn needed_by(&self, results: &[ExprId], system: &System) -> Vec<usize> {
        let needed = self.for_results(results, system).statements;
        let is_needed = |name: &String| needed.iter().any(|other| other.names().contains(&name));
        let places = self.statements.iter().enumerate();
        places
            .filter(|(_, statement)| statement.names().into_iter().any(is_needed))
            .map(|(place, _)| place)
            .collect()
    }

    /// How an expression is computed here, in written order.
    pub fn addends(&self, expr: ExprId, system: &System, bodies: &[usize]) -> Vec<Addend> {
        let graph = &system.mechanism.graph;
        let order = WrittenOrder::new(system, bodies);
        addends(expr, graph, &order, &|other| {
            self.names.contains_key(&other)
        })
    }

    /// The two sides of a condition, in written order.
    fn compared(&self, condition: ExprId, system: &System) -> Compared {
        let graph = &system.mechanism.graph;
        let order = WrittenOrder::new(system, &[]);
        compared(condition, graph, &order, &|other| {
            self.names.contains_key(&other)
        })
    }

    /// The choices without a name that are written out as the arms of this one: the `else if`s.
    fn further_pieces(&self, expr: ExprId, graph: &Graph) -> Vec<ExprId> {
        let mut pieces = Vec::new();
        let mut stack = vec![expr];
        while let Some(piece) = stack.pop() {
            if let Node::Choose {
                below, otherwise, ..
            } = *graph.node(piece)
            {
                let inner = [otherwise, below].into_iter().filter(|&arm| {
                    matches!(graph.node(arm), Node::Choose { .. }) && self.name_of(arm).is_none()
                });
                stack.extend(inner.clone());
                pieces.extend(inner);
            }
        }
        pieces
    }

    /// The statements for these results.
    pub(super) fn new(
        results: Vec<(ExprId, Vec<usize>)>,
        system: &System,
        constants: &mut Constants,
    ) -> Straight {
        let nothing = Straight {
            inputs: Inputs::default(),
            statements: Vec::new(),
            results: Vec::new(),
            operations: Operations::default(),
            names: HashMap::new(),
        };
        Straight::beside(&nothing, std::iter::empty(), results, system, constants)
    }

    /// The same where what `known` computes has its names already, and `taken` are names of other values.
    pub(super) fn beside(
        known: &Straight,
        taken: impl Iterator<Item = String>,
        results: Vec<(ExprId, Vec<usize>)>,
        system: &System,
        constants: &mut Constants,
    ) -> Straight {
        let graph = &system.mechanism.graph;
        let usage = Usage::of(&results, graph, known);
        let mut straight = Straight {
            inputs: Inputs::default(),
            statements: Vec::new(),
            results: Vec::new(),
            operations: Operations::default(),
            names: known.names.clone(),
        };
        let mut names = Names::beside(taken.chain(known.names.values().cloned()));
        for &expr in &usage.ordered {
            if let Node::Symbol(symbol) = graph.node(expr) {
                straight.inputs.note(system.roles[symbol.index()]);
                continue;
            }
            if usage.deserves_name(expr, graph) && straight.name_of(expr).is_none() {
                straight.define(expr, &usage, system, &mut names);
            }
        }
        for parts in straight.computed(&results, system) {
            straight.operations += Operations::of_addends(&parts);
            for constant in parts.iter().filter_map(|part| part.constant.as_ref()) {
                constants.add(constant, graph);
            }
        }
        straight.results = results;
        straight
    }

    fn define(&mut self, expr: ExprId, usage: &Usage, system: &System, names: &mut Names) {
        let graph = &system.mechanism.graph;
        let node = graph.node(expr);
        self.operations += Operations::of_function(node);
        if let Node::Sin(angle) | Node::Cos(angle) = *node {
            let (sine, cosine) = names.sine_and_cosine(angle, system);
            let other = usage.sine_cosine.get(&angle);
            if let Some(&(Some(sine_expr), Some(cosine_expr))) = other {
                let second = graph.node(if expr == sine_expr {
                    cosine_expr
                } else {
                    sine_expr
                });
                self.operations += Operations::of_function(second);
                self.names.insert(sine_expr, sine.clone());
                self.names.insert(cosine_expr, cosine.clone());
                self.statements.push(Statement::SineCosine {
                    sine,
                    cosine,
                    angle,
                });
                return;
            }
            let name = if matches!(node, Node::Sin(_)) {
                sine
            } else {
                cosine
            };
            self.names.insert(expr, name.clone());
            self.statements.push(Statement::Value { name, expr });
            return;
        }
        if let Node::Spline {
            spline, argument, ..
        } = *node
        {
            let orders = usage.splines.get(&(spline, argument)).copied();
            let orders = orders.unwrap_or_default();
            let names = names.spline(&graph.spline_of(spline).name);
            for (name, order) in names.iter().zip(orders) {
                self.names.extend(order.map(|order| (order, name.clone())));
            }
            self.statements
                .extend(lookup(&names.map(Some), orders, spline, argument));
            return;
        }
        self.operations.choices += self.further_pieces(expr, graph).len();
        let name = names.value(node);
        self.names.insert(expr, name.clone());
        self.statements.push(Statement::Value { name, expr });
    }

    /// The addends of everything that this function takes apart into additions and multiplications, each as often as it is
    /// written.
    fn computed(&self, results: &[(ExprId, Vec<usize>)], system: &System) -> Vec<Vec<Addend>> {
        let graph = &system.mechanism.graph;
        let unnamed = |expr: ExprId| self.name_of(expr).is_none() && !is_symbol(expr, graph);
        let mut stack: Vec<ExprId> = Vec::new();
        let mut choices: Vec<ExprId> = Vec::new();
        for statement in &self.statements {
            match statement {
                Statement::SineCosine { angle, .. } => stack.push(*angle),
                Statement::Lookup { argument, .. } => stack.push(*argument),
                Statement::Value { expr, .. } => match graph.node(*expr) {
                    Node::Choose { .. } => {
                        choices.push(*expr);
                        choices.extend(self.further_pieces(*expr, graph));
                    }
                    node if is_function(node) => stack.extend(graph.operands(*expr)),
                    _ => stack.push(*expr),
                },
            }
        }
        // A named expression is computed at its definition; wherever else it stands it costs nothing.
        let defined: HashSet<ExprId> = self.names.keys().copied().collect();
        stack.retain(|expr| !is_symbol(*expr, graph));
        stack.extend(
            results
                .iter()
                .map(|(expr, _)| *expr)
                .filter(|expr| !defined.contains(expr)),
        );
        let mut computed: Vec<Vec<Addend>> = Vec::new();
        for choice in choices {
            if let Node::Choose {
                condition,
                below,
                otherwise,
            } = *graph.node(choice)
            {
                let Compared { left, right, .. } = self.compared(condition, system);
                for side in [left, right] {
                    stack.extend(bases(&side).filter(|&operand| unnamed(operand)));
                    computed.push(side);
                }
                stack.extend([below, otherwise].into_iter().filter(|&arm| unnamed(arm)));
            }
        }
        while let Some(expr) = stack.pop() {
            if is_function(graph.node(expr)) {
                continue;
            }
            let parts = self.addends(expr, system, &[]);
            stack.extend(bases(&parts).filter(|&operand| operand != expr && unnamed(operand)));
            computed.push(parts);
        }
        computed
    }
}

impl Inputs {
    /// Notes that a symbol is read.
    pub fn note(&mut self, role: SymbolRole) {
        match role {
            SymbolRole::Position(_) => self.position = true,
            SymbolRole::Rate(_) => self.rate = true,
            SymbolRole::Acceleration(_) => self.acceleration = true,
            SymbolRole::Time => self.time = true,
            SymbolRole::Parameter(_) => self.parameters = true,
            SymbolRole::Input { .. } => self.inputs = true,
            SymbolRole::Arm(_) | SymbolRole::Intermediate => {}
        }
    }
}

/// The statement for those of the orders that are needed; nothing where none is.
fn lookup(
    names: &[Option<String>; 4],
    orders: Orders,
    spline: SplineId,
    argument: ExprId,
) -> Option<Statement> {
    let mut needed = names.clone();
    for (name, order) in needed.iter_mut().zip(orders) {
        *name = name.take().filter(|_| order.is_some());
    }
    let both = needed.iter().zip(orders);
    let mut found = both.filter_map(|(name, order)| name.clone().zip(order));
    match (found.next(), found.next()) {
        (None, _) => None,
        (Some((name, expr)), None) => Some(Statement::Value { name, expr }),
        _ => Some(Statement::Lookup {
            names: needed,
            spline,
            argument,
        }),
    }
}
