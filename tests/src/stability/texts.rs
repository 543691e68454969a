//! Hard numbers in the text of a description: refused with a code, failed, or solved within the bound.

use std::rc::Rc;

use linkwright::{Frame, Settings};
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::textbook::TextbookEquations;
use nalgebra::DVector;

use super::blocks::Blocks;
use super::sample::{Sample, named};
use super::truth::{Given, Truth};
use super::verdict::{Judge, Scalar, Verdict, Way, exact};

/// A four-bar linkage with these texts for its lengths, which start at the texts for two coordinates.
fn four_bar([g, l1, l2, l3]: [&str; 4], place: &str) -> String {
    format!(
        "mechanism text {{
    const g = {g};
    const l1 = {l1};
    const l2 = {l2};
    const l3 = {l3};
    const x0 = {place};
    point A = (x0, x0), D = (x0 + g, x0);
    body crank   at (x0, x0, 0.7)                   {{ A: (0, 0), B: (l1, 0) }}
    body coupler at (x0 + 0.3*g, x0 + 0.25*g, 0.35) {{ B: (0, 0), C: (l2, 0) }}
    body rocker  at (x0 + g, x0, 1)                 {{ D: (0, 0), C: (l3, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = 0.7 + t;
}}
"
    )
}

/// Cases: the difficulty, and the text.
pub fn cases() -> Vec<(String, String)> {
    let mut cases = Vec::new();
    for exponent in [
        -320, -310, -300, -200, -160, -150, -100, -30, -15, -9, -3, 0, 3, 9, 15, 30, 100, 150, 160,
        200, 300, 306, 400,
    ] {
        let scaled = |digits: &str| format!("{digits}e{exponent}");
        let [g, l1, l2, l3] = ["1", "0.4", "1.2", "0.8"].map(scaled);
        cases.push((
            format!("size 1e{exponent} m"),
            four_bar([&g, &l1, &l2, &l3], "0"),
        ));
    }
    for place in ["1e3", "1e6", "1e9", "1e12", "1e15", "1e18"] {
        let text = four_bar(["1", "0.4", "1.2", "0.8"], place);
        cases.push((format!("{place} m off the origin"), text));
    }
    let digits =
        "0.40000000000000000000000000000000000000000000000000000000000000000000000000000001";
    let more: [(&str, [&str; 4]); 8] = [
        ("a length of 80 digits", ["1", digits, "1.2", "0.8"]),
        ("a crank of no length", ["1", "0", "1.2", "0.8"]),
        ("a coupler of no length", ["1", "0.4", "0", "0.8"]),
        ("a rocker of no length", ["1", "0.4", "1.2", "0"]),
        ("a ground link of no length", ["0", "0.4", "1.2", "0.8"]),
        ("all pins in one point", ["0", "0", "0", "0"]),
        ("a denormal crank", ["1", "1e-310", "1.2", "0.8"]),
        ("a crank beyond all numbers", ["1", "1e309", "1.2", "0.8"]),
    ];
    for (name, lengths) in more {
        cases.push((name.to_string(), four_bar(lengths, "0")));
    }
    let facing = "mechanism text {
    point A = (0, 0), B = (0, 0);
    body 1 at A facing A -> B { A, B }
    revolute A(ground, 1);
    drive phi(1) = t;
}
";
    cases.push((
        "a direction between two equal points".to_string(),
        facing.to_string(),
    ));
    cases
}

/// Verdict on a text, and the finding that refuses it.
pub fn judged(text: &str) -> (Verdict, Option<String>) {
    let refused = |first: &str| {
        let verdict = Verdict::Failed {
            kind: first.to_string(),
            solved: 0,
            cause: None,
        };
        (verdict, Some(first.to_string()))
    };
    let source = Source::new("text.mech", text);
    let first_line = |rendered: String| rendered.lines().next().unwrap_or_default().to_string();
    let read = match linkwright_codegen::read(&source) {
        Ok(read) => read,
        Err(errors) => return refused(&first_line(errors.render(&source))),
    };
    let derived = read.only().expect("one motion");
    if let Err(errors) = linkwright_codegen::stages::check(&derived) {
        return refused(&first_line(errors.render(&source)));
    }
    let truth = Truth::new(&derived);
    let Some(blocks) = Blocks::new(&derived) else {
        return refused("no plan");
    };
    let interpreter = TextbookEquations::new(&derived.pool, &derived.system);
    let start: Vec<f64> = interpreter.estimate().iter().copied().collect();
    let sample = Sample {
        x: 0.0,
        parameters: Vec::new(),
        times: vec![0.0],
        fine: 1,
        signals: Rc::new(|_| Vec::new()),
        estimate: start.clone(),
        start,
        length: truth.length(&Given::default()),
    };
    let exact = exact(&truth, &sample, Scalar::F64);
    let judge = Judge {
        truth: &truth,
        blocks: &blocks,
        scalar: Scalar::F64,
    };
    let solve = |sample: &Sample| {
        let start = DVector::from_column_slice(&sample.estimate);
        let solved = Frame::assemble(&interpreter, &start, 0.0, &Settings::default());
        let levels = solved
            .map(|frame| [&frame.q, &frame.qd, &frame.qdd].map(|it| it.iter().copied().collect()));
        vec![levels.map_err(|failure| named(failure.kind).to_string())]
    };
    (
        judge.judge_outcomes(&sample, &exact, Way::Plain, solve(&sample)),
        None,
    )
}
