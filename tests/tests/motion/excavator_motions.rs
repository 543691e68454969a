//! The excavator driven from either end: one motion inverts the other.

use linkwright::{PointMotion, Signal};
use linkwright_mechanisms::excavator_motions::{forward, reach};
use linkwright_tests::swing::swing;

/// The distance between two points that move.
fn length(from: PointMotion, to: PointMotion) -> Signal {
    let gap = |one: [f64; 2], other: [f64; 2]| [other[0] - one[0], other[1] - one[1]];
    let dot = |one: [f64; 2], other: [f64; 2]| one[0] * other[0] + one[1] * other[1];
    let r = gap(from.position, to.position);
    let v = gap(from.velocity, to.velocity);
    let a = gap(from.acceleration, to.acceleration);
    let value = r[0].hypot(r[1]);
    let rate = dot(r, v) / value;
    Signal {
        value,
        rate,
        acceleration: (dot(v, v) + dot(r, a) - rate * rate) / value,
    }
}

/// The largest differences of value, rate and acceleration so far.
fn compare(largest: &mut [f64; 3], one: Signal, other: Signal) {
    let pairs = [
        (one.value, other.value),
        (one.rate, other.rate),
        (one.acceleration, other.acceleration),
    ];
    for (largest, (one, other)) in largest.iter_mut().zip(pairs) {
        *largest = largest.max((one - other).abs());
    }
}

/// One coordinate of a point as a signal.
fn component(point: PointMotion, axis: usize) -> Signal {
    Signal {
        value: point.position[axis],
        rate: point.velocity[axis],
        acceleration: point.acceleration[axis],
    }
}

#[test]
fn lengths_to_the_tool_and_back_are_the_same_lengths() {
    let (boom, stick) = (0.8_f64.hypot(0.2), 1.0_f64.hypot(0.4));
    let lengths = |t: f64| forward::Inputs {
        boom: swing(boom, 0.05, 1.5, t),
        stick: swing(stick, 0.05, 1.5, t),
    };
    let mut there = forward::ExcavatorMotions::assemble(0.0, &lengths(0.0)).expect("as drawn");
    let mut back =
        reach::ExcavatorMotions::assemble(0.0, &reach::Inputs::default()).expect("as drawn");
    let mut largest = [0.0; 3];
    for step in 0..=500 {
        let t = 0.01 * f64::from(step);
        let lengths_now = lengths(t);
        let tool = there.advance(t, &lengths_now).expect("it moves").point_k();
        let requested = reach::Inputs {
            tool_x: component(tool, 0),
            tool_y: component(tool, 1),
        };
        let frame = back.advance(t, &requested).expect("the tool is in reach");
        compare(
            &mut largest,
            length(frame.point_n(), frame.point_m()),
            lengths_now.boom,
        );
        compare(
            &mut largest,
            length(frame.point_h(), frame.point_g()),
            lengths_now.stick,
        );
    }
    println!("lengths there and back: {largest:?}");
    assert!(largest.iter().all(|difference| *difference <= 1e-12));
}

#[test]
fn the_tool_to_lengths_and_back_is_the_same_path() {
    // An ellipse about the design position of the tool.
    let path = |t: f64| {
        let start = std::f64::consts::FRAC_PI_2;
        let shifted = swing(0.0, 0.04, 1.0, t + start);
        reach::Inputs {
            tool_x: Signal {
                value: shifted.value - 0.04 - 1.2,
                ..shifted
            },
            tool_y: swing(0.6, 0.06, 1.0, t),
        }
    };
    let mut back = reach::ExcavatorMotions::assemble(0.0, &path(0.0)).expect("as drawn");
    let mut there =
        forward::ExcavatorMotions::assemble(0.0, &forward::Inputs::default()).expect("as drawn");
    let mut largest = [0.0; 3];
    for step in 0..=630 {
        let t = 0.01 * f64::from(step);
        let requested = path(t);
        let frame = back.advance(t, &requested).expect("the tool is in reach");
        let lengths = forward::Inputs {
            boom: length(frame.point_n(), frame.point_m()),
            stick: length(frame.point_h(), frame.point_g()),
        };
        let tool = there.advance(t, &lengths).expect("it moves").point_k();
        compare(&mut largest, component(tool, 0), requested.tool_x);
        compare(&mut largest, component(tool, 1), requested.tool_y);
    }
    println!("the tool's path there and back: {largest:?}");
    assert!(largest.iter().all(|difference| *difference <= 1e-12));
}
