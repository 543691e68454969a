//! Gears, belts and relative angles.

use linkwright_tests::jet::Jet;

use super::exact::follows;

fn degrees(angle: f64) -> f64 {
    angle.to_radians()
}

fn length(x: Jet, y: Jet) -> Jet {
    (x.square() + y.square()).sqrt()
}

fn between(a: Jet, b: Jet, c: Jet) -> Jet {
    ((a.square() + b.square() - c.square()) / (2.0 * a * b)).acos()
}

/// Willis: (φ_ring − φ_arm)/(φ_sun − φ_arm) = −r_sun/r_ring = −1/2.
#[test]
fn a_planetary_gear_obeys_willis() {
    follows!(planetary, Planetary, 5.0, 1e-12, |t| {
        let (sun, ring) = (2.0 * t, t / 3.0 + t.sin());
        let arm = (2.0 * ring + sun) / 3.0;
        vec![
            ("phi_arm", arm),
            ("x_planet", 3.0 * arm.cos()),
            ("y_planet", 3.0 * arm.sin()),
            ("phi_planet", arm - 2.0 * (sun - arm) + degrees(20.0)),
        ]
    });
}

#[test]
fn belts_turn_in_one_sense_and_crossed_ones_against() {
    follows!(belt_drive, BeltDrive, 5.0, 1e-12, |t| {
        vec![
            ("phi1", 3.0 * t),
            ("phi2", 2.0 * t + degrees(40.0)),
            ("phi3", -t + degrees(10.0)),
        ]
    });
}

#[test]
fn geared_cranks_carry_a_dyad() {
    follows!(geared_cranks, GearedCranks, 5.0, 1e-12, |t| {
        let first = 1.2 + t.sin() / 4.0;
        let fourth = 0.4_f64.atan2(0.2) - (first - 0.5_f64.atan2(0.2)) / 2.0;
        let [a, b, c, d] = [0.29_f64, 0.61, 0.52, 0.2].map(f64::sqrt);
        let (end_x, end_y) = (1.0 + d * fourth.cos(), d * fourth.sin());
        // From D to B, and by the angle at D to C.
        let (x, y) = (a * first.cos() - end_x, a * first.sin() - end_y);
        let inner = between(Jet::from(c), length(x, y), Jet::from(b));
        vec![("phi4", fourth), ("phi3", y.atan2(x) - inner)]
    });
}

/// Crank and coupler are one link whose length is known at every time: A, C and D make a triangle.
#[test]
fn a_four_bar_is_driven_at_the_pin_between_crank_and_coupler() {
    follows!(driven_coupler, DrivenCoupler, 5.0, 1e-12, |t| {
        let bend = -0.6 + t.sin() / 10.0;
        let [crank, coupler] = [0.05_f64, 0.2].map(f64::sqrt);
        let (x, y) = (crank + coupler * bend.cos(), coupler * bend.sin());
        let reach = length(x, y);
        let inner = between(reach, Jet::from(0.4), Jet::from(0.17_f64.sqrt()));
        let angle = inner - y.atan2(x);
        vec![("phi_crank", angle), ("phi_coupler", angle + bend)]
    });
}

/// The mechanism is symmetric about x = 1, so each half is a triangle.
#[test]
fn mirrored_cranks_open_in_symmetry() {
    follows!(mirrored_cranks, MirroredCranks, 5.0, 1e-12, |t| {
        let (x, y) = (Jet::from(1.0), 2.2 + t.sin() / 4.0);
        let [crank, link] = [1.25_f64, 1.5 * 1.5 + 1.2 * 1.2].map(f64::sqrt);
        let inner = between(Jet::from(crank), length(x, y), Jet::from(link));
        let first = y.atan2(x) + inner;
        vec![("phi1", first), ("phi4", std::f64::consts::PI - first)]
    });
}
