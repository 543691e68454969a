//! Resolves point and body statements into global points, and into bodies with their frames and points.

use std::collections::HashMap;

use super::declared::DrawnPoint;
use super::lines::DISTINCT_POINTS_HELP;
use super::resolve::Resolver;
use super::{Body, Dimension, NamedMark};
use crate::diagnostic::{Code, Diagnostic};
use crate::expr::ExprId;
use crate::joint::geometry::{BodyFrame, BodyId, Mark, Vector, subtract};
use crate::syntax::{self, Name};

/// Returns the names of a body's coordinates: `x1, y1, phi1` of body `1`; `x_c1, y_c1, phi_c1` of body `c1`.
pub(super) fn coordinate_names(body: &str) -> [String; 3] {
    let separator = if body.starts_with(|first: char| first.is_ascii_digit()) {
        ""
    } else {
        "_"
    };
    ["x", "y", "phi"].map(|coordinate| format!("{coordinate}{separator}{body}"))
}

impl Resolver<'_> {
    pub(super) fn add_points(&mut self, points: &syntax::Points) {
        for point in &points.points {
            let position = self.pair(&point.position);
            self.declare_drawn(
                &point.name,
                DrawnPoint {
                    position,
                    docs: points.docs.clone(),
                },
            );
        }
    }

    /// Resolves a pair of lengths. A component with an error becomes zero, so that its name is still declared.
    pub(super) fn pair(&mut self, pair: &syntax::Pair) -> Vector {
        let zero = self.graph.zero();
        let mut component = |written: &syntax::Expression| {
            let value = self.constant(written, Dimension::LENGTH);
            let value = value.filter(|&value| self.is_measurable(value, written.span));
            value.unwrap_or(zero)
        };
        [component(&pair.x), component(&pair.y)]
    }

    pub(super) fn add_body(&mut self, body: &syntax::Body) {
        let name = &body.name;
        let Some(id) = self.new_body(name) else {
            return;
        };
        let symbols = coordinate_names(&name.text).map(|name| self.graph.symbol(&name));
        let [x, y, phi] = symbols.map(|symbol| self.graph.variable(symbol));
        let drawn = self.drawn_pose(body, id);
        let frame = BodyFrame {
            body: id,
            origin: [x, y],
            angle: phi,
        };
        let mut marks: Vec<NamedMark> = Vec::new();
        let mut places: HashMap<&str, usize> = HashMap::new();
        for member in &body.members {
            let Some(mark) = self.member(member, frame, drawn) else {
                continue;
            };
            let (syntax::Member::Local { name: own, .. }
            | syntax::Member::Carried { name: own, .. }) = member;
            self.is_no_angle(own);
            match places.get(own.text.as_str()).map(|&at| &marks[at]) {
                Some(earlier) => self.diagnostics.push(
                    Diagnostic::error(
                        Code::DuplicateName,
                        mark.span,
                        format!("body `{}` carries `{}` twice", name.text, mark.name),
                    )
                    .label("listed again here")
                    .also(earlier.span, "first listed here")
                    .help("remove one of them"),
                ),
                None => {
                    places.insert(&own.text, marks.len());
                    marks.push(mark);
                }
            }
        }
        let coordinates = self.linkage.numbered(symbols.map(Some));
        self.finish_body(
            name,
            Body {
                name: name.text.clone(),
                docs: body.docs.clone(),
                span: name.span,
                frame,
                coordinates,
                drawn,
                marks,
            },
        );
    }

    /// Adds a body that [`Self::new_body`] has numbered. Its name can be used only from now on, so no body depends on itself.
    pub(super) fn finish_body(&mut self, name: &Name, body: Body) {
        self.declared.unfinished_body = None;
        // `new_body` has rejected a declared name.
        let _ = self.declared.body_ids.declare(name, body.frame.body);
        self.linkage.push_body(body);
    }

    /// Returns the number for a body with this name; `None` after an error.
    pub(super) fn new_body(&mut self, name: &Name) -> Option<BodyId> {
        if name.text == "ground" {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NameNotAllowed,
                    name.span,
                    "`ground` is the fixed frame and is always there",
                )
                .help("joints may name it: `revolute A(ground, 1);`"),
            );
            return None;
        }
        match self.declared.body_ids.duplicate(name) {
            Some(duplicate) => {
                self.diagnostics.push(duplicate);
                None
            }
            None => {
                self.declared.unfinished_body = Some(name.clone());
                Some(BodyId(self.linkage.bodies.len()))
            }
        }
    }

    /// Returns the pose of a body in the design configuration.
    fn drawn_pose(&mut self, body: &syntax::Body, id: BodyId) -> BodyFrame {
        let zero = self.graph.zero();
        let origin = match &body.origin {
            syntax::Origin::Coordinates(pair) => self.pair(pair),
            syntax::Origin::Point(reference) => self.drawn_point(reference).unwrap_or([zero, zero]),
        };
        let angle = match &body.orientation {
            syntax::Orientation::Aligned => zero,
            syntax::Orientation::Angle(angle) => {
                self.constant(angle, Dimension::Angle).unwrap_or(zero)
            }
            syntax::Orientation::Facing(direction) => self.facing(direction).unwrap_or(zero),
        };
        BodyFrame {
            body: id,
            origin,
            angle,
        }
    }

    /// Returns the angle of the direction from one global point to another; `None` after an error.
    fn facing(&mut self, direction: &syntax::Direction) -> Option<ExprId> {
        let (from, to) = (
            self.drawn_point(&direction.from),
            self.drawn_point(&direction.to),
        );
        let (from, to) = (from?, to?);
        let mut along = self.unit_direction(from, to, direction.span, DISTINCT_POINTS_HELP)?;
        if !along.iter().all(|&part| self.graph.is_constant(part)) {
            // For parameters, the unnormalized vector is a shorter expression, and has the same angle.
            along = subtract(to, from, &mut self.graph);
        }
        Some(self.graph.atan2(along[1], along[0]))
    }

    fn member(
        &mut self,
        member: &syntax::Member,
        frame: BodyFrame,
        drawn: BodyFrame,
    ) -> Option<NamedMark> {
        match member {
            syntax::Member::Local {
                docs,
                name,
                position,
            } => {
                let local = self.pair(position);
                let in_drawing = Mark::new(drawn, local, &mut self.graph);
                Some(NamedMark {
                    name: name.text.clone(),
                    docs: docs.clone(),
                    mark: Mark::new(frame, local, &mut self.graph),
                    drawn: in_drawing.position(&mut self.graph),
                    span: name.span,
                })
            }
            syntax::Member::Carried { docs, name } => {
                let global = self.declared.drawn.declaration(&name.text);
                let Some((declared, &DrawnPoint { position, .. })) = global else {
                    let unknown = self.declared.drawn.unknown(&name.text, name.span);
                    self.diagnostics.push(unknown.help(format!(
                        "give its global position, `point {0} = (x, y);`, or in the body's frame, `{0}: (x, y)`",
                        name.text
                    )));
                    return None;
                };
                self.note_use(name, declared.span);
                let gap = subtract(position, drawn.origin, &mut self.graph);
                let local = drawn.unrotate(gap, &mut self.graph);
                Some(NamedMark {
                    name: name.text.clone(),
                    docs: docs.clone(),
                    mark: Mark::new(frame, local, &mut self.graph),
                    drawn: position,
                    span: name.span,
                })
            }
        }
    }
}
