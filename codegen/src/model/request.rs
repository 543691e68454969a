//! `output` statements → the quantities that the generated code is asked for.

use super::resolve::Resolver;
use super::{Point, Request, Requested};
use crate::diagnostic::{Code, Diagnostic, nearest};
use crate::syntax::{LEVELS, Name, Output, OutputItem, Reference};

/// The coordinates of a body as `output` names them.
const AXES: [&str; 3] = ["x", "y", "phi"];

impl Resolver<'_> {
    /// What one statement asks for; items with an error are reported and left out.
    pub(super) fn requests(&mut self, output: &Output, points: &[Point]) -> Vec<Request> {
        let named = output
            .level
            .as_ref()
            .and_then(|level| LEVELS.iter().position(|word| *word == level.text));
        let level = named.unwrap_or(LEVELS.len() - 1);
        let mut requests = Vec::new();
        for item in &output.items {
            let quantity = self.requested(item, points);
            requests.extend(quantity.map(|quantity| Request { quantity, level }));
        }
        requests
    }

    /// A point, or a coordinate of a body that has some; `None` after an error.
    pub(super) fn requested(&mut self, item: &OutputItem, points: &[Point]) -> Option<Requested> {
        let (axis, bodies, span) = match item {
            OutputItem::Point(reference) => return self.requested_point(reference, points),
            OutputItem::Coordinate { axis, bodies, span } => (axis, bodies, *span),
        };
        let found = AXES.iter().position(|name| *name == axis.text);
        match (found, bodies.as_slice()) {
            (
                Some(axis),
                [
                    Reference {
                        body: None, name, ..
                    },
                ],
            ) => self
                .moving_body(name)
                .map(|body| Requested::Coordinate { body, axis }),
            _ => {
                self.diagnostics.push(
                    Diagnostic::error(Code::WrongForm, span, "this is no coordinate of a body")
                        .help("write `x(1)`, `y(1)` or `phi(1)` with the name of one body"),
                );
                None
            }
        }
    }

    /// The number of a body that has coordinates.
    pub(super) fn moving_body(&mut self, name: &Name) -> Option<usize> {
        let body = self.body(name)?;
        if body.0 == 0 {
            self.diagnostics.push(
                Diagnostic::error(Code::WrongForm, name.span, "the ground has no coordinates")
                    .help("name a body that moves, as in `phi(1)`"),
            );
            return None;
        }
        Some(body.0)
    }

    /// A point by its name, or by the body that carries it.
    fn requested_point(&mut self, reference: &Reference, points: &[Point]) -> Option<Requested> {
        let place = if reference.body.is_some() {
            let mark = self.point_mark(reference)?;
            let named = |point: &Point| {
                point.name == reference.name.text
                    || point.name.starts_with(&format!("{}_", reference.name.text))
            };
            points
                .iter()
                .position(|point| point.mark == mark)
                .or_else(|| points.iter().position(named))
        } else {
            points
                .iter()
                .position(|point| point.name == reference.name.text)
        };
        if place.is_none() {
            let message = format!("no point is named `{}`", reference.name.text);
            let diagnostic = Diagnostic::error(Code::UnknownName, reference.span, message)
                .label("not a point of this mechanism");
            let meant = nearest(
                &reference.name.text,
                points.iter().map(|point| point.name.as_str()),
            );
            self.diagnostics.push(match meant {
                Some(meant) => diagnostic.help(format!("did you mean `{meant}`?")),
                None => diagnostic.help("add it to the braces of the body that carries it"),
            });
        }
        place.map(Requested::Point)
    }
}
