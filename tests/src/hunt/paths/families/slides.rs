//! Loops that Newton-Raphson solves, with lengths among its unknowns.

use std::f64::consts::TAU;

use super::super::course::Course;
use super::{below, sign, size};
use crate::random::Random;

/// A plate on three legs that slide on guides: each leg is driven in its angle or its length, or turns freely.
pub fn legs(random: &mut Random, _: u64) -> Course {
    let size = size(random);
    let mut bodies = String::new();
    let mut joints = String::new();
    let mut members = Vec::new();
    let mut period = f64::INFINITY;
    let angle = random.between(-3.0, 3.0);
    for leg in 0..3 {
        let around = angle + TAU * f64::from(leg) / 3.0 + random.between(-0.5, 0.5);
        let far = size * random.between(1.5, 2.5);
        let base = [far * around.cos(), far * around.sin()];
        let pin = [0, 1].map(|_| size * random.between(-0.7, 0.7));
        let way = [pin[0] - base[0], pin[1] - base[1]];
        let (length, turned) = (way[0].hypot(way[1]), way[1].atan2(way[0]));
        members.push(format!("P{leg}: ({:?}, {:?})", pin[0], pin[1]));
        let middle = [base[0] + 0.5 * way[0], base[1] + 0.5 * way[1]];
        let half = 0.5 * length;
        bodies += &format!(
            "    point B{leg} = ({:?}, {:?});
    body guide{leg} at B{leg} turned {turned:?} {{ B{leg}, U: ({half:?}, 0) }}
    body leg{leg} at ({:?}, {:?}, {turned:?}) {{ V: (0, 0), P{leg}: ({half:?}, 0) }}
",
            base[0], base[1], middle[0], middle[1]
        );
        joints += &format!(
            "    revolute B{leg}(ground, guide{leg});
    translational (guide{leg}, leg{leg}) along guide{leg}.B{leg} -> leg{leg}.V;
    revolute P{leg}(leg{leg}, plate);
"
        );
        let speed = 10.0_f64.powf(random.between(-0.5, 0.5));
        period = period.min(TAU / speed);
        let rate = speed * sign(random);
        joints += &match below(random, 2) {
            0 => format!(
                "    drive phi(guide{leg}) = {turned:?} + {:?}*sin({rate:?}*t);\n",
                random.between(0.05, 0.5)
            ),
            _ => format!(
                "    drive length(guide{leg}.B{leg}, leg{leg}.V) = {half:?} + {:?}*sin({rate:?}*t);\n",
                half * random.between(0.05, 0.4)
            ),
        };
    }
    let text = format!(
        "mechanism legs {{\n    body plate at (0, 0) {{ {} }}\n{bodies}{joints}}}\n",
        members.join(", ")
    );
    Course::drawn(text, size, period)
}
