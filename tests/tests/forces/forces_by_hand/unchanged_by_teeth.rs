//! Values that forces of teeth leave unchanged, bit by bit.

use linkwright_tests::description;
use linkwright_tests::forces::Followed;
use linkwright_tests::simulated::{options, simulation};

use super::{close, followed};

/// Text without its pressure angles.
fn without(text: &str) -> String {
    let mut parts = text.split(" pressure_angle ");
    let mut whole = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let (_, rest) = part.split_once(';').expect("the end of the statement");
        whole.push(';');
        whole.push_str(rest);
    }
    whole
}

/// Forces of teeth in the bearings change no bit of anything else: pose, rates, accelerations, efforts, powers,
/// energies, the moments of gears and the reactions of other joints.
#[test]
fn motion_and_efforts_keep_their_bits() {
    let linked = "mechanism linked {
        param reach = 0.3;
        point A = (0, 0), B = (0.2, 0.5), C = (0.8, 1), D = (1.2, 0.4), E = (1, 0), H = (0, reach);
        body 1 at A facing A -> B { A, B }
        body 2 at B facing B -> C { B, C }
        body 3 at D facing D -> C { D, C }
        body 4 at E facing E -> D { E, D }
        body 5 at H { H }
        revolute A(ground, 1);
        revolute B(1, 2);
        revolute C(2, 3);
        revolute D(3, 4);
        revolute E(ground, 4);
        revolute H(ground, 5);
        external_gear main(1, 4) = 1/2 pressure_angle 20deg;
        external_gear (5, 1) = reach/0.4 pressure_angle 14.5deg;
        drive crank: phi(1) = 1.2 + sin(t)/4;
        mass 2 = 2kg at (0.1, 0.2) inertia 0.1;
        mass 3 = 1kg at (0.3, 0) inertia 0.2;
        mass 5 = 1kg at (0.01, 0) inertia 0.03;
        gravity = (0, -9.81);
        spring (2.C, ground.E) = 50 free 0.3;
        effort; reactions; energy;
    }";
    let planetary = description::source("toothed_planetary").text;
    for text in [linked, &planetary] {
        let plain = without(text);
        assert!(!plain.contains("pressure_angle"));
        let [mut with, mut without] = [text, &plain].map(followed);
        let (mut same, mut other) = (0, 0);
        for step in 0..60 {
            let t = 0.02 * f64::from(step);
            assert!(with.advance(t) && without.advance(t));
            let bits = |it: &Followed| {
                let instant = it.instant();
                let levels = [instant.q(), instant.qd(), instant.qdd()].concat();
                levels.into_iter().map(f64::to_bits).collect::<Vec<u64>>()
            };
            assert_eq!(bits(&with), bits(&without));
            for (name, value) in without.all() {
                let with_teeth = with.value(name);
                let is_bearing = ["_a_", "_e_", "_h_", "_s_", "_r_", "_c_"];
                let is_bearing = is_bearing.iter().any(|it| name.contains(it));
                match is_bearing && name.starts_with("reaction") {
                    true if with_teeth.to_bits() != value.to_bits() => other += 1,
                    true => {}
                    false => {
                        assert_eq!(with_teeth.to_bits(), value.to_bits(), "{name} at t = {t}");
                        same += 1;
                    }
                }
            }
        }
        assert!(same > 200 && other > 200, "{same} {other}");
    }
}

/// A motion under forces is unchanged.
#[test]
fn a_free_gear_moves_as_without_the_force_of_its_teeth() {
    let text = "mechanism hoist {
        point A = (0, 0), B = (60mm, 0);
        body 1 at A { A }
        body 2 at B { B, S: (0, -30mm) }
        revolute A(ground, 1);
        revolute B(ground, 2);
        external_gear mesh(1, 2) = 20/40 pressure_angle 20deg;
        free swing: phi(2) = 1 rate 2;
        mass 1 = 1kg inertia 0.002;
        mass 2 = 2kg at S inertia 0.003;
        gravity = (0, -9.81);
        reactions;
    }";
    let plain = without(text);
    let [with, without] = [text, &plain].map(|text| {
        let mut run = simulation(text, 0.5, options(1e-9));
        let start = run.frame().qdd()[5];
        run.advance(0.5).expect("no end");
        let frame = run.frame();
        let end = [frame.q(), frame.qd(), frame.qdd()].concat();
        (
            start,
            end.into_iter().map(f64::to_bits).collect::<Vec<u64>>(),
        )
    });
    assert_eq!(with.1, without.1);
    // (I₂ + m s² + 4 I₁) φ̈ = −m g s sin φ, with the first wheel twice as fast.
    let inertia = 0.003 + 2.0 * 0.03 * 0.03 + 4.0 * 0.002;
    let expected = -2.0 * 9.81 * 0.03 * 1_f64.sin() / inertia;
    close(with.0, expected, 1e-13, "the swing");
}
