//! Adds groups to a growing mechanism: driven bodies, dyads, single bodies on ties, and groups that no construction
//! with circles and lines solves.

use super::builder::Builder;
use super::joint::Joint;
use super::legs;
use super::mechanism::{GROUND, difference, dot, length};

/// A random mechanism of at most `largest` bodies.
pub fn grow(builder: &mut Builder, largest: usize) {
    driven(builder);
    let groups = 1 + builder.below(4);
    for _ in 0..groups {
        let there = builder.mechanism.bodies.len() - 1;
        let room = largest.saturating_sub(there);
        match builder.below(22) {
            0..=2 if room >= 1 => driven(builder),
            3..=9 if room >= 2 => dyad(builder),
            10..=13 if room >= 1 => pinned(builder),
            14 if room >= 1 => tied(builder),
            15 if room >= 4 => triad(builder),
            16 if room >= 1 => platform(builder),
            17 if room >= 3 => chain(builder),
            18 if room >= 2 => two_dyads_tied(builder),
            19 if room >= 2 => free(builder),
            20 | 21 if room >= 3 => legs::platform(builder, room),
            _ => {}
        }
    }
}

/// One body whose every motion is driven.
pub fn driven(builder: &mut Builder) {
    let before = builder.mechanism.bodies.len();
    let x = builder.earlier(before);
    match builder.below(8) {
        0..=3 => {
            builder.begin("crank");
            let (body, place) = (builder.body(), builder.place());
            builder.pin(x, body, place);
            let law = builder.angle_law();
            let joint = if builder.chance(0.5) {
                Joint::DrivePhi(body, law)
            } else {
                let [i, j] = builder.either(x, body);
                // Nothing is measured from the ground but angles of bodies.
                if i == GROUND || j == GROUND {
                    Joint::DrivePhi(body, law)
                } else {
                    Joint::DriveRelativeAngle(i, j, law)
                }
            };
            builder.join(joint);
        }
        4 | 5 => {
            builder.begin("driven slider");
            let body = builder.body();
            let [p, q] = builder.slide(x, body);
            let law = builder.length_law();
            builder.join(Joint::DriveLength(p, q, law));
        }
        6 => {
            builder.begin("driven body");
            let (body, place) = (builder.body(), builder.place());
            let point = builder.point(body, place);
            for axis in 0..2 {
                let law = builder.length_law();
                builder.join(Joint::Drive(point, axis, law));
            }
            let law = builder.angle_law();
            builder.join(Joint::DrivePhi(body, law));
        }
        _ => {
            builder.begin("weld");
            let body = builder.body();
            let [i, j] = builder.either(x, body);
            builder.join(Joint::Weld(i, j));
        }
    }
}

/// Two bodies between two others, with a pin or a slide at each of the three places.
fn dyad(builder: &mut Builder) {
    let kind = builder.below(10);
    let (name, slides) = match kind {
        0..=3 => ("dyad RRR", [false, false, false]),
        4 => ("dyad RRP", [false, false, true]),
        5 => ("dyad PRR", [true, false, false]),
        6 => ("dyad RPR", [false, true, false]),
        7 => ("dyad PRP", [true, false, true]),
        8 => ("dyad RPP", [false, true, true]),
        _ => ("dyad PPR", [true, true, false]),
    };
    let before = builder.mechanism.bodies.len();
    let (x, y) = (builder.earlier(before), builder.earlier(before));
    builder.begin(name);
    let (a, b) = (builder.body(), builder.body());
    let mut places = Vec::new();
    for ((i, j), slides) in [(x, a), (a, b), (b, y)].into_iter().zip(slides) {
        if slides {
            builder.slide(i, j);
        } else {
            let place = builder.place_off(&places);
            places.push(place);
            builder.pin(i, j, place);
        }
    }
}

/// One body on a pin and one more equation.
fn pinned(builder: &mut Builder) {
    let before = builder.mechanism.bodies.len();
    let x = builder.earlier(before);
    builder.begin("pinned body with a tie");
    let body = builder.body();
    if builder.chance(0.8) {
        let place = builder.place();
        builder.pin(x, body, place);
    } else {
        builder.slide(x, body);
    }
    let y = builder.earlier(before);
    tie(builder, body, y);
}

/// One body on three equations.
fn tied(builder: &mut Builder) {
    let before = builder.mechanism.bodies.len();
    builder.begin("body on three ties");
    let body = builder.body();
    for _ in 0..3 {
        let y = builder.earlier(before);
        tie(builder, body, y);
    }
}

/// A body on three links.
fn triad(builder: &mut Builder) {
    let before = builder.mechanism.bodies.len();
    builder.begin("triad");
    let platform = builder.body();
    let mut places = Vec::new();
    for _ in 0..3 {
        let x = builder.earlier(before);
        let leg = builder.body();
        let near = builder.place_off(&places);
        places.push(near);
        let far = builder.place_off(&places);
        places.push(far);
        if builder.chance(0.2) {
            builder.slide(x, leg);
        } else {
            builder.pin(x, leg, near);
        }
        builder.pin(leg, platform, far);
    }
}

/// A body on three legs of driven length.
fn platform(builder: &mut Builder) {
    let before = builder.mechanism.bodies.len();
    builder.begin("platform");
    let body = builder.body();
    let mut places = Vec::new();
    for _ in 0..3 {
        let x = builder.earlier(before);
        let near = builder.place_off(&places);
        places.push(near);
        let far = builder.place_off(&places);
        places.push(far);
        let (p, q) = (builder.point(x, near), builder.point(body, far));
        let law = builder.length_law();
        let [p, q] = builder.either(p, q);
        builder.join(Joint::DriveDistance(p, q, law));
    }
}

/// Three bodies in a row between two others, and a tie.
fn chain(builder: &mut Builder) {
    let before = builder.mechanism.bodies.len();
    let (x, y) = (builder.earlier(before), builder.earlier(before));
    builder.begin("chain with a tie");
    let [a, b, c] = [0; 3].map(|_| builder.body());
    let mut places = Vec::new();
    for (i, j) in [(x, a), (a, b), (b, c), (c, y)] {
        let place = builder.place_off(&places);
        places.push(place);
        builder.pin(i, j, place);
    }
    let (body, other) = ([a, b, c][builder.below(3)], builder.earlier(before));
    tie(builder, body, other);
}

/// Two bodies in a row, each with a tie to the mechanism, so that neither comes first.
fn two_dyads_tied(builder: &mut Builder) {
    let before = builder.mechanism.bodies.len();
    let x = builder.earlier(before);
    builder.begin("two tied links");
    let (a, b) = (builder.body(), builder.body());
    let first = builder.place();
    builder.pin(x, a, first);
    let second = builder.place_off(&[first]);
    builder.pin(a, b, second);
    for body in [b, b] {
        let y = builder.earlier(before);
        tie(builder, body, y);
    }
}

/// Two bodies with joints at random, as many equations as coordinates; it may well say too much of one and too little of the
/// other.
fn free(builder: &mut Builder) {
    let before = builder.mechanism.bodies.len();
    builder.begin("joints at random");
    let bodies = [builder.body(), builder.body()];
    let mut left = 6;
    while left > 0 {
        let body = bodies[builder.below(2)];
        let other = if builder.chance(0.3) {
            bodies[0] + bodies[1] - body
        } else {
            builder.earlier(before)
        };
        match builder.below(4) {
            0 if left >= 2 => {
                let place = builder.place();
                builder.pin(body, other, place);
                left -= 2;
            }
            1 if left >= 2 => {
                builder.slide(body, other);
                left -= 2;
            }
            _ => {
                tie(builder, body, other);
                left -= 1;
            }
        }
    }
}

/// One equation between a body and another, or of the body alone.
fn tie(builder: &mut Builder, body: usize, other: usize) {
    let place = builder.place();
    let away = builder.place_off(&[place]);
    let joint = match builder.below(16) {
        0 | 1 => {
            let (p, q) = (builder.point(body, place), builder.point(other, away));
            // The circle is about a point of the ground.
            let [p, q] = if other == GROUND {
                [p, q]
            } else {
                builder.either(p, q)
            };
            Joint::Distance(p, q)
        }
        2 | 3 => {
            let [of_point, of_line] = builder.either(body, other);
            let p = builder.point(of_point, place);
            let on_line = if builder.chance(0.5) { place } else { away };
            let towards = builder.place_off(&[on_line]);
            let (a, b) = (
                builder.point(of_line, on_line),
                builder.point(of_line, towards),
            );
            Joint::Line(p, [a, b])
        }
        4 => {
            let axis = builder.below(2);
            Joint::Absolute(builder.point(body, place), axis)
        }
        5 => {
            let [i, j] = builder.either(body, other);
            let (p, q) = (builder.point(i, place), builder.point(j, away));
            let axis = builder.below(2);
            Joint::Relative(p, q, axis)
        }
        6 => Joint::AbsoluteAngle(body),
        7 if other != GROUND => {
            let [i, j] = builder.either(body, other);
            Joint::RelativeAngle(i, j)
        }
        8 if other != GROUND => {
            let wheels = builder.either(body, other);
            let mechanism_bodies = builder.mechanism.bodies.len();
            let carrier = builder.earlier(mechanism_bodies);
            Joint::Gear {
                wheels,
                carrier: if wheels.contains(&carrier) {
                    GROUND
                } else {
                    carrier
                },
                ratio: builder.between(0.2, 3.0),
                opposite: builder.chance(0.5),
                belt: builder.chance(0.5),
            }
        }
        9 => {
            let [pinion, rack] = if builder.chance(0.5) || other == GROUND {
                [body, other]
            } else {
                [other, body]
            };
            let towards = builder.place_off(&[away]);
            let direction = difference(towards, away);
            let normal = [-direction[1], direction[0]];
            let radius = dot(normal, difference(place, away)).abs() / length(direction);
            let centre = builder.point(pinion, place);
            let line = [builder.point(rack, away), builder.point(rack, towards)];
            Joint::Rack {
                centre,
                line,
                radius,
            }
        }
        10 => {
            let law = builder.angle_law();
            Joint::DrivePhi(body, law)
        }
        11 if other != GROUND => {
            let [i, j] = builder.either(body, other);
            let law = builder.angle_law();
            Joint::DriveRelativeAngle(i, j, law)
        }
        12 => {
            let axis = builder.below(2);
            let law = builder.length_law();
            Joint::Drive(builder.point(body, place), axis, law)
        }
        13 => {
            let [i, j] = builder.either(body, other);
            let (p, q) = (builder.point(i, place), builder.point(j, away));
            let axis = builder.below(2);
            let law = builder.length_law();
            Joint::DriveRelative(p, q, axis, law)
        }
        _ => {
            let [i, j] = builder.either(body, other);
            let (p, q) = (builder.point(i, place), builder.point(j, away));
            let law = builder.length_law();
            Joint::DriveDistance(p, q, law)
        }
    };
    builder.join(joint);
}
