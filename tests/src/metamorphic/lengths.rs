//! Rewrites a description as the same mechanism larger, displaced, or turned.
//!
//! Quantities given to the mechanism are changed, and quantities taken from it changed back: a driver whose motion is
//! `distance(A, B) + 5mm` becomes `(distance(A, B)/1000 + 5mm)*1000`. Constants, parameters, laws and tables stay as
//! they are.

use linkwright_codegen::stages::syntax::{Document, Equation, Expression, Origin, Pair, Statement};

use super::edits::Edits;
use super::roles::{Given, Taken, each_formula, each_given, each_taken};

/// Factor for lengths.
#[derive(Clone, Copy, Debug)]
pub struct Factor {
    /// Text behind a given quantity.
    pub times: &'static str,
    /// Text behind a taken quantity.
    pub over: &'static str,
    /// The factor.
    pub value: f64,
}

/// A thousand million times as large, and as small.
pub const FACTORS: [Factor; 2] = [
    Factor {
        times: "*1000000000",
        over: "/1000000000",
        value: 1e9,
    },
    Factor {
        times: "/1000000000",
        over: "*1000000000",
        value: 1e-9,
    },
];

/// Multiplies all lengths by this factor. `power` is the power of length in the dimension of an equation's rows.
pub fn scaled(
    text: &str,
    document: &Document,
    factor: Factor,
    power: &dyn Fn(&Equation) -> i32,
) -> String {
    let mut edits = Edits::default();
    each_formula(&document.mechanism.statements, &mut |formula, live| {
        each_taken(formula, live, &mut |taken, what| {
            if what != Taken::Angle {
                edits.enclose(taken.span, factor.over);
                // Weaker operations around it must not tear it apart.
                parenthesize(&mut edits, taken);
            }
        });
    });
    each_given(document, &mut |given| match given {
        Given::Place(pair) | Given::Vector(pair) => {
            edits.enclose(pair.x.span, factor.times);
            edits.enclose(pair.y.span, factor.times);
        }
        Given::X(value) | Given::Y(value) | Given::Component(value) | Given::Length(value) => {
            edits.enclose(value.span, factor.times);
        }
        Given::Angle(_) | Given::Aligned(_) => {}
        Given::Sides(equation) => {
            let power = power(equation);
            let factors = if power < 0 { factor.over } else { factor.times };
            let after = factors.repeat(power.unsigned_abs() as usize);
            edits.enclose(equation.left.span, &after);
            edits.enclose(equation.right.span, &after);
        }
    });
    edits.apply(text)
}

fn parenthesize(edits: &mut Edits, inner: &Expression) {
    edits.enclose(inner.span, "");
}

/// Moves the origin of the global frame, so that every abscissa grows by `x` and every ordinate by `y`.
pub fn shifted(text: &str, document: &Document, x: &str, y: &str) -> String {
    let mut edits = Edits::default();
    each_formula(&document.mechanism.statements, &mut |formula, live| {
        each_taken(formula, live, &mut |taken, what| {
            let by = match what {
                Taken::X => x,
                Taken::Y => y,
                Taken::Distance | Taken::Angle => return,
            };
            edits.enclose(taken.span, &format!(" - ({by})"));
            parenthesize(&mut edits, taken);
        });
    });
    let add = |edits: &mut Edits, value: &Expression, by: &str| {
        edits.enclose(value.span, &format!(" + ({by})"));
    };
    each_given(document, &mut |given| match given {
        Given::Place(pair) => {
            add(&mut edits, &pair.x, x);
            add(&mut edits, &pair.y, y);
        }
        Given::X(value) => add(&mut edits, value, x),
        Given::Y(value) => add(&mut edits, value, y),
        _ => {}
    });
    edits.apply(text)
}

/// The angle of [`turned`], whose cosine is 3/5 and whose sine is 4/5.
pub const TURN: &str = "atan2(4, 3)";

/// Turns everything by [`TURN`] about the origin; `None` if a statement refers to the directions x and y themselves.
pub fn turned(text: &str, document: &Document) -> Option<String> {
    let mut edits = Edits::default();
    // Angles alone have no position that could be turned about the origin.
    let mut statements = document.mechanism.statements.iter();
    let mut possible = !statements.any(|it| matches!(it, Statement::Angle(_)));
    each_formula(&document.mechanism.statements, &mut |formula, live| {
        each_taken(formula, live, &mut |taken, what| match what {
            Taken::X | Taken::Y => possible = false,
            Taken::Angle => {
                edits.enclose(taken.span, &format!(" - {TURN}"));
                parenthesize(&mut edits, taken);
            }
            Taken::Distance => {}
        });
    });
    let slice = |value: &Expression| &text[value.span.range()];
    let rotate = |edits: &mut Edits, pair: &Pair| {
        let (x, y) = (slice(&pair.x), slice(&pair.y));
        edits.replace(pair.x.span, format!("3/5*({x}) - 4/5*({y})"));
        edits.replace(pair.y.span, format!("4/5*({x}) + 3/5*({y})"));
    };
    each_given(document, &mut |given| match given {
        Given::Place(pair) => rotate(&mut edits, pair),
        Given::Angle(value) => edits.enclose(value.span, &format!(" + {TURN}")),
        Given::Aligned(body) => {
            let end = match &body.origin {
                Origin::Coordinates(place) => place.span,
                Origin::Point(reference) => reference.span,
            };
            edits.append(end, format!(" turned {TURN}"));
        }
        Given::X(_) | Given::Y(_) | Given::Component(_) => possible = false,
        Given::Vector(_) | Given::Length(_) | Given::Sides(_) => {}
    });
    possible.then(|| edits.apply(text))
}
