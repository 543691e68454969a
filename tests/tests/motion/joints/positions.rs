//! Relative positions, welds, and points whose coordinates are driven.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

use linkwright_tests::jet::Jet;

use super::exact::follows;

#[test]
fn a_body_follows_another_at_a_relative_position_and_angle() {
    follows!(following, Following, 5.0, 1e-12, |t| {
        let second = t + FRAC_PI_6;
        let (x, y) = (2.0 * t.cos() + 0.5, 2.0 * t.sin() + 0.25 + t / 8.0);
        vec![
            ("phi1", t),
            ("phi2", second),
            ("x2", x - second.cos()),
            ("y2", y - second.sin()),
        ]
    });
}

#[test]
fn welded_bodies_move_as_one() {
    follows!(welded, Welded, 5.0, 1e-12, |t| {
        vec![
            ("x2", t.cos() - t.sin()),
            ("y2", t.sin() + t.cos()),
            ("phi2", t + FRAC_PI_2),
        ]
    });
}

/// The inverse kinematics of two links, by the law of cosines.
#[test]
fn two_links_reach_a_driven_point() {
    follows!(driven_tip, DrivenTip, 5.0, 1e-12, |t| {
        let (x, y): (Jet, Jet) = (2.5 + t.sin() / 3.0, 1.5 + t.cos() / 3.0);
        let square = x.square() + y.square();
        let elbow = ((square - 4.0 - 2.25) / 6.0).acos();
        let inner = (1.5 * elbow.sin()).atan2(2.0 + 1.5 * elbow.cos());
        let first = y.atan2(x) - inner;
        vec![("phi1", first), ("phi2", first + elbow)]
    });
}
