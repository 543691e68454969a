//! Poses of the study's mechanisms, worked out by hand from lengths and angles.

use std::rc::Rc;

use super::sample::{Sample, Signals};

pub(super) fn resting(values: Vec<f64>) -> Signals {
    Rc::new(move |_| values.iter().map(|value| [*value, 0.0, 0.0]).collect())
}

/// A signal that passes `value` at t = 0 at the speed `rate`.
pub(super) fn passing(value: f64, rate: f64) -> Signals {
    Rc::new(move |t| vec![[value + rate * t, rate, 0.0]])
}

pub(super) fn instant(
    x: f64,
    parameters: &[f64],
    signals: Signals,
    pose: Vec<f64>,
    length: f64,
) -> Sample {
    Sample {
        x,
        parameters: parameters.to_vec(),
        times: vec![0.0],
        fine: 1,
        signals,
        estimate: pose.clone(),
        start: pose,
        length,
    }
}

/// The lengths of the four-bar linkage.
#[derive(Clone, Copy)]
pub(super) struct Links {
    pub(super) g: f64,
    pub(super) l1: f64,
    pub(super) l2: f64,
    pub(super) l3: f64,
}

pub(super) const LINKS: Links = Links {
    g: 1.0,
    l1: 0.4,
    l2: 1.2,
    l3: 0.8,
};

impl Links {
    pub(super) fn times(self, factor: f64) -> Links {
        Links {
            g: self.g * factor,
            l1: self.l1 * factor,
            l2: self.l2 * factor,
            l3: self.l3 * factor,
        }
    }

    /// The parameters at the place (x, y), with a crank that stands where the signal says.
    pub(super) fn parameters(self, place: f64) -> Vec<f64> {
        let Links { g, l1, l2, l3 } = self;
        vec![
            g, l1, l2, l3, place, place, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0,
        ]
    }

    /// The pose with the rocker ahead of the coupler, as it is drawn.
    pub(super) fn pose(self, angle: f64, place: f64) -> Vec<f64> {
        let (sin, cos) = angle.sin_cos();
        let (x, y) = (self.l1 * cos, self.l1 * sin);
        let (dx, dy) = (self.g - x, -y);
        let d = dx.hypot(dy);
        // The angle at D of the triangle B, C, D.
        let cosine = (self.l3 / d + (d - self.l2) / self.l3 * ((d + self.l2) / d)) / 2.0;
        let rocker = (-dy).atan2(-dx) - cosine.clamp(-1.0, 1.0).acos();
        let (cx, cy) = (self.g + self.l3 * rocker.cos(), self.l3 * rocker.sin());
        let coupler = (cy - y).atan2(cx - x);
        vec![
            place,
            place,
            angle,
            place + x,
            place + y,
            coupler,
            place + self.g,
            place,
            rocker,
        ]
    }

    pub(super) fn sample(self, x: f64, angle: f64, place: f64) -> Sample {
        let pose = self.pose(angle, place);
        instant(
            x,
            &self.parameters(place),
            passing(angle, 2.0),
            pose,
            self.g.max(self.l2),
        )
    }
}

/// The places of the constants of the four-bar linkage's law among its parameters.
pub(super) const SLOW: usize = 6;
pub(super) const RIPPLE: usize = 7;
pub(super) const FAST: usize = 8;
pub(super) const KICK: usize = 9;
pub(super) const GROWTH: usize = 10;
pub(super) const JUMP: usize = 11;
pub(super) const WIDTH: usize = 12;

/// The four-bar linkage moved by a law of time, from `first` on in `count` steps of `h`. `lead` is the law's value at `first`.
pub(super) fn moved(
    x: f64,
    law: &[(usize, f64)],
    first: f64,
    h: f64,
    count: u32,
    lead: f64,
) -> Sample {
    let mut parameters = LINKS.parameters(0.0);
    for (place, value) in law {
        parameters[*place] = *value;
    }
    let pose = LINKS.pose(0.7 + lead, 0.0);
    Sample {
        times: (0..=count)
            .map(|step| first + h * f64::from(step))
            .collect(),
        fine: 5,
        ..instant(x, &parameters, resting(vec![0.7]), pose, 1.2)
    }
}

pub(super) fn slider(x: f64, r: f64, l: f64, position: f64) -> Sample {
    // The angle at A of the triangle A, B, C; the sum of squares is taken apart so that it survives close to dead centre.
    let sine = (((r + l - position) * (r + l + position))
        * ((position - l + r) * (position + l - r)))
        .max(0.0)
        .sqrt()
        / (2.0 * position * r);
    let cosine = (r / position + (position - l) / r * ((position + l) / position)) / 2.0;
    let crank = sine.atan2(cosine);
    let (bx, by) = (r * crank.cos(), r * crank.sin());
    let rod = (-by).atan2(position - bx);
    let pose = vec![0.0, 0.0, crank, bx, by, rod, position, 0.0, 0.0];
    instant(x, &[r, l], passing(position, -0.1 * r), pose, r.max(l))
}

pub(super) fn exam_pose(crank: f64, rod: f64, wall: f64, phi1: f64, phi2: f64) -> Vec<f64> {
    let y = crank * phi1.sin() + rod * phi2.sin();
    vec![0.0, 0.0, phi1, wall, y, phi2]
}

/// The platform in its drawing, moved a little.
pub(super) fn platform(x: f64, size: f64, place: f64) -> Sample {
    let at = |x: f64, y: f64| [place + size * x, place + size * y];
    let pins = [
        (at(-0.8, -0.5), at(-0.05, -0.3)),
        (at(0.8, -0.5), at(0.28, 0.1)),
        (at(0.0, 0.9), at(-0.23, 0.2)),
    ];
    let mut pose = vec![place, place, 0.0];
    let mut legs = Vec::new();
    for (base, pin) in pins {
        let (dx, dy) = (pin[0] - base[0], pin[1] - base[1]);
        legs.push(dx.hypot(dy));
        let angle = dy.atan2(dx);
        pose.extend([base[0], base[1], angle, pin[0], pin[1], angle]);
    }
    let signals: Signals = Rc::new(move |t| {
        let shifted = |leg: f64, rate: f64| [leg + rate * size * t, rate * size, 0.0];
        vec![
            shifted(legs[0], 0.05),
            shifted(legs[1], -0.03),
            shifted(legs[2], 0.04),
        ]
    });
    Sample {
        times: vec![0.0, 0.1, 0.5],
        fine: 4,
        ..instant(x, &[size, place, place], signals, pose, size)
    }
}
