//! Schedules of a course: steps from 1e-3 to 3 of its shortest period.

use super::course::Course;
use super::stepping::{Schedule, Target};
use crate::random::Random;

/// Steps in shortest periods, and their numbers: exact fractions and multiples, and incommensurable ones.
pub const STEPS: [(f64, usize); 16] = [
    (1e-3, 600),
    (std::f64::consts::E * 1e-3, 300),
    (0.01, 200),
    (0.032_414, 120),
    (0.0625, 80),
    (0.1, 60),
    (0.177_245, 50),
    (0.25, 40),
    (0.381_966, 40),
    (0.5, 30),
    (0.618_034, 30),
    (1.0, 24),
    (std::f64::consts::SQRT_2, 24),
    (2.0, 20),
    (std::f64::consts::E, 20),
    (3.0, 20),
];

/// One schedule for each size of steps, and one of random steps, with a fraction `part` of the steps.
pub fn schedules(course: &Course, random: &mut Random, part: f64) -> Vec<Schedule> {
    let mut all: Vec<Schedule> = STEPS
        .iter()
        .map(|&(step, count)| {
            let count = ((count as f64 * part).ceil() as usize).max(2);
            let h = step * course.period;
            // Short steps begin anywhere.
            let reach = h * count as f64;
            let free = (course.span[1] - course.span[0] - reach).max(0.0);
            let shift = match random.between(0.0, 1.0) {
                dice if dice < 0.5 => 0.0,
                _ => free * random.between(0.0, 1.0),
            };
            let first = (shift > 0.0).then(|| course.span[0] + shift);
            let times = (1..=count).map(|k| course.span[0] + shift + h * k as f64);
            along(course, first.into_iter().chain(times))
        })
        .collect();
    let count = (60.0 * part).ceil() as usize;
    let mut t = course.span[0];
    let times: Vec<f64> = (0..count)
        .map(|_| {
            let step = course.period * 10.0_f64.powf(random.between(-3.0, 0.48));
            t += if random.between(0.0, 1.0) < 0.3 {
                -step
            } else {
                step
            };
            t
        })
        .collect();
    all.push(along(course, times.into_iter()));
    all
}

/// Schedule through these times, reflected at the end of the course.
fn along(course: &Course, times: impl Iterator<Item = f64>) -> Schedule {
    let [from, until] = course.span;
    let reflected = |t: f64| {
        let way = (t - from).rem_euclid(2.0 * (until - from));
        from + way.min(2.0 * (until - from) - way)
    };
    let target = |t: f64| Target {
        t: if course.is_standing { from } else { t },
        inputs: course.given(t),
    };
    Schedule {
        start: course.start.clone(),
        targets: std::iter::once(from)
            .chain(times.map(reflected))
            .map(target)
            .collect(),
    }
}
