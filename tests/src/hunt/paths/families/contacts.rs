//! Contacts that have many solutions, and cams from tables.

use std::f64::consts::TAU;

use super::super::course::Course;
use super::{below, junk, sign, size, with};
use crate::random::Random;

/// A slide with a wave that a tip rides on, driven at the tip: the tip finds the same height twice in every wave. The contact is looked
/// for in the drawing between these parts of the wave.
fn wave_between(random: &mut Random, parts: [f64; 2]) -> Course {
    let size = size(random);
    let length = size * random.between(0.3, 3.0);
    let crest = length * random.between(0.05, 0.6);
    let reach = crest * [0.3, 0.9, 0.98, 0.999][below(random, 4)];
    let speed = 10.0_f64.powf(random.between(-1.0, 1.0));
    let height = crest + size;
    let [from, to] = parts.map(|part| part * length);
    let text = format!(
        "mechanism wave {{
    point O = (0, 0), G = (0, {height:?}), E = ({size:?}, 0);
    body slide at O {{ O, E }}
    body tip at G {{ G }}
    translational (ground, slide) along O -> E;
    curve rim(s from {from:?} to {to:?}) on slide = (s, {height:?} + {crest:?}*sin(2*pi*s/{length:?}));
    translational (ground, tip) along O -> G;
    point_on_curve touch(tip.G, rim);
    drive length(O, G) = {height:?} + {reach:?}*sin({speed:?}*t);
}}
"
    );
    Course::drawn(text, length, TAU / speed)
}

/// The contact is looked for in almost a whole wave about the middle.
pub fn wave(random: &mut Random, _: u64) -> Course {
    wave_between(random, [-0.45, 0.42])
}

/// The contact leaves the range in which it is looked for after a part of a thousandth to a tenth of a wave.
pub fn wave_short(random: &mut Random, _: u64) -> Course {
    let parts = [-1.0, 1.0].map(|side| side * 10.0_f64.powf(random.between(-3.0, -1.0)));
    wave_between(random, parts)
}

pub fn wave_unused(random: &mut Random, number: u64) -> Course {
    let mut course = wave(random, number);
    course.text = with(&course.text, &junk(random, course.size));
    course
}

/// A disc cam whose radius is a table, with a knife or a roller that follows it on a line or on a rocker.
pub fn cam(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let points = 6 + below(random, 10);
    let waviness = random.between(0.02, 0.25);
    let first = size;
    let rows: Vec<String> = (0..=points)
        .map(|index| {
            let angle = TAU * index as f64 / points as f64;
            let radius = match index {
                0 => first,
                _ if index == points => first,
                _ => size * (1.0 + waviness * random.between(-1.0, 1.0)),
            };
            format!("({angle:?}, {radius:?})")
        })
        .collect();
    // The last place is a whole turn exactly.
    let mut rows = rows;
    rows[points] = format!("(2*pi, {first:?})");
    let rows = rows.join(", ");
    let speed = 10.0_f64.powf(random.between(-1.0, 1.0));
    let rate = speed * sign(random);
    let (follower, contact) = match below(random, 3) {
        0 => (
            format!(
                "    body follower at (0, {first:?}) {{ P: (0, 0) }}\n    translational (ground, follower) along O -> follower.P;\n"
            ),
            "    point_on_curve tip(follower.P, rim);\n".to_string(),
        ),
        1 => {
            let radius = size * random.between(0.02, 0.2);
            let top = first + radius;
            (
                format!(
                    "    body follower at (0, {top:?}) {{ P: (0, 0) }}\n    translational (ground, follower) along O -> follower.P;\n"
                ),
                format!("    roller tip(follower.P, rim) = {radius:?};\n"),
            )
        }
        _ => {
            let arm = 2.0 * size;
            (
                format!(
                    "    point H = ({:?}, {first:?});\n    body follower at (0, {first:?}) {{ P: (0, 0), H: ({:?}, 0) }}\n    revolute H(ground, follower);\n",
                    -arm, -arm
                ),
                "    point_on_curve tip(follower.P, rim);\n".to_string(),
            )
        }
    };
    let text = format!(
        "mechanism cam_of_table {{
    table radius = [{rows}] periodic;
    point O = (0, 0), U = (0, {first:?});
    body cam at O turned 90deg {{ O }}
    curve rim(a from -1.2 to 1.3) on cam = polar radius(a);
    revolute O(ground, cam);
{follower}{contact}    drive phi(cam) = pi/2 + {rate:?}*t;
}}
"
    );
    let period = TAU / speed / 4.0;
    Course {
        span: [0.0, 8.0 * period],
        is_drawn: false,
        ..Course::drawn(text, size, period)
    }
}
