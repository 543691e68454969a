//! Mechanisms of the hunt itself, driven by laws of t, from late on, by inputs, and beside unused geometry.

use super::super::course::Course;
use super::{below, junk, sign, with};
use crate::hunt::builder::Builder;
use crate::hunt::groups;
use crate::hunt::joint::Joint;
use crate::hunt::law::Law;
use crate::hunt::legs;
use crate::hunt::mechanism::Mechanism;
use crate::hunt::motion::Motions;
use crate::hunt::periodic::Periodic;
use crate::hunt::run::MAX_BODIES;
use crate::random::Random;

/// Length of a course, in shortest periods.
const PERIODS: f64 = 3.0;

/// Latest end of a course (s), and its limit in shortest periods.
const LATEST: [f64; 2] = [12.0, 60.0];

/// Scale of a driven quantity: 1 for an angle.
fn driven_size(joint: &Joint, mechanism: &Mechanism) -> f64 {
    match joint {
        Joint::DrivePhi(..) | Joint::DriveRelativeAngle(..) => 1.0,
        _ => mechanism.size,
    }
}

fn of(mechanism: &Mechanism, text: String, begin: f64) -> Course {
    let mut period = f64::INFINITY;
    for (joint, _) in &mechanism.joints {
        let mut joint = *joint;
        let size = driven_size(&joint, mechanism);
        if let Some(law) = joint.law_mut() {
            period = period.min(law.period(size));
        }
    }
    let period = if period.is_finite() {
        period.min(6.3)
    } else {
        6.3
    };
    let lasts = (PERIODS * period)
        .clamp(3.0, LATEST[0])
        .min(LATEST[1] * period);
    Course {
        span: [begin, begin + lasts],
        start: mechanism.coordinates(),
        is_drawn: mechanism.is_drawn_exactly(),
        ..Course::drawn(text, mechanism.size, period)
    }
}

fn grown(random: &mut Random, number: u64) -> Mechanism {
    crate::hunt::mechanism(random.bits() & 0xffff, number, MAX_BODIES)
}

/// Driven by laws of t.
pub fn laws(random: &mut Random, number: u64) -> Course {
    let mechanism = grown(random, number);
    of(&mechanism, mechanism.text(), 0.0)
}

/// Description with t - `begin` in the place of t.
pub fn shifted(text: &str, begin: f64) -> String {
    let line = |line: &str| match line.trim_start().starts_with("drive ") {
        true => line
            .replace("*t", &format!("*(t - {begin:?})"))
            .replace("(t,", &format!("(t - {begin:?},"))
            .replace("(t)", &format!("(t - {begin:?})"))
            .replace("(-t)", &format!("(-(t - {begin:?}))")),
        false => line.to_string(),
    };
    text.lines().map(|it| line(it) + "\n").collect()
}

/// Driven by laws of t, with a late start.
pub fn late(random: &mut Random, number: u64) -> Course {
    let mechanism = grown(random, number);
    let begin = (random.between(-50.0, 50.0) * 64.0).round() / 64.0;
    of(&mechanism, shifted(&mechanism.text(), begin), begin)
}

/// Mechanism with an input in the place of each law, and the laws.
pub fn with_inputs(mechanism: &Mechanism) -> (Mechanism, Vec<Law>) {
    let mut with_inputs = mechanism.clone();
    with_inputs.motions = None;
    let mut laws = Vec::new();
    for (joint, _) in &mut with_inputs.joints {
        if let Some(law) = joint.law_mut() {
            let input = laws.len();
            laws.push(std::mem::replace(law, Law::Given { input }));
        }
    }
    (with_inputs, laws)
}

/// Statements of this number of inputs with any defaults.
pub fn declared(random: &mut Random, count: usize) -> String {
    let default = |random: &mut Random| sign(random) * 10.0_f64.powf(random.between(-3.0, 3.0));
    (0..count)
        .map(|input| format!("    input k{input} = {:?};\n", default(random)))
        .collect()
}

/// Driven by inputs.
pub fn inputs(random: &mut Random, number: u64) -> Course {
    let mechanism = grown(random, number);
    let (given, laws) = with_inputs(&mechanism);
    let declared = declared(random, laws.len());
    let text = given.text().replacen("{\n", &format!("{{\n{declared}"), 1);
    let mut course = of(&mechanism, text, 0.0);
    course.inputs = laws.into_iter().map(|law| (0.0, law)).collect();
    course
}

/// With unused points and bodies of all sizes.
pub fn unused(random: &mut Random, number: u64) -> Course {
    let mut course = laws(random, number);
    course.text = with(&course.text, &junk(random, course.size));
    // The bodies beside it have coordinates of their own, which begin in the design configuration.
    course
}

/// Driven by inputs that change at constant time.
pub fn standing(random: &mut Random, number: u64) -> Course {
    Course {
        is_standing: true,
        ..inputs(random, number)
    }
}

/// A platform with drivers inside of its legs, half of them on a driven body.
pub fn folded(random: &mut Random, number: u64) -> Course {
    let mut builder = Builder::new(Random::new(random.bits()));
    if number.is_multiple_of(2) {
        groups::driven(&mut builder);
    }
    legs::platform(&mut builder, MAX_BODIES - 1);
    let mechanism = builder.finish();
    of(&mechanism, mechanism.text(), 0.0)
}

/// Driven in a motion among others, with parameters of its own.
pub fn in_motions(random: &mut Random, number: u64) -> Course {
    let mut mechanism = grown(random, number);
    mechanism.motions = Some(Motions {
        before: below(random, 2),
        after: 1 + below(random, 2),
        are_alike: number.is_multiple_of(2),
    });
    of(&mechanism, mechanism.text(), 0.0)
}

/// Driven by periodic tables whose boundaries are targets.
pub fn repeated(random: &mut Random, number: u64) -> Course {
    let mut mechanism = grown(random, number);
    let period = [0.5, 1.0, 2.0][below(random, 3)];
    let sizes: Vec<f64> = mechanism
        .joints
        .iter()
        .map(|(joint, _)| driven_size(joint, &mechanism))
        .collect();
    for (table, ((joint, _), size)) in mechanism.joints.iter_mut().zip(sizes).enumerate() {
        if let Some(law) = joint.law_mut() {
            let heights = [0; 4].map(|_| 0.15 * size * random.between(-1.0, 1.0));
            *law = Law::Repeated(Periodic {
                number: table,
                first: 0.25 * period * (below(random, 33) as f64 - 16.0),
                period,
                heights,
            });
        }
    }
    of(&mechanism, mechanism.text(), 0.0)
}
