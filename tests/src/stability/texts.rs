//! Hard numbers in the text of a description: *a text* → *refused with a code, failed, or solved within the bound*.

use linkwright::{Settings, assemble};
use linkwright_cli::interpreter::Interpreter;
use linkwright_codegen::diagnostic::Source;

use super::precise::Precise;
use super::sample::named;
use super::truth::{Given, Truth};
use super::verdict::Verdict;

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

/// The cases: what is hard, and the text.
pub fn cases() -> Vec<(String, String)> {
    let mut cases = Vec::new();
    for exponent in [
        -320, -310, -300, -200, -160, -150, -100, -30, -15, -9, -3, 0, 3, 9, 15, 30, 100, 150, 160,
        200, 300, 308, 400,
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

/// What becomes of a text, in words, and whether it is wrong.
pub fn judged(text: &str) -> (String, Verdict) {
    let failed = |kind: String, exists| Verdict::Failed {
        kind,
        solved: 0,
        exists,
    };
    let source = Source::new("text.mech", text);
    let read = match linkwright_codegen::read(&source) {
        Ok(read) => read,
        Err(errors) => {
            let rendered = errors.render(&source);
            let first = rendered.lines().next().unwrap_or_default().to_string();
            return (first.clone(), failed(first, false));
        }
    };
    let system = read.only().expect("one motion");
    if let Err(errors) = linkwright_codegen::check(&system) {
        let rendered = errors.render(&source);
        let first = rendered.lines().next().unwrap_or_default().to_string();
        return (first.clone(), failed(first, false));
    }
    let interpreter = Interpreter::new(&system);
    let truth = Truth::new(&system);
    let solved = assemble(
        &interpreter,
        interpreter.estimate(),
        0.0,
        &Settings::default(),
    );
    let frame = match solved {
        Ok(frame) => frame,
        Err(failure) => {
            let kind = named(failure.kind).to_string();
            return (kind.clone(), failed(kind, true));
        }
    };
    let start: Vec<Precise> = frame.q.iter().map(|it| Precise::from_f64(*it)).collect();
    let given = Given::default();
    let wrong = |why: String| (format!("WRONG: {why}"), Verdict::Wrong { why });
    let Some(exact) = truth.solve(&given, &start) else {
        return wrong("a pose where there is none".to_string());
    };
    let length = system.mechanism.characteristic_length;
    let bounds = truth.bounds(&given, &exact, length, f64::EPSILON);
    let scales = truth.scales(length);
    let levels = [&frame.q, &frame.qd, &frame.qdd];
    let (mut error, mut bound, mut ratio) = (0.0_f64, 0.0_f64, 0.0_f64);
    for level in 0..3 {
        for (place, found) in levels[level].iter().enumerate() {
            let off = Precise::from_f64(*found).minus(&exact.levels[level][place]);
            let off = off.to_f64().abs();
            let limit = bounds[level][place].max(1e-60 * exact.levels[level][place].to_f64().abs());
            // No comparison with NaN holds, so that is wrong too.
            let within = off <= limit;
            if !within {
                return wrong(format!(
                    "level {level}, coordinate {place}: off by {off:.1e}, allowed {limit:.1e}"
                ));
            }
            if limit > 0.0 {
                ratio = ratio.max(off / limit);
            }
            if level == 0 {
                error = error.max(off / scales[place]);
                bound = bound.max(limit / scales[place]);
            }
        }
    }
    (
        format!("solved: {error:.1e} of {bound:.1e}"),
        Verdict::Solved {
            error,
            bound,
            ratio,
        },
    )
}
