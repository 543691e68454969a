//! The points of bodies and of the drawing → what a mark is called, found by where it is.
//!
//! Of several names for one place the first one written counts. Nothing here is iterated.

use std::collections::HashMap;

use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::model::{Body, Point};

/// The names of all places that have one.
#[derive(Clone, Debug, Default)]
pub(super) struct MarkNames {
    on_body: HashMap<(BodyId, Vector), String>,
    free: HashMap<(BodyId, Vector), String>,
    in_drawing: HashMap<Vector, String>,
}

impl MarkNames {
    pub(super) fn new(bodies: &[Body], points: &[Point]) -> MarkNames {
        let mut names = MarkNames::default();
        for named in bodies.iter().flat_map(|body| &body.marks) {
            let name = || named.name.clone();
            names.on_body.entry(place(&named.mark)).or_insert_with(name);
            names.in_drawing.entry(named.drawn).or_insert_with(name);
        }
        for point in points {
            let name = || point.name.clone();
            names.free.entry(place(&point.mark)).or_insert_with(name);
        }
        names
    }

    /// What the body of a mark calls it.
    pub(super) fn on_body(&self, mark: &Mark) -> Option<&String> {
        self.on_body.get(&place(mark))
    }

    /// What a mark is called that its body does not list, at this place of the drawing: as a point of the mechanism, or as the first
    /// body calls it that carries a point there.
    pub(super) fn elsewhere(&self, mark: &Mark, drawn: Vector) -> Option<&String> {
        let free = self.free.get(&place(mark));
        free.or_else(|| self.in_drawing.get(&drawn))
    }
}

fn place(mark: &Mark) -> (BodyId, Vector) {
    (mark.frame.body, mark.local)
}
