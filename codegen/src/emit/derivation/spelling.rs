//! Writes expressions and phrases as formulas and sentences in a script.
//!
//! The value of a symbol on the page stands in its place: the number of an unknown, the cosines and sines of a
//! rotated local vector, the value of a local name that a textbook would not introduce.

use std::collections::HashMap;

use super::script::Script;
use crate::emit::named_parts::NamedParts;
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::geometry::{Vector, turned};
use crate::pool::{Draft, SymbolRole};
use crate::system::{System, VectorTerm};
use crate::words::{Phrase, Piece};

/// Spelling of the formulas on one page.
pub(super) struct Spelling<'a> {
    /// New formulas extend it.
    pub pool: &'a mut Draft,
    /// Equations.
    pub system: &'a System,
    pub script: Script,
    /// The names of long choices.
    pub parts: NamedParts,
    /// Replacement of a symbol; only looked up.
    replacements: HashMap<SymbolId, ExprId>,
}

impl<'a> Spelling<'a> {
    pub(super) fn new(pool: &'a mut Draft, system: &'a System, script: Script) -> Spelling<'a> {
        Spelling {
            pool,
            system,
            script,
            parts: NamedParts::default(),
            replacements: HashMap::new(),
        }
    }

    pub(super) fn graph(&mut self) -> &mut Graph {
        &mut self.pool.graph
    }

    /// Replaces a symbol by an expression without other replaced symbols.
    pub(super) fn replace(&mut self, symbol: SymbolId, value: ExprId) {
        self.replacements.insert(symbol, value);
    }

    /// Returns an expression with all replacements.
    pub(super) fn written(&mut self, expr: ExprId) -> ExprId {
        let symbols = self.pool.graph.symbols(expr).to_vec();
        let mut replaced = Vec::new();
        for symbol in symbols {
            if let Some(&value) = self.replacements.get(&symbol) {
                replaced.push((symbol, value));
            } else if let SymbolRole::Arm(place) = self.pool.role(symbol) {
                replaced.push((symbol, self.written_arm(place, symbol)));
            }
        }
        match replaced.is_empty() {
            true => expr,
            false => self.graph().substitute(expr, &replaced),
        }
    }

    /// Component of a rotated local vector as cosines and sines of its angle.
    fn written_arm(&mut self, place: usize, symbol: SymbolId) -> ExprId {
        let arm = self.pool.arms()[place].clone();
        let component = usize::from(symbol != arm.symbols[0]);
        let position = self.pool.position(arm.angle);
        let graph = self.graph();
        let angle = graph.variable(position);
        let (sine, cosine) = (graph.sin(angle), graph.cos(angle));
        let written = turned(cosine, sine, arm.local, graph)[component];
        self.written(written)
    }

    /// An expression as a formula.
    pub(super) fn formula(&mut self, expr: ExprId) -> String {
        let written = self.written(expr);
        self.formula_as_is(written)
    }

    /// Formula without replacements.
    pub(super) fn formula_as_is(&self, expr: ExprId) -> String {
        let is_long = self.parts.meet(&self.pool.graph, expr);
        self.script
            .expression(self.pool, self.system, &self.parts, is_long, expr)
    }

    /// An unknown, its rate or its acceleration.
    pub(super) fn symbol(&self, role: SymbolRole) -> String {
        self.script.symbol(self.pool, self.system, role)
    }

    /// A phrase as a sentence: formulas stand between words.
    pub(super) fn phrase(&mut self, phrase: &Phrase) -> String {
        let spelled = phrase.pieces().iter().map(|piece| match piece {
            Piece::Text(text) => self.script.words(text),
            Piece::Name(name) => self.script.word(name),
            other => {
                let formula = self.piece(other);
                self.script.inline(&formula)
            }
        });
        let spelled: String = spelled.collect();
        self.script.joined(&spelled)
    }

    /// A phrase as a formula of its own.
    pub(super) fn side(&mut self, phrase: &Phrase) -> String {
        let spelled = phrase.pieces().iter().map(|piece| match piece {
            Piece::Text(text) | Piece::Name(text) => self.script.typed(text),
            other => self.piece(other),
        });
        spelled.collect()
    }

    fn piece(&mut self, piece: &Piece) -> String {
        let script = self.script;
        match piece {
            Piece::Text(text) | Piece::Name(text) => text.clone(),
            Piece::Unknown(unknown) => self.symbol(SymbolRole::Position(*unknown)),
            Piece::Rate(unknown) => self.symbol(SymbolRole::Rate(*unknown)),
            Piece::Acceleration(unknown) => self.symbol(SymbolRole::Acceleration(*unknown)),
            Piece::Formula(expr) => self.formula(*expr),
            Piece::Pair(pair) => self.pair(*pair),
            Piece::Turned(angle, v) => self.turned(*angle, *v),
            Piece::Sum(pair) => self.sum(*pair),
            Piece::Local(name) => self.local(name),
            Piece::Vector(name) => script.vector(name),
            Piece::Length(name) => script.length(name),
            Piece::Square(name) => script.square(&script.length(name)),
            Piece::Across(name) => script.perpendicular(name),
            Piece::Dot(first, second) => script.dot(first, second),
            Piece::Cross(first, second) => script.cross(first, second),
            Piece::Matrix(name, index) => script.matrix(name, index),
            Piece::Numbered(name, number) => script.numbered(name, *number),
            Piece::Times => script.times().to_string(),
            Piece::Minus => format!(" {} ", script.minus()),
            Piece::Opposite => script.minus().to_string(),
        }
    }

    /// A name as a symbol.
    fn local(&mut self, name: &str) -> String {
        let symbol = self.pool.intermediate(name);
        let variable = self.graph().variable(symbol);
        self.formula_as_is(variable)
    }

    /// `(a, b)`.
    fn pair(&mut self, pair: Vector) -> String {
        let [x, y] = pair.map(|part| self.formula(part));
        self.script.pair(&x, &y)
    }

    /// `R(phi) (a, b)`.
    fn turned(&mut self, angle: usize, v: Vector) -> String {
        let angle = self.symbol(SymbolRole::Position(angle));
        format!("{} {}", self.script.rotation(&angle), self.pair(v))
    }

    /// Two expressions as one vector: `r_c3 + R(phi_c3) (0.3, 0.2) - (0.4, -0.2)`; as a pair of components if they
    /// are not such a sum.
    fn sum(&mut self, pair: Vector) -> String {
        let Some(terms) = self.system.vector_sum(pair, self.pool) else {
            return self.pair(pair);
        };
        let mut terms: Vec<(bool, String)> = terms.into_iter().map(|it| self.term(it)).collect();
        // A sum does not begin with a minus where that can be avoided.
        if let Some(first) = terms.iter().position(|(negative, _)| !negative) {
            terms[..=first].rotate_right(1);
        }
        let minus = self.script.minus();
        let mut text = String::new();
        for (place, (negative, term)) in terms.iter().enumerate() {
            text.push_str(&match (place, negative) {
                (0, false) => String::new(),
                (0, true) => minus.to_string(),
                (_, false) => format!(" {} ", self.script.plus()),
                (_, true) => format!(" {minus} "),
            });
            text.push_str(term);
        }
        text
    }

    /// Term of a sum of vectors; true if it is subtracted.
    fn term(&mut self, term: VectorTerm) -> (bool, String) {
        let (factor, vector) = match term {
            VectorTerm::Constant(pair) => return (false, self.pair(pair)),
            VectorTerm::Origin(body, factor) => {
                let name = &self.system.mechanism.bodies[body].name;
                (factor, self.script.origin(name))
            }
            VectorTerm::Turned(angle, v, factor) => (factor, self.turned(angle, v)),
        };
        let graph = self.graph();
        let (one, minus) = (graph.one(), graph.negate(factor));
        if factor == one {
            return (false, vector);
        }
        if minus == one {
            return (true, vector);
        }
        let negative = self.formula(factor).starts_with(self.script.minus());
        let size = self.formula(if negative { minus } else { factor });
        (negative, format!("{size}{}{vector}", self.script.times()))
    }
}
