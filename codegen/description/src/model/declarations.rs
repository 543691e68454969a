//! *An error about what an expression measures → the same with the declarations that say so.*
//!
//! A name carries its unit from its declaration, which may stand far above. Deliberately unknown here: what is wrong.

use super::resolve::Resolver;
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::{Expression, ExpressionKind, Name};

/// How many declarations are shown; who mentions more has written a long formula.
const SHOWN: usize = 3;

/// The unit that is also written for the time.
const TONNES: &str = "t";

/// Functions of bodies and points.
const OF_PLACES: &[&str] = &["distance", "x", "y", "phi"];

impl Resolver<'_> {
    /// Shows where the constants, parameters and inputs of these expressions are declared, as far as they have a unit, and what is read
    /// as tonnes.
    pub(super) fn with_declarations(
        &self,
        mut diagnostic: Diagnostic,
        expressions: &[&Expression],
    ) -> Diagnostic {
        let mut shown: Vec<Span> = Vec::new();
        for name in expressions.iter().flat_map(|written| names(written)) {
            let declared = self.declared.constants.declaration(&name.text);
            let Some((place, (_, dimension))) = declared.filter(|(_, it)| it.1.is_marked()) else {
                continue;
            };
            if shown.len() < SHOWN && !shown.contains(&place.span) {
                shown.push(place.span);
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

/// The digits of the first number in tonnes.
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

/// The names in an expression that stand for values, in written order.
fn names(written: &Expression) -> Vec<&Name> {
    let mut found = Vec::new();
    let mut rest = vec![written];
    while let Some(next) = rest.pop() {
        if let ExpressionKind::Reference(reference) = &next.kind {
            found.extend(reference.body.is_none().then_some(&reference.name));
        }
        rest.extend(inside(next).into_iter().rev());
    }
    found
}

/// The expressions that an expression is made of and that stand for values, in written order.
fn inside(written: &Expression) -> Vec<&Expression> {
    match &written.kind {
        ExpressionKind::Reference(_)
        | ExpressionKind::Number { .. }
        | ExpressionKind::Component(_) => Vec::new(),
        ExpressionKind::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
        ExpressionKind::Product(factors) => factors.iter().map(|(_, it)| it).collect(),
        ExpressionKind::Negative(inner) => vec![inner],
        ExpressionKind::Power(base, exponent) => vec![base, exponent],
        // What bodies and points are named alike is no value.
        ExpressionKind::Call { function, .. } if OF_PLACES.contains(&function.text.as_str()) => {
            Vec::new()
        }
        ExpressionKind::Call { arguments, .. } => arguments.iter().collect(),
        ExpressionKind::Components(parts) => parts.iter().collect(),
        ExpressionKind::Choice(choice) => vec![&choice.holds, &choice.otherwise],
    }
}
