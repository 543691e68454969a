//! Tables in mechanisms: the generated code against the interpreter, and files against lists of points.

use std::f64::consts::PI;

use linkwright_codegen::Options;
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::expr::Tape;

use linkwright_tests::description;
use linkwright_tests::random::Random;

use super::close;

mod generated {
    linkwright::include_mechanism!(tables);
}

mod single {
    linkwright::include_mechanism!(tables_single);
}

mod of_file {
    linkwright::include_mechanism!(table_of_file);
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
