//! Resolves `transmission` statements into the quantities whose rates are requested per rate of each driver.

use std::collections::HashMap;

use super::request::Named;
use super::resolve::Resolver;
use super::{Point, Requested, Role, field_name};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax::{OutputItem, RequestKind, Statement};

impl Resolver<'_> {
    /// Resolves all `transmission` statements in source order; items with an error are reported and omitted.
    pub(super) fn transmissions(
        &mut self,
        statements: &[&Statement],
        points: &Named<'_>,
    ) -> Vec<Requested> {
        let mut quantities: Vec<Requested> = Vec::new();
        let mut spans: HashMap<Requested, Span> = HashMap::new();
        let mut names: HashMap<String, Span> = HashMap::new();
        for statement in statements {
            let Some(transmission) = statement.request(RequestKind::Transmission) else {
                continue;
            };
            self.require_drivers(transmission.span, "has no column for it", "`transmission`");
            for item in &transmission.items {
                let Some(quantity) = self.requested(item, points) else {
                    continue;
                };
                if let Requested::Measure(measure) = quantity
                    && self.declared.measurements[measure].order > 0
                {
                    self.report_moving_measure(place(item));
                    continue;
                }
                match spans.get(&quantity) {
                    Some(&earlier) => self.diagnostics.push(
                        Diagnostic::error(
                            Code::DuplicateName,
                            place(item),
                            "this transmission is requested twice",
                        )
                        .label("named again here")
                        .also(earlier, "first named here")
                        .help("remove one of them"),
                    ),
                    None => {
                        let name = self.generated_name(quantity, points.points);
                        self.reject_equal_names(&name, place(item), &names);
                        names.entry(name).or_insert(place(item));
                        spans.insert(quantity, place(item));
                        quantities.push(quantity);
                    }
                }
            }
        }
        quantities
    }

    /// Reports a point with the name of a coordinate in the same statements, as their functions would have equal names.
    fn reject_equal_names(&mut self, name: &str, span: Span, earlier: &HashMap<String, Span>) {
        if let Some(&other) = earlier.get(name) {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NameNotAllowed,
                    span,
                    format!("both would be `transmission_{name}` in the generated code"),
                )
                .also(other, "the other one")
                .help("give the point another name"),
            );
        }
    }

    fn report_moving_measure(&mut self, span: Span) {
        self.diagnostics.push(
            Diagnostic::error(Code::WrongForm, span, "this measure has no transmission")
                .label("contains rates or forces")
                .help("request the transmission of a measure of positions"),
        );
    }

    /// Returns the stem of the function names of a quantity: `k` of the point `K`, `phi_c1` of the angle of the body `c1`.
    pub(super) fn generated_name(&self, quantity: Requested, points: &[Point]) -> String {
        match quantity {
            Requested::Point(place) => points[place].name.to_lowercase(),
            Requested::Measure(place) => field_name(&self.declared.measurements[place].name),
            Requested::Coordinate(place) => {
                let bodies = self.linkage.bodies.iter();
                let mut coordinates = bodies.flat_map(|body| body.coordinates).flatten();
                let coordinate = coordinates.find(|it| it.place == place);
                coordinate
                    .map(|it| self.graph.symbol_name(it.symbol).to_string())
                    .unwrap_or_default()
            }
        }
    }

    /// Requires drivers of quantities. `label` says what a time-dependent equation lacks, `statement` requires the driver.
    pub(super) fn require_drivers(&mut self, span: Span, label: &str, statement: &str) {
        let joints = self.linkage.joints.iter().map(|(joint, _)| joint);
        let mut drivers = joints.filter(|joint| joint.role == Role::Driver);
        // A time-dependent equation has no value whose rate could define a column.
        let equation = drivers.clone().find(|it| it.operands.value.is_none());
        let finding = |problem: String| Diagnostic::error(Code::WrongForm, span, problem);
        if let Some(equation) = equation {
            let problem = format!(
                "`{}` moves with time, but does not drive a single quantity",
                equation.label
            );
            let help = "write what moves as a `drive` statement, and the equation without it";
            let finding = finding(problem)
                .label(label)
                .also(equation.span, "moves with time")
                .help(help);
            self.diagnostics.push(finding);
        // A driver with an error has been reported.
        } else if drivers.next().is_none() && !self.diagnostics.has_errors() {
            let problem = format!("{statement} requires a driver");
            self.diagnostics
                .push(finding(problem).help(
                    "add a driver, for example `drive phi(1) = t;`, or remove the statement",
                ));
        }
    }
}

/// Returns the location of an item.
fn place(item: &OutputItem) -> Span {
    match item {
        OutputItem::Point(reference) => reference.span,
        OutputItem::Coordinate { span, .. } => *span,
    }
}
