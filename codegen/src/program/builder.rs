//! What forms of all kinds state their functions with.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::block::{Branch, Lowering, Measured, PageName};
use super::directional_derivatives::DirectionalDerivatives;
use super::forms::{Form, Solved};
use super::function::{Function, Level, Statement};
use super::path::Paths;
use crate::expr::{ExprId, Graph, Node, Number, Rational, SymbolId};
use crate::joint::geometry::{Vector, dot, turned};
use crate::system::System;
use crate::words::{Known, Phrase, Piece, phrase};

/// The statements of one block in the making.
pub struct Builder<'a> {
    /// The equations; their arena grows by what is computed on the way.
    pub system: &'a mut System,
    /// What has been found so far.
    pub known: &'a mut Known,
    pub(super) derivatives: &'a mut DirectionalDerivatives,
    pub(super) statements: Vec<Statement>,
    /// The number of the block, from 0.
    pub(super) place: usize,
    branches: &'a mut Vec<Branch>,
    pub(super) paths: &'a mut Paths,
    /// Arms that are defined already.
    pub(super) defined: HashSet<SymbolId>,
    measured: Vec<Measured>,
    page_names: HashMap<SymbolId, PageName>,
    written_out: HashSet<SymbolId>,
    pub(super) writes_prose: bool,
    /// How many links of the block change their length.
    pub(super) stretched: usize,
    /// What is noted of the closed forms inside a torn block, while they are stated.
    pub(super) inside: Option<Inside>,
}

/// What closed forms inside a torn block find.
#[derive(Debug, Default)]
pub(super) struct Inside {
    /// Their signs, with what has the sign in the drawing.
    pub signs: Vec<(SymbolId, f64)>,
    /// The directions of angles.
    pub directions: BTreeMap<usize, Direction>,
}

/// A closed form inside a torn block is too close to singular where the square of its sine is one part in so many: it amplifies
/// rounding eightfold.
const SLENDER: i128 = 64;

/// The cosine and the sine of an angle that was found.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// cos φ.
    pub cosine: ExprId,
    /// sin φ.
    pub sine: ExprId,
}

impl<'a> Builder<'a> {
    pub(super) fn new(lowering: &'a mut Lowering<'_>, place: usize) -> Builder<'a> {
        Builder {
            system: lowering.system,
            known: &mut lowering.known,
            derivatives: &mut lowering.derivatives,
            paths: &mut lowering.paths,
            branches: &mut lowering.branches,
            writes_prose: lowering.writes_prose,
            statements: Vec::new(),
            place,
            defined: HashSet::new(),
            measured: Vec::new(),
            page_names: HashMap::new(),
            written_out: HashSet::new(),
            stretched: 0,
            inside: None,
        }
    }

    /// The function, its measures, and how a page writes its local values.
    pub(super) fn finish(
        self,
    ) -> (
        Function,
        Vec<Measured>,
        HashMap<SymbolId, PageName>,
        HashSet<SymbolId>,
    ) {
        let function = Function {
            statements: self.statements,
            ..Function::default()
        };
        (function, self.measured, self.page_names, self.written_out)
    }

    /// The arena.
    pub fn graph(&mut self) -> &mut Graph {
        &mut self.system.mechanism.graph
    }

    /// Begins the statements of a level.
    pub(super) fn section(&mut self, level: Level) {
        self.statements.push(Statement::Section(level));
    }

    /// Says what is found, and from what.
    pub fn heading(&mut self, words: impl Into<Phrase>) {
        self.statements.push(Statement::Heading(words.into()));
    }

    /// Says something, where a person's words are wanted.
    pub fn say(&mut self, words: impl FnOnce(&mut Builder<'a>) -> Phrase) {
        if self.writes_prose {
            let words = words(self);
            if !words.is_empty() {
                self.statements.push(Statement::Note(words));
            }
        }
    }

    /// Shows equations that nobody computes, each as left, right and remark, where a person's words are wanted.
    pub fn show(&mut self, equations: impl FnOnce(&mut Builder<'a>) -> Vec<[Phrase; 3]>) {
        if self.writes_prose {
            let shown = equations(self).into_iter();
            let shown = shown.map(|[left, right, remark]| Statement::Shown {
                left,
                right,
                remark,
            });
            self.statements.extend(shown);
        }
    }

    /// A named local value; what is a symbol or a constant already needs no name.
    pub fn value(&mut self, name: &str, value: ExprId) -> ExprId {
        self.value_with(name, value, "")
    }

    /// The same with what a person says beside it.
    pub fn value_with(&mut self, name: &str, value: ExprId, remark: impl Into<Phrase>) -> ExprId {
        let graph = &self.system.mechanism.graph;
        if graph.is_constant(value) || matches!(graph.node(value), Node::Symbol(_)) {
            return value;
        }
        let is_fixed = graph.is_fixed(value);
        let target = self.system.intermediate(name);
        if is_fixed {
            let zero = self.system.mechanism.graph.zero();
            self.system.vector_form.set_rate(target, zero);
            self.derivatives.fix(target, value);
        }
        self.assign_with(target, value, remark);
        self.graph().variable(target)
    }

    /// A named local value that a page writes out wherever it occurs.
    pub fn factor(&mut self, name: &str, value: ExprId) -> ExprId {
        let named = self.value(name, value);
        if let Node::Symbol(symbol) = *self.system.mechanism.graph.node(named)
            && named != value
        {
            self.written_out.insert(symbol);
        }
        named
    }

    /// Both components of a vector as local values `name_x`, `name_y`. A page names a component, too, that needs no name.
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

    /// target = value.
    pub fn assign(&mut self, target: SymbolId, value: ExprId) {
        self.assign_with(target, value, "");
    }

    /// target = value, with what a person says beside it.
    pub fn assign_with(&mut self, target: SymbolId, value: ExprId, remark: impl Into<Phrase>) {
        let remark = remark.into();
        self.statements.push(Statement::Let {
            target,
            value,
            remark,
        });
    }

    /// What a page calls a symbol in this block.
    pub fn call(&mut self, symbols: Vector, name: &str) {
        for (axis, symbol) in symbols.into_iter().enumerate() {
            if let Node::Symbol(symbol) = *self.system.mechanism.graph.node(symbol) {
                let name = PageName::Component(name.to_string(), axis);
                self.page_names.insert(symbol, name);
            }
        }
    }

    /// Has a page write a local value as the cosine or the sine of an unknown.
    pub(super) fn call_function(&mut self, value: ExprId, unknown: usize, is_cosine: bool) {
        if let Node::Symbol(symbol) = *self.system.mechanism.graph.node(value) {
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

    /// a · b.
    pub fn dot(&mut self, a: Vector, b: Vector) -> ExprId {
        dot(a, b, self.graph())
    }

    /// a_x b_y − a_y b_x.
    pub fn cross(&mut self, a: Vector, b: Vector) -> ExprId {
        let graph = self.graph();
        let [forward, backward] = [graph.multiply(a[0], b[1]), graph.multiply(a[1], b[0])];
        graph.subtract(forward, backward)
    }

    /// a v + b w.
    pub fn combined(&mut self, a: ExprId, v: Vector, b: ExprId, w: Vector) -> Vector {
        [0, 1].map(|axis| {
            let graph = self.graph();
            let [first, second] = [graph.multiply(a, v[axis]), graph.multiply(b, w[axis])];
            graph.add(first, second)
        })
    }

    /// Half of a value.
    pub fn half(&mut self, value: ExprId) -> ExprId {
        self.graph().scale(Number::rational(Rational::HALF), value)
    }

    /// −v.
    pub fn negated(&mut self, vector: Vector) -> Vector {
        vector.map(|component| self.graph().negate(component))
    }

    /// Ω v: a vector turned by a quarter turn counterclockwise.
    pub fn across(&mut self, v: Vector) -> Vector {
        [self.graph().negate(v[1]), v[0]]
    }

    /// R(φ) v.
    pub fn turn(&mut self, direction: Direction, v: Vector) -> Vector {
        turned(direction.cosine, direction.sine, v, self.graph())
    }

    /// d/dt of an expression.
    pub fn rate(&mut self, expr: ExprId) -> ExprId {
        self.system
            .vector_form
            .rate(expr, &mut self.system.mechanism.graph)
    }

    /// The first or the second rate of an expression, or its derivative along a direction, or the rate of that.
    pub fn rate_at(&mut self, expr: ExprId, level: Level) -> ExprId {
        match level {
            Level::Position => expr,
            Level::Velocity => self.rate(expr),
            Level::Acceleration => {
                let first = self.rate(expr);
                self.rate(first)
            }
            Level::Response(direction) => self.along(expr, direction),
            Level::ResponseRate(direction) => {
                let response = self.along(expr, direction);
                self.rate(response)
            }
            // Nothing is differentiated for a force.
            Level::Forces => expr,
        }
    }

    /// The same with what the level finds of these unknowns taken as zero.
    pub fn drift_at(&mut self, expr: ExprId, unknowns: &[usize], level: Level) -> ExprId {
        let whole = self.rate_at(expr, level);
        let own = |unknown: &usize| {
            let unknown = &self.system.vector_form.unknowns[*unknown];
            match level {
                Level::Velocity => Some(unknown.rate),
                Level::Acceleration => Some(unknown.acceleration),
                // What has not been found is held.
                _ => None,
            }
        };
        let symbols: Vec<SymbolId> = unknowns.iter().filter_map(own).collect();
        self.without(whole, &symbols)
    }

    /// States what a level finds for an unknown.
    pub fn find(&mut self, unknown: usize, level: Level, value: ExprId) {
        let own = &self.system.vector_form.unknowns[unknown];
        let target = match level {
            Level::Position => own.position,
            Level::Velocity => own.rate,
            Level::Acceleration => own.acceleration,
            Level::Response(direction) => return self.respond(unknown, direction, value),
            Level::ResponseRate(direction) => return self.respond_rate(unknown, direction, value),
            // An unknown has no force of its own.
            Level::Forces => return,
        };
        self.assign(target, value);
    }

    /// An expression with some symbols set to zero.
    pub fn without(&mut self, expr: ExprId, symbols: &[SymbolId]) -> ExprId {
        let zero = self.system.mechanism.graph.zero();
        let replacements: Vec<_> = symbols.iter().map(|&symbol| (symbol, zero)).collect();
        self.graph().substitute(expr, &replacements)
    }

    /// An unknown as an expression.
    pub fn position(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].position;
        self.graph().variable(symbol)
    }

    /// The rate of an unknown as an expression.
    pub fn rate_of(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].rate;
        self.graph().variable(symbol)
    }

    /// The cosine and the sine of an angle as local values, of which a page knows the functions. The remark stands beside the first.
    pub fn direction(
        &mut self,
        unknown: usize,
        cosine: ExprId,
        sine: ExprId,
        remark: impl Into<Phrase>,
    ) -> Direction {
        let cosine = self.angle_function(unknown, true, cosine, remark.into());
        let sine = self.angle_function(unknown, false, sine, Phrase::default());
        Direction { cosine, sine }
    }

    /// The angle of a direction, and the arms that turn with it.
    pub fn angle(&mut self, unknown: usize, direction: Direction) {
        if let Some(inside) = &mut self.inside {
            inside.directions.insert(unknown, direction);
            return self.arms(unknown, direction);
        }
        let target = self.system.vector_form.unknowns[unknown].position;
        self.statements.push(Statement::Angle {
            target,
            sine: direction.sine,
            cosine: direction.cosine,
        });
        self.paths.note_direction(unknown, direction, self.system);
        self.arms(unknown, direction);
    }

    /// The arms that turn with an angle.
    pub fn arms(&mut self, unknown: usize, direction: Direction) {
        let arms: Vec<_> = self
            .system
            .vector_form
            .arms_of(unknown)
            .map(|arm| (arm.symbols, arm.local))
            .collect();
        for (symbols, local) in arms {
            if self.defined.insert(symbols[0]) {
                let turned = self.turn(direction, local);
                self.assign(symbols[0], turned[0]);
                self.assign(symbols[1], turned[1]);
            }
        }
    }

    /// Sine and cosine of an angle that is known explicitly, where an arm turns with it.
    pub fn explicit_angle(&mut self, unknown: usize) {
        if self.inside.is_none() && self.system.vector_form.arms_of(unknown).next().is_none() {
            return;
        }
        let name = self.system.unknown_name(unknown).to_string();
        let angle = self.position(unknown);
        let [sine, cosine] =
            ["sin", "cos"].map(|function| self.system.intermediate(&format!("{function}_{name}")));
        self.statements.push(Statement::SineCosine {
            sine,
            cosine,
            angle,
        });
        let direction = Direction {
            sine: self.graph().variable(sine),
            cosine: self.graph().variable(cosine),
        };
        if let Some(inside) = &mut self.inside {
            inside.directions.insert(unknown, direction);
        }
        self.arms(unknown, direction);
    }

    /// The statements that compute the arms of these unknowns from the unknowns themselves; as if nothing had been defined.
    pub fn geometry(&mut self, unknowns: &[usize]) -> Vec<Statement> {
        let before = std::mem::take(&mut self.statements);
        let defined = self.defined.clone();
        for &unknown in unknowns {
            self.explicit_angle(unknown);
        }
        self.defined = defined;
        std::mem::replace(&mut self.statements, before)
    }

    /// The turned vector R(φ) p of a form as symbols that move with the angle: an arm where p does not move. The remark stands beside
    /// its first component.
    pub fn link(
        &mut self,
        angle: usize,
        p: Vector,
        value: Vector,
        name: &str,
        remark: impl Into<Phrase>,
    ) -> Vector {
        let graph = &self.system.mechanism.graph;
        if !p.iter().all(|&part| graph.is_fixed(part)) {
            return self.vector(name, value);
        }
        let arm = self.system.arm(angle, p, name);
        let arms = &self.system.vector_form.arms;
        let own = arms
            .iter()
            .position(|it| it.angle == angle && it.local == p);
        if let Some(place) = own {
            let symbols = arms[place].symbols;
            if self.defined.insert(symbols[0]) {
                self.assign_with(symbols[0], value[0], remark);
                self.assign(symbols[1], value[1]);
            }
            self.derivatives.change_arm(place, self.system);
        }
        self.call(arm, name);
        arm
    }

    /// Fails where `excess` is not positive beside `scale`.
    pub fn reach(
        &mut self,
        excess: ExprId,
        scale: ExprId,
        [distance, longest, shortest]: [ExprId; 3],
    ) {
        if self.inside.is_some() {
            // Before its form is singular, rounding is amplified.
            let least = Rational::new(1, SLENDER).unwrap_or(Rational::ONE);
            let graph = self.graph();
            let least = graph.scale(Number::rational(least), scale);
            let excess = graph.subtract(excess, least);
            let zero = graph.zero();
            self.statements.push(Statement::Reach {
                excess,
                scale,
                distance: zero,
                longest: zero,
                shortest: zero,
            });
            return;
        }
        self.statements.push(Statement::Reach {
            excess,
            scale,
            distance,
            longest,
            shortest,
        });
    }

    /// Fails where a divisor vanishes beside `scale`; a constant one was looked at when the plan was made.
    pub fn nonzero(&mut self, value: ExprId, scale: ExprId) {
        if !self.system.mechanism.graph.is_constant(value) {
            self.statements.push(Statement::Nonzero { value, scale });
        }
    }

    /// A new assembly mode as a factor that is +1 or −1, which has the sign of the sine `drawn`. A page writes the sign of the drawing.
    pub fn branch(&mut self, name: String, meaning: String, drawn: f64) -> ExprId {
        if let Some(inside) = &mut self.inside {
            let symbol = self.system.intermediate("sign");
            inside.signs.push((symbol, drawn));
            return self.graph().variable(symbol);
        }
        let symbol = self.system.intermediate("branch");
        self.branches.push(Branch {
            name,
            symbol,
            block: self.place,
            drawn,
            meaning,
        });
        self.graph().variable(symbol)
    }

    /// How far a closed form whose position has been found is from singular, or a Newton block, as fields.
    pub(super) fn measure(&mut self, form: &dyn Form, found: &dyn Solved) {
        let names = form.unknowns().into_iter();
        let names: Vec<&str> = names.map(|it| self.system.unknown_name(it)).collect();
        let name = format!("normalized_determinant_{}", names.join("_"));
        let Some(value) = found.determinant() else {
            let both = ["", "_condition"]
                .map(|suffix| self.system.intermediate(&format!("{name}{suffix}")));
            if let Some(Statement::Newton { measure, .. }) = self
                .statements
                .iter_mut()
                .rev()
                .find(|it| matches!(it, Statement::Newton { .. }))
            {
                *measure = Some(both);
            }
            self.measured.push(Measured::Block(both));
            return;
        };
        let size = {
            let graph = &mut self.system.mechanism.graph;
            form.determinant(&self.system.vector_form, graph).size
        };
        let measure = match size {
            Some(size) => {
                // A length that moves is computed by itself; the others are part of a constant.
                let size = self.value("size", size);
                self.graph().divide(value, size)
            }
            None => value,
        };
        // What never moves is never singular.
        if self.system.mechanism.graph.is_fixed(measure) {
            return;
        }
        let target = self.system.intermediate(&name);
        self.assign(target, measure);
        self.measured.push(match size {
            Some(_) => Measured::Sine(target),
            None => Measured::Slope(target),
        });
    }

    /// The row that says `unknown = value`, in words: `revolute B(crank, coupler), x`.
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
