//! Reduces a mechanism with a finding to a smaller one with the finding: groups, laws and digits that do not matter
//! are left out.

use super::joint::Joint;
use super::law::Law;
use super::mechanism::{GROUND, Mechanism};
use super::periodic::Periodic;

/// Leaves out everything that `stays` does not need. `stays` is called once for each attempt.
pub fn shrunk(mechanism: &Mechanism, stays: impl Fn(&Mechanism) -> bool) -> Mechanism {
    let mut best = mechanism.clone();
    let attempt = |best: &mut Mechanism, candidate: Mechanism| {
        let better = candidate != *best && stays(&candidate);
        if better {
            *best = candidate;
        }
        better
    };
    loop {
        let mut smaller = false;
        for group in (0..best.groups.len()).rev() {
            if let Some(candidate) = without(&best, group) {
                smaller |= attempt(&mut best, candidate);
            }
        }
        if !smaller {
            break;
        }
    }
    let mut plain = best.clone();
    plain.drawn_off.fill([0.0; 3]);
    attempt(&mut best, plain);
    let mut single = best.clone();
    single.motions = None;
    attempt(&mut best, single);
    let mut ordered = best.clone();
    ordered.body_order.sort_unstable();
    attempt(&mut best, ordered);
    for driver in 0..best.joints.len() {
        let mut slower = best.clone();
        if let Some(law) = slower.joints[driver].0.law_mut() {
            *law = Law::Ramp { rate: 0.0 };
            attempt(&mut best, slower);
        }
    }
    for digits in 1..=4 {
        let candidate = rounded(&best, digits);
        if attempt(&mut best, candidate) {
            break;
        }
    }
    best
}

/// Mechanism without a group; `None` if other groups depend on its bodies.
fn without(mechanism: &Mechanism, group: usize) -> Option<Mechanism> {
    let bodies_of = |joint: &Joint| -> Vec<usize> {
        let (mut bodies, points) = joint.mentions();
        bodies.extend(points.iter().map(|it| mechanism.points[*it].body));
        bodies
    };
    // A body belongs to the first group that mentions it.
    let owner = |body: usize| {
        let joints = mechanism.joints.iter();
        let groups = joints.filter(|(joint, _)| bodies_of(joint).contains(&body));
        groups.map(|(_, group)| *group).min()
    };
    let belongs_to_group = |body: &usize| *body != GROUND && owner(*body) == Some(group);
    let others = mechanism.joint_order.iter().filter(|joint| {
        let (_, its) = mechanism.joints[**joint];
        its != group
    });
    let others: Vec<usize> = others.copied().collect();
    let stands = |joint: &usize| {
        bodies_of(&mechanism.joints[*joint].0)
            .iter()
            .any(belongs_to_group)
    };
    if others.len() == mechanism.joint_order.len() || others.iter().any(stands) {
        return None;
    }
    let mut smaller = mechanism.clone();
    smaller.body_order.retain(|body| !belongs_to_group(body));
    smaller.joint_order = others;
    let left = !smaller.body_order.is_empty();
    left.then_some(smaller)
}

/// Mechanism with all positions, angles and laws rounded to this number of decimals of the size or of a radian.
fn rounded(mechanism: &Mechanism, digits: i32) -> Mechanism {
    let mut round = mechanism.clone();
    let to = |value: f64, unit: f64| {
        let grid = 10.0_f64.powi(digits);
        (value / unit * grid).round() / grid * unit
    };
    let size = 10.0_f64.powf(mechanism.size.log10().round());
    for pose in round.bodies.iter_mut().chain(&mut round.drawn_off) {
        *pose = [to(pose[0], size), to(pose[1], size), to(pose[2], 1.0)];
    }
    for point in &mut round.points {
        point.place = point.place.map(|it| to(it, size));
    }
    for (joint, _) in &mut round.joints {
        let unit = match joint {
            Joint::DrivePhi(..) | Joint::DriveRelativeAngle(..) => 1.0,
            _ => size,
        };
        if let Some(law) = joint.law_mut() {
            *law = match *law {
                Law::Harmonic {
                    amplitude,
                    frequency,
                } => Law::Harmonic {
                    amplitude: to(amplitude, unit),
                    frequency: to(frequency, 1.0),
                },
                Law::Step {
                    from,
                    to: end,
                    height,
                } => Law::Step {
                    from: to(from, 1.0),
                    to: to(end, 1.0),
                    height: to(height, unit),
                },
                Law::Ramp { rate } => Law::Ramp {
                    rate: to(rate, unit),
                },
                Law::Decay { height } => Law::Decay {
                    height: to(height, unit),
                },
                Law::Repeated(table) => Law::Repeated(Periodic {
                    first: to(table.first, 1.0),
                    period: to(table.period, 1.0),
                    heights: table.heights.map(|it| to(it, unit)),
                    ..table
                }),
                given @ Law::Given { .. } => given,
            };
        }
    }
    round
}
