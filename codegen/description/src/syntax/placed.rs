//! Moves points and estimates of a part to its position.
//!
//! A statement that refers to the global axes cannot be rotated with a part, and is rejected.

use super::document::{Curve, Orientation, Origin, Statement};
use super::forces::Force;
use super::formula::{Expression, ExpressionKind, Name, Operation, Pair, Reference, Sign};
use super::reader::Outcome;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Position of a part; the default leaves it in place.
pub(super) struct Place {
    /// Origin of the part; `None` for no displacement.
    pub origin: Option<Pair>,
    /// Angle about the origin; `None` for no rotation.
    pub angle: Option<Expression>,
    /// Source location of the position.
    pub span: Span,
}

impl Place {
    /// Moves a statement; `global` is the location at which it refers to a global axis.
    ///
    /// # Errors
    /// Returns an error if the rotation would change the meaning of the statement.
    pub(super) fn take(&self, statement: &mut Statement, global: Option<Span>) -> Outcome<()> {
        if self.origin.is_none() && self.angle.is_none() {
            return Ok(());
        }
        if let Some(span) = global {
            return Err(self.refused("a component along a global axis, or an angle to it,", span));
        }
        match statement {
            Statement::Points(points) => {
                for point in &mut points.points {
                    self.move_point(&mut point.position);
                }
            }
            Statement::Body(body) => {
                if let Origin::Coordinates(origin) = &mut body.origin {
                    self.move_point(origin);
                }
                if let Some(angle) = &self.angle {
                    body.orientation = turned(body.orientation.clone(), angle);
                }
            }
            Statement::Curve(Curve { body, span, .. }) if body.text == "ground" => {
                return Err(self.refused("a curve on the ground", *span));
            }
            Statement::Force(Force { frame, span, .. })
                if frame.as_ref().is_none_or(|it| it.text == "ground") =>
            {
                return Err(self.refused("a force in the global frame", *span));
            }
            Statement::Element(element)
                if element.about.is_some() && element.operands.iter().any(is_ground) =>
            {
                return Err(self.refused("an angle to the ground", element.span));
            }
            Statement::Joint(joint) => joint.placed = Some(self.span),
            Statement::Drive(drive) => drive.placed = Some(self.span),
            Statement::Free(free) => free.drive.placed = Some(self.span),
            _ => {}
        }
        Ok(())
    }

    fn refused(&self, what: &str, span: Span) -> Box<Diagnostic> {
        let message = format!("{what} cannot be moved with a part");
        let finding = Diagnostic::error(Code::WrongForm, span, message)
            .also(self.span, "the part is placed here")
            .help("write it in the mechanism, with names such as `PART.BODY.POINT`");
        Box::new(finding)
    }
}

fn is_ground(operand: &Reference) -> bool {
    operand.body.is_none() && operand.name.text == "ground"
}

fn turned(orientation: Orientation, angle: &Expression) -> Orientation {
    match orientation {
        Orientation::Aligned => Orientation::Angle(angle.clone()),
        Orientation::Angle(own) => {
            let span = own.span;
            let terms = vec![(Sign::Plus, own), (Sign::Plus, angle.clone())];
            Orientation::Angle(Expression {
                kind: ExpressionKind::Sum(terms),
                span,
            })
        }
        // The points of the direction are already rotated.
        Orientation::Facing(direction) => Orientation::Facing(direction),
    }
}

impl Place {
    /// Moves a point to r + R(φ) s, with the position r and the angle φ of the part.
    fn move_point(&self, point: &mut Pair) {
        let (x, y) = (point.x.clone(), point.y.clone());
        let [x_terms, y_terms] = match &self.angle {
            None => [vec![(Sign::Plus, x)], vec![(Sign::Plus, y)]],
            Some(angle) => {
                let along = |function: &str, of: &Expression| times(function, angle, of);
                [
                    vec![
                        (Sign::Plus, along("cos", &x)),
                        (Sign::Minus, along("sin", &y)),
                    ],
                    vec![
                        (Sign::Plus, along("sin", &x)),
                        (Sign::Plus, along("cos", &y)),
                    ],
                ]
            }
        };
        let origin = self.origin.as_ref();
        point.x = sum(origin.map(|it| &it.x), x_terms, point.x.span);
        point.y = sum(origin.map(|it| &it.y), y_terms, point.y.span);
    }
}

/// Returns the sum of all terms, with the location of the moved point.
fn sum(origin: Option<&Expression>, terms: Vec<(Sign, Expression)>, span: Span) -> Expression {
    let origin = origin.map(|it| (Sign::Plus, it.clone()));
    let mut terms: Vec<(Sign, Expression)> = origin.into_iter().chain(terms).collect();
    match (terms.len(), terms.pop()) {
        (1, Some((_, only))) => only,
        (_, last) => {
            terms.extend(last);
            Expression {
                kind: ExpressionKind::Sum(terms),
                span,
            }
        }
    }
}

/// Returns `function(angle)*of`.
fn times(function: &str, angle: &Expression, of: &Expression) -> Expression {
    let turn = Expression {
        kind: ExpressionKind::Call {
            function: Name {
                text: function.to_string(),
                span: angle.span,
            },
            arguments: vec![angle.clone()],
        },
        span: angle.span,
    };
    let factors = vec![(Operation::Times, turn), (Operation::Times, of.clone())];
    Expression {
        kind: ExpressionKind::Product(factors),
        span: of.span,
    }
}
