//! Indexes the points of bodies by name and position, and identifies equal points.
//!
//! All queries use an index, so the time for a description is proportional to its text. Joints that keep two marks of one name
//! coincident make them one point. The order of hash maps is never used.

use std::collections::{HashMap, HashSet};

use crate::joint::geometry::{BodyId, Mark, Vector};

/// One point of one body: the body, and the index among its marks.
pub(super) type Carried = (BodyId, usize);

/// Index of the points of all bodies.
#[derive(Clone, Debug, Default)]
pub(super) struct Carriers {
    all: Vec<Carried>,
    /// Local vector of each point.
    places: Vec<Vector>,
    /// For each point, an earlier equal point or the point itself (union-find).
    same: Vec<usize>,
    /// Points by name, in source order.
    by_name: HashMap<String, Vec<usize>>,
    by_body: HashMap<BodyId, OfBody>,
    /// Pairs of positions that are joined already.
    joined: HashSet<[(BodyId, Vector); 2]>,
}

/// Points of one body.
#[derive(Clone, Debug, Default)]
struct OfBody {
    by_name: HashMap<String, usize>,
    /// Points by local vector, in source order.
    by_place: HashMap<Vector, Vec<(String, usize)>>,
}

impl Carriers {
    /// Adds a point of a body, whose name must be new on this body.
    pub(super) fn add(&mut self, carried: Carried, name: &str, local: Vector) {
        let at = self.all.len();
        self.all.push(carried);
        self.places.push(local);
        self.same.push(at);
        self.by_name.entry(name.to_string()).or_default().push(at);
        let of_body = self.by_body.entry(carried.0).or_default();
        of_body.by_name.insert(name.to_string(), at);
        let there = of_body.by_place.entry(local).or_default();
        there.push((name.to_string(), at));
    }

    /// Identifies the equally named points at two marks.
    pub(super) fn join(&mut self, one: &Mark, other: &Mark) {
        let places = [one, other].map(|mark| (mark.frame.body, mark.local));
        if self.joined.contains(&places) {
            return;
        }
        let of = |mark: &Mark| self.by_body.get(&mark.frame.body);
        let (Some(here), Some(there)) = (of(one), of(other)) else {
            return;
        };
        let named = here.by_place.get(&one.local).into_iter().flatten();
        let pairs = named.filter_map(|(name, at)| {
            let same = *there.by_name.get(name)?;
            (self.places[same] == other.local).then_some((*at, same))
        });
        let pairs: Vec<(usize, usize)> = pairs.collect();
        self.joined.insert(places);
        for (one, other) in pairs {
            let (one, other) = (self.first_of(one), self.first_of(other));
            self.same[one.max(other)] = one.min(other);
        }
    }

    /// Returns the earliest equal point, and compresses the path to it.
    fn first_of(&mut self, mut at: usize) -> usize {
        while self.same[at] != at {
            self.same[at] = self.same[self.same[at]];
            at = self.same[at];
        }
        at
    }

    /// Returns the first body with a point of this name.
    pub(super) fn first_carrier(&self, name: &str) -> Option<Carried> {
        let first = self.by_name.get(name)?.first()?;
        Some(self.all[*first])
    }

    /// Returns all points of this name, in source order.
    pub(super) fn all_of(&self, name: &str) -> impl Iterator<Item = Carried> {
        let named = self.by_name.get(name).map_or(&[][..], Vec::as_slice);
        named.iter().map(|&at| self.all[at])
    }

    /// Returns the first carrier of every distinct point of this name, in source order.
    pub(super) fn carriers_of(&self, name: &str) -> Vec<Carried> {
        let named = self.by_name.get(name).map_or(&[][..], Vec::as_slice);
        let firsts = named.iter().filter(|&&at| self.same[at] == at);
        firsts.map(|&at| self.all[at]).collect()
    }

    /// Returns the index of a name among the marks of a body.
    pub(super) fn on_body(&self, body: BodyId, name: &str) -> Option<usize> {
        let at = self.by_body.get(&body)?.by_name.get(name)?;
        Some(self.all[*at].1)
    }

    /// Returns the index, among the marks of a body, of the first point with this local vector.
    pub(super) fn at_place(&self, body: BodyId, local: Vector) -> Option<usize> {
        let there = self.by_body.get(&body)?.by_place.get(&local)?;
        let (_, at) = there.first()?;
        Some(self.all[*at].1)
    }
}
