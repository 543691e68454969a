//! Finds the names in formulas.

use linkwright_codegen::stages::model::UNITS;
use linkwright_codegen::stages::syntax::{
    AXES, Choice, Expression, ExpressionKind, Name, Operation, Pair, Reference,
};

use super::SymbolId;
use super::scope::{Owner, Scopes, Space};

/// Function of two points.
const DISTANCE: &str = "distance";

/// Parameter that runs along a curve, in a formula of that curve.
pub(super) type Running<'a> = Option<(&'a str, SymbolId)>;

impl Scopes {
    /// Finds the names in a formula.
    pub(super) fn formula(&mut self, written: &Expression, running: Running<'_>) {
        match &written.kind {
            ExpressionKind::Number { .. } => {}
            ExpressionKind::Reference(reference) => self.named(reference, running),
            ExpressionKind::Component(component) => self.point_of_body(&component.point),
            ExpressionKind::Sum(terms) => {
                terms.iter().for_each(|(_, it)| self.formula(it, running));
            }
            ExpressionKind::Product(factors) => self.product(factors, running),
            ExpressionKind::Negative(inner) => self.formula(inner, running),
            ExpressionKind::Power(base, exponent) => {
                self.formula(base, running);
                self.formula(exponent, running);
            }
            ExpressionKind::Call {
                function,
                arguments,
            } => self.call(function, arguments, running),
            ExpressionKind::Components(parts) => {
                parts.iter().for_each(|it| self.formula(it, running));
            }
            ExpressionKind::Choice(choice) => {
                let Choice {
                    left,
                    right,
                    holds,
                    otherwise,
                    ..
                } = choice.as_ref();
                for part in [left, right, holds, otherwise] {
                    self.formula(part, running);
                }
            }
        }
    }

    /// Finds the names in both components of a pair.
    pub(super) fn pair(&mut self, pair: &Pair, running: Running<'_>) {
        self.formula(&pair.x, running);
        self.formula(&pair.y, running);
    }

    /// Finds the names in a product. A factor directly behind a number with a unit may be a unit, `4.5N/mm`, unless a value of that name is
    /// declared above.
    fn product(&mut self, factors: &[(Operation, Expression)], running: Running<'_>) {
        for (_, factor) in factors {
            let unit = match &factor.kind {
                ExpressionKind::Reference(Reference {
                    body: None, name, ..
                }) => UNITS.contains(&name.text.as_str()) && self.value(name).is_none(),
                _ => false,
            };
            if !unit {
                self.formula(factor, running);
            }
        }
    }

    /// Finds a value, a body, a point, or a component of a point: `L`, `K.x`, `1.x`.
    fn named(&mut self, reference: &Reference, running: Running<'_>) {
        let Reference { body, name, .. } = reference;
        let Some(owner) = body else {
            match running.filter(|(own, _)| *own == name.text) {
                Some((_, parameter)) => self.mention(name.span, parameter),
                None => {
                    let named = self.value(name).or_else(|| self.angle(&name.text));
                    if let Some(named) = named {
                        self.mention(name.span, named);
                    }
                }
            }
            return;
        };
        let on_body = self
            .owner(&owner.text)
            .and_then(|body| self.point_on(body, &name.text));
        match (on_body, self.bare_point(&owner.text)) {
            (None, Some(point)) => self.mention(owner.span, point),
            _ => self.point_of_body(reference),
        }
    }

    /// Finds the names in a call of a function or a table.
    fn call(&mut self, function: &Name, arguments: &[Expression], running: Running<'_>) {
        let word = function.text.as_str();
        let is_coordinate = AXES.contains(&word);
        if !is_coordinate && word != DISTANCE {
            if let Some(table) = self.find(Space::Tables, word) {
                self.mention(function.span, table);
            }
            arguments.iter().for_each(|it| self.formula(it, running));
            return;
        }
        for argument in arguments {
            match &argument.kind {
                ExpressionKind::Reference(reference) => self.place(reference, is_coordinate),
                // An integer may be the name of a body.
                ExpressionKind::Number { digits, unit: None } => {
                    if let Some(body) = self.find(Space::Bodies, digits) {
                        self.mention(argument.span, body);
                    }
                }
                _ => self.formula(argument, running),
            }
        }
    }

    /// Finds a body or a point that a function measures. The function determines which of them takes precedence.
    fn place(&mut self, reference: &Reference, bodies_first: bool) {
        if reference.body.is_some() {
            self.point_of_body(reference);
            return;
        }
        let name = &reference.name;
        let body = self.find(Space::Bodies, &name.text);
        let point = self.bare_point(&name.text);
        let symbol = match bodies_first {
            true => body.or(point),
            false => point.or(body),
        };
        if let Some(symbol) = symbol {
            self.mention(name.span, symbol);
        }
    }

    /// Finds both names of `BODY.POINT`; of `BODY.x`, the body alone.
    pub(super) fn point_of_body(&mut self, reference: &Reference) {
        let Some(owner) = reference.body.as_ref().and_then(|it| self.body(it)) else {
            return;
        };
        self.point_of(owner, &reference.name);
    }

    /// Finds a body by its name.
    pub(super) fn body(&mut self, name: &Name) -> Option<Owner> {
        let owner = self.owner(&name.text)?;
        if let Owner::Body(body) = owner {
            self.mention(name.span, body);
        }
        Some(owner)
    }

    /// Finds a point of a body by its name.
    pub(super) fn point_of(&mut self, owner: Owner, name: &Name) -> Option<SymbolId> {
        let point = self.point_on(owner, &name.text)?;
        self.mention(name.span, point);
        Some(point)
    }
}
