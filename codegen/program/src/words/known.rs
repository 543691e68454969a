//! How far a solution has come → what is known by then, and where a known point is.

use std::collections::HashMap;
use std::sync::Arc;

use super::phrase::{Phrase, Piece, phrase};
use super::pins::{Pin, pins};
use crate::joint::geometry::{BodyId, Mark};
use crate::system::System;

/// The unknowns that have been found, and the pins of the mechanism.
#[derive(Clone, Debug)]
pub struct Known {
    pins: Arc<[Pin]>,
    /// The places of the pins on what turns with an angle, ascending; only looked up.
    turning: Arc<HashMap<usize, Vec<usize>>>,
    /// The block that finds each unknown, from 0; `None` while it is not found yet.
    found_in: Vec<Option<usize>>,
}

impl Known {
    /// Nothing has been found.
    pub fn nothing(system: &System) -> Known {
        let pins = pins(&system.mechanism);
        let form = &system.vector_form;
        let mut turning: HashMap<usize, Vec<usize>> = HashMap::new();
        for (place, pin) in pins.iter().enumerate() {
            let leaders = pin
                .marks
                .map(|mark| form.orientations.leader(mark.frame.body).0);
            for leader in leaders.into_iter().filter(|it| *it != BodyId::GROUND) {
                let own = turning.entry(form.angle_of(leader.0)).or_default();
                if own.last() != Some(&place) {
                    own.push(place);
                }
            }
        }
        Known {
            pins: pins.into(),
            turning: turning.into(),
            found_in: vec![None; system.vector_form.unknowns.len()],
        }
    }

    /// Notes that a block, counted from 0, finds an unknown.
    pub fn find(&mut self, unknown: usize, block: usize) {
        self.found_in[unknown] = Some(block);
    }

    /// The block that finds an unknown, from 0.
    pub fn block_of(&self, unknown: usize) -> Option<usize> {
        self.found_in[unknown]
    }

    /// Whether the pose of a body is known.
    pub(super) fn is_known(&self, body: BodyId, system: &System) -> bool {
        let mut places = system.mechanism.bodies[body.0].places();
        places.all(|unknown| self.found_in[unknown].is_some())
    }

    /// The pins on bodies whose leaders turn with one of these angles, in written order.
    pub(super) fn pins_on(&self, angles: &[usize]) -> impl Iterator<Item = &Pin> + use<'_> {
        let places = angles.iter().filter_map(|angle| self.turning.get(angle));
        let mut places: Vec<usize> = places.flatten().copied().collect();
        places.sort_unstable();
        places.dedup();
        places.into_iter().map(|place| &self.pins[place])
    }

    /// The pins on a body that turns with this angle, with what is on their other side: the mark here, the mark there.
    pub(super) fn pins_turning(&self, angle: usize, system: &System) -> Vec<(Pin, Mark, Mark)> {
        let turns = |mark: &Mark| system.vector_form.turns(mark.frame.body, angle);
        let turning = self.pins_on(&[angle]).filter_map(|pin| {
            let [first, second] = pin.marks;
            match [turns(&first), turns(&second)] {
                [true, false] => Some((pin.clone(), first, second)),
                [false, true] => Some((pin.clone(), second, first)),
                _ => None,
            }
        });
        turning.collect()
    }

    /// The pins that connect what turns with this angle to bodies that are known, each with the mark of the known body.
    pub(crate) fn known_pins(&self, angle: usize, system: &System) -> Vec<(Pin, Mark)> {
        self.pins_turning(angle, system)
            .into_iter()
            .filter(|(_, _, there)| self.is_known(there.frame.body, system))
            .map(|(pin, _, there)| (pin, there))
            .collect()
    }

    /// Where a known point is, in words: `on the ground`, `led by the drivers`, `on c3 (block 2)`.
    pub(crate) fn whereabouts(&self, mark: &Mark, system: &System) -> Phrase {
        let body = mark.frame.body.0;
        if body == 0 {
            let mut joints = system.mechanism.joints.iter();
            let led = joints.any(|joint| {
                let is_led = ["x", "y"].contains(&joint.kind.keyword());
                is_led && joint.operands.marks[0].local == mark.local
            });
            return Phrase::from(match led {
                true => "led by the drivers",
                false => "on the ground",
            });
        }
        let name = Piece::Name(system.mechanism.bodies[body].name.clone());
        let places = system.mechanism.bodies[body].places();
        let latest = places.filter_map(|unknown| self.found_in[unknown]);
        match latest.max() {
            Some(block) => phrase!["on ", name, format!(" (block {})", block + 1)],
            None => phrase!["on ", name],
        }
    }
}
