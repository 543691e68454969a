//! Drivers that go beyond an interval in which nothing can be assembled, and on to where it can be again.

use std::f64::consts::TAU;

use super::super::course::Course;
use super::{below, sign, size};
use crate::random::Random;

/// A swing about a value, or a ramp, and its period.
fn swinging(random: &mut Random, start: f64, reach: f64, may_turn: bool) -> (String, f64) {
    let speed = 10.0_f64.powf(random.between(-1.0, 1.0));
    let period = TAU / speed;
    let rate = speed * sign(random);
    let text = match below(random, 3) {
        0 if may_turn => format!("{start:?} + {rate:?}*t"),
        1 => format!("{start:?} + {reach:?}*(1 - cos({rate:?}*t))"),
        _ => format!("{start:?} + {reach:?}*sin({rate:?}*t)"),
    };
    (text, period)
}

/// A crank-rocker or double rocker, driven at its rocker.
pub fn four_bar(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let start = random.between(0.7, 1.9);
    let [c, d] = [0; 2].map(|_| size * random.between(0.5, 1.2));
    let joint = [d + c * start.cos(), c * start.sin()];
    let a = size * random.between(0.25, 1.0);
    let angle = random.between(-2.5, 2.5);
    let pin = [a * angle.cos(), a * angle.sin()];
    let b = (joint[0] - pin[0]).hypot(joint[1] - pin[1]);
    let coupler = (joint[1] - pin[1]).atan2(joint[0] - pin[0]);
    let reach = random.between(0.2, 2.0);
    let (law, period) = swinging(random, start, reach, true);
    let text = format!(
        "mechanism rocker {{
    point A = (0, 0), D = ({d:?}, 0);
    body crank at A turned {angle:?} {{ A, B: ({a:?}, 0) }}
    body coupler at ({:?}, {:?}, {coupler:?}) {{ B: (0, 0), C: ({b:?}, 0) }}
    body rocker at D turned {start:?} {{ D, C: ({c:?}, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(rocker) = {law};
}}
",
        pin[0], pin[1]
    );
    Course::drawn(text, size, period)
}

/// A slider-crank driven at its slider, beyond both dead centers.
pub fn slider_crank(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let crank = size * random.between(0.2, 0.8);
    let longest = size * random.between(0.9, 2.0);
    let offset = size * random.between(-0.3, 0.3);
    let angle = random.between(0.4, 2.7) * sign(random);
    let pin = [crank * angle.cos(), crank * angle.sin()];
    let rise = offset - pin[1];
    // The drawing has to fit.
    let rod = longest.max(1.05 * rise.abs());
    let x = pin[0] + (rod * rod - rise * rise).sqrt();
    let turned = rise.atan2(x - pin[0]);
    let reach = crank * random.between(0.2, 3.0);
    let (law, period) = swinging(random, x, reach, false);
    let text = format!(
        "mechanism slider {{
    point A = (0, 0);
    body crank at A turned {angle:?} {{ A, B: ({crank:?}, 0) }}
    body rod at ({:?}, {:?}, {turned:?}) {{ B: (0, 0), C: ({rod:?}, 0) }}
    revolute A(ground, crank);
    revolute B(crank, rod);
    absolute_y(rod.C) = {offset:?};
    drive x(rod.C) = {law};
}}
",
        pin[0], pin[1]
    );
    Course::drawn(text, size, period)
}

/// A platform on three legs that go farther than it can follow.
pub fn platform(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let mut point = |scale: f64| [0, 1].map(|_| scale * size * random.between(-1.0, 1.0));
    let bases = [point(2.0), point(2.0), point(2.0)];
    let pins = [point(0.7), point(0.7), point(0.7)];
    let mut period = f64::INFINITY;
    let mut drives = String::new();
    for (index, (base, pin)) in bases.iter().zip(&pins).enumerate() {
        let length = (base[0] - pin[0]).hypot(base[1] - pin[1]);
        let reach = length.min(size) * random.between(0.05, 0.9);
        let (law, own) = swinging(random, length, reach, false);
        period = period.min(own);
        drives += &format!("    drive distance(ground.B{index}, plate.P{index}) = {law};\n");
    }
    let text = format!(
        "mechanism platform {{
    point B0 = ({:?}, {:?}), B1 = ({:?}, {:?}), B2 = ({:?}, {:?});
    body plate at (0, 0) {{ P0: ({:?}, {:?}), P1: ({:?}, {:?}), P2: ({:?}, {:?}) }}
{drives}}}
",
        bases[0][0],
        bases[0][1],
        bases[1][0],
        bases[1][1],
        bases[2][0],
        bases[2][1],
        pins[0][0],
        pins[0][1],
        pins[1][0],
        pins[1][1],
        pins[2][0],
        pins[2][1],
    );
    Course::drawn(text, size, period)
}
