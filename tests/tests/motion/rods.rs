//! Rods between positions that formulas give, in the plane and in space: against matrices, a closed form by hand, and
//! other descriptions.

use linkwright::{Blocks, FailureKind, Settings, Signal};
use linkwright_mechanisms::ankle::{to_joint, to_motors};
use linkwright_solver::{Interpreted, View};
use linkwright_tests::ankle::{SIDES, foot_of};
use linkwright_tests::description::written;
use linkwright_tests::files;
use linkwright_tests::forces::{Followed, systems};
use linkwright_tests::jet::Jet;
use linkwright_tests::swing::swing;
use linkwright_tests::values::{assembled_from, levels};

fn jet(signal: Signal) -> Jet {
    Jet([signal.value, signal.rate, signal.acceleration])
}

/// The foot swings 30° and 20°, more than a walking robot's.
fn wanted(t: f64) -> to_motors::Inputs {
    to_motors::Inputs {
        wanted_pitch: swing(0.0, 0.52, 5.0, t),
        wanted_roll: swing(0.0, 0.35, 7.3, t + 0.4 / 7.3),
    }
}

/// Motors with their rates and accelerations.
fn motors(frame: &to_motors::Frame) -> [Signal; 2] {
    [
        Signal {
            value: frame.phi_left(),
            rate: frame.phi_left_rate(),
            acceleration: frame.phi_left_acceleration(),
        },
        Signal {
            value: frame.phi_right(),
            rate: frame.phi_right_rate(),
            acceleration: frame.phi_right_acceleration(),
        },
    ]
}

#[test]
fn cranks_of_the_ankle_are_where_matrices_and_a_closed_form_say() {
    let mut ankle = to_motors::Ankle::assemble(0.0, &wanted(0.0)).expect("in reach");
    let (mut of_gap, mut of_hand) = ([0.0_f64; 3], [0.0_f64; 2]);
    for step in 0..=2000 {
        let t = 1e-3 * f64::from(step);
        let inputs = wanted(t);
        let solved = motors(ankle.advance(t, &inputs).expect("in reach"));
        let [pitch, roll] = [inputs.wanted_pitch, inputs.wanted_roll];
        for (side, motor) in SIDES.into_iter().zip(solved) {
            let gap = side.gap(jet(pitch), jet(roll), jet(motor)).0;
            for (worst, gap) in of_gap.iter_mut().zip(gap) {
                *worst = worst.max(gap.abs());
            }
            let by_hand = side.motor([pitch, roll].map(|it| [it.value, it.rate]));
            let generated = [motor.value, motor.rate];
            for ((worst, generated), by_hand) in of_hand.iter_mut().zip(generated).zip(by_hand) {
                *worst = worst.max((generated - by_hand).abs());
            }
        }
    }
    println!("residuals in m^2 and its rates: {of_gap:?}; beside the closed form: {of_hand:?}");
    // Squares of 0.22 m, whose rates are 10/s and 100/s².
    assert!(of_gap[0] < 1e-16 && of_gap[1] < 1e-15 && of_gap[2] < 1e-13);
    assert!(of_hand[0] < 1e-13 && of_hand[1] < 1e-12);
}

#[test]
fn the_foot_follows_from_the_cranks_and_both_maps_undo_one_another() {
    let mut there = to_motors::Ankle::assemble(0.0, &wanted(0.0)).expect("in reach");
    let still = to_joint::Inputs::default();
    let mut back = to_joint::Ankle::assemble(0.0, &still).expect("as drawn");
    let mut worst = [0.0_f64; 5];
    let mut first = true;
    for step in 0..=2000 {
        let t = 1e-3 * f64::from(step);
        let inputs = wanted(t);
        let frame = *there.advance(t, &inputs).expect("in reach");
        let [left_motor, right_motor] = motors(&frame);
        let joint_inputs = to_joint::Inputs {
            left_motor,
            right_motor,
            pitch_torque: Signal {
                value: 20.0,
                ..Signal::default()
            },
            roll_torque: Signal {
                value: -7.0,
                ..Signal::default()
            },
        };
        if first {
            back = to_joint::Ankle::assemble(t, &joint_inputs).expect("near the drawing");
            first = false;
        }
        let foot = *back.advance(t, &joint_inputs).expect("in reach");
        let levels = [
            [
                foot.phi_pitch(),
                foot.phi_pitch_rate(),
                foot.phi_pitch_acceleration(),
            ],
            [
                foot.phi_roll(),
                foot.phi_roll_rate(),
                foot.phi_roll_acceleration(),
            ],
        ];
        let [pitch, roll] = [inputs.wanted_pitch, inputs.wanted_roll];
        for (levels, wanted) in levels.iter().zip([pitch, roll]) {
            let expected = [wanted.value, wanted.rate, wanted.acceleration];
            for (order, expected) in expected.into_iter().enumerate() {
                worst[order] = worst[order].max((levels[order] - expected).abs());
            }
        }
        // One map of rates is the inverse of the other.
        let joint = [foot.transmission_phi_pitch(), foot.transmission_phi_roll()];
        let motor = [
            frame.transmission_phi_left(),
            frame.transmission_phi_right(),
        ];
        for (row, own) in joint.iter().enumerate() {
            for column in 0..2 {
                let product: f64 = (0..2).map(|at| own[(0, at)] * motor[at][(0, column)]).sum();
                let unit = f64::from(u8::from(row == column));
                worst[3] = worst[3].max((product - unit).abs());
            }
        }
        // The loads take the power that the motors supply.
        let efforts = [foot.effort_drive_phi_left(), foot.effort_drive_phi_right()];
        let power =
            efforts[0] * left_motor.rate + efforts[1] * right_motor.rate + 20.0 * levels[0][1]
                - 7.0 * levels[1][1];
        worst[4] = worst[4].max(power.abs());
        let loads = [20.0, -7.0];
        for (at, effort) in efforts.into_iter().enumerate() {
            let mapped: f64 = (0..2).map(|row| joint[row][(0, at)] * loads[row]).sum();
            worst[4] = worst[4].max((effort + mapped).abs());
        }
        if step % 100 == 0 {
            let newton = foot_of([left_motor.value, right_motor.value], [0.0, 0.0]);
            assert!((newton[0] - pitch.value).abs() + (newton[1] - roll.value).abs() < 1e-9);
        }
    }
    println!("there and back: value, rate, acceleration, maps, power: {worst:?}");
    assert!(worst[0] < 1e-13 && worst[1] < 1e-12 && worst[2] < 1e-10);
    assert!(worst[3] < 1e-12 && worst[4] < 1e-11);
}

/// At the limit of the crank's range, the path ends, and the failure names the time.
#[test]
fn a_foot_out_of_reach_is_refused_with_the_time_at_which_the_path_ends() {
    let ramp = |t: f64| to_motors::Inputs {
        wanted_pitch: Signal {
            value: t,
            rate: 1.0,
            acceleration: 0.0,
        },
        wanted_roll: Signal::default(),
    };
    let mut ankle = to_motors::Ankle::assemble(0.0, &ramp(0.0)).expect("as drawn");
    let failure = (1..=200)
        .find_map(|step| {
            ankle
                .advance(0.02 * f64::from(step), &ramp(0.02 * f64::from(step)))
                .err()
        })
        .expect("an end");
    assert!(matches!(failure.kind, FailureKind::OutOfReach { .. }));
    // There a b = c: the crank and its rod are collinear.
    let end = failure.time;
    let motor = |pitch: f64| SIDES.map(|side| side.motor([[pitch, 0.0], [0.0, 0.0]])[0]);
    assert!(motor(end - 1e-3).iter().all(|it| it.is_finite()), "{end}");
    assert!(motor(end + 1e-3).iter().any(|it| it.is_nan()), "{end}");
}

/// Values of two coordinates of a four-bar at an instant, with rates and accelerations.
fn four_bar(text: &str, names: [&str; 2], t: f64) -> [[f64; 3]; 2] {
    let solved = Interpreted::new(&written(text)).expect("a plan");
    let at = names.map(|name| {
        let mut all = solved.system().coordinates.iter();
        all.position(|it| it.name == name).expect("a coordinate")
    });
    let mut shell = assembled_from(solved, &[], 0.0, Settings::default()).expect("as drawn");
    let inputs = shell.blocks().initial_inputs();
    shell.advance(t, &inputs).expect("a crank");
    let levels = levels(shell.blocks(), shell.frame());
    at.map(|place| levels.each_ref().map(|values| values[place]))
}

#[test]
fn a_four_bar_of_angles_and_a_rod_is_the_four_bar_of_bodies() {
    // In metres, in micrometres and in hundreds of kilometres.
    for scale in [1.0, 1e-6, 1e5] {
        let [crank, rocker, base] = [0.3, 0.5, 1.0].map(|length| length * scale);
        let rod = 0.9 * scale;
        let angles = format!(
            "mechanism four_bar {{ angle crank = 60deg; angle rocker = 100deg; drive crank = 60deg + 2*t;
            equation rod: distance(({crank}*cos(crank), {crank}*sin(crank)), ({base} + {rocker}*cos(rocker), {rocker}*sin(rocker))) = {rod}; }}"
        );
        let bodies = format!(
            "mechanism four_bar {{ point A = (0, 0), D = ({base}, 0);
            body crank at A turned 60deg {{ A, B: ({crank}, 0) }}
            body rocker at D turned 100deg {{ D, C: ({rocker}, 0) }}
            revolute A(ground, crank); revolute D(ground, rocker);
            relative_distance (crank.B, rocker.C) = {rod}; drive phi(crank) = 60deg + 2*t; }}"
        );
        for t in [0.1, 0.9, 2.3] {
            let names = ["phi_crank", "phi_rocker"];
            let (own, other) = (four_bar(&angles, names, t), four_bar(&bodies, names, t));
            for (own, other) in own.as_flattened().iter().zip(other.as_flattened()) {
                assert!(
                    (own - other).abs() < 1e-12 * other.abs().max(1.0),
                    "{own} for {other}"
                );
            }
        }
    }
}

/// A rod pulls with a force whose moment about the motor is the torque of the motor.
#[test]
fn rods_carry_what_motors_exert() {
    let text = std::fs::read_to_string(files::repository().join("mechanisms/ankle.mech"));
    let text = text.expect("the ankle");
    let text = text.replace("effort;", "effort; reactions;");
    let text = text.replace("pitch_torque = 0Nm", "pitch_torque = 20Nm");
    let text = text.replace("roll_torque = 0Nm", "roll_torque = -7Nm");
    let text = text.replace("left_motor = 0deg", "left_motor = 10deg");
    let derived = &systems("ankle", &text)[1];
    let followed = Followed::new(derived, 0.0).expect("near the drawing");
    let q = followed.instant().q();
    // pitch, roll, left, right
    let [pitch, roll] = [q[0], q[1]].map(Jet::from);
    for (at, (side, name)) in SIDES.into_iter().zip(["left", "right"]).enumerate() {
        let tension = followed.value(&format!("reaction_{name}_side_tension"));
        // d|Q − P|/dθ from the slope of the square, by the length.
        let motor = Jet([q[2 + at], 1.0, 0.0]);
        let slope = side.gap(pitch, roll, motor).0[1] / (2.0 * side.rod());
        let effort = followed.value(&format!("effort_drive_phi_{name}"));
        assert!(tension.abs() > 10.0, "{tension}");
        assert!(
            (tension * slope - effort).abs() < 1e-12 * tension.abs(),
            "{tension} {slope} {effort}"
        );
    }
}
