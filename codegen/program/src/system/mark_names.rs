//! Names marks after the points of bodies and of the mechanism at the position of the mark.
//!
//! Of several names of one position, the first written counts. Maps are not iterated.

use std::collections::HashMap;

use crate::joint::geometry::{BodyId, Mark, Vector};
use crate::model::{Body, Point};

/// Names of all named positions.
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

    /// Returns the name of a mark on its own body; `None` if the body lists no such point.
    pub(super) fn on_body(&self, mark: &Mark) -> Option<&String> {
        self.on_body.get(&place(mark))
    }

    /// Returns the name of a mark that its body does not list: the mechanism's point at this design position, or the name on the
    /// first body that has a point there.
    pub(super) fn elsewhere(&self, mark: &Mark, drawn: Vector) -> Option<&String> {
        let free = self.free.get(&place(mark));
        free.or_else(|| self.in_drawing.get(&drawn))
    }
}

fn place(mark: &Mark) -> (BodyId, Vector) {
    (mark.frame.body, mark.local)
}
