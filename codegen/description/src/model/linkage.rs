//! The bodies and joints of a description so far, with the points that they carry.
//!
//! Afterwards each joint has a slug of its own. Deliberately unknown here: names of anything else, and formulas.

use std::collections::HashMap;

use super::carriers::Carriers;
use super::naming::Naming;
use super::slug::Slugs;
use super::{Body, Coordinate, Joint};
use crate::diagnostic::Span;
use crate::expr::{Graph, SymbolId};
use crate::joint::geometry::{BodyFrame, BodyId, Mark, Vector};
use crate::syntax;

/// What moves, and what holds it.
pub(super) struct Linkage {
    pub bodies: Vec<Body>,
    /// The body and the axis of each coordinate; only looked up.
    pub coordinate_places: HashMap<SymbolId, (BodyId, usize)>,
    /// The points that they carry.
    pub carriers: Carriers,
    /// Each with the direction it was written along, by which drivers find it.
    pub joints: Vec<(Joint, Option<syntax::Direction>)>,
    /// What their rows are named after.
    pub slugs: Slugs,
    pub naming: &'static Naming,
    /// How many equations the description has written out.
    pub equation_count: usize,
    /// The directions of joints that have an error.
    pub broken_lines: Vec<syntax::Direction>,
    /// Where the points of the ground are that equations name.
    pub named_on_ground: Vec<Vector>,
}

impl Linkage {
    /// The ground alone.
    pub fn new(graph: &Graph, naming: &'static Naming) -> Linkage {
        let zero = graph.zero();
        let frame = BodyFrame {
            body: BodyId::GROUND,
            origin: [zero, zero],
            angle: zero,
        };
        Linkage {
            bodies: vec![Body {
                name: "ground".to_string(),
                docs: Vec::new(),
                span: Span::default(),
                frame,
                coordinates: [None; 3],
                drawn: frame,
                marks: Vec::new(),
            }],
            coordinate_places: HashMap::new(),
            carriers: Carriers::default(),
            joints: Vec::new(),
            slugs: Slugs::default(),
            naming,
            equation_count: 0,
            broken_lines: Vec::new(),
            named_on_ground: Vec::new(),
        }
    }

    /// The coordinates of the next body, with the places behind all so far.
    pub fn numbered(&self, symbols: [Option<SymbolId>; 3]) -> [Option<Coordinate>; 3] {
        let mut places = self.coordinate_places.len()..;
        symbols.map(|symbol| {
            let (symbol, place) = (symbol?, places.next()?);
            Some(Coordinate { symbol, place })
        })
    }

    /// Takes in a body.
    pub fn push_body(&mut self, body: Body) {
        let id = body.frame.body;
        for (axis, coordinate) in body.coordinates.iter().enumerate() {
            if let Some(Coordinate { symbol, .. }) = coordinate {
                self.coordinate_places.insert(*symbol, (id, axis));
            }
        }
        for (place, mark) in body.marks.iter().enumerate() {
            self.carriers.add((id, place), &mark.name, mark.mark.local);
        }
        self.bodies.push(body);
    }

    /// Takes in a joint, with the direction it was written along.
    pub fn push_joint(&mut self, joint: Joint, along: Option<syntax::Direction>) {
        if let (true, [one, other]) = (joint.kind.joins_points(), &joint.operands.marks[..]) {
            self.carriers.join(one, other);
        }
        self.slugs.take(&joint.slug);
        self.joints.push((joint, along));
    }

    /// The words as a lower-case identifier that no other joint's rows are named after.
    pub fn unique_slug(&mut self, words: &str) -> String {
        let base = (self.naming.apart)(&words.to_lowercase(), "row");
        self.slugs.free(base)
    }

    /// The largest coordinate of what joints hold and equations name, which lengths are scaled by; where all are zero, as where a body
    /// turns about the origin, that of what `loaded` points have.
    pub fn characteristic_length(&self, loaded: &[Mark], graph: &Graph) -> f64 {
        let joints = || self.joints.iter().map(|(joint, _)| joint);
        // What an angle turns is a direction.
        let has_place = |mark: &&Mark| !self.bodies[mark.frame.body.0].is_angle();
        let marks = joints().flat_map(|joint| &joint.operands.marks);
        let marks = marks.filter(has_place).map(|mark| mark.local);
        let rods = joints().filter_map(|joint| Some([joint.operands.length()?; 2]));
        let origins = self.bodies.iter().map(|body| body.drawn.origin);
        let named = self.named_on_ground.iter().copied();
        let held: Vec<Vector> = marks.chain(origins).chain(named).chain(rods).collect();
        let loaded: Vec<Vector> = loaded.iter().map(|mark| mark.local).collect();
        let mut largest = [held, loaded].into_iter().map(|places| {
            let components = places.into_iter().flatten();
            components
                .filter_map(|component| graph.constant_value(component))
                .fold(0.0_f64, |largest, value| largest.max(value.abs()))
        });
        let length = largest.find(|it| *it > 0.0 && it.is_finite());
        length.unwrap_or(1.0)
    }
}
