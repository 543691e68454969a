//! A slider-crank whose bodies are balanced one by one, with friction by substitution.

use linkwright_tests::description;
use nalgebra::{SMatrix, SVector};

use super::solved;

/// Pose, rate and acceleration of the described press: of the crank, the rod and the ram.
struct Press {
    crank: [f64; 3],
    rod: [f64; 3],
    ram: [f64; 3],
}

const CRANK: f64 = 0.03;
const ROD: f64 = 0.1;

fn press(t: f64) -> Press {
    let crank = [
        60_f64.to_radians() + 4.0 * t + 0.3 * (3.0 * t).sin(),
        4.0 + 0.9 * (3.0 * t).cos(),
        -2.7 * (3.0 * t).sin(),
    ];
    // r sin φ + l sin ψ = 0 and x = r cos φ + l cos ψ, differentiated twice.
    let [phi, rate, spin] = crank;
    let psi = (-CRANK * phi.sin() / ROD).asin();
    let of_rod = -CRANK * phi.cos() * rate / (ROD * psi.cos());
    let centripetal = CRANK * phi.sin() * rate * rate + ROD * psi.sin() * of_rod * of_rod;
    let rod_spin = (centripetal - CRANK * phi.cos() * spin) / (ROD * psi.cos());
    let x = CRANK * phi.cos() + ROD * psi.cos();
    let speed = -CRANK * phi.sin() * rate - ROD * psi.sin() * of_rod;
    let acceleration = -CRANK * (phi.cos() * rate * rate + phi.sin() * spin)
        - ROD * (psi.cos() * of_rod * of_rod + psi.sin() * rod_spin);
    Press {
        crank,
        rod: [psi, of_rod, rod_spin],
        ram: [x, speed, acceleration],
    }
}

/// Forces in the press from the balances of its three bodies, nine linear equations, with friction by substitution: pins O, A and B,
/// the normal force and the moment of the guide, and the torque.
fn balanced(press: &Press) -> SVector<f64, 9> {
    let turned = |angle: f64, [x, y]: [f64; 2]| {
        let (sine, cosine) = angle.sin_cos();
        [x * cosine - y * sine, x * sine + y * cosine]
    };
    let [phi, rate, spin] = press.crank;
    let [psi, of_rod, rod_spin] = press.rod;
    let accelerated = |arm: [f64; 2], rate: f64, spin: f64| {
        [
            -spin * arm[1] - rate * rate * arm[0],
            spin * arm[0] - rate * rate * arm[1],
        ]
    };
    let pin_a = turned(phi, [CRANK, 0.0]);
    let center = turned(phi, [0.01, 0.0]);
    let of_crank = accelerated(center, rate, spin);
    let at_a = accelerated(pin_a, rate, spin);
    let rod_center = turned(psi, [0.05, 0.005]);
    let rod_arm = turned(psi, [ROD, 0.0]);
    let relative = accelerated(rod_center, of_rod, rod_spin);
    let of_rod_center = [at_a[0] + relative[0], at_a[1] + relative[1]];
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let mut friction = [0.0; 4];
    let mut forces = SVector::<f64, 9>::zeros();
    for _ in 0..200 {
        // Unknowns: O on the crank, A on the rod, B on the ram, the normal force and the moment on the ram, the torque.
        let mut matrix = SMatrix::<f64, 9, 9>::zeros();
        let mut right = SVector::<f64, 9>::zeros();
        let set = |matrix: &mut SMatrix<f64, 9, 9>, row: usize, entries: &[(usize, f64)]| {
            for &(column, value) in entries {
                matrix[(row, column)] = value;
            }
        };
        let (weight, inertia) = (9.81, [0.0004, 0.001]);
        set(&mut matrix, 0, &[(0, 1.0), (2, -1.0)]);
        right[0] = 0.5 * of_crank[0];
        set(&mut matrix, 1, &[(1, 1.0), (3, -1.0)]);
        right[1] = 0.5 * (of_crank[1] + weight);
        // Moments about O: the crank, then about A: the rod.
        set(&mut matrix, 2, &[(2, pin_a[1]), (3, -pin_a[0]), (8, 1.0)]);
        let moved = 0.5 * cross(center, [of_crank[0], of_crank[1] + weight]);
        right[2] = inertia[0] * spin + moved - friction[0] + friction[1];
        set(&mut matrix, 3, &[(2, 1.0), (4, -1.0)]);
        right[3] = 0.8 * of_rod_center[0];
        set(&mut matrix, 4, &[(3, 1.0), (5, -1.0)]);
        right[4] = 0.8 * (of_rod_center[1] + weight);
        set(&mut matrix, 5, &[(4, rod_arm[1]), (5, -rod_arm[0])]);
        let moved = 0.8 * cross(rod_center, [of_rod_center[0], of_rod_center[1] + weight]);
        right[5] = inertia[1] * rod_spin + moved - friction[1] + friction[2];
        set(&mut matrix, 6, &[(4, 1.0)]);
        right[6] = 2.0 * press.ram[2] + 200.0 - friction[3];
        set(&mut matrix, 7, &[(5, 1.0), (6, 1.0)]);
        right[7] = 2.0 * weight;
        set(&mut matrix, 8, &[(7, 1.0)]);
        right[8] = 2.0 * cross([0.02, 0.01], [press.ram[2], weight]) - friction[2];
        forces = matrix.lu().solve(&right).expect("regular");
        let pin = |at: usize| f64::hypot(forces[at], forces[at + 1]);
        let (front, back) = (
            0.5 * forces[6] + forces[7] / 0.06,
            0.5 * forces[6] - forces[7] / 0.06,
        );
        // On the second body of each joint, against its rate on the first one.
        let next = [
            -0.15 * 0.012 * pin(0) * rate.signum(),
            -0.15 * 0.01 * pin(2) * (of_rod - rate).signum(),
            -0.2 * 0.008 * pin(4) * (-of_rod).signum(),
            -0.1 * (front.abs() + back.abs()) * press.ram[1].signum(),
        ];
        if next == friction {
            break;
        }
        friction = next;
    }
    forces
}

#[test]
fn a_press_balances_body_by_body() {
    let columns = solved(&description::system("rubbing_press"), 2.0);
    let names = [
        "reaction_o_x",
        "reaction_o_y",
        "reaction_a_x",
        "reaction_a_y",
        "reaction_b_x",
        "reaction_b_y",
        "reaction_guide_normal",
        "reaction_guide_moment",
        "effort_motor",
    ];
    let (mut worst, mut turns) = (0.0_f64, [0; 2]);
    columns.each(&names, |instant, values| {
        let press = press(instant.t());
        let expected = balanced(&press);
        for (value, expected) in values.iter().zip(expected.iter()) {
            worst = worst.max((value - expected).abs());
        }
        turns[usize::from(press.ram[1] > 0.0)] += 1;
    });
    println!("{worst:e}, on the way in and out: {turns:?}");
    assert!(worst < 1e-10 && turns.iter().all(|it| *it > 20));
}
