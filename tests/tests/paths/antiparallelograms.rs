//! Antiparallelograms whose cranks turn at very different rates where all links are in line.
//!
//! Around a ground of length g cranks of length r turn by tan(φ/2) = −(g + r)/(g − r) tan(φ₀/2): the nearer both lengths are, the
//! faster is the second crank where the first one passes the ground.

use linkwright::{Blocks as _, Settings, Shell};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::read;
use linkwright_solver::{Interpreted, View as _};
use linkwright_tests::values::assembled_from;

const CRANK: f64 = 0.1;

/// When the first crank passes the ground (s), which turns by 1 rad/s.
const TIME: f64 = 0.25;

/// Distances of a frame from that instant (s).
const OFFSETS: [f64; 13] = [
    0.0, 1e-12, -1e-12, 1e-8, -1e-8, 1e-5, -1e-5, 1e-4, -1e-4, 1e-3, -1e-3, 1e-2, -1e-2,
];

/// Steps (s).
const STEPS: [f64; 5] = [1.5e-4, 1e-3, 5e-3, 0.02, 0.2];

/// The ratio of tan(φ/2) of both cranks around a ground.
fn ratio(ground: f64) -> f64 {
    -(ground + CRANK) / (ground - CRANK)
}

/// Angles of all cranks after the first one: each turns with the one before it, and the last one with the first.
fn angles(grounds: &[f64], t: f64) -> Vec<f64> {
    let mut tangent = (0.5 * (t - TIME)).tan();
    let turned = grounds.iter().map(|ground| {
        tangent *= ratio(*ground);
        2.0 * tangent.atan()
    });
    turned.chain([t - TIME]).collect()
}

/// Antiparallelograms one after another, and a parallelogram over all of them.
fn blocks(grounds: &[f64], start: f64) -> Interpreted {
    let all: f64 = grounds.iter().sum();
    let mut angles = angles(grounds, start);
    angles.insert(0, start - TIME);
    let count = angles.len();
    let mut text = String::from("mechanism row {\n");
    let mut places = vec![0.0];
    places.extend(grounds.iter().scan(0.0, |sum, ground| {
        *sum += ground;
        Some(*sum)
    }));
    places.push(all + 0.1);
    let end = |k: usize| {
        let (sine, cosine) = angles[k].sin_cos();
        [places[k] + CRANK * cosine, CRANK * sine]
    };
    for k in 0..count {
        let (place, angle) = (places[k], angles[k]);
        text += &format!(
            "point D{k} = ({place:?}, 0); body crank{k} at D{k} turned {angle:?} {{ D{k}, P: ({CRANK}, 0) }} revolute D{k}(ground, crank{k});\n"
        );
        if k > 0 {
            let from = if k + 1 == count { 0 } else { k - 1 };
            let [[x, y], [to_x, to_y]] = [end(from), end(k)];
            let length = places[k] - places[from];
            let angle = (to_y - y).atan2(to_x - x);
            text += &format!(
                "body rod{k} at ({x:?}, {y:?}, {angle:?}) {{ P: (0, 0), Q: ({length:?}, 0) }} revolute (crank{from}.P, rod{k}.P); revolute (rod{k}.Q, crank{k}.P);\n"
            );
        }
    }
    text += &format!("drive phi(crank0) = t - {TIME};\n}}");
    let derived = read(&Source::new("row.mech", text)).expect("no errors");
    Interpreted::new(&derived.only().expect("one motion")).expect("its blocks")
}

/// Number of frames beyond the pose in which all links are in line, of four that are asked for; each must be right.
fn passed(grounds: &[f64], step: f64, offset: f64) -> usize {
    let at = |k: i32| TIME + offset + f64::from(k) * step;
    let before = ((0.02 / step).ceil() as i32).clamp(1, 20);
    let blocks = blocks(grounds, at(-before));
    let coordinates = &blocks.system().coordinates;
    let names = (1..grounds.len() + 2).map(|k| format!("phi_crank{k}"));
    let places = names.map(|name| coordinates.iter().position(|it| it.name == name));
    let places: Vec<usize> = places.map(|it| it.expect("an angle")).collect();
    let shell = assembled_from(blocks.clone(), &[], at(-before), Settings::default());
    let mut shell: Shell<Interpreted> = shell.expect("as drawn");
    let mut beyond = 0;
    for k in 1 - before..=4 {
        let Ok(frame) = shell.advance(at(k), &blocks.initial_inputs()) else {
            break;
        };
        for (place, expected) in places.iter().zip(angles(grounds, at(k))) {
            let coordinate = frame.q()[*place];
            let case = format!("{grounds:?}, step {step}, offset {offset}, frame {k}");
            assert!(
                (coordinate - expected).abs() < 1e-6,
                "{case}: {coordinate} instead of {expected}"
            );
        }
        beyond += usize::from(k > 0);
    }
    beyond
}

/// The second crank is at most twice as fast as the first one: no frame is refused.
#[test]
fn a_crank_of_a_similar_rate_goes_straight_on() {
    for step in STEPS {
        for offset in OFFSETS {
            assert_eq!(passed(&[0.3], step, offset), 4, "{step} {offset}");
        }
    }
}

/// Cranks that are up to 88 times as fast as the first one: no frame is wrong, and small steps lead through.
#[test]
fn cranks_of_very_different_rates_are_never_elsewhere() {
    let mut reached = 0;
    for grounds in [&[0.1023][..], &[0.3, 0.106], &[0.11, 0.25], &[0.16, 0.11]] {
        for step in STEPS {
            for offset in OFFSETS {
                reached += passed(grounds, step, offset);
            }
        }
    }
    assert!(reached > 400, "{reached}");
}
