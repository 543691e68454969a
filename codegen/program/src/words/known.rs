//! Tracks the progress of a solution: known unknowns, and positions of known points in words.

use std::collections::HashMap;
use std::sync::Arc;

use super::phrase::{Phrase, Piece, phrase};
use super::pins::{Pin, pins};
use crate::joint::geometry::{BodyId, Mark};
use crate::system::System;

/// Unknowns that are solved so far, and the pins of the mechanism.
#[derive(Clone, Debug)]
pub struct Known {
    pins: Arc<[Pin]>,
    /// Indices of the pins on bodies of an angle, ascending; only looked up.
    turning: Arc<HashMap<usize, Vec<usize>>>,
    /// Block that solves each unknown, from 0; `None` if none has so far.
    found_in: Vec<Option<usize>>,
}

impl Known {
    /// Returns the state before the first block.
    pub fn nothing(system: &System) -> Known {
        let pins = pins(&system.mechanism);
        let form = &system.vector_form;
        let mut turning: HashMap<usize, Vec<usize>> = HashMap::new();
        for (place, pin) in pins.iter().enumerate() {
            let leaders = pin
                .marks
                .map(|mark| form.orientations.leader(mark.frame.body).0);
            for leader in leaders.into_iter().filter(|it| *it != BodyId::GROUND) {
                let of_angle = turning.entry(form.angle_of(leader.0)).or_default();
                if of_angle.last() != Some(&place) {
                    of_angle.push(place);
                }
            }
        }
        Known {
            pins: pins.into(),
            turning: turning.into(),
            found_in: vec![None; system.vector_form.unknowns.len()],
        }
    }

    /// Records the block, counted from 0, that solves an unknown.
    pub fn find(&mut self, unknown: usize, block: usize) {
        self.found_in[unknown] = Some(block);
    }

    /// Returns the block that solves an unknown, from 0; `None` if none has so far.
    pub fn block_of(&self, unknown: usize) -> Option<usize> {
        self.found_in[unknown]
    }

    /// True if the pose of a body is known.
    pub(super) fn is_known(&self, body: BodyId, system: &System) -> bool {
        let mut places = system.mechanism.bodies[body.0].places();
        places.all(|unknown| self.found_in[unknown].is_some())
    }

    /// Returns the pins on bodies whose leaders rotate with one of these angles, in written order.
    pub(super) fn pins_on(&self, angles: &[usize]) -> impl Iterator<Item = &Pin> + use<'_> {
        let places = angles.iter().filter_map(|angle| self.turning.get(angle));
        let mut places: Vec<usize> = places.flatten().copied().collect();
        places.sort_unstable();
        places.dedup();
        places.into_iter().map(|place| &self.pins[place])
    }

    /// Returns the pins on a body that rotates with this angle, each with the mark here and the mark on the other side.
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

    /// Returns the pins between bodies of this angle and known bodies, each with the mark of the known body.
    pub(crate) fn known_pins(&self, angle: usize, system: &System) -> Vec<(Pin, Mark)> {
        self.pins_turning(angle, system)
            .into_iter()
            .filter(|(_, _, there)| self.is_known(there.frame.body, system))
            .map(|(pin, _, there)| (pin, there))
            .collect()
    }

    /// Describes the position of a known point: `on the ground`, `led by the drivers`, `on c3 (block 2)`.
    pub(crate) fn whereabouts(&self, mark: &Mark, system: &System) -> Phrase {
        let body = mark.frame.body.0;
        if body == 0 {
            let mut joints = system.mechanism.joints.iter();
            let led = joints.any(|joint| {
                let is_led = ["x", "y"].contains(&joint.kind.keyword);
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
