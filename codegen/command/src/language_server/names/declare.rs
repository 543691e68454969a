//! Walks over a document for declarations, before mentions are sought.

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::{
    Document, ExpandedSort, Expansion, Member, Name, Statement,
};

use super::scope::{Scopes, Space};
use super::{Sort, Symbol, SymbolId};

impl Scopes {
    /// Declares all names. Points that bodies carry come last, since they may be drawn below.
    pub(super) fn declare_all(&mut self, document: &Document) {
        let item = &document.mechanism;
        if !item.name.text.is_empty() {
            self.plain(Sort::Mechanism, &item.name, item.span, &item.docs);
        }
        self.statements(&item.statements);
        for statement in &item.statements {
            self.declare_members(statement);
        }
    }

    fn statements(&mut self, statements: &[Statement]) {
        for statement in statements {
            self.declare_statement(statement);
        }
    }

    /// Declares a symbol whose declaration is a whole statement.
    fn plain(&mut self, sort: Sort, name: &Name, statement: Span, docs: &[String]) -> SymbolId {
        self.declare(Symbol {
            sort,
            name: name.text.clone(),
            spelled: name.text.clone(),
            place: name.span,
            declared: name.span,
            written: statement,
            statement,
            opening: "",
            docs: docs.to_vec(),
            body: None,
            motion: self.motion,
        })
    }

    /// Adds indices, parts and mechanisms that are parts, which the parser has resolved, with their mentions.
    pub(super) fn add_expanded(&mut self, expansion: &Expansion) {
        for own in &expansion.declared {
            let sort = match own.sort {
                ExpandedSort::Index => Sort::Index,
                ExpandedSort::Part => Sort::Part,
                ExpandedSort::Mechanism => Sort::Mechanism,
            };
            if !own.name.text.is_empty() && self.declared_at(own.name.span).is_none() {
                self.plain(sort, &own.name, own.span, &[]);
            }
        }
        for &[span, declaration] in &expansion.mentions {
            if let Some(symbol) = self.declared_at(declaration) {
                self.mention(span, symbol);
            }
        }
    }

    fn declare_statement(&mut self, statement: &Statement) {
        let span = statement.span();
        match statement {
            Statement::Constant(own) => {
                self.plain(Sort::Constant, &own.name, span, &own.docs);
            }
            Statement::Parameter(own) => {
                self.plain(Sort::Parameter, &own.name, span, &own.docs);
            }
            Statement::Input(own) => {
                self.plain(Sort::Input, &own.name, span, &own.docs);
            }
            Statement::Table(own) => {
                self.plain(Sort::Table, &own.name, span, &own.docs);
            }
            Statement::Points(own) => {
                for point in &own.points {
                    self.declare(Symbol {
                        sort: Sort::Point,
                        name: point.name.text.clone(),
                        spelled: point.name.text.clone(),
                        place: point.name.span,
                        declared: point.name.span,
                        written: point.name.span.to(point.position.span),
                        statement: span,
                        opening: "point ",
                        docs: own.docs.clone(),
                        body: None,
                        motion: self.motion,
                    });
                }
            }
            Statement::Body(own) => {
                self.plain(Sort::Body, &own.name, span, &own.docs);
            }
            Statement::Angle(own) => {
                self.plain(Sort::Angle, &own.name, span, &own.docs);
            }
            Statement::Curve(own) => {
                self.plain(Sort::Curve, &own.name, span, &own.docs);
                self.plain(Sort::CurveParameter, &own.parameter, span, &[]);
            }
            Statement::Drive(own) => {
                if let Some(name) = &own.name {
                    self.plain(Sort::Driver, name, span, &own.docs);
                }
            }
            Statement::Free(own) => {
                self.plain(Sort::Free, &own.name, span, &own.drive.docs);
            }
            Statement::Equation(own) => {
                if let Some(name) = &own.name {
                    self.plain(Sort::Equation, name, span, &own.docs);
                }
            }
            Statement::Element(own) => {
                if let Some(name) = &own.name {
                    self.plain(Sort::Element, name, span, &own.docs);
                }
            }
            Statement::Motion(own) => {
                if !own.name.text.is_empty() {
                    self.plain(Sort::Motion, &own.name, span, &own.docs);
                }
                self.motion = Some(span);
                self.statements(&own.statements);
                self.motion = None;
            }
            // The name of a joint may be that of a point: operands are considered together with it.
            Statement::Joint(_)
            | Statement::Request(_)
            | Statement::Mass(_)
            | Statement::Gravity(_)
            | Statement::Force(_)
            | Statement::Torque(_)
            | Statement::Units(_) => {}
        }
    }

    /// Declares the points that a body lists.
    fn declare_members(&mut self, statement: &Statement) {
        let Statement::Body(own) = statement else {
            return;
        };
        let Some(body) = self.find(Space::Bodies, &own.name.text) else {
            return;
        };
        for member in &own.members {
            let (docs, name, written) = match member {
                Member::Local {
                    docs,
                    name,
                    position,
                } => (docs, name, name.span.to(position.span)),
                Member::Carried { docs, name } => {
                    if let Some(drawn) = self.find(Space::Drawn, &name.text) {
                        self.mention(name.span, drawn);
                        self.carry(body, drawn);
                        continue;
                    }
                    (docs, name, name.span)
                }
            };
            let point = self.declare(Symbol {
                sort: Sort::BodyPoint,
                name: name.text.clone(),
                spelled: name.text.clone(),
                place: name.span,
                declared: name.span,
                written,
                statement: own.span,
                opening: "",
                docs: docs.clone(),
                body: Some(body),
                motion: None,
            });
            self.carry(body, point);
            // A point that is drawn under the name of a body's point is declared where it is drawn.
            if let Some(drawn) = self.find(Space::Drawn, &name.text) {
                self.unite(drawn, point);
            }
        }
    }
}
