//! What the parts of a derivation are written with.

use std::rc::Rc;

use super::document::{Document, Equation, Item, Section};
use super::geometry::{Pin, pins};
use super::script::Script;
use crate::emit::named_parts::NamedParts;
use crate::expr::{ExprId, Graph, Number, Rational, SymbolId};
use crate::joint::geometry::Vector;
use crate::structure::SolvedPlan;
use crate::system::{SymbolRole, System};

/// A derivation in the making.
pub(super) struct Writer<'a> {
    /// A copy, since new formulas are made in its graph.
    pub system: System,
    pub plan: &'a SolvedPlan,
    pub script: Script,
    /// The block that finds each unknown, from 0; `None` while it is not found yet.
    pub found_in: Vec<Option<usize>>,
    /// Unknowns that are constant, with their values.
    pub(super) constants: Vec<(SymbolId, ExprId)>,
    /// The pins of the mechanism.
    pub(super) pins: Rc<[Pin]>,
    items: Vec<Item>,
    /// The names of long choices.
    pub(super) parts: NamedParts,
}

impl<'a> Writer<'a> {
    pub(super) fn new(system: &System, plan: &'a SolvedPlan, script: Script) -> Writer<'a> {
        Writer {
            system: system.clone(),
            plan,
            script,
            found_in: vec![None; system.vector_form.unknowns.len()],
            constants: Vec::new(),
            pins: pins(&system.mechanism).into(),
            items: Vec::new(),
            parts: NamedParts::default(),
        }
    }

    /// The whole derivation.
    pub(super) fn document(mut self) -> Document {
        let (summary, outline) = (self.summary(), self.outline());
        let plan = self.plan;
        let sections = plan.blocks.iter().enumerate().map(|(number, block)| {
            let heading = self.block(number, block);
            Section {
                heading,
                items: std::mem::take(&mut self.items),
            }
        });
        let mut sections: Vec<Section> = sections.collect();
        sections.extend(self.singular_section());
        Document {
            name: self.script.word(&self.system.mechanism.title()),
            summary,
            outline,
            sections,
        }
    }

    pub(super) fn paragraph(&mut self, text: impl Into<String>) {
        self.define(self.items.len());
        self.items.push(Item::Paragraph(text.into()));
    }

    pub(super) fn equations(&mut self, equations: Vec<Equation>) {
        if !equations.is_empty() {
            let introduced = matches!(self.items.last(), Some(Item::Paragraph(_)));
            self.define(self.items.len() - usize::from(introduced));
            self.items.push(Item::Equations(equations));
        }
    }

    /// Says at a place what the names stand for that were used since they were last defined.
    fn define(&mut self, place: usize) {
        let definitions = self.parts.definitions(&mut self.system);
        let equations: Vec<Equation> = definitions
            .iter()
            .map(|definition| Equation {
                left: self.formula(definition.name),
                right: self.script.value(&self.system, definition.value),
                note: String::new(),
            })
            .collect();
        if equations.is_empty() {
            return;
        }
        let slopes = equations
            .iter()
            .any(|equation| equation.left.contains("slope"));
        let words = if slopes {
            "Given piece by piece, slopes and curvatures as first and second derivatives:"
        } else {
            "Given piece by piece:"
        };
        let items = [
            Item::Paragraph(words.to_string()),
            Item::Equations(equations),
        ];
        self.items.splice(place..place, items);
    }

    pub(super) fn graph(&mut self) -> &mut Graph {
        &mut self.system.mechanism.graph
    }

    /// An expression as a formula.
    pub(super) fn formula(&self, expr: ExprId) -> String {
        self.script.expression(&self.system, &self.parts, expr)
    }

    /// An unknown as a formula.
    pub(super) fn unknown(&self, unknown: usize) -> String {
        self.script
            .symbol(&self.system, SymbolRole::Position(unknown))
    }

    /// An unknown between words.
    pub(super) fn named(&self, unknown: usize) -> String {
        self.script.inline(&self.unknown(unknown))
    }

    pub(super) fn variable(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].position;
        self.graph().variable(symbol)
    }

    /// The rate of an unknown as an expression.
    pub(super) fn rate_of(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].rate;
        self.graph().variable(symbol)
    }

    /// The acceleration of an unknown as an expression.
    pub(super) fn acceleration_of(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].acceleration;
        self.graph().variable(symbol)
    }

    /// A new name for a value, as an expression.
    pub(super) fn name(&mut self, name: &str) -> ExprId {
        let symbol = self.system.intermediate(name);
        self.graph().variable(symbol)
    }

    /// New names for the components of a vector.
    pub(super) fn components(&mut self, name: &str) -> Vector {
        ["x", "y"].map(|axis| self.name(&format!("{name}_{axis}")))
    }

    /// left = right, both expressions.
    pub(super) fn equation(
        &self,
        left: ExprId,
        right: ExprId,
        note: impl Into<String>,
    ) -> Equation {
        Equation {
            left: self.formula(left),
            right: self.formula(right),
            note: note.into(),
        }
    }

    /// expression = 0.
    pub(super) fn vanishing(&self, expr: ExprId, note: impl Into<String>) -> Equation {
        Equation {
            left: self.formula(expr),
            right: "0".to_string(),
            note: note.into(),
        }
    }

    /// Arms written out as sines and cosines of the angles that turn them.
    pub(super) fn written_out(&mut self, expr: ExprId) -> ExprId {
        let System {
            mechanism,
            vector_form,
            ..
        } = &mut self.system;
        vector_form.written_out(expr, &mut mechanism.graph)
    }

    /// The same with the values of constant unknowns put in.
    pub(super) fn with_numbers(&mut self, expr: ExprId) -> ExprId {
        let expr = self.written_out(expr);
        let constants = std::mem::take(&mut self.constants);
        let expr = self.graph().substitute(expr, &constants);
        self.constants = constants;
        expr
    }

    /// The constant unknowns in an expression with their values, as words: `x1 = 0 and x2 = sqrt(3)`.
    pub(super) fn numbers_in(&self, expr: ExprId) -> Vec<String> {
        let graph = &self.system.mechanism.graph;
        self.constants
            .iter()
            .filter(|(symbol, _)| graph.depends_on(expr, *symbol))
            .map(|(symbol, value)| {
                let role = self.system.roles[symbol.index()];
                let name = self.script.symbol(&self.system, role);
                self.script
                    .inline(&format!("{name} = {}", self.formula(*value)))
            })
            .collect()
    }

    /// Notes that an unknown is found from now on, as a constant where its value is one.
    pub(super) fn found(&mut self, unknown: usize, block: usize, value: Option<ExprId>) {
        self.found_in[unknown] = Some(block);
        let symbol = self.system.vector_form.unknowns[unknown].position;
        if let Some(value) = value
            && self.system.mechanism.graph.is_fixed(value)
        {
            self.constants.push((symbol, value));
        }
    }

    /// R(φ) v written out.
    pub(super) fn turn(&mut self, angle: usize, v: Vector) -> Vector {
        let angle = self.variable(angle);
        turned(angle, v, self.graph())
    }

    pub(super) fn half(&mut self, expr: ExprId) -> ExprId {
        self.graph().scale(Number::rational(Rational::HALF), expr)
    }

    /// The square of an expression.
    pub(super) fn square(&mut self, expr: ExprId) -> ExprId {
        self.graph().multiply(expr, expr)
    }

    /// a · b.
    pub(super) fn dot(&mut self, a: Vector, b: Vector) -> ExprId {
        crate::joint::geometry::dot(a, b, self.graph())
    }

    /// a_x b_y − a_y b_x.
    pub(super) fn cross(&mut self, a: Vector, b: Vector) -> ExprId {
        let graph = self.graph();
        let [forward, backward] = [graph.multiply(a[0], b[1]), graph.multiply(a[1], b[0])];
        graph.subtract(forward, backward)
    }

    /// d/dt of an expression of unknowns and t.
    pub(super) fn derivative(&mut self, expr: ExprId) -> ExprId {
        self.parts.relate(&mut self.system, expr, 1);
        let System {
            mechanism,
            vector_form,
            ..
        } = &mut self.system;
        vector_form.rate(expr, &mut mechanism.graph)
    }

    /// An expression with some symbols set to zero.
    pub(super) fn without(&mut self, expr: ExprId, unknowns: &[usize]) -> ExprId {
        let zero = self.graph().zero();
        let replacements: Vec<_> = unknowns
            .iter()
            .flat_map(|&unknown| {
                let unknown = &self.system.vector_form.unknowns[unknown];
                [(unknown.rate, zero), (unknown.acceleration, zero)]
            })
            .collect();
        self.graph().substitute(expr, &replacements)
    }

    /// The value of an expression of unknowns and arms in the drawing.
    pub(super) fn drawn(&mut self, expr: ExprId) -> f64 {
        let expr = self.written_out(expr);
        let estimates: Vec<_> = self
            .system
            .vector_form
            .unknowns
            .iter()
            .map(|unknown| (unknown.position, unknown.estimate))
            .collect();
        let graph = self.graph();
        let value = graph.substitute(expr, &estimates);
        // What depends on nothing but unknowns has a value in the drawing; a sign taken from anything else says nothing.
        graph.constant_value(value).unwrap_or(0.0)
    }
}

/// R(φ) v as sines and cosines.
fn turned(angle: ExprId, v: Vector, graph: &mut Graph) -> Vector {
    let (sine, cosine) = (graph.sin(angle), graph.cos(angle));
    let [cx, sy] = [graph.multiply(cosine, v[0]), graph.multiply(sine, v[1])];
    let [sx, cy] = [graph.multiply(sine, v[0]), graph.multiply(cosine, v[1])];
    [graph.subtract(cx, sy), graph.add(sx, cy)]
}
