//! Repetitions and parts, against descriptions that are written by hand and against motions of displaced mechanisms.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::sync::Arc;

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::{Options, format, generate, read};
use linkwright_tests::description;
use linkwright_tests::solver::{Interpreted, Solver};

fn source(text: &str) -> Source {
    Source::new("repeated.mech", text)
}

fn code(text: &str) -> String {
    let source = source(text);
    let generated = generate(&source, &Options::default())
        .unwrap_or_else(|found| panic!("{}", found.render(&source)));
    assert!(generated.warnings.is_empty());
    generated.code().to_string()
}

fn findings(text: &str) -> Diagnostics {
    generate(&source(text), &Options::default()).expect_err("an error")
}

/// Ladder of parallelograms, each on top of the last one.
fn ladder(rungs: usize) -> String {
    format!(
        "mechanism ladder {{
            const rungs = {rungs};
            param width = 0.5;
            repeat i from 0 to rungs {{
                point L[i] = (0, 0.3*i), R[i] = (width, 0.3*i);
            }}
            repeat i from 1 to rungs {{
                body left[i] at L[i - 1] facing L[i - 1] -> L[i] {{ L[i - 1], L[i] }}
                body right[i] at R[i - 1] facing R[i - 1] -> R[i] {{ R[i - 1], R[i] }}
                body rung[i] at L[i] {{ L[i], R[i] }}
                revolute L[i](left[i], rung[i]);
                revolute R[i](right[i], rung[i]);
                drive phi(left[i]) = 90deg + 0.1*i*sin(t);
            }}
            revolute L[0](ground, left[1]);
            revolute R[0](ground, right[1]);
            repeat i from 2 to rungs {{
                revolute L[i - 1](rung[i - 1], left[i]);
                revolute R[i - 1](rung[i - 1], right[i]);
            }}
            output L[rungs];
        }}"
    )
}

/// The ladder, every statement by hand.
fn ladder_by_hand(rungs: usize) -> String {
    let mut text = "mechanism ladder {\nparam width = 0.5;\n".to_string();
    for i in 0..=rungs {
        let _ = writeln!(text, "point L{i} = (0, 0.3*{i}), R{i} = (width, 0.3*{i});");
    }
    for i in 1..=rungs {
        let below = i - 1;
        let _ = writeln!(
            text,
            "body left{i} at L{below} facing L{below} -> L{i} {{ L{below}, L{i} }}
             body right{i} at R{below} facing R{below} -> R{i} {{ R{below}, R{i} }}
             body rung{i} at L{i} {{ L{i}, R{i} }}
             revolute L{i}(left{i}, rung{i});
             revolute R{i}(right{i}, rung{i});
             drive phi(left{i}) = 90deg + 0.1*{i}*sin(t);"
        );
    }
    text.push_str("revolute L0(ground, left1);\nrevolute R0(ground, right1);\n");
    for i in 2..=rungs {
        let below = i - 1;
        let _ = writeln!(
            text,
            "revolute L{below}(rung{below}, left{i});
             revolute R{below}(rung{below}, right{i});"
        );
    }
    let _ = writeln!(text, "output L{rungs}; }}");
    text
}

#[test]
fn a_repetition_is_what_is_written_by_hand() {
    for rungs in [1, 2, 5] {
        assert_eq!(
            code(&ladder(rungs)),
            code(&ladder_by_hand(rungs)),
            "{rungs}"
        );
    }
}

/// Statements of the scissor lift between its documentation and its driver.
const SCISSOR: &str = "
    point A = (0, 0), B = (0.8, 0);
    repeat i from 1 to 6 {
        point M[i] = (0.4, 0.6*i - 0.3), L[i] = (0, 0.6*i), R[i] = (0.8, 0.6*i);
    }

    /// The moving end of the cylinder.
    body shoe at B { B }
    body rising[1] at M[1] facing A -> R[1] { A, M[1], R[1] }
    body falling[1] at M[1] facing B -> L[1] { B, M[1], L[1] }
    repeat i from 2 to 6 {
        body rising[i] at M[i] facing L[i - 1] -> R[i] { L[i - 1], M[i], R[i] }
        body falling[i] at M[i] facing R[i - 1] -> L[i] { R[i - 1], M[i], L[i] }
    }

    revolute A(ground, rising[1]);
    translational (ground, shoe) along A -> B;
    revolute B(shoe, falling[1]);
    revolute M[1](rising[1], falling[1]);
    repeat i from 2 to 6 {
        revolute L[i - 1](falling[i - 1], rising[i]);
        revolute R[i - 1](rising[i - 1], falling[i]);
        revolute M[i](rising[i], falling[i]);
    }
";

#[test]
fn the_scissor_lift_can_be_written_with_repetitions() {
    let by_hand = description::source("scissor").text;
    let (before, rest) = by_hand.split_once("    point A").expect("points");
    let (_, driver) = rest.split_once("    drive").expect("a driver");
    let repeated = format!("{before}{SCISSOR}    drive{driver}");
    assert_eq!(code(&repeated), code(&by_hand));
}

#[test]
fn the_code_grows_by_the_same_amount_with_every_repetition() {
    // Names of one length and numbers of one number of digits.
    let lines = [20, 40, 60].map(|rungs| code(&ladder(rungs)).lines().count());
    let [first, second] = [lines[1] - lines[0], lines[2] - lines[1]];
    assert!(
        first.abs_diff(second) * 50 <= first,
        "{lines:?}: {first} lines more, then {second}"
    );
}

/// Crank rocker with a coupler point and a spring; its driver stands outside.
const LEG: &str = "
mechanism leg {
    param crank_length = 20mm;
    const reach = 30mm;
    point A = (0, 0), B = (0, crank_length), C = (80mm, 60mm), D = (80mm, 0);
    body crank at A { A, B }
    body coupler at B facing B -> C { B, C, K: (50mm, reach) }
    body rocker at (80mm, 0, 90deg) { C, D }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(rocker, ground);
    spring (ground.A, coupler.K) = 200 free 40mm;
}
";

#[test]
fn a_part_moves_as_it_does_alone_where_it_is_and_as_it_is_turned() {
    let alone = format!(
        "{} drive phi(crank) = 3*t; effort; }}",
        LEG.trim().trim_end_matches('}')
    );
    let mut alone = Interpreted::of(&description::written(&alone));
    let (x, y, turn) = (0.3, -0.2, 25.0_f64.to_radians());
    let text = format!(
        "{LEG} mechanism stand {{
            repeat i from 1 to 2 {{
                part leg[i] = leg(reach = 30mm) at (0.3, -0.2) turned 25deg;
                drive phi(leg[i].crank) = 3*t + 25deg;
            }}
            effort;
        }}"
    );
    let mut placed = Interpreted::of(&description::written(&text));
    alone.assemble(0.0);
    placed.assemble(0.0);
    let (sine, cosine) = turn.sin_cos();
    for step in 0..=100 {
        let t = f64::from(step) * 0.03;
        alone.advance(t);
        placed.advance(t);
        for point in ["B", "C", "K"] {
            let reference = alone.point(point);
            let there = placed.point(&format!("leg2_{point}"));
            for (reference, there, origin) in [
                (reference.position, there.position, [x, y]),
                (reference.velocity, there.velocity, [0.0, 0.0]),
                (reference.acceleration, there.acceleration, [0.0, 0.0]),
            ] {
                let turned = [
                    origin[0] + cosine * reference[0] - sine * reference[1],
                    origin[1] + sine * reference[0] + cosine * reference[1],
                ];
                let error = (turned[0] - there[0]).hypot(turned[1] - there[1]);
                let size = 1.0 + reference[0].hypot(reference[1]);
                assert!(error < 1e-13 * size, "{point} at {t}: {error}");
            }
        }
    }
}

#[test]
fn a_part_has_the_values_that_it_is_given() {
    let text = format!(
        "{LEG} mechanism stand {{
            param long = 24mm;
            part short = leg(crank_length = 12mm);
            part other = leg(crank_length = long, reach = 10mm) at (0, 1);
            drive phi(short.crank) = t;
            drive phi(other.crank) = t;
        }}"
    );
    let derived = description::written(&text);
    let parameters: Vec<&str> = derived
        .system
        .mechanism
        .parameters
        .iter()
        .map(|it| it.name.as_str())
        .collect();
    assert_eq!(parameters, ["long"]);
    let mut view = Interpreted::of(&derived);
    view.assemble(0.0);
    let crank = |view: &Interpreted, name: &str, y: f64| {
        let place = view.point(name).position;
        place[0].hypot(place[1] - y)
    };
    assert!((crank(&view, "short_B", 0.0) - 0.012).abs() < 1e-15);
    assert!((crank(&view, "other_B", 1.0) - 0.024).abs() < 1e-15);
    let [b, k] = ["other_B", "other_K"].map(|it| view.point(it).position);
    let reach = (k[0] - b[0]).hypot(k[1] - b[1]);
    assert!((reach - 0.05_f64.hypot(0.01)).abs() < 1e-15, "{reach}");
}

#[test]
fn a_part_knows_nothing_of_what_stands_around_it() {
    let text = "mechanism cell {
            point A = (0, 0), B = (gap, 0);
            body rod at A { A, B }
            revolute A(ground, rod);
        }
        mechanism whole {
            const gap = 2;
            point B = (5, 5);
            repeat i from 1 to 40 { part cell[i] = cell; drive phi(cell[i].rod) = t; }
        }";
    let errors = findings(text).into_sorted();
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert_eq!(errors[0].message, "no constant is named `cell[1].gap`");
    let line = &text[errors[0].primary.span.range()];
    assert_eq!(line, "gap");
    assert_eq!(errors[0].notes, ["this holds for 39 more copies, too"]);
}

#[test]
fn missing_equations_are_named_as_written() {
    let text = format!(
        "{LEG} mechanism stand {{
            repeat i from 1 to 2 {{ part leg[i] = leg at (0, i); }}
            drive phi(leg[1].crank) = t;
        }}"
    );
    let source = source(&text);
    let message = generate(&source, &Options::default())
        .expect_err("one leg has no driver")
        .render(&source);
    assert!(message.contains("`leg[2].crank`"), "{message}");
    assert!(!message.contains("`leg2_crank`"), "{message}");
}

#[test]
fn a_text_that_repeats_too_much_is_refused_at_once() {
    for text in [
        "mechanism m { repeat i from 1 to 9999999999 {} }",
        "mechanism m { repeat i from 1 to 300 { repeat j from 1 to 300 { const c[i][j] = 1; } } }",
        "mechanism a { point P = (0, 0), Q = (1, 0); body rod at P { P, Q } }
         mechanism b { repeat i from 1 to 99 { part a[i] = a; } }
         mechanism c { repeat i from 1 to 99 { part b[i] = b; } }
         mechanism d { repeat i from 1 to 99 { part c[i] = c; } }",
    ] {
        let errors = findings(text).into_sorted();
        assert_eq!(errors[0].code.name(), "K37", "{text}: {errors:?}");
    }
    // Each line is twice the one above, and the first is empty.
    let mut doubled = "mechanism a0 {}".to_string();
    for level in 1..=60 {
        let above = level - 1;
        let _ = writeln!(
            doubled,
            "mechanism a{level} {{ part x = a{above}; part y = a{above}; }}"
        );
    }
    let errors = findings(&doubled);
    assert!(
        errors.iter().any(|it| it.code.name() == "K37"),
        "{errors:?}"
    );
}

#[test]
fn a_walk_of_three_hundred_cells_is_solved() {
    // Every cell is turned by its number and stands on the last one: the end of the chain in closed form.
    let cells = 300;
    let text = format!(
        "mechanism cell {{ const k = 1; point A = (0, 0), B = (0.1, 0); body rod at A {{ A, B }} }}
        mechanism chain {{
            const n = {cells};
            repeat i from 1 to n {{
                part cell[i] = cell(k = i) at (0.1*(i - 1), 0);
                drive phi(cell[i].rod) = 0.01*i*t;
            }}
            revolute (ground.cell[1].A, cell[1].rod.A);
            repeat i from 2 to n {{ revolute (cell[i - 1].rod.B, cell[i].rod.A); }}
        }}"
    );
    let mut view = Interpreted::of(&description::written(&text));
    view.assemble(0.0);
    view.advance(0.5);
    let end = view.point(&format!("cell{cells}_B")).position;
    let mut sum = [0.0; 2];
    for i in 1..=cells {
        let (sine, cosine) = (0.005 * f64::from(i)).sin_cos();
        sum = [sum[0] + 0.1 * cosine, sum[1] + 0.1 * sine];
    }
    let error = (sum[0] - end[0]).hypot(sum[1] - end[1]);
    assert!(error < 1e-12, "{error}");
    assert!(
        sum[0].hypot(sum[1]) < 0.1 * f64::from(cells) / PI * 3.0,
        "it is bent"
    );
}

#[test]
fn repeated_descriptions_are_formatted_and_mean_the_same() {
    let untidy = ladder(3).replace("    ", "").replace(" - ", "-");
    let tidy = format(&source(&untidy)).expect("it can be read");
    assert_eq!(format(&source(&tidy)).expect("it can be read"), tidy);
    assert!(
        tidy.contains(
            "    repeat i from 2 to rungs {\n        revolute L[i - 1](rung[i - 1], left[i]);\n"
        ),
        "{tidy}"
    );
    assert_eq!(code(&tidy), code(&ladder(3)));
}

/// Every motion is a mechanism of its own: copied names of all others would grow with the square of their number.
#[test]
fn motions_that_are_written_out_share_the_spellings_of_names() {
    let text = "mechanism many {
        body b at (0, 0);
        absolute_x(b) = 0;
        absolute_y(b) = 0;
        repeat i from 1 to 5 { motion m[i] { drive phi(b) = t; } }
    }";
    let read =
        read(&source(text)).unwrap_or_else(|found| panic!("{}", found.render(&source(text))));
    assert_eq!(read.motions.len(), 5);
    for pair in read.motions.windows(2) {
        let [first, second] = [&pair[0], &pair[1]].map(|it| &it.system.mechanism.spellings);
        assert_eq!(first["m3"], "m[3]");
        assert!(Arc::ptr_eq(first, second));
    }
}
