//! Resolves curve statements into curves p(s) in the frame of a body.
//!
//! A curve is a pair of expressions of constants and of its parameter, with its range in pictures.

use super::Dimension;
use super::resolve::Resolver;
use super::search::{Range, minima};
use crate::diagnostic::{Code, Diagnostic};
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::{BodyId, Vector};
use crate::syntax::{self, BUILT_IN, Name};

/// Square of the speed, relative to its maximum, below which a curve has a cusp.
const STANDSTILL: f64 = 1e-10;

/// A declared curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct DrawnCurve {
    pub body: BodyId,
    /// Symbol of the parameter, for which every contact substitutes its own.
    pub parameter: SymbolId,
    pub quantity: Quantity,
    pub point: Vector,
    pub range: Range,
}

/// Parameter of a curve whose formula is being resolved.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    pub name: Name,
    pub value: ExprId,
    pub dimension: Dimension,
}

impl Resolver<'_> {
    /// Declares a curve, even with an error, so that its uses cause no further errors.
    pub(super) fn add_curve(&mut self, curve: &syntax::Curve) {
        let drawn = self.drawn_curve(curve);
        let duplicate = self.declared.curves.declare(&curve.name, drawn);
        self.diagnostics.extend(duplicate);
        if let Some(drawn) = drawn {
            self.warn_of_cusps(curve, &drawn);
        }
    }

    fn drawn_curve(&mut self, curve: &syntax::Curve) -> Option<DrawnCurve> {
        let body = self.body(&curve.body);
        let body = body.filter(|&it| self.has_place(it, &curve.body));
        let name = &curve.parameter;
        let taken = BUILT_IN.contains(&name.text.as_str())
            || self.declared.constants.get(&name.text).is_some();
        if taken {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NameNotAllowed,
                    name.span,
                    format!("`{}` has another meaning already", name.text),
                )
                .label("the parameter of a curve is a name of its own")
                .help("choose another name for the parameter"),
            );
            return None;
        }
        let is_polar = matches!(curve.shape, syntax::Shape::Polar(_));
        let (range, dimension) = match &curve.range {
            Some(ends) => self.range(ends, is_polar)?,
            None => (Range::TURN, Dimension::Angle),
        };
        let quantity = match dimension {
            Dimension::Angle => Quantity::Angle,
            Dimension::LENGTH => Quantity::Length,
            _ => Quantity::Power(0),
        };
        // The name begins with a digit, so it differs from all coordinates.
        let count = self.graph.symbol_count();
        let parameter = self.graph.symbol(&format!("{count} parameter"));
        self.formulas.parameter = Some(Parameter {
            name: name.clone(),
            value: self.graph.variable(parameter),
            dimension,
        });
        let point = match &curve.shape {
            syntax::Shape::Parametric(pair) => {
                let [x, y] = [&pair.x, &pair.y].map(|part| self.constant(part, Dimension::LENGTH));
                x.zip(y).map(|(x, y)| [x, y])
            }
            syntax::Shape::Polar(radius) => {
                let radius = self.constant(radius, Dimension::LENGTH);
                let graph = &mut self.graph;
                let angle = graph.variable(parameter);
                let direction = [graph.cos(angle), graph.sin(angle)];
                radius.map(|radius| direction.map(|part| graph.multiply(radius, part)))
            }
        };
        self.formulas.parameter = None;
        let (body, point) = (body?, point?);
        if point
            .iter()
            .all(|&part| !self.graph.depends_on(part, parameter))
        {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::DegenerateGeometry,
                    curve.span,
                    format!("the curve `{}` is a single point", curve.name.text),
                )
                .label(format!("nothing depends on `{}`", name.text))
                .help("write the points of the curve in terms of its parameter"),
            );
            return None;
        }
        Some(DrawnCurve {
            body,
            parameter,
            quantity,
            point,
            range,
        })
    }

    /// Resolves `from A to B` and its quantity.
    fn range(
        &mut self,
        ends: &[syntax::Expression; 2],
        is_polar: bool,
    ) -> Option<(Range, Dimension)> {
        let [from, to] = ends;
        let first = if is_polar {
            self.constant(from, Dimension::Angle)
                .map(|value| (value, Dimension::Angle))
        } else {
            self.value(from)
        };
        let (first, dimension) = first?;
        let second = self.constant(to, dimension)?;
        let dimension = match self.value(to) {
            Some((_, found)) => dimension.joined(found),
            None => dimension,
        };
        let [first_value, second_value] = [first, second].map(|end| self.graph.constant_value(end));
        let (Some(first), Some(second)) = (first_value, second_value) else {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NotConstant,
                    from.span.to(to.span),
                    "the range of a curve is constant",
                )
                .help("write two values that do not depend on `t`"),
            );
            return None;
        };
        if first < second {
            return Some((
                Range {
                    from: first,
                    to: second,
                    is_closed: false,
                },
                dimension,
            ));
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::DegenerateGeometry,
                from.span.to(to.span),
                "this range is empty",
            )
            .label("the second value is not above the first")
            .help("write the smaller value first: `(s from 0 to 200mm)`"),
        );
        None
    }

    /// Warns of points with p' = 0, which have no normal.
    fn warn_of_cusps(&mut self, curve: &syntax::Curve, drawn: &DrawnCurve) {
        let tangent = drawn
            .point
            .map(|part| self.graph.derivative(part, drawn.parameter));
        let mut along = self.along(&tangent, drawn.parameter);
        let minima = minima(drawn.range, |place| along.square(place));
        let Some(found) = minima.first() else { return };
        if found.cost <= STANDSTILL * minima.largest {
            self.diagnostics.push(
                Diagnostic::warning(
                    Code::DegenerateGeometry,
                    curve.span,
                    format!(
                        "the curve `{}` stops at {} = {}",
                        curve.name.text,
                        curve.parameter.text,
                        shown(found.place, drawn.quantity)
                    ),
                )
                .label("its derivative vanishes there, so it has no normal")
                .help("a contact that comes near this point is singular; write the curve so that it continues smoothly"),
            );
        }
    }
}

/// Formats a value of a parameter for messages.
pub(super) fn shown(value: f64, quantity: Quantity) -> String {
    let rounded = |value: f64| {
        let text = format!("{value:.4}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        if text == "-0" {
            "0".to_string()
        } else {
            text.to_string()
        }
    };
    match quantity {
        Quantity::Angle => format!("{}deg", rounded(value.to_degrees())),
        Quantity::Length => format!("{}m", rounded(value)),
        Quantity::Power(_) => rounded(value),
    }
}
