//! Walks over a document for declarations.

use std::collections::HashSet;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::model;
use linkwright_codegen::stages::syntax::{
    Body, Document, ExpandedSort, Expansion, Member, Name, Statement,
};

use super::collector::Collector;
use super::{Sort, Symbol, SymbolId};

/// Places and names of uses; only looked up.
type Used<'a> = HashSet<(Span, &'a str)>;

impl Collector {
    /// Declares all names, then records their uses.
    pub(super) fn add_all(&mut self, document: &Document) {
        let item = &document.mechanism;
        if !item.name.text.is_empty() {
            self.plain(Sort::Mechanism, &item.name, item.span, &item.docs);
        }
        let uses = model::mentions(document);
        let used = uses.iter().map(|it| (it.span, it.name.as_str()));
        self.statements(&item.statements, &used.collect());
        for used in &uses {
            self.add_use(used);
        }
        for statement in &item.statements {
            if let Statement::Body(own) = statement {
                self.carry_all(own);
            }
        }
        self.expanded(&document.expansion);
    }

    fn statements(&mut self, statements: &[Statement], used: &Used<'_>) {
        for statement in statements {
            self.declare_statement(statement, used);
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
    fn expanded(&mut self, expansion: &Expansion) {
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
        for &[place, declaration] in &expansion.mentions {
            self.add_expanded(place, declaration);
        }
    }

    fn declare_statement(&mut self, statement: &Statement, used: &Used<'_>) {
        let span = statement.span();
        match statement {
            Statement::Constant(own) => {
                self.plain(Sort::Constant, &own.name, span, &own.docs);
            }
            Statement::Given(own) => {
                self.plain(Sort::Constant, &own.constant.name, span, &own.constant.docs);
            }
            Statement::Parameter(own) => {
                self.plain(
                    Sort::Parameter,
                    &own.constant.name,
                    span,
                    &own.constant.docs,
                );
            }
            Statement::Input(own) => {
                self.plain(Sort::Input, &own.constant.name, span, &own.constant.docs);
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
                let body = self.plain(Sort::Body, &own.name, span, &own.docs);
                self.declare_members(body, own, used);
            }
            Statement::Angle(own) => {
                self.plain(Sort::Angle, &own.name, span, &own.docs);
            }
            Statement::Measure(own) => {
                self.plain(Sort::Measure, &own.name, span, &own.docs);
            }
            Statement::Curve(own) => {
                self.plain(Sort::Curve, &own.name, span, &own.docs);
                self.plain(Sort::CurveParameter, &own.parameter, span, &[]);
            }
            // A joint may use the name of a point of its bodies.
            Statement::Joint(own) => {
                let name = own.name.as_ref();
                if let Some(name) = name.filter(|it| !used.contains(&(it.span, &it.text))) {
                    self.plain(Sort::Joint, name, span, &own.docs);
                }
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
                self.statements(&own.statements, used);
                self.motion = None;
            }
            Statement::Request(_)
            | Statement::Mass(_)
            | Statement::Gravity(_)
            | Statement::Force(_)
            | Statement::Torque(_)
            | Statement::Limit(_)
            | Statement::Clearance(_)
            | Statement::Friction(_)
            | Statement::Motor(_)
            | Statement::Units(_) => {}
        }
    }

    /// Declares the points that a body lists, except for global points, which a list only names.
    fn declare_members(&mut self, body: SymbolId, own: &Body, used: &Used<'_>) {
        for member in &own.members {
            let (docs, name, written) = match member {
                Member::Local {
                    docs,
                    name,
                    position,
                } => (docs, name, name.span.to(position.span)),
                Member::Carried { name, .. } if used.contains(&(name.span, &name.text)) => continue,
                Member::Carried { docs, name } => (docs, name, name.span),
            };
            self.declare(Symbol {
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
        }
    }

    fn carry_all(&mut self, own: &Body) {
        for member in &own.members {
            let (Member::Local { name, .. } | Member::Carried { name, .. }) = member;
            self.carry(&own.name, name);
        }
    }
}
