//! Adds declarations to errors about dimensions, as the declaration that determines a unit may be far above.

use super::resolve::Resolver;
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::{Expression, ExpressionKind, Name};

/// Maximum number of declarations in a message; more would come from a long formula.
const MAX_SHOWN_DECLARATIONS: usize = 3;

/// Unit of tonnes, whose symbol users also write for time.
const TONNES: &str = "t";

/// Functions of bodies and points.
const OF_PLACES: &[&str] = &["distance", "x", "y", "phi"];

impl Resolver<'_> {
    /// Adds the declarations of constants, parameters and inputs in these expressions, if they have a unit, and the numbers
    /// read as tonnes.
    pub(super) fn with_declarations(
        &self,
        mut diagnostic: Diagnostic,
        expressions: &[&Expression],
    ) -> Diagnostic {
        let mut spans: Vec<Span> = Vec::new();
        for name in expressions.iter().flat_map(|written| names(written)) {
            let declared = self.declared.constants.declaration(&name.text);
            let Some((place, (_, dimension))) = declared.filter(|(_, it)| it.1.is_marked()) else {
                continue;
            };
            if spans.len() < MAX_SHOWN_DECLARATIONS && !spans.contains(&place.span) {
                spans.push(place.span);
                let text = format!("`{}` is declared as {}", name.text, dimension.name());
                diagnostic = diagnostic.also(place.span, text);
            }
        }
        match expressions.iter().find_map(|written| tonnes(written)) {
            Some(digits) => diagnostic.help(format!(
                "`{digits}t` is read as {digits} tonnes; `{digits}*t` is {digits} times the time"
            )),
            None => diagnostic,
        }
    }
}

/// Returns the digits of the first number in tonnes; `None` without one.
fn tonnes(written: &Expression) -> Option<&str> {
    let (mut found, mut rest) = (None, vec![written]);
    while let Some(next) = rest.pop() {
        match &next.kind {
            ExpressionKind::Number { digits, unit } => {
                let is_one = unit.as_ref().is_some_and(|it| it.text == TONNES);
                found = found.or(is_one.then_some(digits.as_str()));
            }
            _ => rest.extend(inside(next).into_iter().rev()),
        }
    }
    found
}

/// Returns the names of values in an expression, in source order.
fn names(written: &Expression) -> Vec<&Name> {
    let mut collected = Vec::new();
    let mut rest = vec![written];
    while let Some(next) = rest.pop() {
        if let ExpressionKind::Reference(reference) = &next.kind {
            collected.extend(reference.body.is_none().then_some(&reference.name));
        }
        rest.extend(inside(next).into_iter().rev());
    }
    collected
}

/// Returns the operands of an expression that are values, in source order.
fn inside(written: &Expression) -> Vec<&Expression> {
    match &written.kind {
        ExpressionKind::Reference(_)
        | ExpressionKind::Number { .. }
        | ExpressionKind::Component(_) => Vec::new(),
        ExpressionKind::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
        ExpressionKind::Product(factors) => factors.iter().map(|(_, it)| it).collect(),
        ExpressionKind::Negative(inner) => vec![inner],
        ExpressionKind::Power(base, exponent) => vec![base, exponent],
        // Arguments of these functions are bodies and points, not values.
        ExpressionKind::Call { function, .. } if OF_PLACES.contains(&function.text.as_str()) => {
            Vec::new()
        }
        ExpressionKind::Call { arguments, .. } => arguments.iter().collect(),
        ExpressionKind::Components(parts) => parts.iter().collect(),
        ExpressionKind::Choice(choice) => vec![&choice.holds, &choice.otherwise],
    }
}
