//! Holds the bodies and joints declared so far, with the points of the bodies.
//!
//! Each joint has a unique slug.

use std::collections::HashMap;

use super::carriers::Carriers;
use super::naming::Naming;
use super::slug::Slugs;
use super::{Body, Coordinate, Joint};
use crate::diagnostic::Span;
use crate::expr::{Graph, SymbolId};
use crate::joint::geometry::{BodyFrame, BodyId, Mark, Vector};
use crate::syntax;

/// Bodies and joints of a description.
pub(super) struct Linkage {
    pub bodies: Vec<Body>,
    /// Body and axis of each coordinate; never iterated.
    pub coordinate_places: HashMap<SymbolId, (BodyId, usize)>,
    /// Index of the points of bodies.
    pub carriers: Carriers,
    /// Joints, each with the written direction by which drivers find it.
    pub joints: Vec<(Joint, Option<syntax::Direction>)>,
    /// Stems of row names.
    pub slugs: Slugs,
    pub naming: &'static Naming,
    /// Number of equations in the description.
    pub equation_count: usize,
    /// Directions of joints with an error.
    pub broken_lines: Vec<syntax::Direction>,
    /// Positions of the ground points that equations name.
    pub named_on_ground: Vec<Vector>,
}

impl Linkage {
    /// Creates the linkage with only the ground.
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

    /// Returns the coordinates of the next body, with indices after all previous ones.
    pub fn numbered(&self, symbols: [Option<SymbolId>; 3]) -> [Option<Coordinate>; 3] {
        let mut places = self.coordinate_places.len()..;
        symbols.map(|symbol| {
            let (symbol, place) = (symbol?, places.next()?);
            Some(Coordinate { symbol, place })
        })
    }

    /// Adds a body.
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

    /// Adds a joint with its written direction.
    pub fn push_joint(&mut self, joint: Joint, along: Option<syntax::Direction>) {
        if let (true, [one, other]) = (joint.kind.joins_points, &joint.operands.marks[..]) {
            self.carriers.join(one, other);
        }
        self.slugs.take(&joint.slug);
        self.joints.push((joint, along));
    }

    /// Returns the words as a lower-case identifier that is unique among the stems of row names.
    pub fn unique_slug(&mut self, words: &str) -> String {
        let base = (self.naming.apart)(&words.to_lowercase(), "row");
        self.slugs.free(base)
    }

    /// Returns the scale of lengths: the largest coordinate of points in joints and equations. If all are zero, as for a body
    /// that rotates about the origin, the coordinates of `loaded` points are used.
    pub fn characteristic_length(&self, loaded: &[Mark], graph: &Graph) -> f64 {
        let joints = || self.joints.iter().map(|(joint, _)| joint);
        // The mark of an angle is a direction.
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
