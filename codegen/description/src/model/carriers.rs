//! Points as bodies carry them → which body carries a name, what lies at a place of a body, and which of them are one point.
//!
//! Every question is answered from an index, so that a description of many points is read in time proportional to its text. Joints
//! that keep two marks of one name together make them one point. Nothing here is iterated in an order of its own.

use std::collections::{HashMap, HashSet};

use crate::joint::geometry::{BodyId, Mark, Vector};

/// One point of one body: the body, and the place among its marks.
pub(super) type Carried = (BodyId, usize);

/// What all bodies carry so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Carriers {
    all: Vec<Carried>,
    /// The local vector of each.
    places: Vec<Vector>,
    /// Of each the earliest that is the same point, itself or on the way to it.
    same: Vec<usize>,
    /// In written order.
    by_name: HashMap<String, Vec<usize>>,
    by_body: HashMap<BodyId, OfBody>,
    /// The pairs of places that are joined already.
    joined: HashSet<[(BodyId, Vector); 2]>,
}

/// What one body carries.
#[derive(Clone, Debug, Default)]
struct OfBody {
    by_name: HashMap<String, usize>,
    /// In written order.
    by_place: HashMap<Vector, Vec<(String, usize)>>,
}

impl Carriers {
    /// Takes in the next point of a body, which has no other of its name.
    pub(super) fn add(&mut self, carried: Carried, name: &str, local: Vector) {
        let at = self.all.len();
        self.all.push(carried);
        self.places.push(local);
        self.same.push(at);
        self.by_name.entry(name.to_string()).or_default().push(at);
        let own = self.by_body.entry(carried.0).or_default();
        own.by_name.insert(name.to_string(), at);
        let there = own.by_place.entry(local).or_default();
        there.push((name.to_string(), at));
    }

    /// Makes the points of one name at two marks one point.
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

    /// The earliest that is the same point, with the way there made shorter.
    fn first_of(&mut self, mut at: usize) -> usize {
        while self.same[at] != at {
            self.same[at] = self.same[self.same[at]];
            at = self.same[at];
        }
        at
    }

    /// The first body that carries a point of this name.
    pub(super) fn first_carrier(&self, name: &str) -> Option<Carried> {
        let first = self.by_name.get(name)?.first()?;
        Some(self.all[*first])
    }

    /// All points of this name, in written order.
    pub(super) fn all_of(&self, name: &str) -> impl Iterator<Item = Carried> {
        let named = self.by_name.get(name).map_or(&[][..], Vec::as_slice);
        named.iter().map(|&at| self.all[at])
    }

    /// The first carrier of every distinct point of this name, in written order.
    pub(super) fn carriers_of(&self, name: &str) -> Vec<Carried> {
        let named = self.by_name.get(name).map_or(&[][..], Vec::as_slice);
        let firsts = named.iter().filter(|&&at| self.same[at] == at);
        firsts.map(|&at| self.all[at]).collect()
    }

    /// The place of a name among the marks of a body.
    pub(super) fn on_body(&self, body: BodyId, name: &str) -> Option<usize> {
        let at = self.by_body.get(&body)?.by_name.get(name)?;
        Some(self.all[*at].1)
    }

    /// The first point of a body at this local vector, as a place among its marks.
    pub(super) fn at_place(&self, body: BodyId, local: Vector) -> Option<usize> {
        let there = self.by_body.get(&body)?.by_place.get(&local)?;
        let (_, at) = there.first()?;
        Some(self.all[*at].1)
    }
}
