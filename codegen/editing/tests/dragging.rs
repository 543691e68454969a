//! Points that can be dragged, the reasons of those that cannot, and the numbers that are written.

use linkwright_codegen::{Source, read};
use linkwright_editing::{Description, Handle, handles, moved, step};

fn of(text: &str) -> Vec<Handle> {
    let source = Source::new("text", text);
    let read = read(&source).unwrap_or_else(|found| panic!("{}", found.render(&source)));
    handles(&Description::of(source), &read.motions[0].system.mechanism)
}

/// A crank with these points in global coordinates and on its body, below these statements.
fn crank(statements: &str, global: &str, local: &str) -> String {
    format!(
        "mechanism m {{\n{statements}\npoint O = (100mm, 0), {global};\nbody rod at O {{ O, A: (100mm, 0), {local} }}\nrevolute O(ground, rod);\ndrive phi(rod) = t;\n}}\n"
    )
}

fn handle(text: &str, point: &str) -> Handle {
    let mut all = of(text).into_iter();
    let handle = all.find(|it| it.point == point);
    handle.unwrap_or_else(|| panic!("no `{point}`"))
}

/// Moves the point P, and returns what is written between its parentheses.
fn written(literals: &str, position: [f64; 2]) -> String {
    let mut text = crank("", &format!("P = ({literals})"), "B: (1mm, 1mm)");
    let edits = moved(&text, &handle(&text, "P"), position).expect("a point to drag");
    for edit in edits.iter().rev() {
        text.replace_range(edit.span.range(), &edit.text);
    }
    let coordinates = handle(&text, "P").coordinates.expect("plain numbers");
    for (coordinate, value) in coordinates.iter().zip(position) {
        assert!((coordinate.value - value).abs() <= 1e-5, "{text}");
    }
    let (_, rest) = text.split_once("P = (").expect("the point");
    rest.split_once(')').expect("a parenthesis").0.to_string()
}

#[test]
fn numbers_keep_units_and_useful_decimals() {
    // The characteristic length is 0.1 m, so that steps are 0.01 mm.
    for (before, position, after) in [
        ("120mm, -30mm", [0.1, 0.05], "100mm, 50mm"),
        ("120mm, -30mm", [0.123456, -0.0312], "123.46mm, -31.2mm"),
        ("120mm, - 30mm", [0.12, 0.03], "120mm, 30mm"),
        ("12cm, 3inch", [0.1, 0.0254], "10cm, 1inch"),
        ("0.12, 0.03", [-0.1, 0.05], "-0.10, 0.05"),
        ("0, 0", [0.1, 0.0], "100mm, 0"),
        ("0, 3cm", [0.1, 0.03], "10cm, 3cm"),
        ("0, 0.5", [0.1, 0.25], "0.1, 0.25"),
        ("1.5e2mm, 1e-1m", [0.02, 0.03], "20mm, 0.03m"),
        ("120.000mm, 30.5mm", [0.1201234, 0.03], "120.123mm, 30.0mm"),
        ("1_000mm, 2mm", [0.5, 0.002], "500mm, 2mm"),
        ("-0.5mm, 1mm", [-0.000001, 0.001], "0.0mm, 1mm"),
        ("0.05mm, 1mm", [0.00005, 1234567.0], "0.05mm, 1234567000mm"),
    ] {
        assert_eq!(written(before, position), after, "{before}");
    }
}

#[test]
fn other_points_have_a_reason() {
    let statements = "param rod = 80mm;\nconst L = 40mm;";
    for (literals, reason) in [
        ("L/2, 0", "`L/2` is a formula"),
        ("1mm, 2 *\n  L", "`2 * L` is a formula"),
        ("L, 0", "given by the constant `L`"),
        ("0, L", "given by the constant `L`"),
        ("-L, 0", "`-L` is a formula"),
        ("(3mm), 0", "`(3mm)` is a formula"),
        ("-(3mm), 0", "`-(3mm)` is a formula"),
        ("- /* no */ 3mm, 0", "`- /* no */ 3mm` is a formula"),
        ("2*3mm, 0", "`2*3mm` is a formula"),
    ] {
        let text = crank(statements, &format!("P = ({literals})"), "B: (1mm, 0)");
        assert_eq!(handle(&text, "P").coordinates, Err(reason.to_string()));
    }
    let text = crank(
        "param rod_length = 80mm;",
        "P = (1, 1)",
        "B: (rod_length, 0)",
    );
    let reason = "given by the parameter `rod_length`".to_string();
    assert_eq!(handle(&text, "B").coordinates, Err(reason));
}

#[test]
fn points_of_bodies_name_their_body() {
    let text = crank("", "P = (1mm, 2mm)", "B: (3mm, -4mm)");
    let all = of(&text);
    let named: Vec<(&str, Option<&str>)> = all
        .iter()
        .map(|it| (it.point.as_str(), it.body.as_deref()))
        .collect();
    let rod = Some("rod");
    assert_eq!(named, [("O", None), ("P", None), ("A", rod), ("B", rod)]);
    let [x, y] = all[3].coordinates.clone().expect("plain numbers");
    assert_eq!([x.value, y.value], [0.003, -0.004]);
    assert_eq!([x, y].map(|it| &text[it.span.range()]), ["3mm", "-4mm"]);
    assert_eq!(&text[all[3].declared.range()], "B");
}

#[test]
fn bodies_that_share_a_point_have_a_handle_each() {
    let text = "mechanism m {
    body 1 at (0, 0) { O: (0, 0), P: (1, 0) }
    body 2 at (1, 0) { P: (0, 0), Q: (2, 0) }
    body 3 at (5, 5) { Q: (0, 0), R: (0, 0) }
    body 4 at (5, 5) { R: (0, 0) }
    body 5 at (5, 6) { R: (0, 1) }
    revolute P(1, 2);
    revolute R(3, 4);
}";
    let named: Vec<String> = of(text)
        .into_iter()
        .map(|it| format!("{} {}", it.point, it.body.unwrap_or_default()))
        .collect();
    assert_eq!(
        named,
        [
            "O 1", "P 1", "P 2", "Q_2 2", "Q_3 3", "R_3 3", "R_3 4", "R_5 5"
        ]
    );
}

#[test]
fn repetitions_and_parts_are_not_dragged() {
    let text = "mechanism arm {
    point S = (0, 0);
    body link at S { S, T: (20mm, 0) }
}
mechanism m {
    repeat i from 1 to 2 { point R[i] = (0, 0); }
    point P = (1mm, 0);
    part left = arm;
    part right[1] = arm at (50mm, 0);
}
";
    let all: Vec<(String, Result<(), String>)> = of(text)
        .into_iter()
        .map(|it| (it.point, it.coordinates.map(|_| ())))
        .collect();
    let repeated = || Err("made by `repeat`".to_string());
    let part = |name: &str| Err(format!("belongs to the part `{name}`"));
    assert_eq!(
        all,
        [
            ("R1".to_string(), repeated()),
            ("R2".to_string(), repeated()),
            ("P".to_string(), Ok(())),
            ("left_S".to_string(), part("left")),
            ("left_T".to_string(), part("left")),
            ("right1_S".to_string(), part("right[1]")),
            ("right1_T".to_string(), part("right[1]")),
        ]
    );
}

#[test]
fn another_text_is_not_changed() {
    let text = crank("", "P = (1mm, 2mm)", "B: (3mm, -4mm)");
    let handle = handle(&text, "P");
    assert!(moved(&text, &handle, [0.0, 0.0]).is_some_and(|it| it.len() == 2));
    assert_eq!(moved(&text, &handle, [0.001, 0.002]), Some(Vec::new()));
    assert_eq!(moved(&text[1..], &handle, [0.0, 0.0]), None);
    assert_eq!(moved(&text, &handle, [f64::NAN, 0.0]), None);
    assert_eq!(moved("", &handle, [0.0, 0.0]), None);
}

#[test]
fn a_step_is_the_least_change_that_is_written() {
    let text = crank("", "P = (120mm, 0.5)", "B: (12.3456mm, 1mm)");
    for (point, steps) in [("P", [1e-5, 1e-5]), ("B", [1e-7, 1e-5])] {
        let handle = handle(&text, point);
        let coordinates = handle.coordinates.clone().expect("plain numbers");
        for (place, coordinate) in coordinates.iter().enumerate() {
            let length = step(coordinate);
            assert!((length - steps[place]).abs() < 1e-18, "{point}: {length:e}");
            let mut position = coordinates.each_ref().map(|it| it.value);
            position[place] += 0.4 * length;
            assert_eq!(moved(&text, &handle, position), Some(Vec::new()));
            position[place] += 0.6 * length;
            assert_eq!(moved(&text, &handle, position).map(|it| it.len()), Some(1));
        }
    }
}
