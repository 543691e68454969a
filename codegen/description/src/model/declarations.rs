//! *An error about what an expression measures → the same with the declarations that say so.*
//!
//! A name carries its unit from its declaration, which may stand far above. Deliberately unknown here: what is wrong.

use super::resolve::Resolver;
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::{Expression, ExpressionKind, Name};

/// How many declarations are shown; who mentions more has written a long formula.
const SHOWN: usize = 3;

/// Functions of bodies and points.
const OF_PLACES: &[&str] = &["distance", "x", "y", "phi"];

impl Resolver<'_> {
    /// Shows where the constants, parameters and inputs of these expressions are declared, as far as they have a unit.
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
        diagnostic
    }
}

/// The names in an expression that stand for values, in written order.
fn names(written: &Expression) -> Vec<&Name> {
    let mut found = Vec::new();
    let mut rest = vec![written];
    while let Some(next) = rest.pop() {
        let inner: Vec<&Expression> = match &next.kind {
            ExpressionKind::Reference(reference) => {
                found.extend(reference.body.is_none().then_some(&reference.name));
                Vec::new()
            }
            ExpressionKind::Number { .. } | ExpressionKind::Component(_) => Vec::new(),
            ExpressionKind::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
            ExpressionKind::Product(factors) => factors.iter().map(|(_, it)| it).collect(),
            ExpressionKind::Negative(inner) => vec![inner],
            ExpressionKind::Power(base, exponent) => vec![base, exponent],
            // What bodies and points are named alike is no value.
            ExpressionKind::Call { function, .. }
                if OF_PLACES.contains(&function.text.as_str()) =>
            {
                Vec::new()
            }
            ExpressionKind::Call { arguments, .. } => arguments.iter().collect(),
            ExpressionKind::Components(parts) => parts.iter().collect(),
            ExpressionKind::Choice(choice) => vec![&choice.holds, &choice.otherwise],
        };
        rest.extend(inner.into_iter().rev());
    }
    found
}
