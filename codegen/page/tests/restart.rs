//! Points of mechanisms that forces move: a pull moves free coordinates, and the motion starts again from their pose.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use linkwright_page::{Answer, Detail, Pull, Pulled, Question, Range, Session};

const MASS: f64 = 3.0;
const LENGTH: f64 = 2.0;
const INERTIA: f64 = 0.5;
const GRAVITY: f64 = 9.81;

const PENDULUM: &str = "
    mechanism pendulum {
        point O = (0, 0);
        body bob at O { O, S: (0, -2) }
        revolute O(ground, bob);
        free swing: phi(bob) = 30deg;
        mass bob = 3kg at S inertia 0.5;
        gravity = (0, -9.81);
    }";

/// Question about a motion of 4 s.
fn question(text: &str) -> Question {
    Question {
        text: text.to_string(),
        range: Range {
            from: 0.0,
            to: 4.0,
            step: 0.02,
        },
        ..Question::default()
    }
}

/// Question that pulls a point to a position, from a time of the motion.
fn pull(question: &Question, point: &str, to: [f64; 2], t: f64, detail: Detail) -> Question {
    Question {
        detail,
        pull: Some(Pull {
            point: point.to_string(),
            to,
            t,
            ranges: BTreeMap::new(),
        }),
        ..question.clone()
    }
}

fn answer(session: &mut Session, question: &Question) -> (Answer, Pulled) {
    let mut answer = session.answer(question);
    assert!(answer.messages.is_empty(), "{:?}", answer.messages);
    let pulled = answer.pulled.take().expect("a pull");
    assert!(pulled.starts && pulled.t == 0.0, "{pulled:?}");
    (answer, pulled)
}

/// Returns the question after a pull, as a page asks it.
fn released(question: &Question, pulled: &Pulled) -> Question {
    let values = pulled.values.iter();
    Question {
        pull: None,
        detail: Detail::Resting,
        values: values
            .map(|(name, it)| (name.clone(), it.to_string()))
            .collect(),
        assembly: pulled.assembly.clone().or(question.assembly.clone()),
        ..question.clone()
    }
}

/// Returns columns of the motion of a question.
fn columns<const N: usize>(
    session: &mut Session,
    question: &Question,
    names: [&str; N],
) -> Vec<[f64; N]> {
    let table = session.table(question).expect("a motion");
    let mut lines = table.lines().map(|it| it.split(','));
    let header: Vec<&str> = lines.next().expect("a header").collect();
    let place = |name: &str| header.iter().position(|it| *it == name);
    let places = names.map(|it| place(it).unwrap_or_else(|| panic!("{it} in {header:?}")));
    lines
        .map(|line| {
            let cells: Vec<&str> = line.collect();
            places.map(|it| cells[it].parse().expect("a number"))
        })
        .collect()
}

/// Returns the times of the first motion of an answer.
fn times(answer: &Answer) -> Vec<f64> {
    let json = serde_json::to_value(answer).expect("JSON");
    let times = json["assemblies"][0]["times"].as_array().expect("a motion");
    times.iter().filter_map(|it| it.as_f64()).collect()
}

#[test]
fn a_pendulum_is_lifted_to_the_direction_of_the_pointer() {
    let mut worst = 0.0_f64;
    let mut session = Session::default();
    for to in [[1.2, -0.7], [2.5, 1.0], [-0.3, -1.9], [0.1, -3.0]] {
        for t in [0.0, 0.7, 3.1] {
            let question = pull(&question(PENDULUM), "S", to, t, Detail::Moving);
            let (answer, pulled) = answer(&mut session, &question);
            let swing = pulled.values[0].1.to_radians();
            let error = (swing - to[0].atan2(-to[1])).abs();
            worst = worst.max(error);
            assert!(error < 1e-9, "{to:?} from {t} s: {error:e}");
            let rest = (to[0].hypot(to[1]) - LENGTH).abs();
            assert!((pulled.distance - rest).abs() < 1e-9, "{pulled:?}");
            // The motion waits at the pose until the point is released.
            assert_eq!(times(&answer), [0.0]);
        }
    }
    println!("largest error {worst:e} rad");
}

#[test]
fn a_released_pendulum_starts_at_rest_and_keeps_its_energy() {
    let mut session = Session::default();
    let question = question(PENDULUM);
    let lift = pull(&question, "S", [1.9, 0.4], 1.3, Detail::Resting);
    let (answer, pulled) = answer(&mut session, &lift);
    assert_eq!(times(&answer).len(), 201);
    let question = released(&question, &pulled);
    let motion = columns(&mut session, &question, ["t", "phi_bob", "phi_bob_d"]);
    assert_eq!(motion.len(), 201);
    let angle = 1.9_f64.atan2(-0.4);
    let [t, start, rate] = motion[0];
    assert_eq!([t, rate], [0.0, 0.0]);
    assert!((start - angle).abs() < 1e-9, "{start}");
    let about_pin = INERTIA + MASS * LENGTH * LENGTH;
    let energy = |[_, phi, rate]: [f64; 3]| {
        0.5 * about_pin * rate * rate - MASS * GRAVITY * LENGTH * phi.cos()
    };
    let all = motion.iter().map(|it| energy(*it) - energy(motion[0]));
    let drift = all.fold(0.0, |most: f64, it| most.max(it.abs()));
    println!("energy changes by {drift:e} J");
    assert!(drift < 1e-7, "{drift:e} J");
    let fastest = motion.iter().map(|it| it[2].abs()).fold(0.0, f64::max);
    let expected = (2.0 * MASS * GRAVITY * LENGTH * (1.0 - angle.cos()) / about_pin).sqrt();
    assert!((fastest - expected).abs() < 1e-2 * expected, "{fastest}");
}

#[test]
fn a_starting_rate_of_the_description_stays() {
    let text = PENDULUM
        .replace("30deg;", "30deg rate push;")
        .replace("point O", "param push = 1.5;\n        point O");
    let mut session = Session::default();
    let mut question = question(&text);
    question.values.insert("push".to_string(), "2".to_string());
    let (_, pulled) = answer(
        &mut session,
        &pull(&question, "S", [2.0, 0.0], 0.4, Detail::Moving),
    );
    let mut question = released(&question, &pulled);
    question.values.insert("push".to_string(), "2".to_string());
    let motion = columns(&mut session, &question, ["phi_bob", "phi_bob_d"]);
    assert!((motion[0][0] - 0.5 * PI).abs() < 1e-9, "{:?}", motion[0]);
    assert_eq!(motion[0][1], 2.0);
}

#[test]
fn a_pendulum_is_turned_over_its_pin() {
    let (mut session, mut next) = (Session::default(), question(PENDULUM));
    for step in 0..=60 {
        let around = 0.5 + 0.05 * PI * f64::from(step);
        let to = [LENGTH * around.sin(), -LENGTH * around.cos()];
        let (_, pulled) = answer(&mut session, &pull(&next, "S", to, 0.0, Detail::Moving));
        let swing = pulled.values[0].1.to_radians();
        assert!((swing - around).abs() < 1e-8, "{swing} at {around}");
        next = released(&next, &pulled);
    }
}

/// Crank and connecting rod, whose piston begins with a rate.
const ENGINE: &str = "
    mechanism engine {
        point O = (0, 0), A = (0.06, 0.08), B = (0.4, 0);
        body crank at O facing O -> A { O, A }
        body rod at A facing A -> B { A, B }
        body piston at B { B }
        revolute O(ground, crank);
        revolute A(crank, rod);
        revolute B(rod, piston);
        absolute_y(piston) = 0;
        absolute_angle(piston) = 0;
        free stroke: x(piston) = 0.4 rate -1;
        mass crank = 2kg at O inertia 0.02;
        mass piston = 0.5kg at B;
    }";

#[test]
fn a_motion_starts_again_in_the_assembly_that_it_has_reached() {
    let mut session = Session::default();
    let question = question(ENGINE);
    let names = ["t", "x_piston", "phi_crank"];
    let motion = columns(&mut session, &question, names);
    // The crank has passed the dead center on the left and points down.
    let below = motion.iter().find(|it| it[2].sin() < -0.5);
    let [t, x, phi] = *below.expect("the crank turns");
    let lift = pull(&question, "B", [x + 0.004, 0.0], t, Detail::Moving);
    let (_, pulled) = answer(&mut session, &lift);
    assert!(
        pulled.assembly.is_some() && pulled.distance < 1e-12,
        "{pulled:?}"
    );
    let question = released(&question, &pulled);
    let [_, start, crank] = columns(&mut session, &question, names)[0];
    assert!((start - x - 0.004).abs() < 1e-12, "{start}");
    let rod = 0.34_f64.hypot(0.08);
    let cosine = (start * start + 0.01 - rod * rod) / (0.2 * start);
    assert!((crank.cos() - cosine).abs() < 1e-9, "{crank}");
    assert!(crank.sin() < 0.0, "{crank} after {phi}");
}

#[test]
fn a_free_coordinate_stays_within_reach_of_its_links() {
    let mut session = Session::default();
    let lift = pull(&question(ENGINE), "B", [1.0, 0.0], 0.0, Detail::Moving);
    let (_, pulled) = answer(&mut session, &lift);
    let longest = 0.1 + 0.34_f64.hypot(0.08);
    let stroke = pulled.values[0].1;
    assert!(stroke > 0.4 && stroke < longest, "{pulled:?}");
    assert!(longest - stroke < 1e-2, "{pulled:?}");
    assert!((pulled.distance - (1.0 - stroke)).abs() < 1e-12);
}

/// Pendulum on a slider that follows the time.
const CARRIED: &str = "
    mechanism carried {
        point O = (0, 0);
        body slider at O { O }
        body bob at O { O, S: (0, -1) }
        absolute_y(slider) = 0;
        absolute_angle(slider) = 0;
        revolute O(slider, bob);
        drive x(slider) = 0.3*sin(4*t);
        free swing: phi(bob) = 10deg;
        mass bob = 1kg at S;
        gravity = (0, -9.81);
    }";

#[test]
fn drivers_return_to_the_start_of_the_motion() {
    let mut session = Session::default();
    let lift = pull(&question(CARRIED), "S", [0.6, -0.8], 0.4, Detail::Moving);
    let (_, pulled) = answer(&mut session, &lift);
    let swing = pulled.values[0].1.to_radians();
    assert!((swing - 0.6_f64.atan2(0.8)).abs() < 1e-9, "{pulled:?}");
}

#[test]
fn a_pull_needs_finite_numbers() {
    for (to, t) in [([f64::NAN, 0.0], 0.0), ([1.0, 0.0], f64::NAN)] {
        let question = pull(&question(PENDULUM), "S", to, t, Detail::Moving);
        let answer = Session::default().answer(&question);
        assert_eq!(answer.messages[0].text, "a pull needs finite numbers");
    }
}

#[test]
fn a_motion_under_forces_begins_at_zero() {
    let mut question = question(PENDULUM);
    question.range.from = 1.0;
    let answer = Session::default().answer(&question);
    assert_eq!(
        answer.messages[0].text,
        "moves under forces from t = 0 s on, and not from t = 1 s: set the first time to 0 s"
    );
}
