//! Families of hard cases: compiled mechanisms with samples of growing difficulty.
//!
//! Poses are worked out by hand, from triangles ([`super::poses`]).

use std::f64::consts::TAU;

use super::compiled::{Compiled, EXAM, EXAM_BY_ROD, FOUR_BAR, PLATFORM, SLIDER};
use super::poses::{
    FAST, GROWTH, JUMP, KICK, LINKS, Links, RIPPLE, SLOW, WIDTH, exam_pose, instant, moved,
    passing, platform, slider,
};
use super::sample::Sample;

/// Samples of one kind.
pub struct Family {
    /// Difficulty.
    pub title: &'static str,
    /// Varied quantity.
    pub varies: &'static str,
    /// Compiled mechanism.
    pub compiled: Compiled,
    /// Samples, the easy ones first.
    pub samples: Vec<Sample>,
}

/// Powers of ten between two exponents.
fn powers(from: i32, to: i32) -> Vec<f64> {
    digits(from, to, &[1])
}

/// Powers of ten, and three times each power between.
fn finer(from: i32, to: i32) -> Vec<f64> {
    let leading: &[u32] = if from < to { &[1, 3] } else { &[3, 1] };
    let mut values = digits(from, to, leading);
    // Between the ends, not beyond.
    values.retain(|value| {
        let exponent = value.log10();
        exponent <= f64::from(from.max(to)) + 0.1
    });
    values
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
    // The exponential law is switched off by its rate too: zero times infinity would be NaN.
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
        1e-20, 1e-40, 1e-100, 1e-150, 1e-160, 1e-200, 1e-300, 1e-306, 1e-310, 1e-320,
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
    // Lengths at which fourth powers leave the normal numbers, in f32 and in f64.
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
