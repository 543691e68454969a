//! Drivers whose laws refer to the positions that they drive.

use std::f64::consts::TAU;

use super::super::course::Course;
use super::change_points::four_bar;
use super::{below, sign, size};
use crate::random::Random;

/// A crank-rocker whose crank follows time, its own angle, the place of its own pin, or the rocker that it moves.
pub fn self_referring(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let [crank, coupler, rocker] = [[0.2, 0.4], [0.9, 1.2], [0.7, 1.1]]
        .map(|[least, most]| size * random.between(least, most));
    let start = random.between(-3.0, 3.0);
    let elbow = sign(random);
    let speed = 10.0_f64.powf(random.between(-0.5, 0.5)) * sign(random);
    let (part, turns) = (random.between(-0.9, 0.9), (1 + below(random, 2)) as f64);
    let links = [crank, coupler, rocker, size];
    let (own, first) = match below(random, 4) {
        0 | 1 => (
            format!("{:?}*sin({turns:?}*phi(crank))", part / turns),
            part / turns * (turns * start).sin(),
        ),
        2 => (format!("{:?}*crank.B.y", part / crank), part * start.sin()),
        _ => {
            let place = [crank * start.cos(), crank * start.sin()];
            let way = [size - place[0], -place[1]];
            let distance = way[0].hypot(way[1]);
            (format!("{:?}*distance(crank.B, D)", part / distance), part)
        }
    };
    let law = format!("{:?} + {own} + {speed:?}*t", start - first);
    let text = four_bar(links, start, 0.0, elbow, &law);
    let text = text.replace("drive phi(crank)", "equation phi(crank)");
    Course::drawn(text, size, TAU / speed.abs())
}
