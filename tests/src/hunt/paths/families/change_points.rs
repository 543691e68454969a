//! Linkages whose links become collinear, so that two branches meet: the smooth path passes straight through.

use std::f64::consts::{PI, TAU};

use super::super::course::Course;
use super::{below, sign, size, turning};
use crate::random::Random;

/// Relative difference of links below which neither the tracker nor f64 can tell whether branches meet.
const BLURRED: f64 = 5e-11;

fn course(text: String, size: f64, period: f64, is_blurred: bool) -> Course {
    Course {
        span: [0.0, 2.5 * period],
        is_blurred,
        ..Course::drawn(text, size, period)
    }
}

/// Four-bar with these links (crank, coupler, rocker, ground), with an estimated angle of its crank, in an
/// orientation.
pub(super) fn four_bar(links: [f64; 4], crank: f64, turned: f64, elbow: f64, law: &str) -> String {
    let [a, b, c, d] = links;
    // B and D are known; C is where two circles meet.
    let place = |length: f64, angle: f64| [length * angle.cos(), length * angle.sin()];
    let (pin, ground) = (place(a, crank + turned), place(d, turned));
    let between = [ground[0] - pin[0], ground[1] - pin[1]];
    let distance = between[0].hypot(between[1]);
    let cosine = ((b * b + distance * distance - c * c) / (2.0 * b * distance)).clamp(-1.0, 1.0);
    let coupler = between[1].atan2(between[0]) + elbow * cosine.acos();
    let joint = [pin[0] + b * coupler.cos(), pin[1] + b * coupler.sin()];
    let rocker = (joint[1] - ground[1]).atan2(joint[0] - ground[0]);
    let angle = crank + turned;
    format!(
        "mechanism four_links {{
    point A = (0, 0), D = ({:?}, {:?});
    body crank at (0, 0, {angle:?}) {{ A: (0, 0), B: ({a:?}, 0) }}
    body coupler at ({:?}, {:?}, {coupler:?}) {{ B: (0, 0), C: ({b:?}, 0) }}
    body rocker at ({:?}, {:?}, {rocker:?}) {{ D: (0, 0), C: ({c:?}, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi({}) = {law};
}}
",
        ground[0], ground[1], pin[0], pin[1], ground[0], ground[1], "crank"
    )
}

fn parallel(random: &mut Random, change: f64) -> Course {
    let size = size(random);
    let a = size * random.between(0.4, 1.0);
    // Half of them have the longer links in the crank.
    let d = match below(random, 5) {
        0 => a,
        _ => size * random.between(0.4, 2.5),
    };
    let crank = sign(random) * random.between(0.4, 2.7);
    let turned = match below(random, 2) {
        0 => 0.0,
        _ => random.between(-PI, PI),
    };
    let swing = random.between(0.5, 4.0);
    let (law, period) = turning(random, crank + turned, swing);
    let mut links = [a, d, a, d];
    links[below(random, 4)] *= 1.0 + change;
    // Either elbow: parallel links, or crossed ones.
    let elbow = sign(random);
    let text = four_bar(links, crank, turned, elbow, &law);
    course(text, size, period, change != 0.0 && change.abs() < BLURRED)
}

pub fn parallelogram(random: &mut Random, _: u64) -> Course {
    parallel(random, 0.0)
}

/// Four-bar at a change point with one link that is longer or shorter, by 1e-3 to 1e-15 of its length.
pub fn nearly(random: &mut Random, number: u64) -> Course {
    let power = 3 + (number % 13) as i32;
    let change = sign(random) * 10.0_f64.powi(-power);
    parallel(random, change)
}

/// Two pairs of equal links side by side.
pub fn kite(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let short = size * random.between(0.3, 1.0);
    let long = short * random.between(1.05, 3.0);
    let links = match below(random, 2) {
        // The crank equals the ground in length.
        0 => match below(random, 2) {
            0 => [short, long, long, short],
            _ => [long, short, short, long],
        },
        // The crank equals the coupler in length.
        _ => match below(random, 2) {
            0 => [short, short, long, long],
            _ => [long, long, short, short],
        },
    };
    let crank = sign(random) * random.between(0.5, 1.5);
    let (law, period) = turning(random, crank, 1.5);
    let elbow = sign(random);
    course(
        four_bar(links, crank, 0.0, elbow, &law),
        size,
        period,
        false,
    )
}

/// Two rolling wheels with a coupling rod.
pub fn locomotive(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let pin = size * random.between(0.2, 0.9);
    let base = size * random.between(1.2, 4.0);
    let start = sign(random) * random.between(0.3, 2.8);
    let speed = 10.0_f64.powf(random.between(-1.0, 1.0)) * sign(random);
    let (x, y) = (pin * start.cos(), size + pin * start.sin());
    let law = match below(random, 3) {
        0 => format!("{:?}*sin({:?}*t)", 2.5 * size, speed),
        _ => format!("{:?}*t", speed * size),
    };
    let text = format!(
        "mechanism wheels {{
    point G0 = ({:?}, 0), G1 = ({:?}, 0);
    body frame at (0, {size:?}) {{ C: (0, 0), D: ({base:?}, 0) }}
    body front at (0, {size:?}) turned {start:?} {{ C: (0, 0), P: ({pin:?}, 0) }}
    body rear at ({base:?}, {size:?}) turned {start:?} {{ D: (0, 0), Q: ({pin:?}, 0) }}
    body rod at ({x:?}, {y:?}) {{ P: (0, 0), Q: ({base:?}, 0) }}
    absolute_angle(frame) = 0;
    absolute_y(frame) = {size:?};
    revolute C(frame, front);
    revolute D(frame, rear);
    rack (front.C, ground) along G0 -> G1 = {size:?};
    revolute P(front, rod);
    revolute Q(rear, rod);
    drive x(frame) = {law};
}}
",
        -5.0 * size,
        5.0 * size
    );
    course(text, size, TAU / speed.abs(), false)
}

/// Three cranks at one coupler, of which one is redundant.
pub fn three_cranks(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let crank = size * random.between(0.2, 0.8);
    // Distances with exact sums.
    let base = (size * random.between(0.5, 1.5) * 1e6).round() / 1e6;
    let start = sign(random) * random.between(0.4, 2.7);
    let swing = random.between(0.2, 2.5);
    let (law, period) = turning(random, start, swing);
    let (x, y) = (crank * start.cos(), crank * start.sin());
    let twice = 2.0 * base;
    let text = format!(
        "mechanism three_cranks {{
    point A = (0, 0), B = ({base:?}, 0), C = ({twice:?}, 0);
    body 1 at A turned {start:?} {{ A, K: ({crank:?}, 0) }}
    body 2 at B turned {start:?} {{ B, L: ({crank:?}, 0) }}
    body 3 at C turned {start:?} {{ C, M: ({crank:?}, 0) }}
    body 4 at ({x:?}, {y:?}) {{ K: (0, 0), L: ({base:?}, 0), M: ({twice:?}, 0) }}
    revolute A(ground, 1);
    revolute B(ground, 2);
    revolute C(ground, 3);
    revolute K(1, 4);
    revolute L(2, 4);
    redundant revolute M(3, 4);
    drive phi(1) = {law};
}}
"
    );
    course(text, size, period, false)
}
