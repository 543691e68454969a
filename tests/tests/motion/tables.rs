//! Tables: the spline through given points against closed forms, and the generated code against the interpreter.

use std::f64::consts::{PI, TAU};

use linkwright_codegen::Options;
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::expr::Tape;

use linkwright_tests::description;
use linkwright_tests::law::Law;
use linkwright_tests::random::Random;

mod generated {
    linkwright::include_mechanism!(tables);
}

mod single {
    linkwright::include_mechanism!(tables_single);
}

mod of_file {
    linkwright::include_mechanism!(table_of_file);
}

mod from_elsewhere {
    linkwright::include_mechanism!(periodic_from_elsewhere);
}

fn close(found: f64, expected: f64, bound: f64, what: &str) {
    assert!(
        (found - expected).abs() <= bound,
        "{what}: {found} instead of {expected}"
    );
}

/// Table as a function of t.
fn table(points: &[[f64; 2]], ends: &str) -> Law {
    let points: Vec<String> = points
        .iter()
        .map(|[x, y]| format!("({x:e}, {y:e})"))
        .collect();
    let statement = format!("table f = [{}] {ends};", points.join(", "));
    Law::with(&statement, "f(t)")
}

#[test]
fn a_cubic_with_its_slopes_at_the_ends_is_reproduced() {
    let cubic = |x: f64| {
        [
            1.0 + x * (-2.0 + x * (0.5 + x * 0.25)),
            -2.0 + x * (1.0 + x * 0.75),
            1.0 + 1.5 * x,
            1.5,
            0.0,
        ]
    };
    let places = [-1.0, 0.0, 0.5, 2.0, 3.0];
    let points = places.map(|x| [x, cubic(x)[0]]);
    let slopes = [-1.0, 3.0].map(|x| cubic(x)[1]);
    let motion = table(
        &points,
        &format!("clamped({:e}, {:e})", slopes[0], slopes[1]),
    );
    for step in 0..400 {
        let x = -1.0 + f64::from(step) / 100.0;
        for (order, (found, expected)) in motion.at(x).iter().zip(cubic(x)).enumerate() {
            close(*found, expected, 1e-13, &format!("order {order} at {x}"));
        }
    }
    // Outside, the tangent continues.
    for (end, x) in [(-1.0, -3.5), (3.0, 7.25)] {
        let [value, slope, ..] = cubic(end);
        let continued = motion.at(x);
        close(
            continued[0],
            value + slope * (x - end),
            1e-12,
            "a continuation",
        );
        close(continued[1], slope, 1e-13, "its slope");
        assert_eq!(continued[2..], [0.0; 3]);
    }
}

/// Points of `periodic_from_elsewhere`. The second derivative at the boundary of two periods follows from an
/// independent solution: 70/11 1/s², by the three equations of the ring (de Boor, chapter IV), solved by hand with
/// 0.3, 0.4 and 0.3 s between points.
const SWING: [[f64; 2]; 4] = [[0.2, 0.0], [0.5, 0.6], [0.9, -0.3], [1.2, 0.0]];
const SWING_SECOND: f64 = 70.0 / 11.0;

#[test]
fn a_periodic_table_is_smooth_at_its_boundaries_wherever_it_begins() {
    let motion = table(&SWING, "periodic");
    let mut swing = from_elsewhere::PeriodicFromElsewhere::assemble(0.2).expect("an angle");
    for period in 0..200 {
        let boundary = 0.2 + f64::from(period);
        for t in [boundary.next_down(), boundary, boundary.next_up()] {
            if t < 0.2 {
                continue;
            }
            let [value, slope, second, ..] = motion.at(t);
            close(value, 0.0, 1e-11, &format!("the value at {t}"));
            close(
                second,
                SWING_SECOND,
                1e-9,
                &format!("the second derivative at {t}"),
            );
            let frame = swing.advance(t).expect("it swings");
            assert_eq!(
                [frame.q.phi_a, frame.qd.phi_a, frame.qdd.phi_a],
                [value, slope, second],
                "{t}"
            );
        }
    }
}

/// A spline has a continuous second derivative: beside a boundary it differs by the third one times the distance at
/// most.
#[test]
fn periodic_tables_of_random_places_are_smooth_at_their_boundaries() {
    const BESIDE: f64 = 1e-5;
    let mut random = Random::new(32);
    let mut looked_at = 0;
    for _ in 0..60 {
        let first = random.between(-3.0, 3.0);
        let widths = [0; 4].map(|_| random.between(0.1, 0.7));
        let heights = [0; 3].map(|_| random.between(-1.0, 1.0));
        let mut points = vec![[first, 0.0]];
        for (place, width) in widths.into_iter().enumerate() {
            let [last, _] = points[place];
            points.push([last + width, heights.get(place).copied().unwrap_or(0.0)]);
        }
        let period = points[4][0] - first;
        let motion = table(&points, "periodic");
        for number in -30..30 {
            let boundary = first + f64::from(number) * period;
            let around = [-BESIDE, 0.0, BESIDE].map(|beside| motion.at(boundary + beside));
            let third = around
                .iter()
                .fold(0.0_f64, |most, it| most.max(it[3].abs()));
            let bound = 2.0 * BESIDE * third + 1e-9;
            for beside in [around[0], around[2]] {
                let gap = (around[1][2] - beside[2]).abs();
                assert!(
                    gap <= bound,
                    "{gap:e} over {bound:e} at {boundary} of {points:?}"
                );
                looked_at += 1;
            }
        }
    }
    assert_eq!(looked_at, 7200);
}

/// Samples of the sine over one turn, with this number of pieces.
fn sine(pieces: u32, ends: &str) -> (f64, Law) {
    let width = TAU / f64::from(pieces);
    let points: Vec<[f64; 2]> = (0..=pieces)
        .map(|place| {
            let x = width * f64::from(place);
            // The last sample is the first one, as a periodic table requires.
            [x, if place == pieces { 0.0 } else { x.sin() }]
        })
        .collect();
    (width, table(&points, ends))
}

#[test]
fn a_sampled_sine_is_met_to_the_order_of_truncation() {
    // Hall & Meyer, Optimal error bounds for cubic spline interpolation, J. Approx. Theory 16 (1976): with the slopes at the
    // ends the errors are at most c hᵏ max|f⁗|, and the first two constants cannot be improved.
    let bounds = [(5.0 / 384.0, 4), (1.0 / 24.0, 3), (3.0 / 8.0, 2)];
    let exact = |x: f64| [x.sin(), x.cos(), -x.sin()];
    for ends in ["clamped(1, 1)", "periodic"] {
        let mut errors = Vec::new();
        for pieces in [16, 32, 64] {
            let (width, motion) = sine(pieces, ends);
            let mut largest = [0.0_f64; 3];
            for step in 0..=4000 {
                let x = TAU * f64::from(step) / 4000.0;
                for (order, expected) in exact(x).iter().enumerate() {
                    let error = (motion.at(x)[order] - expected).abs();
                    largest[order] = largest[order].max(error);
                }
            }
            for (order, (constant, power)) in bounds.iter().enumerate() {
                let bound = constant * width.powi(*power);
                let error = largest[order];
                assert!(
                    error <= bound + 1e-14,
                    "{ends}, order {order}: {error:e}, {bound:e}"
                );
                assert!(
                    error >= 0.1 * bound,
                    "{ends}, order {order}: {error:e}, {bound:e}"
                );
            }
            errors.push(largest);
        }
        for pair in errors.windows(2) {
            for (order, power) in [4.0, 3.0, 2.0].iter().enumerate() {
                let order_of_convergence = (pair[0][order] / pair[1][order]).log2();
                close(
                    order_of_convergence,
                    *power,
                    0.1,
                    &format!("{ends}: the power of order {order}"),
                );
            }
        }
    }
}

/// Points at unequal distances, with equal first and last values.
const UNEQUAL: [[f64; 2]; 6] = [
    [-0.5, 0.25],
    [0.25, 1.5],
    [1.0, -0.75],
    [1.125, -0.5],
    [2.5, 3.0],
    [3.5, 0.25],
];

#[test]
fn pieces_join_in_value_slope_and_curvature_but_not_beyond() {
    for (ends, [before, after]) in [
        ("", [-3.0, 6.5]),
        ("natural", [-3.0, 6.5]),
        ("clamped(2, -1)", [-3.0, 6.5]),
        ("periodic", [-4.5, 7.5]),
    ] {
        let motion = table(&UNEQUAL, ends);
        let mut jumps = 0;
        for (place, [x, y]) in UNEQUAL.into_iter().enumerate() {
            let [left, right] = [x.next_down(), x].map(|x| motion.at(x));
            close(right[0], y, 1e-14, "the value at a point");
            let is_end = place == 0 || place == UNEQUAL.len() - 1;
            // Beside clamped ends the table continues straight.
            let smooth = if is_end && ends.starts_with("clamped") {
                2
            } else {
                3
            };
            for order in 0..smooth {
                close(
                    left[order],
                    right[order],
                    1e-12,
                    &format!("{ends}, order {order} at {x}"),
                );
            }
            jumps += usize::from((left[3] - right[3]).abs() > 1.0);
        }
        assert!(
            jumps >= 4,
            "{ends}: the third derivative jumps {jumps} times"
        );
        if ends == "periodic" {
            continue;
        }
        let [first, last] = [before, after].map(|x| motion.at(x));
        assert_eq!([first[2], first[3], last[2], last[3]], [0.0; 4], "{ends}");
        let [start, end] = [UNEQUAL[0], UNEQUAL[5]];
        close(
            first[0],
            start[1] + first[1] * (before - start[0]),
            1e-12,
            "before",
        );
        close(last[0], end[1] + last[1] * (after - end[0]), 1e-12, "after");
        if ends.starts_with("clamped") {
            assert_eq!([first[1], last[1]], [2.0, -1.0]);
        } else {
            let [from, to] = [start[0], end[0]].map(|x| motion.at(x)[2]);
            assert_eq!([from, to], [0.0; 2]);
        }
    }
    // The default of `clamped` is rest.
    let resting = table(&UNEQUAL, "clamped");
    assert_eq!([resting.at(-7.0)[1], resting.at(9.0)[1]], [0.0; 2]);
}

#[test]
fn few_points_give_what_they_must() {
    let line = table(&[[1.0, 2.0], [3.0, 8.0]], "");
    for x in [-4.0, 1.0, 1.5, 3.0, 10.0] {
        assert_eq!(line.at(x), [2.0 + 3.0 * (x - 1.0), 3.0, 0.0, 0.0, 0.0]);
    }
    // Hermite: 3 s² − 2 s³.
    let rise = table(&[[0.0, 0.0], [1.0, 1.0]], "clamped");
    for s in [0.0, 0.25, 0.5, 0.875_f64] {
        close(rise.at(s)[0], s * s * (3.0 - 2.0 * s), 1e-15, "a rise");
    }
    // Two pieces of one period, by symmetry 1 − 6 s² + 4 s³ up to half a period.
    let wave = table(&[[0.0, 1.0], [1.0, -1.0], [2.0, 1.0]], "periodic");
    for s in [0.0, 0.25, 0.5, 1.0_f64] {
        let expected = 1.0 - 6.0 * s * s + 4.0 * s.powi(3);
        close(wave.at(s)[0], expected, 1e-14, "a wave");
        close(wave.at(2.0 - s)[0], expected, 1e-14, "its other half");
    }
}

#[test]
fn a_periodic_table_repeats_itself() {
    let motion = table(&UNEQUAL, "periodic");
    for step in 0..400 {
        let x = -0.5 + f64::from(step) / 100.0;
        let here = motion.at(x);
        for turns in [-3.0, 1.0, 25.0] {
            let there = motion.at(x + 4.0 * turns);
            for order in 0..3 {
                // An argument of 100 is rounded by 7e-15, and the slopes are up to 50.
                close(
                    there[order],
                    here[order],
                    1e-11,
                    &format!("order {order} at {x}"),
                );
            }
        }
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let statement = "table f = [(-0.5, 0.25), (0.25, 1.5), (1, -0.75), (1.125, -0.5), (2.5, 3), (3.5, 0.25)] periodic;";
    let inner = |t: f64| 1.5 * t + 0.3 * t.sin();
    let motion = Law::with(statement, "f(1.5*t + 0.3*sin(t))*cos(t)");
    let (mut random, step, mut compared) = (Random::new(3), 1e-3, 0);
    for _ in 0..2000 {
        let t = random.between(-6.0, 6.0);
        // Across a point of the table the third derivative jumps, and a difference of the second is meaningless.
        let piece = |t: f64| {
            let place = (inner(t) + 0.5).rem_euclid(4.0) - 0.5;
            UNEQUAL.iter().filter(|point| point[0] <= place).count()
        };
        if piece(t - 2.0 * step) != piece(t + 2.0 * step) {
            continue;
        }
        compared += 1;
        let stencil = [-2.0, -1.0, 1.0, 2.0].map(|side| motion.at(t + side * step));
        let here = motion.at(t);
        for order in 0..3 {
            let [a, b, c, d] = stencil.map(|it| it[order]);
            let quotient = (a - 8.0 * b + 8.0 * c - d) / (12.0 * step);
            let scale = 1.0 + here[order + 1].abs();
            close(
                quotient,
                here[order + 1],
                1e-8 * scale,
                &format!("order {order} at {t}"),
            );
        }
    }
    assert!(compared > 1500, "{compared}");
}

#[test]
fn generated_code_agrees_with_the_interpreter_in_both_precisions() {
    const COUNT: usize = generated::Coordinates::COUNT;
    let derived = description::system("tables");
    let rows = &derived.system.rows;
    let roots: Vec<_> = rows
        .iter()
        .flat_map(|row| [row.residual, row.time_derivative, row.gamma])
        .collect();
    let tape = Tape::new(&derived.pool.graph, &roots);
    let mut random = Random::new(11);
    let mut values = vec![0.0; roots.len()];
    for step in -800..=2400 {
        // Points of the tables are among these times, and most are outside of one.
        let t = f64::from(step) / 200.0;
        let mut symbols = vec![0.0; derived.pool.graph.symbol_count()];
        let mut q = [0.0; COUNT];
        let mut qd = [0.0; COUNT];
        for (index, coordinate) in derived.system.coordinates.iter().enumerate() {
            // Exactly the same in single precision.
            q[index] = f64::from(random.between(-4.0, 4.0) as f32);
            qd[index] = f64::from(random.between(-1.0, 1.0) as f32);
            symbols[coordinate.position.index()] = q[index];
            symbols[coordinate.rate.index()] = qd[index];
        }
        symbols[derived.system.mechanism.time.index()] = t;
        tape.evaluate(&symbols, &mut Vec::new(), &mut values);
        let [q_named, qd_named] = [q, qd].map(generated::Coordinates::from_array);
        let generated_levels = [
            generated::phi(&q_named, t),
            generated::phi_t(&q_named, t),
            generated::gamma(&q_named, &qd_named, t),
        ];
        let [q_single, qd_single] =
            [q, qd].map(|it| single::Coordinates::from_array(it.map(|value| value as f32)));
        let rough = [
            single::phi(&q_single, t as f32),
            single::phi_t(&q_single, t as f32),
            single::gamma(&q_single, &qd_single, t as f32),
        ];
        for (row, name) in rows.iter().map(|row| &row.name).enumerate() {
            for level in 0..3 {
                let expected = values[3 * row + level];
                let what = format!("{name}, level {level} at {t}");
                close(generated_levels[level][row], expected, 1e-14 * 30.0, &what);
                close(
                    f64::from(rough[level][row]),
                    expected,
                    3e-5,
                    &format!("f32, {what}"),
                );
            }
        }
    }
}

/// Pitch curve of the description: its radius every 30 degrees.
const PITCH: [f64; 12] = [
    40.0, 41.0, 44.0, 48.0, 52.0, 55.0, 56.0, 55.0, 52.0, 48.0, 44.0, 41.0,
];

#[test]
fn a_cam_with_a_table_as_its_profile_lifts_its_follower_through_the_points() {
    let mut moved = generated::Tables::assemble(0.0).expect("the drawing assembles");
    let mut rough = single::Tables::assemble(0.0).expect("the drawing assembles");
    // Twice round, with steps between the points; the cam turns back by t, so the follower sees its angle 90° + t.
    for step in 0..=240 {
        let t = PI / 60.0 * f64::from(step);
        let frame = moved.advance(t).expect("the motion can be followed");
        let rough = rough.advance(t as f32).expect("the motion can be followed");
        let (y, y_rough) = (frame.q.y_follower, rough.q.y_follower);
        close(y_rough.into(), y, 1e-6, &format!("f32 at {t}"));
        if step % 10 == 0 {
            let radius = PITCH[(3 + step as usize / 10) % 12] / 1000.0;
            close(y - 1.0, radius, 1e-13, &format!("the follower at {t}"));
        }
    }
}

#[test]
fn a_table_drives_through_its_points() {
    let mut moved = generated::Tables::assemble(0.0).expect("the drawing assembles");
    let sway = [0.0, 10.0, -5.0, 4.0, 20.0_f64];
    for (t, degrees) in sway.into_iter().enumerate() {
        let frame = moved.advance(t as f64).expect("the motion can be followed");
        close(frame.q.phi_crank, degrees.to_radians(), 1e-15, "the crank");
        close(frame.q.x_shaft, 0.012, 1e-17, "a table at a number");
    }
    // From 2 s on the shaft turns with the given slope.
    let frame = moved.advance(5.0).expect("the motion can be followed");
    close(
        frame.q.phi_shaft,
        60_f64.to_radians() + 2.0 * 3.0,
        1e-14,
        "the shaft",
    );
    assert_eq!([frame.qd.phi_shaft, frame.qdd.phi_shaft], [2.0, 0.0]);
}

#[test]
fn a_table_of_a_file_is_the_same_as_the_one_that_lists_its_points() {
    let mut moved = of_file::TableOfFile::assemble(0.0).expect("the drawing assembles");
    let mut travelled = 0.0_f64;
    for step in -300..=300 {
        let t = f64::from(step) / 20.0;
        let frame = moved.advance(t).expect("the motion can be followed");
        let [q, qd, qdd] = [frame.q, frame.qd, frame.qdd];
        assert_eq!(
            [q.x_first, qd.x_first, qdd.x_first],
            [q.x_second, qd.x_second, qdd.x_second],
            "at {t}"
        );
        travelled = travelled.max(q.x_first);
    }
    assert!(travelled > 0.03, "{travelled}");
}

/// A table gives equal code to the last byte in any format of a file, and among any other columns.
#[test]
fn tables_of_other_programs_give_the_same_code() {
    let code = |statement: &str, bytes: &[u8]| {
        let text = format!(
            "mechanism moved {{\n    table lift = \"lift.csv\"{statement} periodic;\n    body slide at (0, 0);\n    absolute_y(slide) = 0;\n    absolute_angle(slide) = 0;\n    drive x(slide) = lift(1.5*t);\n}}\n"
        );
        let source = Source::new("moved.mech", text);
        let source = source.with_attachment("lift.csv", Ok(bytes.to_vec()));
        let generated = linkwright_codegen::generate(&source, &Options::default());
        generated
            .unwrap_or_else(|found| panic!("{}", found.render(&source)))
            .code()
            .to_string()
    };
    let plain = code(
        " in (deg, mm)",
        b"angle, lift # of the follower\n0,0\n90,12.5\n180,20\n360,0\n",
    );
    assert!(plain.contains("0.0125"), "{plain}");
    let german =
        "Zeit;Winkel (deg);lift (mm)\r\n0;0;0\r\n0,1;90;12,5\r\n0,2;180;2,0e1\r\n0,3;360;0\r\n";
    let wide: Vec<u8> = german.encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (statement, bytes) in [
        (" columns (Winkel, lift) in (deg, mm)", german.as_bytes()),
        (" columns (Winkel, lift)", german.as_bytes()),
        (" columns (2, 3)", german.as_bytes()),
        (" columns (Winkel, 3)", &wide),
        ("", b"# angle lift\n%\ta comment\n0 0\n1.5707963267948966 12.5e-3\n3.141592653589793 .02\n6.283185307179586 0\n"),
    ] {
        let module = code(statement, bytes);
        match statement.is_empty() {
            // Values in rad are not exact fractions of a turn.
            true => assert!(module.contains("0.0125"), "{module}"),
            false => assert_eq!(module, plain, "{statement}"),
        }
    }
}
