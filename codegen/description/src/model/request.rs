//! Resolves `output` statements into requested quantities.

use std::collections::HashMap;

use super::resolve::Resolver;
use super::{Body, Point, Request, Requested};
use crate::diagnostic::{Code, Diagnostic};
use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::syntax::{self, AXES, LEVELS, Name, OutputItem, Reference};

/// Points of a mechanism by the names used in items; never iterated.
pub(super) struct Named<'a> {
    pub points: &'a [Point],
    by_name: HashMap<&'a str, usize>,
    by_mark: HashMap<(BodyId, Vector), usize>,
    /// First point for each prefix that ends before an underscore.
    by_start: HashMap<&'a str, usize>,
}

impl<'a> Named<'a> {
    pub(super) fn new(points: &'a [Point]) -> Named<'a> {
        let mut named = Named {
            points,
            by_name: HashMap::new(),
            by_mark: HashMap::new(),
            by_start: HashMap::new(),
        };
        for (at, point) in points.iter().enumerate() {
            let mark = &point.mark;
            named.by_name.entry(&point.name).or_insert(at);
            let place = (mark.frame.body, mark.local);
            named.by_mark.entry(place).or_insert(at);
            for (end, _) in point.name.match_indices('_') {
                named.by_start.entry(&point.name[..end]).or_insert(at);
            }
        }
        named
    }

    /// Returns a point of a body: the point itself, or the first point named after it.
    fn of_body(&self, mark: &Mark, name: &str) -> Option<usize> {
        let itself = self.by_mark.get(&(mark.frame.body, mark.local));
        let after = [&self.by_name, &self.by_start].map(|places| places.get(name));
        itself.or(after.into_iter().flatten().min()).copied()
    }
}

impl Resolver<'_> {
    /// Resolves the items of a statement; items with an error are reported and omitted.
    pub(super) fn requests(
        &mut self,
        output: &syntax::Request,
        points: &Named<'_>,
    ) -> Vec<Request> {
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

    /// Resolves a point, or a coordinate of a moving body; `None` after an error.
    pub(super) fn requested(&mut self, item: &OutputItem, points: &Named<'_>) -> Option<Requested> {
        let (axis, bodies, span) = match item {
            OutputItem::Point(reference) => {
                if reference.body.is_none()
                    && let Some((declaration, place)) =
                        self.declared.measures.found(&reference.name.text)
                {
                    self.note_use(&reference.name, declaration);
                    return place.map(Requested::Measure);
                }
                let angle = self.angle_named(&reference.name.text);
                let angle = angle.filter(|_| reference.body.is_none());
                let Some(angle) = angle else {
                    return self.requested_point(reference, points);
                };
                let Body {
                    span, coordinates, ..
                } = self.linkage.bodies[angle.0];
                self.note_use(&reference.name, span);
                return coordinates[2].map(|it| Requested::Coordinate(it.place));
            }
            OutputItem::Coordinate { axis, bodies, span } => (axis, bodies, *span),
        };
        let index = AXES.iter().position(|name| *name == axis.text);
        match (index, bodies.as_slice()) {
            (
                Some(axis),
                [
                    Reference {
                        body: None, name, ..
                    },
                ],
            ) => self
                .moving_body(name)
                .filter(|&body| AXES[axis] == "phi" || self.has_place(BodyId(body), name))
                .and_then(|body| self.linkage.bodies[body].coordinates[axis])
                .map(|it| Requested::Coordinate(it.place)),
            _ => {
                self.diagnostics.push(
                    Diagnostic::error(Code::WrongForm, span, "this is not a coordinate of a body")
                        .help("write `x(1)`, `y(1)` or `phi(1)` with the name of one body"),
                );
                None
            }
        }
    }

    /// Returns the number of a body with coordinates; `None` after an error.
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

    /// Resolves a point by its name, or by its name and body.
    fn requested_point(&mut self, reference: &Reference, points: &Named<'_>) -> Option<Requested> {
        let place = if reference.body.is_some() {
            let mark = self.point_mark(reference)?;
            points.of_body(&mark, &reference.name.text)
        } else {
            let place = points.by_name.get(reference.name.text.as_str()).copied();
            if let Some(place) = place {
                self.note_use(&reference.name, points.points[place].span);
            }
            place
        };
        if place.is_none() && !self.names_of_carriers(&reference.name.text).is_empty() {
            self.report_without_body(&reference.name);
        } else if place.is_none() {
            let message = format!("no point is named `{}`", reference.name.text);
            let diagnostic = Diagnostic::error(Code::UnknownName, reference.span, message)
                .label("not a point of this mechanism");
            let known = points.points.iter().map(|point| point.name.as_str());
            let measures = self.declared.measures.iter();
            let known = known.chain(measures.map(|(name, _)| name.text.as_str()));
            let meant = self.declared.nearest_known(&reference.name.text, known);
            self.diagnostics.push(match meant {
                Some(meant) => diagnostic.help(format!("did you mean `{meant}`?")),
                None => diagnostic.help("add it to the braces of the body that carries it"),
            });
        }
        place.map(Requested::Point)
    }
}
