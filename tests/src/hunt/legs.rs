//! Adds platforms on legs of every kind to a mechanism that grows, with drivers of every kind inside of them.
//!
//! Nothing inside a platform follows before its pose, so that its bodies are one block, and each leg takes one freedom from it.

use super::builder::Builder;
use super::joint::Joint;
use super::mechanism::GROUND;

/// Number of legs.
const LEGS: usize = 3;

/// Largest number of bodies of a leg.
const MAX_LEG_BODIES: usize = 2;

/// Adds a platform on three legs, of at most so many bodies together.
pub fn platform(builder: &mut Builder, most: usize) {
    let before = builder.mechanism.bodies.len();
    builder.begin("platform on folded legs");
    let plate = builder.body();
    let mut left = most - 1;
    let mut places = Vec::new();
    for leg in 0..LEGS {
        let x = builder.earlier(before);
        let ends = [0; 2].map(|_| {
            let place = builder.place_off(&places);
            places.push(place);
            place
        });
        // One leg is folded at least.
        let bodies = match leg {
            0 => MAX_LEG_BODIES,
            _ => builder.below(MAX_LEG_BODIES.min(left) + 1),
        };
        left -= bodies;
        match bodies {
            0 => driven_distance(builder, [x, plate], ends),
            1 => link(builder, [x, plate], ends),
            _ => match builder.below(4) {
                0 => telescope(builder, [x, plate], ends),
                _ => folded(builder, [x, plate], ends),
            },
        }
    }
}

/// A leg without bodies: the distance of its ends is driven.
fn driven_distance(builder: &mut Builder, [x, plate]: [usize; 2], [near, far]: [[f64; 2]; 2]) {
    let (p, q) = (builder.point(x, near), builder.point(plate, far));
    let law = builder.length_law();
    let [p, q] = builder.either(p, q);
    builder.join(Joint::DriveDistance(p, q, law));
}

/// A rigid link between two pins.
fn link(builder: &mut Builder, [x, plate]: [usize; 2], [near, far]: [[f64; 2]; 2]) {
    let link = builder.body();
    builder.pin(x, link, near);
    builder.pin(link, plate, far);
}

/// Two links with a knee, and a driver somewhere in the leg.
fn folded(builder: &mut Builder, [x, plate]: [usize; 2], [near, far]: [[f64; 2]; 2]) {
    let (thigh, shank) = (builder.body(), builder.body());
    let knee = builder.place_off(&[near, far]);
    builder.pin(x, thigh, near);
    builder.pin(thigh, shank, knee);
    builder.pin(shank, plate, far);
    let axis = builder.below(2);
    let driver = match builder.below(8) {
        0 | 1 => {
            let [i, j] = builder.either(thigh, shank);
            Joint::DriveRelativeAngle(i, j, builder.angle_law())
        }
        2 => {
            let [i, j] = builder.either(shank, plate);
            Joint::DriveRelativeAngle(i, j, builder.angle_law())
        }
        3 => {
            let body = [thigh, shank][builder.below(2)];
            Joint::DrivePhi(body, builder.angle_law())
        }
        4 => {
            let point = builder.point(thigh, knee);
            Joint::Drive(point, axis, builder.length_law())
        }
        5 => {
            let (p, q) = (builder.point(thigh, knee), builder.point(plate, far));
            let [p, q] = builder.either(p, q);
            Joint::DriveRelative(p, q, axis, builder.length_law())
        }
        6 if x != GROUND => {
            let (p, q) = (builder.point(x, near), builder.point(shank, knee));
            let [p, q] = builder.either(p, q);
            Joint::DriveRelative(p, q, axis, builder.length_law())
        }
        _ => {
            let (p, q) = (builder.point(x, near), builder.point(shank, far));
            let [p, q] = builder.either(p, q);
            Joint::DriveDistance(p, q, builder.length_law())
        }
    };
    builder.join(driver);
}

/// Two links of which one slides in the other, and a driver of its length or of its angle.
fn telescope(builder: &mut Builder, [x, plate]: [usize; 2], [near, far]: [[f64; 2]; 2]) {
    let (guide, rod) = (builder.body(), builder.body());
    builder.pin(x, guide, near);
    let (from, to) = (builder.point(guide, near), builder.point(rod, far));
    builder.join(Joint::Translational(from, to));
    builder.pin(rod, plate, far);
    let driver = match builder.below(3) {
        0 => Joint::DrivePhi(guide, builder.angle_law()),
        1 => {
            let [i, j] = builder.either(rod, plate);
            Joint::DriveRelativeAngle(i, j, builder.angle_law())
        }
        _ => Joint::DriveLength(from, to, builder.length_law()),
    };
    builder.join(driver);
}
