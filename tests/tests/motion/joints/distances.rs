//! Points that keep a distance: on the ground, on another body, as a massless link, driven.

use std::f64::consts::{FRAC_PI_2, PI};

use linkwright_tests::jet::Jet;

use super::exact::follows;

/// The law of cosines: the angle between the sides a and b of a triangle whose third side is c.
fn between(a: Jet, b: Jet, c: Jet) -> Jet {
    ((a.square() + b.square() - c.square()) / (2.0 * a * b)).acos()
}

fn length(x: Jet, y: Jet) -> Jet {
    (x.square() + y.square()).sqrt()
}

#[test]
fn a_point_at_a_distance_from_the_ground_lies_on_two_circles() {
    follows!(held_at_distance, HeldAtDistance, 5.0, 1e-12, |t| {
        let height = 0.8 + 0.1 * t;
        let (x, y) = (Jet::from(4.0), -height);
        let angle = y.atan2(x) + between(Jet::from(3.0), length(x, y), Jet::from(2.0));
        vec![("x1", Jet::from(0.0)), ("y1", height), ("phi1", angle)]
    });
}

#[test]
fn sliders_at_a_distance_are_an_elliptic_trammel() {
    follows!(ellipse_sliders, EllipseSliders, 5.0, 1e-12, |t| {
        let x = 0.6 + 0.2 * t.sin();
        vec![("x1", x), ("y2", (1.0 - x.square()).sqrt())]
    });
}

#[test]
fn a_massless_link_is_the_coupler_of_a_four_bar() {
    follows!(coupled_rockers, CoupledRockers, 5.0, 1e-12, |t| {
        let crank = 1.0 + t;
        let radius = 0.05_f64.sqrt();
        let (x, y) = (radius * crank.cos() - 0.4, radius * crank.sin());
        let inner = between(
            Jet::from(0.17_f64.sqrt()),
            length(x, y),
            Jet::from(0.2_f64.sqrt()),
        );
        // The pin B passes the negative x axis as seen from D, where atan2 jumps.
        let outer = y.atan2(x);
        let outer = if outer.0[0] < 0.0 {
            outer + 2.0 * PI
        } else {
            outer
        };
        vec![("phi_crank", crank), ("phi_rocker", outer - inner)]
    });
}

#[test]
fn a_driven_distance_opens_a_triangle() {
    follows!(pushed_apart, PushedApart, 5.0, 1e-12, |t| {
        let first = FRAC_PI_2 + t.sin() / 4.0;
        let (x, y) = (first.cos() - 2.0, first.sin());
        let driven = 2.7 + (2.0 * t).sin() / 5.0;
        let inner = between(Jet::from(1.5), length(x, y), driven);
        vec![("phi1", first), ("phi2", y.atan2(x) - inner)]
    });
}

mod platform_on_cylinders {
    linkwright::include_mechanism!(platform_on_cylinders);
}

/// Without a closed form, Newton-Raphson solves the angles of the links together with the platform; legs with bodies
/// move it alike.
#[test]
fn cylinders_without_bodies_move_a_platform_as_those_with_bodies_do() {
    let mut legs = linkwright_mechanisms::platform_3rpr::Platform3rpr::assemble(0.0)
        .expect("the drawing assembles");
    let mut links =
        platform_on_cylinders::PlatformOnCylinders::assemble(0.0).expect("the drawing assembles");
    for step in 0..=500 {
        let t = f64::from(step) / 100.0;
        let expected = *legs.advance(t).expect("the motion can be followed");
        let moved = *links.advance(t).expect("the motion can be followed");
        let pairs = [
            (expected.q.x_platform, moved.q.x_platform),
            (expected.q.y_platform, moved.q.y_platform),
            (expected.q.phi_platform, moved.q.phi_platform),
            (expected.qd.phi_platform, moved.qd.phi_platform),
            (expected.qdd.x_platform, moved.qdd.x_platform),
            (expected.qdd.phi_platform, moved.qdd.phi_platform),
        ];
        for (expected, moved) in pairs {
            let error = (expected - moved).abs() / expected.abs().max(1.0);
            assert!(error <= 1e-11, "t = {t}: {moved} instead of {expected}");
        }
    }
}
