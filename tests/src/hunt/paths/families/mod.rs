//! Builds mechanisms of families that are hard to follow from random numbers.

mod change_points;
mod contacts;
mod exact;
mod gaps;
mod grown;
mod slides;
mod tears;
mod wheels;
mod written;

use super::course::Course;
use crate::random::Random;

/// Makes one mechanism of a family; a number says which of the run.
type Make = fn(&mut Random, u64) -> Course;

/// All families.
pub const FAMILIES: [(&str, Make); 29] = [
    ("grown, laws of t", grown::laws),
    ("grown, late start", grown::late),
    ("grown, inputs", grown::inputs),
    ("grown, unused far geometry", grown::unused),
    ("wave and tip", contacts::wave),
    ("wave and tip, unused far geometry", contacts::wave_unused),
    ("cam from a table", contacts::cam),
    ("parallelogram", change_points::parallelogram),
    ("parallelogram, links differ", change_points::nearly),
    ("kite", change_points::kite),
    ("locomotive", change_points::locomotive),
    ("three cranks, redundant", change_points::three_cranks),
    ("four-bar with gaps", gaps::four_bar),
    ("slider-crank with gaps", gaps::slider_crank),
    ("platform with gaps", gaps::platform),
    ("lengths in a Newton block", slides::legs),
    ("rack and tie rods", wheels::rack),
    ("six-bar driven at its far link", tears::six_bar),
    ("chain driven at its end", tears::chain),
    ("platform with parallel differences", tears::level_platform),
    ("grown, inputs while time stands", grown::standing),
    ("grown, drivers in motions", grown::in_motions),
    ("grown, periodic tables", grown::repeated),
    ("platform on folded legs", grown::folded),
    ("six-bar driven between its links", tears::six_bar_between),
    ("parallelogram, change point hit", exact::parallelogram),
    ("several loops singular at once", exact::row),
    ("crank that refers to itself", written::self_referring),
    ("wave and tip, short range", contacts::wave_short),
];

/// The mechanism of a family with this number.
pub fn course(family: usize, seed: u64, number: u64) -> Course {
    let (name, make) = FAMILIES[family];
    let mut random = Random::new(
        seed.wrapping_mul(0x9e37_79b9_7f4a_7c15)
            ^ number.wrapping_mul(0xd134_2543_de82_ef95)
            ^ family as u64,
    );
    random.bits();
    let mut course = make(&mut random, number);
    course.family = name;
    course
}

/// A whole number below `count`.
fn below(random: &mut Random, count: usize) -> usize {
    (random.bits() % count as u64) as usize
}

/// 1 or -1.
fn sign(random: &mut Random) -> f64 {
    if random.bits() & 1 == 0 { 1.0 } else { -1.0 }
}

/// A size (m).
fn size(random: &mut Random) -> f64 {
    10.0_f64.powf(random.between(-3.0, 2.0))
}

/// A law of t as text, and its shortest period (s): an angle that turns on or swings, from `start`, with this speed (rad/s).
fn turning(random: &mut Random, start: f64, swing: f64) -> (String, f64) {
    let speed = 10.0_f64.powf(random.between(-1.0, 1.0));
    let period = std::f64::consts::TAU / speed;
    let speed = speed * sign(random);
    match below(random, 3) {
        0 | 1 => (format!("{start:?} + {speed:?}*t"), period),
        _ => (format!("{start:?} + {swing:?}*sin({speed:?}*t)"), period),
    }
}

/// Points, bodies and curves that nothing uses, in sizes from 1e-9 to 1e9, as statements.
pub fn junk(random: &mut Random, size: f64) -> String {
    let mut text = String::new();
    for index in 0..1 + below(random, 3) {
        let far = size * 10.0_f64.powf(9.0 * sign(random) * random.between(0.3, 1.0));
        let [x, y, angle] = [far, far, 3.0].map(|it| it * random.between(-1.0, 1.0));
        match below(random, 3) {
            0 => text += &format!("    point Far{index} = ({x:?}, {y:?});\n"),
            1 => {
                text += &format!(
                    "    body far{index} at ({x:?}, {y:?}, {angle:?}) {{ F: ({far:?}, 0) }}\n    weld (ground, far{index});\n"
                );
            }
            _ => {
                text += &format!(
                    "    curve far{index}(s from -1 to 1) on ground = ({x:?}*s, {y:?} + {far:?}*sin(s));\n"
                );
            }
        }
    }
    text
}

/// A description with more statements at its end, but before its motions.
pub fn with(text: &str, more: &str) -> String {
    let end = text.find("    motion ").or_else(|| text.rfind('}'));
    let (before, after) = text.split_at(end.expect("a mechanism ends with a brace"));
    format!("{before}{more}{after}")
}
