//! The points that bodies carry → the points whose motion can be asked for, each once.
//!
//! A joint point is carried by several bodies and is one point; bodies that carry different points of the same name give one
//! point each, named `K_c1`, `K_c2`.

use super::resolve::{DrawnPoint, Resolver};
use super::{NamedMark, Point};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::joint::geometry::{BodyId, Mark};
use crate::syntax::Name;

impl Resolver<'_> {
    /// Every point once: the drawn ones first, then those that only bodies declare, each sort in written order.
    pub(super) fn output_points(&mut self) -> Vec<Point> {
        let drawn: Vec<(String, DrawnPoint, Span)> = self
            .drawn
            .iter()
            .map(|(name, point)| (name.text.clone(), point.clone(), name.span))
            .collect();
        let mut names: Vec<String> = drawn.iter().map(|(name, ..)| name.clone()).collect();
        for body in &self.bodies {
            for mark in &body.marks {
                if !names.contains(&mark.name) {
                    names.push(mark.name.clone());
                }
            }
        }
        let mut points = Vec::new();
        for (position, name) in names.iter().enumerate() {
            let groups = self.carriers_of(name);
            let several = groups.len() > 1;
            if let (true, Some((_, point, span))) = (groups.is_empty(), drawn.get(position)) {
                let ground = self.bodies[0].frame;
                let mark = Mark::new(ground, point.position, &mut self.graph);
                points.push(Point {
                    name: name.clone(),
                    docs: point.docs.clone(),
                    mark,
                    span: *span,
                });
            }
            for (body, carried) in groups {
                let full = if several {
                    format!("{name}_{}", self.bodies[body.0].name)
                } else {
                    name.clone()
                };
                let mut docs = carried.docs;
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
        points
    }

    /// The first carrier of every distinct point of this name.
    pub(super) fn carriers_of(&self, name: &str) -> Vec<(BodyId, NamedMark)> {
        let carried: Vec<(BodyId, &NamedMark)> = self
            .bodies
            .iter()
            .flat_map(|body| body.marks.iter().map(move |mark| (body.frame.body, mark)))
            .filter(|(_, mark)| mark.name == name)
            .collect();
        // Union-find over the carriers; joints that keep two of these marks together make them one point.
        let mut group: Vec<usize> = (0..carried.len()).collect();
        for (joint, _) in &self.joints {
            if !joint.kind.joins_points() {
                continue;
            }
            let end = |side: usize| {
                let mark = joint.operands.marks.get(side)?;
                carried.iter().position(|(_, other)| other.mark == *mark)
            };
            if let (Some(one), Some(other)) = (end(0), end(1)) {
                let (low, high) = (group[one].min(group[other]), group[one].max(group[other]));
                for entry in &mut group {
                    if *entry == high {
                        *entry = low;
                    }
                }
            }
        }
        let firsts = (0..carried.len()).filter(|&at| group[at] == at);
        firsts
            .map(|at| (carried[at].0, carried[at].1.clone()))
            .collect()
    }

    /// Generated functions are named in lower case, so two points must not differ by case alone.
    fn reject_equal_lowercase(&mut self, points: &[Point]) {
        for (at, point) in points.iter().enumerate() {
            let lowercase = point.name.to_lowercase();
            if let Some(earlier) = points[..at]
                .iter()
                .find(|earlier| earlier.name.to_lowercase() == lowercase)
            {
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

    /// Adds a drawn point.
    pub(super) fn declare_drawn(&mut self, name: &Name, point: DrawnPoint) {
        if let Some(duplicate) = self.drawn.declare(name, point) {
            self.diagnostics.push(duplicate);
        }
    }
}
