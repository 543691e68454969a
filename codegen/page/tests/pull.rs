//! Points that are pulled by inputs and by time: positions that can be reached, those that cannot, ends of ranges and assemblies.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use linkwright_page::{Detail, Pull, Pulled, Question, Range, Session};

/// Two links on a pin, with lengths of 1 m and 0.8 m and absolute angles.
const ARM: &str = "
    mechanism arm {
        input a = 30deg;
        input b = 80deg;
        point O = (0, 0);
        body upper at (0, 0, 30deg)       { O: (0, 0), E: (1, 0) }
        body lower at (0.87, 0.5, 80deg)  { E: (0, 0), P: (0.8, 0) }
        revolute O(ground, upper);
        revolute E(upper, lower);
        drive phi(upper) = a;
        drive phi(lower) = b;
    }";

const TURN: [f64; 2] = [-180.0, 180.0];

/// Question that pulls P of a mechanism to a position, from a time of a motion that takes 2 s.
fn question(text: &str, to: [f64; 2], t: f64, ranges: &[(&str, [f64; 2])]) -> Question {
    let ranges = ranges.iter();
    Question {
        text: text.to_string(),
        detail: Detail::Moving,
        range: Range {
            from: 0.0,
            to: 2.0,
            step: 0.02,
        },
        pull: Some(Pull {
            point: "P".to_string(),
            to,
            t,
            ranges: ranges.map(|it| (it.0.to_string(), it.1)).collect(),
        }),
        ..Question::default()
    }
}

fn answer(session: &mut Session, question: &Question) -> Pulled {
    let answer = session.answer(question);
    assert!(answer.messages.is_empty(), "{:?}", answer.messages);
    answer.pulled.expect("a pull")
}

fn pull(text: &str, to: [f64; 2], t: f64, ranges: &[(&str, [f64; 2])]) -> Pulled {
    answer(&mut Session::default(), &question(text, to, t, ranges))
}

/// Returns the value of an input, angles in rad.
fn value(pulled: &Pulled, name: &str) -> f64 {
    let mut values = pulled.values.iter();
    values.find(|it| it.0 == name).expect("the input").1
}

fn angle(pulled: &Pulled, name: &str) -> f64 {
    value(pulled, name).to_radians()
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Closed form of P on the arm.
fn of_arm(a: f64, b: f64) -> [f64; 2] {
    [a.cos() + 0.8 * b.cos(), a.sin() + 0.8 * b.sin()]
}

#[test]
fn two_inputs_reach_a_position_with_the_elbow_on_its_side() {
    let mut worst = 0.0_f64;
    for to in [[1.0, 1.0], [1.5, 0.9], [-0.4, 1.2], [0.25, 0.0]] {
        let pulled = pull(ARM, to, 0.7, &[("a", TURN), ("b", TURN)]);
        let [a, b] = ["a", "b"].map(|it| angle(&pulled, it));
        let distance = apart(of_arm(a, b), to);
        worst = worst.max(distance);
        assert!(distance < 1e-9, "{to:?}: {distance:e}");
        assert!(
            (b - a).sin() > 0.0,
            "{to:?}: the elbow is on the other side"
        );
        assert_eq!(pulled.t, 0.7);
    }
    println!("largest distance {worst:e} m");
}

#[test]
fn a_point_follows_a_pointer_around_its_pin() {
    let all = [("a", [-500.0, 500.0]), ("b", [-500.0, 500.0])];
    let (mut session, mut values) = (Session::default(), BTreeMap::new());
    for step in 0..=40 {
        let around = 1.0 + 0.05 * PI * f64::from(step);
        let to = [1.1 * around.cos(), 1.1 * around.sin()];
        let question = Question {
            values: values.clone(),
            ..question(ARM, to, 0.0, &all)
        };
        let pulled = answer(&mut session, &question);
        let [a, b] = ["a", "b"].map(|it| angle(&pulled, it));
        assert!(apart(of_arm(a, b), to) < 1e-9, "{to:?}");
        assert!(
            (b - a).sin() > 0.0,
            "{to:?}: the elbow is on the other side"
        );
        // Angles are counted on through the turn.
        assert!((a - around).abs() < 1.0, "{a} at {around}");
        values = pulled
            .values
            .iter()
            .map(|(name, it)| (name.clone(), it.to_string()))
            .collect();
    }
}

#[test]
fn a_position_out_of_reach_stretches_the_arm_toward_it() {
    for to in [[3.0, 1.0], [2.0, -0.5], [1.0, 1.6]] {
        let pulled = pull(ARM, to, 0.0, &[("a", TURN), ("b", TURN)]);
        let [a, b] = ["a", "b"].map(|it| angle(&pulled, it));
        let [x, y] = of_arm(a, b);
        let nearest = to[0].hypot(to[1]) - 1.8;
        assert!(
            (pulled.distance - nearest).abs() < 1e-12,
            "{to:?}: {pulled:?}"
        );
        let residual = [x - to[0], y - to[1]];
        for (length, angle) in [(1.0, a), (0.8, b)] {
            let slope = length * (angle.cos() * residual[1] - angle.sin() * residual[0]);
            assert!(slope.abs() < 1e-7, "{to:?}: {slope:e}");
        }
    }
}

#[test]
fn inputs_stay_between_their_ends() {
    let pulled = pull(ARM, [-1.0, 1.0], 0.0, &[("a", [0.0, 60.0]), ("b", TURN)]);
    let [a, b] = ["a", "b"].map(|it| angle(&pulled, it));
    assert!((a - 60.0_f64.to_radians()).abs() < 1e-12, "{pulled:?}");
    // The second link points from its pin toward the position.
    let direction = (1.0 - a.sin()).atan2(-1.0 - a.cos());
    assert!((b - direction).abs() < 1e-9, "{b} is not {direction}");
    let still = pull(ARM, [-1.0, 1.0], 0.0, &[("b", TURN)]);
    assert_eq!(still.values.len(), 1);
}

#[test]
fn redundant_inputs_reach_a_position() {
    let text = ARM
        .replace("input b", "input c = 0;\n        input b")
        .replace(
            "revolute O(ground, upper);",
            "drive x(upper) = c;\n        absolute_y(upper) = 0;",
        );
    let all = [("a", TURN), ("b", TURN), ("c", [-0.5, 0.5])];
    let pulled = pull(&text, [2.1, 0.2], 0.0, &all);
    let [a, b] = ["a", "b"].map(|it| angle(&pulled, it));
    let [x, y] = of_arm(a, b);
    let distance = apart([x + value(&pulled, "c"), y], [2.1, 0.2]);
    assert!(distance < 1e-9, "{distance:e}: {pulled:?}");
}

#[test]
fn time_helps_an_input_that_does_not_suffice() {
    let text = ARM
        .replace("input b = 80deg;", "")
        .replace("= b;", "= 80deg + t;");
    let goal = of_arm(0.9, 80.0_f64.to_radians() + 1.3);
    let pulled = pull(&text, goal, 0.4, &[("a", TURN)]);
    let a = angle(&pulled, "a");
    let distance = apart(of_arm(a, 80.0_f64.to_radians() + pulled.t), goal);
    assert!(distance < 1e-9, "{distance:e}");
    assert!(
        (pulled.t - 1.3).abs() < 1e-9 && (a - 0.9).abs() < 1e-9,
        "{pulled:?}"
    );
    // An input that suffices leaves the time alone.
    let [x, y] = of_arm(0.2, 80.0_f64.to_radians() + 0.4);
    let pulled = pull(&text, [x, y], 0.4, &[("a", TURN)]);
    assert_eq!(pulled.t, 0.4);
    assert!((angle(&pulled, "a") - 0.2).abs() < 1e-9);
}

/// Two cranks on pins at a distance of 1 m, whose ends two rods of 0.9 m join at P.
const FIVE_BAR: &str = "
    mechanism five_bar {
        input a = 100deg;
        input b = 80deg;
        point A = (0, 0), B = (1, 0);
        body left   at (0, 0, 100deg)      { A: (0, 0), C: (0.5, 0) }
        body right  at (1, 0, 80deg)       { B: (0, 0), D: (0.5, 0) }
        body first  at (-0.09, 0.49, 0.85) { C: (0, 0), P: (0.9, 0) }
        body second at (1.09, 0.49, 2.29)  { D: (0, 0), P: (0.9, 0) }
        revolute A(ground, left);
        revolute B(ground, right);
        revolute C(left, first);
        revolute D(right, second);
        revolute P(first, second);
        drive phi(left) = a;
        drive phi(right) = b;
    }";

/// Ends of both cranks, and P in the assembly that points up.
fn of_five_bar(a: f64, b: f64) -> [[f64; 2]; 3] {
    let c = [0.5 * a.cos(), 0.5 * a.sin()];
    let d = [1.0 + 0.5 * b.cos(), 0.5 * b.sin()];
    let [x, y] = [d[0] - c[0], d[1] - c[1]];
    let half = 0.5 * x.hypot(y);
    let height = (0.81 - half * half).sqrt() / (2.0 * half);
    let p = [c[0] + 0.5 * x - height * y, c[1] + 0.5 * y + height * x];
    [c, d, p]
}

#[test]
fn a_loop_stays_in_its_assembly() {
    let all = [("a", [0.0, 180.0]), ("b", [0.0, 180.0])];
    for to in [[0.5, 1.2], [0.3, 0.9], [0.8, 1.1]] {
        let pulled = pull(FIVE_BAR, to, 0.0, &all);
        let [a, b] = ["a", "b"].map(|it| angle(&pulled, it));
        let [_, _, p] = of_five_bar(a, b);
        assert!(apart(p, to) < 1e-9, "{to:?}: {:e}", apart(p, to));
    }
    // The other assembly alone has P down there.
    for to in [[0.5, -1.2], [0.4, -0.2]] {
        let pulled = pull(FIVE_BAR, to, 0.0, &all);
        let [a, b] = ["a", "b"].map(|it| angle(&pulled, it));
        let [_, _, p] = of_five_bar(a, b);
        assert!(
            (apart(p, to) - pulled.distance).abs() < 1e-9,
            "{to:?}: {pulled:?}"
        );
        assert!(
            pulled.distance
                < apart(
                    of_five_bar(100_f64.to_radians(), 80_f64.to_radians())[2],
                    to
                )
        );
    }
}

/// Coupler point of the four-bar linkage of the gallery at a time (s).
fn of_four_bar(t: f64) -> [f64; 2] {
    let crank = 40.0_f64.to_radians() + 3.0 * t;
    let b = [0.04 * crank.cos(), 0.04 * crank.sin()];
    let [x, y] = [0.1 - b[0], -b[1]];
    let distance = x.hypot(y);
    let cosine = (0.12_f64.powi(2) + distance.powi(2) - 0.08_f64.powi(2)) / (0.24 * distance);
    let angle = y.atan2(x) + cosine.acos();
    let (sine, cosine) = angle.sin_cos();
    [
        b[0] + 0.06 * cosine - 0.04 * sine,
        b[1] + 0.06 * sine + 0.04 * cosine,
    ]
}

#[test]
fn a_coupler_point_is_pulled_along_its_path() {
    let text = include_str!("../../../mechanisms/four_bar.mech");
    for (from, to) in [
        (0.1, of_four_bar(0.45)),
        (0.5, [0.06, 0.12]),
        (1.2, [0.0, 0.0]),
        (0.8, [0.03, 0.2]),
    ] {
        let pulled = pull(text, to, from, &[]);
        let t = pulled.t;
        assert!(pulled.values.is_empty());
        let distance = |t: f64| apart(of_four_bar(t), to);
        assert!((pulled.distance - distance(t)).abs() < 1e-12, "{to:?}");
        assert!(distance(t) <= distance(from));
        let [before, after] = [of_four_bar(t - 1e-5), of_four_bar(t + 1e-5)];
        let rate = [0, 1].map(|axis| (after[axis] - before[axis]) / 2e-5);
        let point = of_four_bar(t);
        let slope: f64 = [0, 1]
            .iter()
            .map(|&it| rate[it] * (point[it] - to[it]))
            .sum();
        assert!(slope.abs() < 1e-9, "{to:?}: {slope:e} at {t}");
        assert!(distance(t) <= distance(t - 1e-3) && distance(t) <= distance(t + 1e-3));
    }
    // Beyond the end of the motion the point stays at it.
    let pulled = pull(text, of_four_bar(2.05), 1.9, &[]);
    assert_eq!(pulled.t, 2.0);
}

#[test]
fn a_pull_that_cannot_begin_says_why() {
    let mut question = question(ARM, [f64::NAN, 0.0], 0.0, &[]);
    let answer = Session::default().answer(&question);
    assert_eq!(answer.messages[0].text, "a pull needs finite numbers");
    question.pull = question.pull.map(|it| Pull {
        point: "Q".to_string(),
        ..it
    });
    let answer = Session::default().answer(&question);
    assert_eq!(answer.messages[0].text, "no point is named `Q`");
}
