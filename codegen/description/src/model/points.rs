//! Lists the points whose motion can be requested, without duplicates.
//!
//! Bodies share a joint point, which counts once. Different points of one name are listed per body, as `K_c1`, `K_c2`.

use std::collections::{HashMap, HashSet};

use super::carriers::Carried;
use super::declared::DrawnPoint;
use super::resolve::Resolver;
use super::{NamedMark, Point};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::joint::geometry::Mark;
use crate::syntax::Name;

impl Resolver<'_> {
    /// Returns every point once: global points first, then points declared only on bodies, each in source order.
    pub(super) fn output_points(&mut self) -> Vec<Point> {
        let drawn: Vec<(String, DrawnPoint, Span)> = self
            .declared
            .drawn
            .iter()
            .map(|(name, point)| (name.text.clone(), point.clone(), name.span))
            .collect();
        let carried = self.linkage.bodies.iter().flat_map(|body| &body.marks);
        let local = carried.filter(|mark| self.declared.drawn.get(&mark.name).is_none());
        let mut seen = HashSet::new();
        let local = local.filter(|mark| seen.insert(mark.name.as_str()));
        let mut names: Vec<String> = drawn.iter().map(|(name, ..)| name.clone()).collect();
        names.extend(local.map(|mark| mark.name.clone()));
        let mut points = Vec::new();
        for (position, name) in names.iter().enumerate() {
            let groups = self.linkage.carriers.carriers_of(name);
            let several = groups.len() > 1;
            if let (true, Some((_, point, span))) = (groups.is_empty(), drawn.get(position)) {
                let ground = self.linkage.bodies[0].frame;
                let mark = Mark::new(ground, point.position, &mut self.graph);
                points.push(Point {
                    name: name.clone(),
                    docs: point.docs.clone(),
                    mark,
                    span: *span,
                });
            }
            for carried in groups {
                let full = if several {
                    format!("{name}_{}", self.linkage.bodies[carried.0.0].name)
                } else {
                    name.clone()
                };
                let carried = self.carried(carried);
                let mut docs = carried.docs.clone();
                if let (true, Some((_, point, _))) = (docs.is_empty(), drawn.get(position)) {
                    docs.clone_from(&point.docs);
                }
                points.push(Point {
                    name: full,
                    docs,
                    mark: carried.mark,
                    span: carried.span,
                });
            }
        }
        self.reject_equal_lowercase(&points);
        self.note_drawn_points();
        points
    }

    /// Records that a point of a body and the global point of its name are requested by one name.
    fn note_drawn_points(&mut self) {
        if self.mentions.is_none() {
            return;
        }
        let marks = self.linkage.bodies.iter().flat_map(|body| &body.marks);
        let drawn = marks.filter_map(|mark| {
            let (name, _) = self.declared.drawn.declaration(&mark.name)?;
            let written = Name {
                text: mark.name.clone(),
                span: mark.span,
            };
            Some((written, name.span))
        });
        for (name, declaration) in drawn.collect::<Vec<_>>() {
            self.note_use(&name, declaration);
        }
    }

    /// Returns a point of a body.
    pub(super) fn carried(&self, (body, place): Carried) -> &NamedMark {
        &self.linkage.bodies[body.0].marks[place]
    }

    /// Reports points that differ only by case, since generated functions have lower-case names.
    fn reject_equal_lowercase(&mut self, points: &[Point]) {
        let mut earlier_by_name: HashMap<String, &Point> = HashMap::new();
        for point in points {
            let lowercase = point.name.to_lowercase();
            let earlier = *earlier_by_name.entry(lowercase.clone()).or_insert(point);
            if !std::ptr::eq(earlier, point) {
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::NameNotAllowed,
                        point.span,
                        format!(
                            "points `{}` and `{}` differ only in case",
                            earlier.name, point.name
                        ),
                    )
                    .label(format!(
                        "both would be `point_{lowercase}` in the generated code"
                    ))
                    .also(earlier.span, "the other one")
                    .help("give one of them another name"),
                );
            }
        }
    }

    /// Declares a global point.
    pub(super) fn declare_drawn(&mut self, name: &Name, point: DrawnPoint) {
        self.is_no_angle(name);
        if let Some(duplicate) = self.declared.drawn.declare(name, point) {
            self.diagnostics.push(duplicate);
        }
    }
}
