//! Resolves the statements of a document, in source order, into a mechanism.
//!
//! Methods of one `Resolver` resolve all kinds of statements, because operands contain formulas, and formulas contain points,
//! distances and tables. So each kind may lead to any other. What is resolved so far lies in types of its own: declarations, formulas,
//! linkage and forces. A name is declared before it is read, and each finding is reported once, in source order.

use std::collections::HashMap;
use std::sync::Arc;

use super::bodies::coordinate_names;
use super::bounds::beyond_bounds;
use super::declared::Declared;
use super::expression::{Value, listed};
use super::forces::Forces;
use super::formulas::Formulas;
use super::linkage::Linkage;
use super::mention::Mentions;
use super::naming::Naming;
use super::request::Named;
use super::units::chosen_units;
use super::{Constant, Dimension, Mechanism, Motion};
use crate::diagnostic::internal::work_at;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};
use crate::expr::{Graph, SymbolId};
use crate::joint::geometry::{Mark, Vector};
use crate::pool::Pool;
use crate::syntax::{self, BUILT_IN, RequestKind};
use crate::units::ReportUnits;

/// State of the resolution of a description.
pub(super) struct Resolver<'a> {
    pub graph: Graph,
    pub declared: Declared<'a>,
    pub formulas: Formulas,
    pub linkage: Linkage,
    pub forces: Forces,
    /// Gravity with its location; `None` before its statement.
    pub gravity: Option<(Vector, Span)>,
    /// True if a bound of the graph has been passed and reported.
    exceeded: bool,
    pub mentions: Mentions,
    pub diagnostics: &'a mut Diagnostics,
}

/// Resolves the mechanism of these statements: all of a document, or those of one motion.
///
/// Names may only be used below their declaration. Coordinates are named `x1, y1, phi1` for the body `1`, and `x_c1, y_c1,
/// phi_c1` for the body `c1`.
pub(super) fn resolve_statements<'a>(
    document: &'a syntax::Document,
    statements: &[&'a syntax::Statement],
    motion: Option<&syntax::Motion>,
    naming: &'static Naming,
    mentions: &mut Mentions,
    diagnostics: &mut Diagnostics,
) -> (Pool, Mechanism) {
    let mut graph = Graph::new();
    let item = &document.mechanism;
    // Coordinates are numbered before t, so that they precede t in every order of symbols.
    let mut carried = HashMap::new();
    for statement in statements {
        let body = match statement {
            syntax::Statement::Body(body) => body,
            syntax::Statement::Angle(angle) => {
                let [_, _, name] = coordinate_names(&angle.name.text);
                graph.symbol(&name);
                continue;
            }
            _ => continue,
        };
        for name in coordinate_names(&body.name.text) {
            graph.symbol(&name);
        }
        for member in &body.members {
            let (syntax::Member::Local { name, .. } | syntax::Member::Carried { name, .. }) =
                member;
            let first = (body.name.text.as_str(), name.span);
            carried.entry(name.text.as_str()).or_insert(first);
        }
    }
    let time = graph.symbol("t");
    let mut resolver = Resolver::new(graph, time, naming, diagnostics);
    resolver.mentions = mentions.take();
    resolver.declared.attachments = &document.attachments;
    resolver.declared.carried = carried;
    // A missing name has been reported.
    if !item.name.text.is_empty() {
        resolver.diagnostics.extend((naming.mechanism)(&item.name));
    }
    let chosen = chosen_units(statements, resolver.diagnostics);
    resolver.formulas.requested_units = document.units.clone().or(chosen);
    for statement in statements {
        let before = resolver.diagnostics.mark();
        resolver.add(statement);
        resolver.note_excess(before, statement.span());
        if resolver.exceeded || resolver.diagnostics.is_full() {
            break;
        }
    }
    if resolver.linkage.bodies.len() == 1 && !resolver.diagnostics.has_errors() {
        resolver.diagnostics.push(
            Diagnostic::error(
                Code::NoBodies,
                item.name.span,
                format!("mechanism `{}` has no bodies", item.name.text),
            )
            .help("declare one: `body 1 at (0, 0) { P: (1, 0) }`"),
        );
    }
    let mut all = statements.iter();
    resolver.declared.has_friction = all.any(|it| matches!(it, syntax::Statement::Friction(_)));
    let points = resolver.output_points();
    resolver.reject_columns(&points);
    let outputs = statements
        .iter()
        .filter_map(|it| it.request(RequestKind::Output));
    let named = Named::new(&points);
    let requests = outputs
        .flat_map(|output| resolver.requests(output, &named))
        .collect();
    let transmissions = resolver.transmissions(statements, &named);
    let sensitivities = resolver.sensitivities(statements, &points);
    let clearances = resolver.clearances(statements);
    let monitor = resolver.has(RequestKind::Monitor, statements);
    let is_unguarded = resolver.has(RequestKind::Unguarded, statements);
    let forces = resolver.wanted_forces(statements);
    let units = ReportUnits {
        requested: resolver.formulas.requested_units.take(),
        written: resolver.formulas.written_units.most(),
    };
    let end = resolver.diagnostics.mark();
    resolver.note_excess(end, item.name.span);
    resolver.note_used();
    let loads = forces.loads.iter();
    let loaded: Vec<Mark> = loads.flat_map(|it| it.element.marks()).collect();
    let characteristic_length = resolver
        .linkage
        .characteristic_length(&loaded, &resolver.graph);
    let constants = resolver.constants(statements);
    *mentions = resolver.mentions;
    let docs = document.docs.iter().chain(&item.docs).cloned().collect();
    let pool = Pool::new(resolver.graph, naming.apart);
    let mechanism = Mechanism {
        name: item.name.text.clone(),
        motion: motion.map(|motion| Motion {
            name: motion.name.text.clone(),
            docs: motion.docs.clone(),
            span: motion.name.span,
        }),
        docs,
        span: item.name.span,
        naming,
        time,
        constants,
        parameters: resolver.declared.parameters,
        inputs: resolver.declared.inputs,
        tables: resolver.declared.tables,
        bodies: resolver.linkage.bodies,
        joints: resolver
            .linkage
            .joints
            .into_iter()
            .map(|(joint, _)| joint)
            .collect(),
        points,
        measurements: resolver.declared.measurements,
        limits: resolver.declared.limits,
        motors: resolver.declared.motors,
        clearances,
        requests,
        transmissions,
        sensitivities,
        forces,
        monitor,
        is_unguarded,
        units,
        spellings: Arc::clone(&document.spellings),
        characteristic_length,
    };
    (pool, mechanism)
}

impl<'a> Resolver<'a> {
    /// Creates the state with only the ground declared.
    pub(super) fn new(
        graph: Graph,
        time: SymbolId,
        naming: &'static Naming,
        diagnostics: &'a mut Diagnostics,
    ) -> Resolver<'a> {
        Resolver {
            declared: Declared::new(),
            formulas: Formulas::new(time),
            linkage: Linkage::new(&graph, naming),
            forces: Forces::default(),
            gravity: None,
            graph,
            exceeded: false,
            mentions: None,
            diagnostics,
        }
    }
}

impl Resolver<'_> {
    /// Resolves one statement.
    fn add(&mut self, statement: &syntax::Statement) {
        let _work = work_at(statement.span());
        match statement {
            syntax::Statement::Constant(constant) => {
                self.add_constant(constant);
            }
            syntax::Statement::Given(given) => self.add_given(given),
            syntax::Statement::Parameter(parameter) => self.add_parameter(parameter),
            syntax::Statement::Input(input) => self.add_input(input),
            syntax::Statement::Table(table) => self.add_table(table),
            syntax::Statement::Points(points) => self.add_points(points),
            syntax::Statement::Body(body) => self.add_body(body),
            syntax::Statement::Angle(angle) => self.add_angle(angle),
            syntax::Statement::Curve(curve) => self.add_curve(curve),
            syntax::Statement::Joint(joint) => self.add_joint(joint),
            syntax::Statement::Drive(drive) => self.add_driver(drive),
            syntax::Statement::Free(free) => self.add_free(free),
            syntax::Statement::Equation(equation) => self.add_equation(equation),
            syntax::Statement::Mass(mass) => self.add_mass(mass),
            syntax::Statement::Gravity(gravity) => self.add_gravity(gravity),
            syntax::Statement::Element(element) => self.add_element(element),
            syntax::Statement::Force(force) => self.add_force(force),
            syntax::Statement::Torque(torque) => self.add_torque(torque),
            syntax::Statement::Measure(measure) => self.add_measure(measure),
            syntax::Statement::Limit(limit) => self.add_limit(limit),
            syntax::Statement::Motor(motor) => self.add_motor(motor),
            // Points are known after all bodies, and parameters and joints may follow.
            syntax::Statement::Clearance(_)
            | syntax::Statement::Friction(_)
            | syntax::Statement::Request(_)
            | syntax::Statement::Units(_) => {}
            // The statements of motions are passed separately.
            syntax::Statement::Motion(_) => {}
        }
    }

    /// Replaces the findings of a statement that passed a bound of the graph by one finding about the bound.
    fn note_excess(&mut self, before: usize, span: Span) {
        if let (Some(excess), false) = (self.graph.excess(), self.exceeded) {
            self.exceeded = true;
            self.diagnostics.forget_after(before);
            self.diagnostics.push(beyond_bounds(excess, span));
        }
    }

    /// Returns the constants of `const` statements, and those that uses of parts give.
    fn constants(&self, statements: &[&syntax::Statement]) -> Vec<Constant> {
        let declared = statements.iter().filter_map(|statement| {
            let (syntax::Statement::Constant(written)
            | syntax::Statement::Given(syntax::Adjustable {
                constant: written, ..
            })) = statement
            else {
                return None;
            };
            let (name, &(value, dimension)) =
                self.declared.constants.declaration(&written.name.text)?;
            // Omits a duplicate: its name was declared earlier.
            (name.span == written.name.span).then(|| Constant {
                name: name.text.clone(),
                value,
                dimension,
                span: name.span,
            })
        });
        declared.collect()
    }

    fn add_given(&mut self, given: &syntax::Adjustable) {
        if let Some(value) = self.add_constant(&given.constant) {
            self.limits(given, value);
        }
    }

    /// Adds a constant; returns its value unless it has an error.
    fn add_constant(&mut self, constant: &syntax::Constant) -> Option<Value> {
        let name = &constant.name;
        if !self.may_be_declared(name) {
            return None;
        }
        let value = self.value(&constant.value);
        if let Some((value, _)) = value
            && let Some(cause) = self.moving(value)
        {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NotConstant,
                    constant.value.span,
                    format!("a constant cannot depend on {cause}"),
                )
                .label("changes with time")
                .help("write the expression where it is used, in a `drive` statement"),
            );
        }
        let declared = value.unwrap_or((self.graph.one(), Dimension::Number));
        if let Some(duplicate) = self.declared.constants.declare(name, declared) {
            self.diagnostics.push(duplicate);
        }
        value.filter(|(value, _)| self.graph.is_fixed(*value))
    }

    /// Reports a predefined name; true if the name may be declared.
    pub(super) fn may_be_declared(&mut self, name: &syntax::Name) -> bool {
        if !BUILT_IN.contains(&name.text.as_str()) {
            return self.is_no_angle(name);
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::NameNotAllowed,
                name.span,
                format!("`{}` has a fixed meaning", name.text),
            )
            .help(format!(
                "{} cannot be declared; choose another name",
                listed(BUILT_IN)
            )),
        );
        false
    }
}
