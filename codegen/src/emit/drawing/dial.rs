//! Dials: angles without a body, each as a pointer on a circle of its own.
//!
//! They stand in a row, below the bodies if there are any; zero is to the right, as it is for bodies.

use super::draft::{Draft, PIN};
use super::figure::{Frame, Layer, Look, Outline};
use super::plane::{Bounds, Place, Point};
use super::pose::{At, Carried};

/// Radius of a dial, and gap between two of them, relative to the space of each.
const RADIUS: f64 = 0.34;

/// Space of a dial relative to the size of the rest.
const SHARE: f64 = 0.3;

/// Puts the angles of these numbers beside one another in all poses; `size` is the characteristic length.
pub(super) fn arrange(
    angles: &[usize],
    bodies: &mut [Carried],
    motion: &mut [Vec<Place>],
    size: f64,
) {
    let others = bodies
        .iter()
        .enumerate()
        .filter(|(at, _)| !angles.contains(at));
    let drawn: Vec<Point> = others
        .flat_map(|(_, body)| body.points.iter().map(|it| body.place.globally(*it)))
        .collect();
    let bounds = Bounds::of(drawn.iter().copied());
    let (room, left, height) = match drawn.is_empty() {
        true => (size, 0.0, 0.0),
        false => {
            let extent = bounds.size()[0].max(bounds.size()[1]).max(size);
            let room = SHARE * extent;
            let row = room * angles.len() as f64;
            (room, bounds.center()[0] - 0.5 * row, bounds.low[1] - room)
        }
    };
    for (number, &angle) in angles.iter().enumerate() {
        let origin = [left + room * (number as f64 + 0.5), height];
        bodies[angle].place.origin = origin;
        bodies[angle].points = vec![[0.0; 2], [RADIUS * room, 0.0]];
        bodies[angle].is_dial = true;
        for places in motion.iter_mut() {
            places[angle].origin = origin;
        }
    }
}

impl Draft<'_> {
    /// Position of the dial of an angle, in pixels of the ground.
    pub(super) fn dial(&self, body: usize) -> At {
        At {
            body: 0,
            local: self.figure.stance.places[body].origin,
        }
    }

    /// The circles about the pointers, with a tick at zero.
    pub(super) fn dials(&mut self) {
        let scale = self.figure.scale;
        for (body, own) in self.scene.bodies.iter().enumerate() {
            let [_, tip] = own.points[..] else { continue };
            if !own.is_dial {
                continue;
            }
            let radius = tip[0] * scale;
            let tick = Outline::line([0.9 * radius, 0.0], [1.1 * radius, 0.0]);
            let pin = Outline::Circle([0.0; 2], PIN * self.unit);
            let fixed = Frame::Riding(self.dial(body), 0);
            if let Some(group) = self.body(body) {
                group.title = format!("angle {}", own.name);
                let ring = Outline::Circle([0.0; 2], radius);
                group.add(Layer::Below, fixed, Look::Thought, ring);
                group.add(Layer::Below, fixed, Look::Edge, tick);
                group.add(Layer::Above, fixed, Look::Part, pin);
            }
        }
    }
}
