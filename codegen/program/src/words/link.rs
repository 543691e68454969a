//! Finds links by name: the pins at their ends.

use super::known::Known;
use super::pins::Pin;
use crate::joint::geometry::{BodyFrame, BodyId, Mark, Vector};
use crate::pool::Pool;
use crate::system::System;

/// Link between two pins that rotates with one angle.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    /// Known pin at the start of its vector.
    pub from: Pin,
    /// Mark of the known body at this pin.
    pub held: Mark,
    /// Pin at the end of its vector.
    pub to: Pin,
    /// True if the vector of the plan has this direction, and not the opposite one.
    pub forward: bool,
}

/// Two known pins and the pin between them.
#[derive(Clone, Debug)]
pub(crate) struct Triangle {
    /// Known pins at the start of the first link and at the end of the second, each with the mark of the known body.
    pub outer: [(Pin, Mark); 2],
    /// Pin between the links.
    pub apex: Pin,
    /// True if the first vector leads from the first outer pin to the apex, and not in the opposite direction.
    pub forward: bool,
}

impl Known {
    /// Returns the link from a known pin with vector `local` in its body, in either direction. `to` accepts the body at its end.
    pub(crate) fn link(
        &self,
        angle: usize,
        local: Vector,
        to: impl Fn(&System, BodyId) -> bool,
        pool: &mut Pool,
        system: &System,
    ) -> Option<Link> {
        let turning = self.pins_turning(angle, system);
        for (from, here, held) in &turning {
            if !self.is_known(held.frame.body, system) {
                continue;
            }
            for (end, at, beyond) in &turning {
                if end.name == from.name || !to(system, beyond.frame.body) {
                    continue;
                }
                if let Some(forward) = spans(*here, *at, angle, local, pool, system) {
                    return Some(Link {
                        from: from.clone(),
                        held: *held,
                        to: end.clone(),
                        forward,
                    });
                }
            }
        }
        None
    }

    /// Returns the pins of the triangle of two links and the known vector between their outer ends.
    pub(crate) fn triangle(
        &self,
        angles: [usize; 2],
        links: [Vector; 2],
        pool: &mut Pool,
        system: &System,
    ) -> Option<Triangle> {
        let turns = |angle: usize| {
            move |system: &System, body: BodyId| system.vector_form.turns(body, angle)
        };
        let first = self.link(angles[0], links[0], turns(angles[1]), pool, system)?;
        let second = self.link(angles[1], links[1], turns(angles[0]), pool, system)?;
        // The second vector leads from the apex to its known pin if the first leads to the apex.
        let closes = first.to.name == second.to.name && first.forward != second.forward;
        closes.then_some(Triangle {
            outer: [(first.from, first.held), (second.from, second.held)],
            apex: first.to,
            forward: first.forward,
        })
    }
}

/// Returns `true` if a vector in the orientation of `angle` leads from one mark to another, `false` if it leads back, otherwise
/// `None`. Marks on one body are compared exactly. Between bodies that slide along one another, the vector must contain a
/// displacement.
fn spans(
    from: Mark,
    to: Mark,
    angle: usize,
    local: Vector,
    pool: &mut Pool,
    system: &System,
) -> Option<bool> {
    let (_, offset) = system.vector_form.orientations.leader(from.frame.body);
    let graph = &mut pool.graph;
    if from.frame.body == to.frame.body {
        let difference = [0, 1].map(|axis| graph.subtract(to.local[axis], from.local[axis]));
        let frame = BodyFrame {
            angle: offset,
            ..from.frame
        };
        let difference = frame.rotate(difference, graph);
        let backward = local.map(|part| graph.negate(part));
        return if difference == local {
            Some(true)
        } else if difference == backward {
            Some(false)
        } else {
            None
        };
    }
    if local.iter().all(|&part| graph.is_fixed(part)) {
        return None;
    }
    let link = system.drawn_turn(angle, local, pool);
    let [from, to] = [from, to].map(|mark| system.drawn_position(mark, pool));
    let along = link[0] * (to[0] - from[0]) + link[1] * (to[1] - from[1]);
    Some(along > 0.0)
}
