//! The families of hard cases: *a name* → *a compiled mechanism and samples of growing difficulty*.
//!
//! Poses are worked out here by hand, from triangles.

use std::f64::consts::TAU;
use std::rc::Rc;

use super::compiled::{Compiled, EXAM, EXAM_BY_ROD, FOUR_BAR, PLATFORM, SLIDER};
use super::sample::{Sample, Signals};

/// Samples of one kind.
pub struct Family {
    /// What is hard.
    pub title: &'static str,
    /// What varies.
    pub varies: &'static str,
    /// What is solved.
    pub compiled: Compiled,
    /// The samples, the easy ones first.
    pub samples: Vec<Sample>,
}

fn resting(values: Vec<f64>) -> Signals {
    Rc::new(move |_| values.iter().map(|value| [*value, 0.0, 0.0]).collect())
}

/// A signal that passes `value` at t = 0 at the speed `rate`.
fn passing(value: f64, rate: f64) -> Signals {
    Rc::new(move |t| vec![[value + rate * t, rate, 0.0]])
}

fn instant(x: f64, parameters: &[f64], signals: Signals, pose: Vec<f64>, length: f64) -> Sample {
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

/// The powers of ten from one to the other.
fn powers(from: i32, to: i32) -> Vec<f64> {
    digits(from, to, &[1])
}

/// The same with three times each power between.
fn finer(from: i32, to: i32) -> Vec<f64> {
    let leading: &[u32] = if from < to { &[1, 3] } else { &[3, 1] };
    let mut found = digits(from, to, leading);
    // Between the ends, not beyond.
    found.retain(|value| {
        let exponent = value.log10();
        exponent <= f64::from(from.max(to)) + 0.1
    });
    found
}

fn digits(from: i32, to: i32, leading: &[u32]) -> Vec<f64> {
    let exponents: Vec<i32> = if from <= to {
        (from..=to).collect()
    } else {
        (to..=from).rev().collect()
    };
    let texts = exponents.into_iter().flat_map(|exponent| {
        leading
            .iter()
            .map(move |digit| format!("{digit}e{exponent}"))
    });
    texts.map(|text| text.parse().expect("a number")).collect()
}

/// The lengths of the four-bar linkage.
#[derive(Clone, Copy)]
struct Links {
    g: f64,
    l1: f64,
    l2: f64,
    l3: f64,
}

const LINKS: Links = Links {
    g: 1.0,
    l1: 0.4,
    l2: 1.2,
    l3: 0.8,
};

impl Links {
    fn times(self, factor: f64) -> Links {
        Links {
            g: self.g * factor,
            l1: self.l1 * factor,
            l2: self.l2 * factor,
            l3: self.l3 * factor,
        }
    }

    /// The parameters at the place (x, y), with a crank that stands where the signal says.
    fn parameters(self, place: f64) -> Vec<f64> {
        let Links { g, l1, l2, l3 } = self;
        vec![
            g, l1, l2, l3, place, place, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0,
        ]
    }

    /// The pose with the rocker ahead of the coupler, as it is drawn.
    fn pose(self, angle: f64, place: f64) -> Vec<f64> {
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

    fn sample(self, x: f64, angle: f64, place: f64) -> Sample {
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
const SLOW: usize = 6;
const RIPPLE: usize = 7;
const FAST: usize = 8;
const KICK: usize = 9;
const GROWTH: usize = 10;
const JUMP: usize = 11;
const WIDTH: usize = 12;

/// The four-bar linkage moved by a law of time, from `first` on in `count` steps of `h`. `lead` is the law's value at `first`.
fn moved(x: f64, law: &[(usize, f64)], first: f64, h: f64, count: u32, lead: f64) -> Sample {
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

fn slider(x: f64, r: f64, l: f64, position: f64) -> Sample {
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

fn exam_pose(crank: f64, rod: f64, wall: f64, phi1: f64, phi2: f64) -> Vec<f64> {
    let y = crank * phi1.sin() + rod * phi2.sin();
    vec![0.0, 0.0, phi1, wall, y, phi2]
}

/// The platform in its drawing, moved a little.
fn platform(x: f64, size: f64, place: f64) -> Sample {
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

/// All families.
pub fn families() -> Vec<Family> {
    let mut families = Vec::new();
    let mut add = |title, varies, compiled, samples| {
        families.push(Family {
            title,
            varies,
            compiled,
            samples,
        });
    };
    let near: Vec<f64> = finer(-1, -14);
    let rod = 3.0_f64.sqrt();
    let exam = |delta: &f64| {
        // cos φ1 = √3 (1 - cos φ2).
        let phi1 = (2.0 * rod * (delta / 2.0).sin().powi(2)).acos();
        let pose = exam_pose(1.0, rod, rod, phi1, *delta);
        instant(*delta, &[1.0, rod, rod], passing(phi1, -1.0), pose, 2.0)
    };
    let by_rod = |delta: &f64| {
        let phi1 = (2.0 * rod * (delta / 2.0).sin().powi(2)).acos();
        let pose = exam_pose(1.0, rod, rod, phi1, *delta);
        instant(*delta, &[1.0, rod, rod], passing(*delta, -1.0), pose, 2.0)
    };
    add(
        "The exam towards its singular pose, crank driven",
        "φ2, rad",
        EXAM,
        near.iter().map(exam).collect(),
    );
    add(
        "The exam at the same poses, rod driven",
        "φ2, rad",
        EXAM_BY_ROD,
        near.iter().map(by_rod).collect(),
    );
    let parallel = Links {
        g: 1.0,
        l1: 0.5,
        l2: 1.0,
        l3: 0.5,
    };
    let change = near.iter().map(|delta| {
        let (sin, cos) = delta.sin_cos();
        let pose = vec![
            0.0,
            0.0,
            *delta,
            0.5 * cos,
            0.5 * sin,
            0.0,
            1.0,
            0.0,
            *delta,
        ];
        instant(
            *delta,
            &parallel.parameters(0.0),
            passing(*delta, 1.0),
            pose,
            1.0,
        )
    });
    add(
        "A parallelogram at its change point",
        "crank, rad",
        FOUR_BAR,
        change.collect(),
    );
    let dead = finer(-1, -16);
    let dead = dead
        .iter()
        .map(|gap| slider(*gap, 0.4, 1.2, 1.6 * (1.0 - gap)));
    add(
        "A slider-crank driven by its slider, at dead centre",
        "distance from dead centre, relative",
        SLIDER,
        dead.collect(),
    );
    let collinear = [
        1.0, 0.6, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12, 1e-16, 0.0,
    ]
    .map(|rest| {
        let mut sample = LINKS.sample(rest, 0.7, 0.0);
        for place in [5, 8] {
            sample.estimate[place] *= rest;
        }
        sample
    });
    add(
        "Assembly from estimates with coupler and rocker nearly in line",
        "their angles in the estimate, part of the true ones",
        FOUR_BAR,
        collinear.to_vec(),
    );
    let short = finer(0, -8);
    let short = short.iter().map(|ratio| {
        let links = Links {
            l1: 0.4 * ratio,
            ..LINKS
        };
        links.sample(*ratio, 0.7, 0.0)
    });
    add(
        "A crank that is short beside the other links",
        "its length, relative",
        FOUR_BAR,
        short.collect(),
    );
    let long = finer(0, 8);
    let long = long.iter().map(|ratio| {
        let links = Links {
            g: *ratio,
            l2: ratio + 0.2,
            l1: 0.4,
            l3: 0.8,
        };
        links.sample(*ratio, 0.7, 0.0)
    });
    add(
        "Ground link and coupler that are long beside crank and rocker",
        "their length, relative",
        FOUR_BAR,
        long.collect(),
    );
    let sizes = powers(-9, 9);
    add(
        "Sizes: four-bar linkage, set by parameters",
        "size, m",
        FOUR_BAR,
        sizes
            .iter()
            .map(|size| LINKS.times(*size).sample(*size, 0.7, 0.0))
            .collect(),
    );
    add(
        "Sizes: slider-crank, set by parameters",
        "size, m",
        SLIDER,
        sizes
            .iter()
            .map(|size| slider(*size, 0.4 * size, 1.2 * size, 1.3 * size))
            .collect(),
    );
    add(
        "Sizes: platform, set by parameters",
        "size, m",
        PLATFORM,
        sizes
            .iter()
            .map(|size| platform(*size, *size, 0.0))
            .collect(),
    );
    let places = finer(0, 9);
    add(
        "Places: four-bar linkage far from the origin",
        "distance, m",
        FOUR_BAR,
        places
            .iter()
            .map(|place| LINKS.sample(*place, 0.7, *place))
            .collect(),
    );
    add(
        "Places: platform far from the origin",
        "distance, m",
        PLATFORM,
        places
            .iter()
            .map(|place| platform(*place, 1.0, *place))
            .collect(),
    );
    let mut steps = finer(-6, -1);
    steps.extend([0.5, 1.0, 1.5, 2.0, 2.5, 3.0]);
    let swing = |step: &f64| moved(*step, &[(RIPPLE, 0.5), (FAST, *step)], 0.0, 1.0, 5, 0.0);
    add(
        "Driver frequency times step, 5 steps",
        "rad",
        FOUR_BAR,
        steps.iter().map(swing).collect(),
    );
    let late = finer(0, 9);
    // The exponential law is switched off by its rate too: nothing times infinity is no number.
    let turning = |t: &f64| moved(*t, &[(SLOW, 3.0), (GROWTH, 0.0)], *t, 0.01, 4, 3.0 * t);
    add(
        "Late times, crank at 3 rad/s, 4 steps of 0.01 s",
        "t, s",
        FOUR_BAR,
        late.iter().map(turning).collect(),
    );
    let ripple = finer(-7, -2);
    let ripple = ripple.iter().map(|h| {
        moved(
            *h,
            &[(SLOW, 0.5), (RIPPLE, 1e-3), (FAST, 1e5)],
            0.0,
            *h,
            20,
            0.0,
        )
    });
    add(
        "A ripple of 1e-3 rad at 1e5 rad/s on a slow turn, 20 steps",
        "step, s",
        FOUR_BAR,
        ripple.collect(),
    );
    let growing = [1.0, 3.0, 10.0, 30.0, 100.0, 700.0, 1e3, 1e4, 1e5, 1e6].map(|rate: f64| {
        moved(
            rate,
            &[(KICK, 1e-3), (GROWTH, rate)],
            0.0,
            0.5 / rate,
            16,
            1e-3,
        )
    });
    add(
        "An exponential law, 16 steps of half its time constant",
        "rate, 1/s",
        FOUR_BAR,
        growing.to_vec(),
    );
    let jumping = finer(-1, -12);
    let jumping = jumping
        .iter()
        .map(|width| moved(*width, &[(JUMP, 0.5), (WIDTH, *width)], -1e-3, 1e-3, 4, 0.0));
    add(
        "A jump of 0.5 rad, passed in steps of 1e-3 s",
        "its duration, s",
        FOUR_BAR,
        jumping.collect(),
    );
    let wound = finer(0, 6);
    let wound = wound.iter().map(|turns| {
        let angle = 0.7 + TAU * turns;
        let mut sample = LINKS.sample(*turns, 0.7, 0.0);
        sample.signals = passing(angle, 2.0);
        sample.estimate[2] = angle;
        sample.start[2] = angle;
        sample.times = (0..=4).map(|step| 0.05 * f64::from(step)).collect();
        sample.fine = 2;
        sample
    });
    add(
        "A crank wound up, 4 steps of 0.1 rad",
        "turns",
        FOUR_BAR,
        wound.collect(),
    );
    let tiny = [
        1e-20, 1e-40, 1e-100, 1e-150, 1e-160, 1e-200, 1e-300, 1e-308, 1e-310, 1e-320,
    ];
    let tiny = tiny.map(|size| LINKS.times(size).sample(size, 0.7, 0.0));
    add(
        "Sizes down to denormal numbers, set by parameters",
        "size, m",
        FOUR_BAR,
        tiny.to_vec(),
    );
    let huge = [1e20, 1e38, 1e100, 1e150, 1e155, 1e200, 1e300, 1e308];
    let huge = huge.map(|size| LINKS.times(size).sample(size, 0.7, 0.0));
    add(
        "Sizes up to the largest number, set by parameters",
        "size, m",
        FOUR_BAR,
        huge.to_vec(),
    );
    // Where the fourth powers of lengths are no normal numbers any more, in f32 and in f64.
    let mut edges: Vec<f64> = finer(-8, -12);
    edges.extend(finer(-75, -82));
    edges.extend(finer(8, 11));
    edges.extend(finer(75, 78));
    add(
        "Sizes whose fourth powers leave the range of a scalar, set by parameters",
        "size, m",
        FOUR_BAR,
        edges
            .iter()
            .map(|size| LINKS.times(*size).sample(*size, 0.7, 0.0))
            .collect(),
    );
    let vanishing = [
        1e-10, 1e-15, 1e-20, 1e-40, 1e-160, 1e-200, 1e-300, 1e-310, 1e-320, 0.0,
    ];
    let vanishing = vanishing.map(|length| {
        let links = Links {
            l1: length,
            ..LINKS
        };
        links.sample(length, 0.7, 0.0)
    });
    add(
        "A crank down to no length, denormal numbers among it",
        "its length, m",
        FOUR_BAR,
        vanishing.to_vec(),
    );
    let zero = [
        [1.0, 0.0, 1.2, 0.8],
        [1.0, 0.4, 0.0, 0.8],
        [1.0, 0.4, 1.2, 0.0],
        [0.0, 0.4, 1.2, 0.8],
        [0.0; 4],
    ];
    let zero = zero
        .into_iter()
        .enumerate()
        .map(|(index, [g, l1, l2, l3])| {
            let mut sample = LINKS.sample(index as f64, 0.7, 0.0);
            sample.parameters[..4].copy_from_slice(&[g, l1, l2, l3]);
            let pose = Links { g, l1, l2, l3 }.pose(0.7, 0.0);
            if l2 > 0.0 && l3 > 0.0 && pose.iter().all(|value| value.is_finite()) {
                sample.start = pose;
            }
            sample
        });
    add(
        "A link of no length, its pins duplicated",
        "crank, coupler, rocker, ground, all",
        FOUR_BAR,
        zero.collect(),
    );
    families
}
