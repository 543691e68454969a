//! Laws of motion against the closed forms and definitions of the literature, and their derivatives against differences.

use std::f64::consts::PI;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::read;
use linkwright_codegen::stages::expr::Tape;

use linkwright_tests::files;
use linkwright_tests::law::Law;
use linkwright_tests::random::Random;

mod generated {
    linkwright::include_mechanism!(laws);
}

mod pieces {
    linkwright::include_mechanism!(pieces);
}

/// Each rise from (x0, h0) = (1, 0.5) to (x1, h1) = (3, 2): s = (t − 1)/2, and one unit of y is 3/2.
fn rise(law: &str) -> Law {
    Law::new(&format!("{law}(t, 1, 0.5, 3, 2)"))
}

const HEIGHT: f64 = 1.5;
const LENGTH: f64 = 2.0;

fn close(found: f64, expected: f64, scale: f64, what: &str) {
    assert!(
        (found - expected).abs() <= 1e-14 * scale,
        "{what}: {found} instead of {expected}"
    );
}

/// Name of a law and its y, y', y'' in s.
type Closed = (&'static str, fn(f64) -> [f64; 3]);

const CLOSED: [Closed; 8] = [
    ("step", cubic),
    ("havsin", half_cosine),
    ("simple_harmonic", half_cosine),
    ("step5", quintic),
    ("poly345", quintic),
    ("poly4567", septic),
    ("cycloidal", |s| {
        let angle = 2.0 * PI * s;
        [
            s - angle.sin() / (2.0 * PI),
            1.0 - angle.cos(),
            2.0 * PI * angle.sin(),
        ]
    }),
    ("step", |s| {
        // The function reference of ADAMS: a Δ² (3 − 2 Δ).
        [s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s), 6.0 - 12.0 * s]
    }),
];

fn cubic(s: f64) -> [f64; 3] {
    [
        3.0 * s.powi(2) - 2.0 * s.powi(3),
        6.0 * s - 6.0 * s.powi(2),
        6.0 - 12.0 * s,
    ]
}

fn half_cosine(s: f64) -> [f64; 3] {
    // ADAMS: (h0 + h1)/2 + (h1 − h0)/2 sin(π s − π/2).
    let angle = PI * s - PI / 2.0;
    [
        0.5 + 0.5 * angle.sin(),
        0.5 * PI * angle.cos(),
        -0.5 * PI * PI * angle.sin(),
    ]
}

fn quintic(s: f64) -> [f64; 3] {
    [
        s.powi(3) * (10.0 + s * (6.0 * s - 15.0)),
        30.0 * (s * (1.0 - s)).powi(2),
        60.0 * s * (1.0 - s) * (1.0 - 2.0 * s),
    ]
}

fn septic(s: f64) -> [f64; 3] {
    [
        s.powi(4) * (35.0 + s * (-84.0 + s * (70.0 - 20.0 * s))),
        140.0 * (s * (1.0 - s)).powi(3),
        420.0 * (s * (1.0 - s)).powi(2) * (1.0 - 2.0 * s),
    ]
}

#[test]
fn a_rise_follows_its_closed_form_and_rests_before_and_after() {
    for (law, closed) in CLOSED {
        let motion = rise(law);
        for step in -20..=120 {
            let s = f64::from(step) / 100.0;
            let values = motion.at(1.0 + LENGTH * s);
            let expected = if step < 0 {
                [0.0; 3]
            } else if step < 100 {
                closed(s)
            } else {
                [1.0, 0.0, 0.0]
            };
            // The terms of a polynomial are as large as its coefficients.
            let scales = [300.0, 3000.0, 20000.0];
            for order in 0..3 {
                let height = if order == 0 { 0.5 } else { 0.0 };
                let expected = height + HEIGHT * expected[order] / LENGTH.powi(order as i32);
                let what = format!("{law}, order {order}, s = {s}");
                close(values[order], expected, scales[order], &what);
            }
        }
    }
}

/// The acceleration y'' by which Norton defines the modified trapezoid and the modified sine.
fn norton(b: f64, d: f64, peak: f64, s: f64) -> f64 {
    if s < b / 2.0 {
        peak * (PI * s / b).sin()
    } else if s < (1.0 - d) / 2.0 {
        peak
    } else if s < (1.0 + d) / 2.0 {
        peak * (PI / d * (s - (1.0 - d) / 2.0)).cos()
    } else if s < 1.0 - b / 2.0 {
        -peak
    } else {
        peak * (PI / b * (s - 1.0)).sin()
    }
}

#[test]
fn the_modified_laws_have_the_acceleration_that_defines_them() {
    // Peaks of acceleration and velocity: Norton, Cam Design and Manufacturing Handbook, table 3-1.
    let laws = [
        ("modified_trapezoid", 0.25, 0.25, 4.888_123, 2.0),
        ("modified_sine", 0.25, 0.75, 5.527_957, 1.759_603),
    ];
    for (law, b, d, peak, velocity) in laws {
        let motion = rise(law);
        // Rounded up to seven digits in the book.
        let mut largest = [0.0_f64; 2];
        // y and y' by Simpson's rule over y'', whose pieces end on the steps.
        let (mut y, mut slope) = (0.0, 0.0);
        let steps = 800;
        let width = 1.0 / f64::from(steps);
        for step in 0..steps {
            let s = f64::from(step) * width;
            let values = motion.at(1.0 + LENGTH * (s + 0.5 * width));
            let acceleration = values[2] * LENGTH * LENGTH / HEIGHT;
            let expected = norton(b, d, peak, s + 0.5 * width);
            assert!(
                (acceleration - expected).abs() < 1e-6 * peak,
                "{law}, s = {s}"
            );
            let start = motion.at(1.0 + LENGTH * s);
            let [value, rate] = [(start[0] - 0.5) / HEIGHT, start[1] * LENGTH / HEIGHT];
            assert!(
                (value - y).abs() < 1e-6 && (rate - slope).abs() < 1e-6,
                "{law}, s = {s}"
            );
            largest = [largest[0].max(acceleration.abs()), largest[1].max(rate)];
            // Samples from the interior keep a jump at the end of a piece.
            let ends = [1e-12, 1.0 - 1e-12].map(|end| norton(b, d, peak, s + end * width));
            let middle = norton(b, d, peak, s + 0.5 * width);
            y += slope * width + width * width * (ends[0] + 2.0 * middle) / 6.0;
            slope += width * (ends[0] + 4.0 * middle + ends[1]) / 6.0;
        }
        assert!(
            (y - 1.0).abs() < 1e-6 && slope.abs() < 1e-6,
            "{law}: {y}, {slope}"
        );
        assert!((largest[0] - peak).abs() < 1e-4, "{law}: {largest:?}");
        assert!((largest[1] - velocity).abs() < 1e-4, "{law}: {largest:?}");
    }
}

/// Number of derivatives that vanish at the ends, from the first on.
const REST: [(&str, usize); 7] = [
    ("step", 1),
    ("simple_harmonic", 1),
    ("poly345", 2),
    ("cycloidal", 2),
    ("modified_trapezoid", 2),
    ("modified_sine", 2),
    ("poly4567", 3),
];

#[test]
fn the_ends_rest_as_the_law_says_and_no_more() {
    for (law, resting) in REST {
        let motion = rise(law);
        // Just inside, within the pieces of the rise; a derivative that vanishes is as small as the distance.
        let inside = [1.0 + 1e-9, 3.0 - 1e-9].map(|t| motion.at(t));
        for (end, height) in inside.iter().zip([0.5, 2.0]) {
            assert!((end[0] - height).abs() < 1e-8, "{law}: {end:?}");
            for (order, derivative) in end.iter().enumerate().skip(1) {
                let vanishes = derivative.abs() < 1e-5;
                assert!(
                    if order <= resting {
                        vanishes
                    } else {
                        order > resting + 1 || !vanishes
                    },
                    "{law}, order {order}: {derivative}"
                );
            }
        }
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let mut random = Random::new(5);
    let written = [
        "step(t, 1, 0.5, 3, 2)",
        "step(sin(t), -0.5, 0.5, 0.5, 2)",
        "poly4567(t^2, 1, 0.5, 9, 2)",
        "cycloidal(t, 1, 0.5, 3, 2)",
        "modified_trapezoid(t, 1, 0.5, 3, 2)",
        "modified_sine(t, 1, 0.5, 3, 2)",
        "havsin(t, 1, cos(t), 3, sin(t))",
        "sequence(t, modified_sine, (0, 0), (1, 1), (2, 1), (4, 0), periodic)",
        "polynomial(t, 1, 2, 3, 4, 5)",
        "harmonic(t, 1, 2, 3, 4, 5)",
    ];
    for text in written {
        let motion = Law::new(text);
        let step = 1e-3;
        let mut compared = 0;
        for _ in 0..400 {
            let t = random.between(0.0, 6.0);
            // Where a derivative jumps nearby, by more than the next one explains, a difference is meaningless.
            let stencil = [-2.0, -1.0, 1.0, 2.0].map(|side| motion.at(t + side * step));
            let here = motion.at(t);
            let jumps = (1..5).any(|order| {
                let size = |of: usize| stencil.iter().map(|it| it[of].abs()).fold(1e-9, f64::max);
                let moved = stencil.iter().map(|it| (it[order] - here[order]).abs());
                // The fifth derivative is not available; where the fourth is smooth it changes little.
                let explained = if order < 4 {
                    3.0 * step * size(order + 1)
                } else {
                    0.1 * (1.0 + size(4))
                };
                moved.fold(0.0, f64::max) > explained
            });
            if jumps {
                continue;
            }
            compared += 1;
            for order in 0..3 {
                let [a, b, c, d] = stencil.map(|it| it[order]);
                let quotient = (a - 8.0 * b + 8.0 * c - d) / (12.0 * step);
                let scale = 1.0 + here[order + 1].abs();
                assert!(
                    (quotient - here[order + 1]).abs() < 1e-6 * scale,
                    "{text}, order {order} at {t}: {quotient} and {}",
                    here[order + 1]
                );
            }
        }
        assert!(compared > 300, "{text}: {compared}");
    }
}

#[test]
fn a_sequence_goes_through_its_stations_and_repeats() {
    let motion = Law::new("sequence(t, cycloidal, (1, 0.2), (2, 1), (3, 1), (5, 0.2), periodic)");
    let once = Law::new("sequence(t, cycloidal, (1, 0.2), (2, 1), (3, 1), (5, 0.2))");
    for (t, height) in [
        (1.0, 0.2),
        (2.0, 1.0),
        (2.4, 1.0),
        (3.0, 1.0),
        (4.0, 0.6),
        (5.0, 0.2),
    ] {
        for found in [
            motion.at(t)[0],
            once.at(t)[0],
            motion.at(t + 8.0)[0],
            motion.at(t - 12.0)[0],
        ] {
            close(found, height, 10.0, &format!("t = {t}"));
        }
    }
    assert_eq!(once.at(-3.0), [0.2, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(once.at(7.0), [0.2, 0.0, 0.0, 0.0, 0.0]);
    // The fall takes twice the time of the rise.
    close(
        motion.at(4.0)[1],
        -0.8,
        10.0,
        "velocity in the middle of the fall",
    );
    close(
        motion.at(1.5)[1],
        1.6,
        10.0,
        "velocity in the middle of the rise",
    );
}

#[test]
fn series_are_what_the_function_reference_says() {
    let polynomial = Law::new("polynomial(t, 2, 3, 5, 7)");
    close(
        polynomial.at(4.0)[0],
        3.0 + 5.0 * 2.0 + 7.0 * 4.0,
        100.0,
        "POLY",
    );
    let harmonic = Law::new("harmonic(t, 2, 3, 5, 7, 11)");
    let angle = 5.0 * (4.0 - 2.0) - 7.0_f64;
    close(harmonic.at(4.0)[0], 3.0 * angle.sin() + 11.0, 100.0, "SHF");
    close(harmonic.at(4.0)[1], 15.0 * angle.cos(), 100.0, "SHF");
}

#[test]
fn generated_code_agrees_with_the_interpreter() {
    let path = files::package("descriptions").join("laws.mech");
    let text = std::fs::read_to_string(path).expect("the description");
    let source = Source::new("laws.mech", text);
    let read = read(&source).unwrap_or_else(|found| panic!("{}", found.render(&source)));
    let derived = read.only().expect("one motion");
    let rows = &derived.system.rows;
    let roots: Vec<_> = rows
        .iter()
        .flat_map(|row| [row.residual, row.time_derivative, row.gamma])
        .collect();
    let tape = Tape::new(&derived.pool.graph, &roots);
    let mut symbols = vec![0.0; derived.pool.graph.symbol_count()];
    let mut values = vec![0.0; roots.len()];
    let zero = generated::Coordinates::from_array([0.0; 9]);
    let mut moved = generated::Laws::assemble(-1.0).expect("the drawing assembles");
    for step in -300..=1500 {
        // Ends of pieces are among these times.
        let t = f64::from(step) / 200.0;
        symbols[derived.system.mechanism.time.index()] = t;
        tape.evaluate(&symbols, &mut Vec::new(), &mut values);
        let (phi, phi_t) = (generated::phi(&zero, t), generated::phi_t(&zero, t));
        let gamma = generated::gamma(&zero, &zero, t);
        for (row, name) in rows.iter().map(|row| &row.name).enumerate() {
            for (found, expected) in [phi[row], phi_t[row], gamma[row]]
                .iter()
                .zip(&values[3 * row..])
            {
                close(*found, *expected, 1000.0, &format!("{name} at {t}"));
            }
        }
        // The solved formulation has the values of the drivers' rows at q = 0: f(t), f'(t) and f''(t).
        let frame = moved.advance(t).expect("the motion can be followed");
        let levels = [
            [frame.q.phi_crank, frame.qd.phi_crank, frame.qdd.phi_crank],
            [frame.q.x_slide, frame.qd.x_slide, frame.qdd.x_slide],
            [frame.q.phi_table, frame.qd.phi_table, frame.qdd.phi_table],
        ];
        for (levels, row) in levels.iter().zip([2, 5, 8]) {
            let expected = [-values[3 * row], -values[3 * row + 1], values[3 * row + 2]];
            for (levels, expected) in levels.iter().zip(expected) {
                close(*levels, expected, 1000.0, &format!("row {row} at {t}"));
            }
        }
    }
}

#[test]
fn pieces_are_what_their_conditions_say() {
    let mut mechanism = pieces::Pieces::assemble(-1.0).expect("the drawing assembles");
    for step in -200..=1200 {
        let t = f64::from(step) / 200.0;
        let frame = mechanism.advance(t).expect("the motion can be followed");
        let s = t / 2.0;
        let expected = if t < 0.0 {
            0.0
        } else if t <= 2.0 {
            quintic(s)[0] + 3.0 * s.powi(3) * (1.0 - s).powi(3)
        } else {
            1.0 + 0.5 * (t - 2.0).powi(3) / (1.0 + (t - 2.0).powi(2))
        };
        close(frame.q.phi_crank, expected, 100.0, &format!("angle at {t}"));
        // t³ − 3t² + 4t meets t + 1 at t = 1 with the same tangent and without curvature.
        let expected = if t > 1.0 {
            [
                t * t * t - 3.0 * t * t + 4.0 * t,
                3.0 * t * t - 6.0 * t + 4.0,
                6.0 * t - 6.0,
            ]
        } else {
            [t + 1.0, 1.0, 0.0]
        };
        let slide = [frame.q.x_slide - 1.0, frame.qd.x_slide, frame.qdd.x_slide];
        for (slide, expected) in slide.iter().zip(expected) {
            close(*slide, 0.1 * expected, 1000.0, &format!("length at {t}"));
        }
    }
}

/// Findings about a driven angle.
fn findings(written: &str) -> String {
    let text = format!(
        "mechanism case {{ param L = 2s; body 1 at (0, 0); absolute_x(1) = 0; absolute_y(1) = 0; drive phi(1) = {written}; }}"
    );
    let source = Source::new("case.mech", text);
    match read(&source) {
        Ok(read) => read.warnings.render(&source),
        Err(found) => found.render(&source),
    }
}

#[test]
fn a_jump_is_named_with_its_place_and_both_sides() {
    let cases = [
        (
            "if t < 2s { t } else { 5 }",
            "error[K28]: the value jumps from 2 to 5 at t = 2",
        ),
        (
            "if t >= L { t } else { 5 }",
            "error[K28]: the value jumps from 5 to 2 at t = 2",
        ),
        (
            "if 4s - 2*t < 0 { 2*t } else { t + 2 }",
            "warning[K28]: the first derivative jumps from 1 to 2 at t = 2",
        ),
        (
            "if t <= L { t^2 } else { 4*t - 4 }",
            "warning[K28]: the second derivative jumps from 2 to 0 at t = 2",
        ),
        (
            "if t < 1s { 0 } else if t < 2s { t - 1 } else { 7 }",
            "error[K28]: the value jumps from 1 to 7 at t = 2",
        ),
        (
            "if sin(t) < 0 { t } else { t }",
            "error[K30]: the place where this condition changes is not a closed form",
        ),
    ];
    for (written, expected) in cases {
        let messages = findings(written);
        assert!(messages.contains(expected), "{written}:\n{messages}");
    }
    let smooth = [
        "if t < L { t^3 } else { t^3 + (t - L)^3 }",
        "if t < 2s { step(t, 0s, 0, 1s, 1) } else { 1 }",
        // The inner boundary is never reached.
        "if t < 2s { if t < 3s { 1 } else { t } } else { 1 }",
        // Rounding of sines does not count as a jump.
        "if t < 1s { sin(pi*t/3) } else { sin(pi*t/3) + (t - 1)^3 }",
    ];
    for written in smooth {
        let messages = findings(written);
        assert!(!messages.contains("K28"), "{written}:\n{messages}");
    }
}
