//! Position of each frame of a figure in a pose, in pixels.

use super::figure::{Frame, Winding};
use super::plane::{Place, Point, angle_of, difference, distance, scaled};
use super::pose::Scene;

/// Positions of all frames in one pose.
#[derive(Clone, Debug, Default)]
pub(super) struct Stance {
    /// The frames of the bodies, in pixels.
    pub places: Vec<Place>,
    /// Arrows of the loads, relative to the longest.
    pub arrows: Vec<Point>,
}

impl Stance {
    /// Position of a frame in this pose.
    pub fn place(&self, frame: Frame) -> Place {
        match frame {
            Frame::Body(body) => self.places[body],
            Frame::Riding(at, body)
            | Frame::Wound(
                at,
                Winding {
                    bodies: [body, _], ..
                },
            ) => Place {
                origin: self.places[at.body].globally(at.local),
                angle: self.places[body].angle,
            },
            Frame::Toward(from, to) | Frame::Between(from, to, _) => {
                let [from, to] = [from, to].map(|it| self.places[it.body].globally(it.local));
                Place {
                    origin: from,
                    angle: angle_of(difference(to, from)),
                }
            }
            Frame::Force(at, load) => Place {
                origin: self.places[at.body].globally(at.local),
                angle: angle_of(self.arrows[load]),
            },
            Frame::Torque(at, angle, _) => Place {
                origin: self.places[at.body].globally(at.local),
                angle: self.places[at.body].angle + angle,
            },
            Frame::Still => Place::default(),
        }
    }

    /// Factors by which a frame is stretched along its axes in this pose.
    pub fn stretch(&self, frame: Frame) -> [f64; 2] {
        match frame {
            Frame::Between(from, to, length) => {
                let [from, to] = [from, to].map(|it| self.places[it.body].globally(it.local));
                [distance(from, to) / length, 1.0]
            }
            Frame::Force(_, load) => {
                let [x, y] = self.arrows[load];
                [x.hypot(y); 2]
            }
            Frame::Torque(_, _, load) => {
                let [turning, _] = self.arrows[load];
                [turning.abs(), turning]
            }
            _ => [1.0; 2],
        }
    }

    /// Position of a point of a frame along its axes in this pose.
    pub fn deformed(&self, frame: Frame, point: Point) -> Point {
        if let Frame::Wound(_, winding) = frame {
            return self.wound(winding, point);
        }
        let stretch = self.stretch(frame);
        [stretch[0] * point[0], stretch[1] * point[1]]
    }

    /// Point of a spiral, turned with the outer body in proportion to its distance from the inner end.
    fn wound(&self, winding: Winding, point: Point) -> Point {
        let ([from, to], [inner, outer]) = (winding.bodies, winding.radii);
        let turned = self.places[to].angle - self.places[from].angle - winding.drawn;
        let part = (point[0].hypot(point[1]) - inner) / (outer - inner);
        let place = Place {
            angle: part * turned,
            ..Place::default()
        };
        place.globally(point)
    }
}

impl Scene {
    /// All positions, in pixels, in one of the poses of the picture.
    pub fn stance(&self, pose: usize, scale: f64) -> Stance {
        let places = self.motion[pose].iter().map(|place| Place {
            origin: scaled(place.origin, scale),
            angle: place.angle,
        });
        Stance {
            places: places.collect(),
            arrows: self.arrows[pose].clone(),
        }
    }
}
