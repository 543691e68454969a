//! Resolves names in equations besides constants and t: `x(1)`, `phi(1)`, `K.x` and names alone.

use super::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::joint::geometry::{BodyId, Mark};
use crate::syntax::{Expression, ExpressionKind, Name, Reference};

/// Names of rates in other languages.
const RATES: &[&str] = &[
    "velocity",
    "speed",
    "acceleration",
    "omega",
    "alpha",
    "rate",
    "der",
    "diff",
    "ddt",
    "dot",
    "vx",
    "vy",
    "ax",
    "ay",
    "xd",
    "yd",
    "phid",
    "xdot",
    "ydot",
    "phidot",
];

impl Resolver<'_> {
    /// Resolves a call that has a particular meaning in equations; `None` for any other call.
    pub(super) fn kinematic_call(
        &mut self,
        function: &Name,
        arguments: &[Expression],
        span: Span,
    ) -> Option<Option<Value>> {
        if let Some(value) = self.measure_call(function, arguments, span) {
            return Some(value);
        }
        let is_load = self.formulas.kinematic.as_ref()?.is_of_load();
        let name = function.text.as_str();
        if is_load && name == "rate" {
            return Some(self.rate_in_load(arguments, span));
        }
        if RATES.contains(&name) {
            self.report_rate(function);
            return Some(None);
        }
        match (name, arguments) {
            ("x" | "y" | "phi", [of]) => Some(self.coordinate(function, of)),
            ("x" | "y" | "phi", _) => {
                let count = arguments.len();
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::WrongArgumentCount,
                        span,
                        format!("`{name}` takes 1 argument, not {count}"),
                    )
                    .label(format!("{count} given"))
                    .help("write `x(1)`, `y(1)` or `phi(1)` with the name of one body"),
                );
                Some(None)
            }
            ("distance", [from, to]) => Some(self.live_distance([from, to])),
            _ => None,
        }
    }

    /// Resolves `x(1)`, `y(1.P)`, `phi(1)`.
    fn coordinate(&mut self, axis: &Name, of: &Expression) -> Option<Value> {
        let reference = self.written_place(axis, of)?;
        if axis.text == "phi" {
            let body = self.turning_body(&reference)?;
            return Some((self.linkage.bodies[body.0].frame.angle, Dimension::Angle));
        }
        let is_body =
            reference.body.is_none() && self.declared.body_ids.get(&reference.name.text).is_some();
        let mark = if is_body {
            self.moving_body(&reference.name)?;
            self.origin_mark(&reference)?
        } else {
            self.live_point(&reference)?
        };
        let position = self.live_position(mark);
        let component = usize::from(axis.text == "y");
        Some((position[component], Dimension::LENGTH))
    }

    /// Resolves a body named alone, for its angle.
    fn turning_body(&mut self, reference: &Reference) -> Option<BodyId> {
        let mark = self.turning_mark(reference)?;
        self.moving_body(&reference.name)?;
        self.mention_mark(mark);
        Some(mark.frame.body)
    }

    /// Returns the body or point in an argument; an integer may name a body.
    pub(super) fn written_place(
        &mut self,
        function: &Name,
        argument: &Expression,
    ) -> Option<Reference> {
        match &argument.kind {
            ExpressionKind::Reference(reference) => Some(reference.clone()),
            ExpressionKind::Number { digits, unit: None }
                if digits.bytes().all(|byte| byte.is_ascii_digit()) =>
            {
                Some(Reference {
                    body: None,
                    name: Name {
                        text: digits.clone(),
                        span: argument.span,
                    },
                    span: argument.span,
                })
            }
            _ => {
                let (wanted, example) = match function.text.as_str() {
                    "phi" => ("a body", "`phi(1)`"),
                    "distance" => ("points", "`distance(A, B)` or `distance(c1.A, c2.B)`"),
                    _ => ("a body or a point", "`x(1)` or `x(1.P)`"),
                };
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::OutsideGrammar,
                        argument.span,
                        format!("`{}` takes {wanted}", function.text),
                    )
                    .label("not a name")
                    .help(format!("write {example}")),
                );
                None
            }
        }
    }

    /// Resolves a name in an equation that is not a constant: `K.x`; reports an error for others.
    pub(super) fn live_name(&mut self, reference: &Reference) -> Option<Value> {
        let name = &reference.name;
        if reference.body.is_none()
            && let Some(value) = self.measure_named(name)
        {
            return value;
        }
        if let Some(owner) = &reference.body {
            let owner = Reference {
                body: None,
                name: owner.clone(),
                span: owner.span,
            };
            if self.is_point(&owner.name.text) && !self.is_on_body(&owner.name, name) {
                return self.component_of(&owner, name, reference.span);
            }
            let body = self.body(&owner.name)?;
            if matches!(name.text.as_str(), "x" | "y") && !self.is_on_body(&owner.name, name) {
                self.moving_body(&owner.name)?;
                let mark = self.origin_mark(&owner)?;
                return self.axis(mark, name);
            }
            // Reports an error if the point is not on the body.
            self.mark_on(body, name)?;
        }
        if let (None, Some(body)) = (&reference.body, self.angle_named(&name.text)) {
            let mark = self.turning_mark(reference)?;
            self.mention_mark(mark);
            return Some((self.linkage.bodies[body.0].frame.angle, Dimension::Angle));
        }
        let message = |what: &str| format!("a {what} is not a number");
        let finding = |what: &str| {
            Diagnostic::error(Code::OutsideGrammar, reference.span, message(what))
                .label(format!("this is a {what}"))
        };
        let text = &name.text;
        let diagnostic = if reference.body.is_some() || self.is_point(text) {
            let written = reference
                .body
                .as_ref()
                .map_or(text.clone(), |body| format!("{}.{text}", body.text));
            finding("point").help(format!(
                "write one of its components: `{written}.x` or `{written}.y`"
            ))
        } else if self.declared.body_ids.get(text).is_some() {
            finding("body").help(format!(
                "write one of its coordinates: `x({text})`, `y({text})` or `phi({text})`"
            ))
        } else if let Some((declaration, _)) = self.declared.measures.found(text) {
            Diagnostic::error(
                Code::OutsideGrammar,
                reference.span,
                "only a measure may contain another one",
            )
            .label("this is a measure")
            .also(declaration, "declared here")
            .help("write the formula of the measure itself")
        } else {
            self.unknown_in_equation(name)
        };
        self.diagnostics.push(diagnostic);
        None
    }

    fn unknown_in_equation(&self, name: &Name) -> Diagnostic {
        let message = format!("nothing is named `{}`", name.text);
        let diagnostic =
            Diagnostic::error(Code::UnknownName, name.span, message).label("not declared above");
        let constants = self
            .declared
            .constants
            .iter()
            .map(|(name, _)| name.text.as_str());
        let drawn = self
            .declared
            .drawn
            .iter()
            .map(|(name, _)| name.text.as_str());
        let marks = self.linkage.bodies.iter().flat_map(|body| &body.marks);
        let measures = self.declared.measures.iter();
        let known = constants
            .chain(measures.map(|(name, _)| name.text.as_str()))
            .chain(drawn)
            .chain(marks.map(|mark| mark.name.as_str()));
        match self.declared.nearest_known(&name.text, known) {
            Some(meant) => diagnostic.help(format!("did you mean `{meant}`?")),
            None => diagnostic.help("declare a constant or a point of this name above this line"),
        }
    }

    /// Resolves `K.x`, `1.P.y`: a component of the position of a point.
    pub(super) fn component_of(
        &mut self,
        point: &Reference,
        axis: &Name,
        span: Span,
    ) -> Option<Value> {
        if self.formulas.kinematic.is_none() {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::OutsideGrammar,
                    span,
                    "only an `equation` may refer to the position of a point",
                )
                .label("moves with the mechanism")
                .help("measure the design configuration with `distance(A, B)`, or write an `equation`"),
            );
            return None;
        }
        let mark = self.live_point(point)?;
        self.axis(mark, axis)
    }

    fn axis(&mut self, mark: Mark, axis: &Name) -> Option<Value> {
        let component = match axis.text.as_str() {
            "x" => 0,
            "y" => 1,
            rate if RATES.contains(&rate) => {
                self.report_rate(axis);
                return None;
            }
            _ => {
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::UnknownName,
                        axis.span,
                        format!("a point has no component `{}`", axis.text),
                    )
                    .label("not a component")
                    .help("the components of a point are `x` and `y`"),
                );
                return None;
            }
        };
        let position = self.live_position(mark);
        Some((position[component], Dimension::LENGTH))
    }

    fn report_rate(&mut self, name: &Name) {
        let kinematic = self.formulas.kinematic.as_mut();
        if kinematic.is_some_and(|it| it.is_of_load() || it.measure().is_some()) {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::UnknownFunction,
                    name.span,
                    format!("`{}` is not a function of this language", name.text),
                )
                .label("a rate is the rate of a formula")
                .help("write `rate(phi(1))`, `rate(K.x)` or `rate(distance(1.P, 2.Q))`"),
            );
            return;
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::UnknownFunction,
                name.span,
                format!("`{}` is not available in an equation", name.text),
            )
            .label("an equation is about positions")
            .help("rates follow from the equations by differentiation; where a rate is given, write what it adds up to: `phi(1) = 2*t`"),
        );
    }

    fn is_point(&self, name: &str) -> bool {
        self.declared.drawn.get(name).is_some()
            || self.linkage.carriers.first_carrier(name).is_some()
    }

    /// True if a body of this name has a point of that name.
    fn is_on_body(&self, body: &Name, point: &Name) -> bool {
        let body = self.declared.body_ids.get(&body.text);
        body.is_some_and(|&body| self.linkage.carriers.on_body(body, &point.text).is_some())
    }
}
