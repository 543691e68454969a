//! Mechanisms cut into free bodies: the equations of Newton and Euler, solved as one linear system, give the same forces.

use linkwright_tests::description;
use linkwright_tests::forces::{Followed, cross, moving, systems};
use nalgebra::{DMatrix, DVector};

use super::{close, followed};

/// A body cut free: where its center of mass is, its mass, its moment of inertia.
struct Free {
    body: usize,
    center: [f64; 2],
    mass: f64,
    inertia: f64,
}

/// The unknowns of a pin: which two of all, where it is, and whether it acts on this body as it is written or the other way.
struct Pin {
    unknown: usize,
    place: [f64; 2],
    sign: f64,
}

/// Recursive Newton-Euler for one body: two forces and one moment about its center of mass, into three rows.
fn cut_free(
    free: &Free,
    pins: &[Pin],
    torques: &[(usize, f64)],
    gravity: f64,
    followed: &Followed,
    (matrix, right): (&mut DMatrix<f64>, &mut DVector<f64>),
    first: usize,
) {
    let moving = moving(free.body, followed.instant());
    let arm = moving.arm(free.center);
    let center = [moving.at[0] + arm[0], moving.at[1] + arm[1]];
    let acceleration = moving.acceleration(free.center);
    right[first] = free.mass * acceleration[0];
    right[first + 1] = free.mass * (acceleration[1] + gravity);
    right[first + 2] = free.inertia * moving.acceleration[2];
    for pin in pins {
        let lever = [pin.place[0] - center[0], pin.place[1] - center[1]];
        matrix[(first, pin.unknown)] += pin.sign;
        matrix[(first + 1, pin.unknown + 1)] += pin.sign;
        matrix[(first + 2, pin.unknown)] -= pin.sign * lever[1];
        matrix[(first + 2, pin.unknown + 1)] += pin.sign * lever[0];
    }
    for &(unknown, sign) in torques {
        matrix[(first + 2, unknown)] += sign;
    }
}

/// Position of a point of a body.
fn place(body: usize, local: [f64; 2], followed: &Followed) -> [f64; 2] {
    let moving = moving(body, followed.instant());
    let arm = moving.arm(local);
    [moving.at[0] + arm[0], moving.at[1] + arm[1]]
}

#[test]
fn a_four_bar_cut_into_free_bodies_has_the_same_forces() {
    let text = "mechanism four_bar {
        point A = (0, 0), D = (0.5, -0.1);
        body crank at (0, 0, 63deg) { A: (0, 0), B: (0.22, 0) }
        body coupler at (0.1, 0.2, 22deg) { B: (0, 0), C: (0.54, 0) }
        body rocker at (0.5, -0.1, 79deg) { D: (0, 0), C: (0.51, 0) }
        revolute A(ground, crank);
        revolute B(crank, coupler);
        revolute C(coupler, rocker);
        revolute D(ground, rocker);
        drive phi(crank) = 63deg + 7*t - 3*t^2;
        mass crank = 1.2kg at (0.1, 0.02) inertia 0.01;
        mass coupler = 2kg at (0.3, 0.05) inertia 0.06;
        mass rocker = 0.8kg at (0.2, -0.03) inertia 0.03;
        gravity = (0, -9.81);
        effort; reactions;
    }";
    let mut four_bar = followed(text);
    for step in 0..60 {
        assert!(four_bar.advance(0.02 * f64::from(step)));
        let mut matrix = DMatrix::zeros(9, 9);
        let mut right = DVector::zeros(9);
        let [a, b, c, d] = [
            [0.0, 0.0],
            place(0, [0.22, 0.0], &four_bar),
            place(1, [0.54, 0.0], &four_bar),
            [0.5, -0.1],
        ];
        let pin = |unknown, place, sign| Pin {
            unknown,
            place,
            sign,
        };
        // A on the crank, B on the coupler, C on the rocker, D on the rocker; the torque on the crank.
        let bodies = [
            (
                Free {
                    body: 0,
                    center: [0.1, 0.02],
                    mass: 1.2,
                    inertia: 0.01,
                },
                vec![pin(0, a, 1.0), pin(2, b, -1.0)],
                vec![(8, 1.0)],
            ),
            (
                Free {
                    body: 1,
                    center: [0.3, 0.05],
                    mass: 2.0,
                    inertia: 0.06,
                },
                vec![pin(2, b, 1.0), pin(4, c, -1.0)],
                vec![],
            ),
            (
                Free {
                    body: 2,
                    center: [0.2, -0.03],
                    mass: 0.8,
                    inertia: 0.03,
                },
                vec![pin(4, c, 1.0), pin(6, d, 1.0)],
                vec![],
            ),
        ];
        for (number, (free, pins, torques)) in bodies.iter().enumerate() {
            let derived = (&mut matrix, &mut right);
            cut_free(free, pins, torques, 9.81, &four_bar, derived, 3 * number);
        }
        let solved = matrix.full_piv_lu().solve(&right).expect("regular");
        let names = ["a", "b", "c", "d"]
            .into_iter()
            .flat_map(|pin| ["x", "y"].map(|axis| format!("reaction_{pin}_{axis}")));
        for (unknown, name) in names.enumerate() {
            close(four_bar.value(&name), solved[unknown], 1e-11, &name);
        }
        close(
            four_bar.value("effort_drive_phi_crank"),
            solved[8],
            1e-11,
            "torque",
        );
    }
}

#[test]
fn a_slider_crank_cut_into_free_bodies_has_the_same_forces() {
    let text = description::source("forced_slider").text;
    let mut engine = followed(&text);
    let lengths = |body: usize, name: &str| {
        let derived = &systems("slider", &text)[0];
        let marks = &derived.system.mechanism.moving_bodies()[body].marks;
        let mark = marks.iter().find(|it| it.name == name).expect("a point");
        let value = |part| derived.pool.graph.constant_value(part).expect("a number");
        mark.mark.local.map(value)
    };
    let (to_b, to_p) = (lengths(0, "B"), lengths(1, "P"));
    for step in 0..80 {
        let t = 0.005 * f64::from(step);
        assert!(engine.advance(t));
        let mut matrix = DMatrix::zeros(9, 9);
        let mut right = DVector::zeros(9);
        let (b, p) = (place(0, to_b, &engine), place(1, to_p, &engine));
        let pin = |unknown, place, sign| Pin {
            unknown,
            place,
            sign,
        };
        // O on the crank, B on the rod, P on the slider; the guide's normal and its moment about P; the torque on the crank.
        let crank = Free {
            body: 0,
            center: [0.02, 0.01],
            mass: 0.7,
            inertia: 0.002,
        };
        let rod = Free {
            body: 1,
            center: [0.15, 0.01],
            mass: 0.5,
            inertia: 0.004,
        };
        let slider = Free {
            body: 2,
            center: [0.005, 0.003],
            mass: 1.1,
            inertia: 0.001,
        };
        let on_crank = [pin(0, [0.0; 2], 1.0), pin(2, b, -1.0)];
        let on_rod = [pin(2, b, 1.0), pin(4, p, -1.0)];
        let derived = (&mut matrix, &mut right);
        cut_free(&crank, &on_crank, &[(8, 1.0)], 9.81, &engine, derived, 0);
        cut_free(
            &rod,
            &on_rod,
            &[],
            9.81,
            &engine,
            (&mut matrix, &mut right),
            3,
        );
        let derived = (&mut matrix, &mut right);
        cut_free(
            &slider,
            &[pin(4, p, 1.0)],
            &[(7, 1.0)],
            9.81,
            &engine,
            derived,
            6,
        );
        // The guide is along x: its force is along y at P, and P is where the driving force acts too.
        let moving = moving(2, engine.instant());
        let arm = moving.arm([0.005, 0.003]);
        matrix[(7, 6)] += 1.0;
        matrix[(8, 6)] += -arm[0];
        let gas = -200.0 * (1.0 + (5.0 * t).sin());
        right[6] -= gas;
        right[8] -= cross([-arm[0], -arm[1]], [gas, 0.0]);
        let solved = matrix.full_piv_lu().solve(&right).expect("regular");
        let names = [
            "reaction_o_x",
            "reaction_o_y",
            "reaction_b_x",
            "reaction_b_y",
            "reaction_p_x",
            "reaction_p_y",
            "reaction_guide_normal",
            "reaction_guide_moment",
            "effort_drive_phi_crank",
        ];
        for (unknown, name) in names.into_iter().enumerate() {
            close(engine.value(name), solved[unknown], 1e-11, name);
        }
    }
}
