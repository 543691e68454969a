//! Builds a mechanism from random numbers by adding groups, each with as many equations as coordinates.

use super::joint::Joint;
use super::law::Law;
use super::mechanism::{GROUND, Mechanism, Point, Pose, difference, length};
use super::motion::Motions;
use super::periodic::Periodic;
use crate::random::Random;

/// Mechanism that grows.
pub struct Builder {
    random: Random,
    /// Mechanism so far.
    pub mechanism: Mechanism,
    /// Center of its growth (m).
    centre: [f64; 2],
    /// Range of drivers, in sizes.
    range: f64,
    /// Largest distance of a body's frame from its points, in sizes.
    frames: f64,
    group: usize,
    /// Number of periodic tables.
    tables: usize,
}

impl Builder {
    /// The ground alone.
    pub fn new(mut random: Random) -> Builder {
        let dice = random.between(0.0, 1.0);
        let size = match dice {
            d if d < 0.04 => 1e-6,
            d if d < 0.08 => 1e6,
            _ => 10.0_f64.powf(random.between(-3.0, 1.0)),
        };
        let mut builder = Builder {
            random,
            mechanism: Mechanism {
                size,
                bodies: vec![[0.0; 3]],
                drawn_off: vec![[0.0; 3]],
                points: Vec::new(),
                joints: Vec::new(),
                groups: Vec::new(),
                body_order: Vec::new(),
                joint_order: Vec::new(),
                motions: None,
            },
            centre: [0.0; 2],
            range: 0.0,
            frames: 1.0,
            group: 0,
            tables: 0,
        };
        let away = match builder.between(0.0, 1.0) {
            d if d < 0.06 => 1e5,
            d if d < 0.5 => 0.0,
            _ => 3.0,
        };
        builder.centre = [0, 1].map(|_| away * size * builder.between(-1.0, 1.0));
        builder.range = match builder.between(0.0, 1.0) {
            d if d < 0.3 => builder.between(0.3, 1.5),
            _ => builder.between(0.02, 0.3),
        };
        if builder.chance(0.03) {
            builder.frames = 1e5;
        }
        builder
    }

    /// Random number from `low` to below `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.random.between(low, high)
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    /// Random whole number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.random.bits() % count as u64) as usize
    }

    /// Either pair, at random.
    pub fn either<T>(&mut self, first: T, second: T) -> [T; 2] {
        if self.chance(0.5) {
            [first, second]
        } else {
            [second, first]
        }
    }

    /// Size (m).
    pub fn size(&self) -> f64 {
        self.mechanism.size
    }

    /// Begins a group.
    pub fn begin(&mut self, name: &'static str) {
        self.group = self.mechanism.groups.len();
        self.mechanism.groups.push(name);
    }

    /// Random position.
    pub fn place(&mut self) -> [f64; 2] {
        let size = self.size();
        [0, 1].map(|axis| self.centre[axis] + size * self.between(-1.0, 1.0))
    }

    /// Random position, at least a seventh of the size from these positions (at times only a millionth).
    pub fn place_off(&mut self, others: &[[f64; 2]]) -> [f64; 2] {
        let clearance = if self.chance(0.01) { 1e-6 } else { 0.15 };
        for _ in 0..64 {
            let place = self.place();
            let far = others
                .iter()
                .all(|other| length(difference(place, *other)) > clearance * self.size());
            if far {
                return place;
            }
        }
        self.place()
    }

    /// A new body in a random pose.
    pub fn body(&mut self) -> usize {
        let near = self.place();
        let frames = self.frames * self.size();
        let at: Pose = [
            near[0] + frames * self.between(-1.0, 1.0),
            near[1] + frames * self.between(-1.0, 1.0),
            self.between(-3.2, 3.2),
        ];
        self.mechanism.bodies.push(at);
        self.mechanism.drawn_off.push([0.0; 3]);
        let body = self.mechanism.bodies.len() - 1;
        if self.chance(0.03) {
            let turns = [1.0, -1.0, 20.0][self.below(3)];
            self.mechanism.bodies[body][2] += turns * std::f64::consts::TAU;
        }
        body
    }

    /// Existing body: the ground, or one of those before `before`.
    pub fn earlier(&mut self, before: usize) -> usize {
        if before <= 1 || self.chance(0.35) {
            GROUND
        } else {
            1 + self.below(before - 1)
        }
    }

    /// A point of a body.
    pub fn point(&mut self, body: usize, place: [f64; 2]) -> usize {
        self.mechanism.points.push(Point { body, place });
        self.mechanism.points.len() - 1
    }

    /// A joint of the group.
    pub fn join(&mut self, joint: Joint) {
        let group = self.group;
        self.mechanism.joints.push((joint, group));
    }

    /// A pin between two bodies.
    pub fn pin(&mut self, i: usize, j: usize, place: [f64; 2]) {
        let [i, j] = self.either(i, j);
        let (p, q) = (self.point(i, place), self.point(j, place));
        self.join(Joint::Revolute(p, q));
    }

    /// A slide between two bodies; its two points, the first on the body that holds the line.
    pub fn slide(&mut self, i: usize, j: usize) -> [usize; 2] {
        let [i, j] = self.either(i, j);
        let from = self.place();
        let to = self.place_off(&[from]);
        let (p, q) = (self.point(i, from), self.point(j, to));
        self.join(Joint::Translational(p, q));
        [p, q]
    }

    fn law(&mut self, range: f64) -> Law {
        let amplitude = range * self.between(0.3, 1.0) * if self.chance(0.5) { 1.0 } else { -1.0 };
        match self.below(5) {
            0 => Law::Ramp {
                rate: amplitude / 1.5,
            },
            1 => Law::Harmonic {
                amplitude,
                frequency: if self.chance(0.1) {
                    20.0
                } else {
                    self.between(0.5, 4.0)
                },
            },
            2 => Law::Step {
                from: self.between(0.2, 1.0),
                to: self.between(1.2, 2.8),
                height: amplitude,
            },
            3 => Law::Decay { height: amplitude },
            _ => Law::Repeated(self.periodic(amplitude)),
        }
    }

    /// Periodic table with heights up to `height` and any start; half of them have their boundaries at exact binary
    /// numbers, among them the instants of the hunt.
    pub fn periodic(&mut self, height: f64) -> Periodic {
        let number = self.tables;
        self.tables += 1;
        let (first, period) = match self.chance(0.5) {
            true => (
                0.125 * (self.below(33) as f64 - 16.0),
                0.25 * (2 + self.below(5)) as f64,
            ),
            false => (self.between(-2.0, 2.0), self.between(0.5, 2.0)),
        };
        Periodic {
            number,
            first,
            period,
            heights: [0; 4].map(|_| 0.5 * height * self.between(-1.0, 1.0)),
        }
    }

    /// Writes the drivers in motions.
    fn in_motions(&mut self) {
        self.mechanism.motions = Some(Motions {
            before: self.below(2),
            after: self.below(2),
            are_alike: self.chance(0.6),
        });
    }

    /// Law of a driven length.
    pub fn length_law(&mut self) -> Law {
        let range = self.range * self.size();
        self.law(range)
    }

    /// Law of a driven angle.
    pub fn angle_law(&mut self) -> Law {
        if self.chance(0.15) {
            // Whole turns.
            return Law::Ramp {
                rate: self.between(1.0, 5.0),
            };
        }
        let range = 2.0 * self.range;
        self.law(range)
    }

    /// The mechanism, its statements in random order, and drawn a little elsewhere where that does no harm.
    pub fn finish(mut self) -> Mechanism {
        let mut bodies: Vec<usize> = (1..self.mechanism.bodies.len()).collect();
        self.shuffle(&mut bodies);
        let mut joints: Vec<usize> = (0..self.mechanism.joints.len()).collect();
        self.shuffle(&mut joints);
        // A driver of a length stands below the joint along which it is measured.
        let is_length =
            |joint: &usize| matches!(self.mechanism.joints[*joint].0, Joint::DriveLength(..));
        let (lengths, mut order): (Vec<usize>, Vec<usize>) =
            joints.into_iter().partition(is_length);
        order.extend(lengths);
        self.mechanism.body_order = bodies;
        self.mechanism.joint_order = order;
        if self.chance(0.2) {
            self.in_motions();
        }
        if self.chance(0.4) {
            let mut exact = vec![false; self.mechanism.bodies.len()];
            for (joint, _) in &self.mechanism.joints {
                for body in joint.drawn(&self.mechanism) {
                    exact[body] = true;
                }
            }
            let size = self.size();
            for (body, exact) in exact.iter().enumerate().skip(1) {
                if !exact {
                    let off = [size, size, 1.0].map(|scale| 0.03 * scale);
                    self.mechanism.drawn_off[body] = off.map(|it| it * self.between(-1.0, 1.0));
                }
            }
        }
        self.mechanism
    }

    fn shuffle(&mut self, items: &mut [usize]) {
        for last in (1..items.len()).rev() {
            let other = self.below(last + 1);
            items.swap(last, other);
        }
    }
}
