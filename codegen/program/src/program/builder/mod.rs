//! Builds the statements of blocks for all solution methods.
//!
//! A block and the verification of paths have one type of builder, and each file of methods states one kind of values. The files
//! call each other in both directions: closed forms note the links that a path needs, and a path rotates vectors as blocks do.
//! All append to one list of statements, in which every value is defined before it is read, and a rotated vector once.

mod angles;
mod checks;
mod inside;
mod rates;
mod vectors;

pub use angles::Direction;
pub(super) use inside::Inside;

use super::block::{Branch, Lowering, Measured, PageName};
use super::directional_derivatives::DirectionalDerivatives;
use super::function::{Function, Level, Statement};
use super::path::Paths;
use super::quantities::Quantities;
use crate::expr::{ExprId, Graph, IdMap, IdSet, Node, SymbolId};
use crate::joint::geometry::Vector;
use crate::pool::Pool;
use crate::structure::SolvedPlan;
use crate::system::{Passing, System};
use crate::words::{Known, Phrase, Piece, phrase};

/// Builder of one block's statements.
pub struct Builder<'a> {
    /// Expressions; intermediate values are added.
    pub pool: &'a mut Pool,
    /// Equations.
    pub system: &'a System,
    /// Plan of the solution.
    pub plan: &'a SolvedPlan,
    /// Unknowns that are solved so far.
    pub known: &'a mut Known,
    pub(super) derivatives: &'a mut DirectionalDerivatives,
    pub(super) statements: Vec<Statement>,
    /// Number of the block, from 0.
    pub(super) place: usize,
    branches: &'a mut Vec<Branch>,
    /// Joints whose driven lengths are checked already.
    driven: &'a mut Vec<usize>,
    pub(super) paths: &'a mut Paths,
    /// Rotated vectors that are defined already.
    pub(super) defined: IdSet<SymbolId>,
    measured: Vec<Measured>,
    page_names: IdMap<SymbolId, PageName>,
    written_out: IdSet<SymbolId>,
    /// Quantities that name constants of the block.
    pub(super) quantities: Quantities,
    pub(super) writes_prose: bool,
    /// Number of links with variable length in the block.
    pub(super) stretched: usize,
    /// State of the closed forms inside a torn block, while they are stated.
    pub(super) inside: Option<Inside>,
}

impl<'a> Builder<'a> {
    pub(super) fn new(lowering: &'a mut Lowering<'_>, place: usize) -> Builder<'a> {
        Builder {
            pool: &mut *lowering.pool,
            system: lowering.system,
            plan: lowering.plan,
            known: &mut lowering.known,
            derivatives: &mut lowering.derivatives,
            paths: &mut lowering.paths,
            branches: &mut lowering.branches,
            driven: &mut lowering.driven,
            writes_prose: lowering.writes_prose,
            statements: Vec::new(),
            place,
            defined: IdSet::default(),
            measured: Vec::new(),
            page_names: IdMap::default(),
            written_out: IdSet::default(),
            quantities: Quantities::default(),
            stretched: 0,
            inside: None,
        }
    }

    /// Returns the function, its measures, and the names of its local values in derivations.
    pub(super) fn finish(
        self,
    ) -> (
        Function,
        Vec<Measured>,
        IdMap<SymbolId, PageName>,
        IdSet<SymbolId>,
    ) {
        let function = Function {
            statements: self.statements,
            quantities: self.quantities,
            ..Function::default()
        };
        (function, self.measured, self.page_names, self.written_out)
    }

    /// Returns the forces that a joint or driver transmits.
    pub(super) fn passing(&mut self, joint: usize) -> Passing {
        self.system.passing(joint, &self.plan.rows, self.pool)
    }

    /// Returns the arena of all expressions.
    pub fn graph(&mut self) -> &mut Graph {
        &mut self.pool.graph
    }

    /// Begins the statements of a level.
    pub(super) fn section(&mut self, level: Level) {
        self.statements.push(Statement::Section(level));
    }

    /// Adds a heading: results and inputs of the next statements.
    pub fn heading(&mut self, words: impl Into<Phrase>) {
        self.statements.push(Statement::Heading(words.into()));
    }

    /// Adds a note if derivations are requested.
    pub fn say(&mut self, words: impl FnOnce(&mut Builder<'a>) -> Phrase) {
        if self.writes_prose {
            let words = words(self);
            if !words.is_empty() {
                self.statements.push(Statement::Note(words));
            }
        }
    }

    /// Explains the next values in generated code. Derivations have formulas instead.
    pub fn comment(&mut self, words: impl FnOnce(&mut Builder<'a>) -> Phrase) {
        if !self.writes_prose {
            let words = words(self);
            self.statements.push(Statement::Note(words));
        }
    }

    /// Prints equations as left side, right side and remark, if derivations are requested.
    pub fn show(&mut self, equations: impl FnOnce(&mut Builder<'a>) -> Vec<[Phrase; 3]>) {
        if self.writes_prose {
            let equations = equations(self).into_iter();
            let equations = equations.map(|[left, right, remark]| Statement::Shown {
                left,
                right,
                remark,
            });
            self.statements.extend(equations);
        }
    }

    /// Returns a named local value; symbols and constants need no name.
    pub fn value(&mut self, name: &str, value: ExprId) -> ExprId {
        self.value_with(name, value, "")
    }

    /// Returns a named local value with a remark.
    pub fn value_with(&mut self, name: &str, value: ExprId, remark: impl Into<Phrase>) -> ExprId {
        let graph = &self.pool.graph;
        if graph.is_constant(value) || matches!(graph.node(value), Node::Symbol(_)) {
            return value;
        }
        let is_fixed = graph.is_fixed(value);
        let target = self.pool.intermediate(name);
        if is_fixed {
            let zero = self.pool.graph.zero();
            self.pool.set_rate(target, zero);
            self.derivatives.fix(target, value);
        }
        self.assign_with(target, value, remark);
        self.graph().variable(target)
    }

    /// Returns a named local value that derivations expand wherever it occurs.
    pub fn factor(&mut self, name: &str, value: ExprId) -> ExprId {
        let named = self.value(name, value);
        if let Node::Symbol(symbol) = *self.pool.graph.node(named)
            && named != value
        {
            self.written_out.insert(symbol);
        }
        named
    }

    /// Returns both components of a vector as local values `name_x`, `name_y`. Derivations name components that need no name,
    /// too.
    pub fn vector(&mut self, name: &str, vector: Vector) -> Vector {
        [("x", vector[0]), ("y", vector[1])].map(|(axis, value)| {
            let component = format!("{name}_{axis}");
            let named = self.value(&component, value);
            if named == value {
                let component = Piece::Local(component);
                self.show(|_| vec![[component.into(), Piece::Formula(value).into(), "".into()]]);
            }
            named
        })
    }

    /// Assigns a value to a target.
    pub fn assign(&mut self, target: SymbolId, value: ExprId) {
        self.assign_with(target, value, "");
    }

    /// Assigns a value to a target, with a remark.
    pub fn assign_with(&mut self, target: SymbolId, value: ExprId, remark: impl Into<Phrase>) {
        let remark = remark.into();
        self.statements.push(Statement::Let {
            target,
            value,
            remark,
        });
    }

    /// Sets the name of a vector's symbols in derivations.
    pub fn call(&mut self, symbols: Vector, name: &str) {
        for (axis, symbol) in symbols.into_iter().enumerate() {
            if let Node::Symbol(symbol) = *self.pool.graph.node(symbol) {
                let name = PageName::Component(name.to_string(), axis);
                self.page_names.insert(symbol, name);
            }
        }
    }

    /// Makes derivations print a local value as the cosine or the sine of an unknown.
    pub(super) fn call_function(&mut self, value: ExprId, unknown: usize, is_cosine: bool) {
        if let Node::Symbol(symbol) = *self.pool.graph.node(value) {
            let name = match is_cosine {
                true => PageName::Cosine(unknown),
                false => PageName::Sine(unknown),
            };
            self.page_names.insert(symbol, name);
        }
    }

    /// Adds a statement.
    pub(super) fn state(&mut self, statement: Statement) {
        self.statements.push(statement);
    }

    /// Describes the row that gives an unknown: `revolute B(crank, coupler), x`.
    pub(super) fn origin(&self, joints: &[usize], row: usize) -> Phrase {
        let row = &self.system.vector_form.rows[row];
        if !self.writes_prose || !joints.contains(&row.joint) {
            return Phrase::default();
        }
        let label = &self.system.mechanism.joints[row.joint].label;
        let component = match row.component {
            "" => String::new(),
            component => format!(", {component}"),
        };
        phrase![Piece::Name(label.clone()), component]
    }
}
