//! `linkwright solve` from the outside: exit codes, output and files.

use crate::folder::{EXAM, Folder};
use crate::printed::{json, number};
use serde_json::Value;

fn assert_close(value: &Value, expected: &[f64]) {
    let values = value.as_array().expect("an array");
    assert_eq!(values.len(), expected.len(), "{value}");
    for (found, expected) in values.iter().zip(expected) {
        assert!((number(found) - expected).abs() <= 1e-14, "{value}");
    }
}

/// Eight points that move and one that does not.
const NINE_POINTS: &str = "mechanism wheel {
    point O = (0.1, 0.2);
    body 1 at O { O, A: (1, 0), B: (2, 0), C: (3, 0), D: (4, 0), E: (5, 0), F: (6, 0), G: (7, 0), H: (8, 0) }
    revolute O(ground, 1);
    drive phi(1) = t;
}
";

#[test]
fn tables_of_six_points_are_printed_unless_points_are_chosen() {
    let folder = Folder::new("nine_points", NINE_POINTS);
    let tables = |text: &str| text.matches(": position, velocity, acceleration").count();
    let printed = folder.run("solve a.mech").exits_with(0).stdout;
    assert_eq!(tables(&printed), 6, "{printed}");
    for text in [
        "\nmore with `--points G,H`\n",
        "\nO stays at (0.100000, 0.200000) m\n",
    ] {
        assert!(printed.contains(text), "{text:?} in {printed}");
    }
    let chosen = folder
        .run("solve a.mech --points A,B,C,D,E,F,G")
        .exits_with(0)
        .stdout;
    assert_eq!(tables(&chosen), 7, "{chosen}");
    assert!(!chosen.contains("more with"), "{chosen}");
}

#[test]
fn a_good_motion_is_printed_and_written() {
    let folder = Folder::new("good", EXAM);
    let ran = folder.run("solve a.mech").exits_with(0);
    assert_eq!(ran.stderr, "", "a well-conditioned motion gives no warning");
    for text in [
        "two_body\n",
        "2: 1, 2\n",
        "6: x1, y1, phi1, x2, y2, phi2\n",
        "constraint equations  5: ",
        "revolute P(1, 2) [2]",
        "1: drive phi(1)\n",
        "1 without drivers, 0 with them",
        "at t = 0 s            det Φ_q = 1.500000e+00",
        "largest residuals over 501 frames",
        "  0.0  1.299038  1.250000  -0.500000   1.443376",
    ] {
        assert!(ran.stdout.contains(text), "{text:?} in {}", ran.stdout);
    }
    let names = folder.list("two_body");
    assert_eq!(
        names,
        [
            "P.svg",
            "Q.svg",
            "motion.csv",
            "motion.csv.source",
            "paths.svg"
        ]
    );
    let table = folder.read("two_body/motion.csv");
    assert_eq!(table.lines().count(), 502);
    assert!(
        table.starts_with("t,x1,y1,phi1,x2,y2,phi2,x1_d,"),
        "{table:.80}"
    );
    assert!(
        table
            .lines()
            .next()
            .is_some_and(|it| it.ends_with(",Q_x,Q_y,Q_vx,Q_vy,Q_ax,Q_ay"))
    );
    let picture = folder.read("two_body/Q.svg");
    for text in [
        "position (m)",
        "velocity (m/s)",
        "acceleration (m/s²)",
        "t (s)",
        "<polyline",
    ] {
        assert!(picture.contains(text), "{text}");
    }
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
}

#[test]
fn json_holds_the_answers_of_the_exam() {
    let folder = Folder::new("json", EXAM);
    let ran = folder.run("solve a.mech --json --to 0.1").exits_with(0);
    let object = json(&ran.stdout);
    assert_eq!(object["mechanism"], "two_body");
    assert_eq!(object["coordinates"][5], "phi2");
    assert_eq!(object["warnings"], Value::Array(Vec::new()));
    assert!(object.get("error").is_none());
    assert!((number(&object["det"]) - 1.5).abs() < 1e-14);
    assert!((0.01..1.0).contains(&number(&object["rcond"])));
    assert!(number(&object["residuals"]["position"]) < 1e-14);
    let frames = object["frames"].as_array().expect("an array");
    assert_eq!(frames.len(), 11);
    let first = &frames[0];
    let root = 3.0_f64.sqrt();
    let pi = std::f64::consts::PI;
    assert_close(&first["q"], &[0.0, 0.0, pi / 6.0, root, 2.0, pi / 3.0]);
    assert_close(
        &first["qd"],
        &[0.0, 0.0, 2.0, 0.0, 2.0 * root / 3.0, -2.0 / 3.0],
    );
    assert_close(&first["points"]["Q"]["position"], &[0.75 * root, 1.25]);
    assert_close(&first["points"]["Q"]["velocity"], &[-0.5, 5.0 * root / 6.0]);
    assert_eq!(folder.list(""), ["a.mech"], "no file is written unasked");
    // The keys come in the documented order.
    assert!(
        ran.stdout
            .starts_with(r#"{"mechanism":"two_body","coordinates":["x1","#)
    );
}

#[test]
fn a_single_instant_follows_the_motion() {
    let folder = Folder::new("instant", EXAM);
    let at = |options: &str| {
        let ran = folder
            .run(&format!("solve a.mech --json {options}"))
            .exits_with(0);
        json(&ran.stdout)["frames"].clone()
    };
    let frames = at("--at 1.2345 --at -0.5,2");
    let times: Vec<f64> = frames
        .as_array()
        .expect("an array")
        .iter()
        .map(|it| number(&it["t"]))
        .collect();
    assert_eq!(times, [-0.5, 1.2345, 2.0]);
    assert_eq!(frames[2], at("--to 2")[200], "the same frame as on the way");
    let ran = folder.run("solve a.mech --at 1.2345").exits_with(0);
    assert!(ran.stdout.contains("1.2345  "), "{}", ran.stdout);
    assert_eq!(folder.list(""), ["a.mech"], "no file is written unasked");
}

#[test]
fn bad_input_exits_with_2() {
    let folder = Folder::new("bad", EXAM);
    for (arguments, message) in [
        ("solve nowhere.mech", "cannot read `nowhere.mech`"),
        ("solve .", "cannot read `.`"),
        (
            "solve a.mech --points Z",
            "no point `Z` in `two_body`\n  its points are: P, Q",
        ),
        ("solve a.mech --step 0", "a step must be positive"),
        ("solve a.mech --step -1", "a step must be positive"),
        ("solve a.mech --step nan", "not a finite number"),
        ("solve a.mech --to inf", "not a finite number"),
        ("solve a.mech --to -1", "`--to -1` lies before `--from 0`"),
        ("solve a.mech --step 1e-9", "steps are too many"),
        ("solve a.mech --json --csv -", "cannot both write to stdout"),
        ("solve a.mech --at 1 --plot x", "cannot be used with"),
        ("solve", "required"),
        ("fly a.mech", "unrecognized subcommand"),
    ] {
        let ran = folder.run(arguments).exits_with(2);
        assert!(ran.stderr.contains(message), "{arguments}: {}", ran.stderr);
        assert_eq!(ran.stdout, "", "{arguments}");
    }
    std::fs::write(folder.file("latin.mech"), b"mechanism caf\xe9 {}").expect("it can be written");
    let ran = folder.run("solve latin.mech").exits_with(2);
    assert!(ran.stderr.contains("latin.mech:1:14"), "{}", ran.stderr);
    assert_eq!(folder.list(""), ["a.mech", "latin.mech"]);
}

#[test]
fn a_misspelt_point_is_recognized() {
    let text = EXAM.replace("Q:", "middle:");
    let folder = Folder::new("misspelt", text);
    let ran = folder.run("solve a.mech --points P,midle").exits_with(2);
    assert!(
        ran.stderr.contains("did you mean `middle`?"),
        "{}",
        ran.stderr
    );
}

#[test]
fn an_underdriven_mechanism_is_bad_input() {
    let text: String = EXAM
        .lines()
        .filter(|line| !line.contains("drive"))
        .map(|line| format!("{line}\n"))
        .collect();
    let folder = Folder::new("underdriven", text);
    let ran = folder.run("solve a.mech --json").exits_with(2);
    assert_eq!(ran.stdout, "");
    assert!(
        ran.stderr.contains("error[K32]: 1 equation too few"),
        "{}",
        ran.stderr
    );
    let ran = folder.run("inspect a.mech").exits_with(0);
    assert!(
        ran.stdout
            .contains("x1 + cos(phi1) - x2 + sqrt(3)*cos(phi2)"),
        "{}",
        ran.stdout
    );
}

#[test]
fn files_go_where_they_are_wanted_and_are_never_half_written() {
    let folder = Folder::new("files", EXAM);
    let ran = folder
        .run("solve a.mech --points Q --to 1 --csv new/folder/q.csv --plot plots")
        .exits_with(0);
    assert!(
        ran.stdout.contains("wrote new/folder/q.csv\n"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout.contains("wrote plots/*.svg (Q, paths)\n"),
        "{}",
        ran.stdout
    );
    assert!(!ran.stdout.contains("\nP:"), "{}", ran.stdout);
    assert_eq!(
        folder.list("new/folder"),
        ["q.csv", "q.csv.source"],
        "no partial file is left"
    );
    assert_eq!(folder.list("plots"), ["Q.svg", "paths.svg"]);
    assert!(!folder.file("two_body").exists());
    // Numbers in the file are exact.
    let table = folder.read("new/folder/q.csv");
    let ran = folder.run("solve a.mech --json --to 1").exits_with(0);
    let frame = &json(&ran.stdout)["frames"][73];
    let line = table.lines().nth(74).expect("a line per frame");
    let values: Vec<f64> = line
        .split(',')
        .map(|it| it.parse().expect("a number"))
        .collect();
    assert_eq!(values.len(), 1 + 18 + 6);
    assert_eq!(values[0], number(&frame["t"]));
    assert_eq!(values[6], number(&frame["q"][5]));
    assert_eq!(values[18], number(&frame["qdd"][5]));
    assert_eq!(values[24], number(&frame["points"]["Q"]["acceleration"][1]));
    // A folder stands where the file should go: the file is named, and nothing is lost.
    let ran = folder.run("solve a.mech --csv plots").exits_with(2);
    assert!(
        ran.stderr.contains("cannot write `plots`"),
        "{}",
        ran.stderr
    );
    assert_eq!(folder.list("plots"), ["Q.svg", "paths.svg"]);
    let ran = folder.run("solve a.mech --csv a.mech/x.csv").exits_with(2);
    assert!(
        ran.stderr.contains("cannot write `a.mech/x.csv`"),
        "{}",
        ran.stderr
    );
    assert_eq!(folder.read("a.mech"), EXAM);
}

#[test]
fn csv_on_stdout_stands_alone() {
    let folder = Folder::new("stdout", EXAM);
    let ran = folder
        .run("solve a.mech --csv - --to 1 --plot plots")
        .exits_with(0);
    assert_eq!(ran.stdout.lines().count(), 102);
    let width = ran
        .stdout
        .lines()
        .next()
        .map(|line| line.split(',').count());
    assert_eq!(width, Some(1 + 18 + 12));
    assert!(
        ran.stdout
            .lines()
            .all(|line| Some(line.split(',').count()) == width)
    );
    assert!(ran.stderr.starts_with("two_body\n"), "{}", ran.stderr);
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_early_is_no_error() {
    use std::io::Read;
    use std::process::Stdio;
    let folder = Folder::new("pipe", EXAM);
    for format in ["--json", "--csv=-"] {
        let mut child = folder
            .command()
            .args([
                "solve", "a.mech", "--step", "0.001", format, "--plot", "plots",
            ])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let mut byte = [0];
        let mut output = child.stdout.take().expect("stdout is piped");
        output.read_exact(&mut byte).expect("there is output");
        drop(output);
        let ran =
            crate::folder::Ran::from(child.wait_with_output().expect("it ends")).exits_with(0);
        assert!(
            !ran.stderr.contains("error") && !ran.stderr.contains("panicked"),
            "{}",
            ran.stderr
        );
        assert_eq!(
            folder.list("plots"),
            ["P.svg", "Q.svg", "paths.svg"],
            "files are written all the same"
        );
    }
}

#[test]
fn the_same_twice() {
    let folder = Folder::new("twice", EXAM);
    let run = || {
        let ran = folder.run("solve a.mech").exits_with(0);
        let read = |name: &str| folder.read(&format!("two_body/{name}"));
        (ran.stdout, read("motion.csv"), read("P.svg"))
    };
    assert!(run() == run());
}

/// φ1 = π/6 + sin 2t, and x1 is always 0.
#[test]
fn coordinates_are_shown_with_their_rates_in_the_wanted_unit() {
    let folder = Folder::new("shown", EXAM);
    let ran = folder
        .run("solve a.mech --show phi1,x1 --angles deg --to 500ms --step 250ms --out shown")
        .exits_with(0);
    assert!(!ran.stdout.contains("P: position"), "{}", ran.stdout);
    let row = |t: f64| {
        let angle = std::f64::consts::FRAC_PI_6 + (2.0 * t).sin();
        let motion = [angle, 2.0 * (2.0 * t).cos(), -4.0 * (2.0 * t).sin()];
        motion.map(|it| format!("{:.6}", it.to_degrees()))
    };
    for text in [
        "phi1: value, rate, acceleration in deg, deg/s, deg/s²",
        "x1: value, rate, acceleration in m, m/s, m/s²",
    ] {
        assert!(ran.stdout.contains(text), "{text} in {}", ran.stdout);
    }
    for value in [row(0.25), row(0.5)].concat() {
        assert!(ran.stdout.contains(&value), "{value} in {}", ran.stdout);
    }
    // What stands still has no picture.
    assert_eq!(
        folder.list("shown"),
        ["motion.csv", "motion.csv.source", "phi1.svg"]
    );
    assert!(folder.read("shown/phi1.svg").contains("phi1&apos; (deg/s)"));
    let ran = folder.run("solve a.mech --show phi3").exits_with(2);
    assert!(
        ran.stderr.contains("no coordinate or point `phi3`")
            && ran.stderr.contains("are: x1, y1, phi1,")
            && ran.stderr.contains("its points are: P, Q"),
        "{}",
        ran.stderr
    );
}

/// As the description, the tables of frames and the generated code write them.
#[test]
fn what_is_shown_may_be_spelled_as_it_is_met() {
    let folder = Folder::new("spelled", EXAM);
    let run = |name: &str| {
        let show = format!("solve a.mech --show {name} --at 0.5 --no-files");
        folder.run(&show).exits_with(0).stdout
    };
    let angle = run("phi2");
    assert!(angle.contains("phi2: value, rate, acceleration"), "{angle}");
    for name in ["phi(2)", "phi_2", "phi2_d", "phi2_dd", "q.phi2", "qdd.phi2"] {
        assert_eq!(run(name), angle, "{name}");
    }
    // The middle of the rod; nothing else is shown.
    let point = run("Q");
    assert!(point.contains("Q: position"), "{point}");
    assert!(
        !point.contains("P: position") && !point.contains("phi2: value"),
        "{point}"
    );
    for name in ["Q_x", "Q_vy", "Q.y", "2.Q", "2.Q_ax", "y(2.Q)", "point_q"] {
        assert_eq!(run(name), point, "{name}");
    }
    let both = run("x(2),Q,phi2,Q_y");
    assert!(
        both.contains("x2: value") && both.contains("Q: position"),
        "{both}"
    );
    // Each has one picture.
    folder
        .run("solve a.mech --show phi(2),phi2,Q_x,Q --to 1 --plot plots --no-files")
        .exits_with(0);
    assert_eq!(folder.list("plots"), ["Q.svg", "paths.svg", "phi2.svg"]);
    for name in [
        "phi(3)", "phi_", "x(2.R)", "Q_z", "3.Q", "phi(2", "phi(1.Q)",
    ] {
        let ran = folder
            .run(&format!("solve a.mech --show {name}"))
            .exits_with(2);
        assert!(ran.stderr.contains(&format!("`{name}`")), "{}", ran.stderr);
    }
}

#[test]
fn a_point_can_be_named_by_any_body_that_carries_it() {
    let folder = Folder::new("carried", EXAM);
    let printed = |points: &str| {
        let ran = folder.run(&format!("solve a.mech --points {points} --no-files"));
        ran.exits_with(0).stdout
    };
    assert_eq!(printed("2.P"), printed("P"));
    assert_eq!(printed("1.P,2.Q"), printed("P,Q"));
    for wrong in ["1.Q", "3.P", "1.", ".P"] {
        let ran = folder.run(&format!("solve a.mech --points {wrong}"));
        assert!(ran.exits_with(2).stderr.contains("no point"), "{wrong}");
    }
}

/// By hand: x2 is 1.7 instead of √3, and the rest follows from the rows of the pin.
#[test]
fn the_first_step_is_that_of_the_exam() {
    let folder = Folder::new("first_step", EXAM);
    let ran = folder
        .run("solve a.mech --first-step --no-files")
        .exits_with(0);
    let root = 3.0_f64.sqrt();
    let residuals = [
        30.0_f64.to_radians().cos() - 1.7 + root * 1.0_f64.cos(),
        0.5 - 2.0 + root * 1.0_f64.sin(),
    ];
    let turned = (-residuals[0] + root - 1.7) / (-root * 1.0_f64.sin());
    for number in [
        -residuals[0],
        -residuals[1],
        root - 1.7,
        turned,
        1.0 + turned,
    ] {
        let text = format!("{number:.6}");
        assert!(ran.stdout.contains(&text), "{text} in {}", ran.stdout);
    }
}

/// The drawing and its derivatives are the same at each instant; the driver misses by 0.3 rad/s times the time that is between them.
#[test]
fn the_first_step_is_that_of_the_instant_that_is_asked_for() {
    let crank = "mechanism crank {
    point A = (0, 0);
    body crank at A { A }
    revolute A(ground, crank);
    drive phi(crank) = 0.1 + 0.3*t;
}
";
    let folder = Folder::new("first_step_at", crank);
    let step = |options: &str| {
        let command = format!("solve a.mech --first-step --no-files {options}");
        folder.run(&command).exits_with(0).stdout
    };
    let both = step("--at 1,2");
    for (t, residual) in [(1, "0.400000"), (2, "0.700000")] {
        let heading = format!("from the drawing at t = {t} s");
        let (_, from) = both.split_once(&heading).expect("a step");
        let own = from.split("from the drawing").next().expect("a text");
        assert!(own.contains(residual), "{residual} in {own}");
    }
    assert!(!both.contains("from the drawing at t = 0 s"), "{both}");
    assert!(step("--from 1").contains("from the drawing at t = 1 s"));
}

#[test]
fn tables_have_units_on_request_and_are_known_again() {
    let folder = Folder::new("units", EXAM);
    for _ in 0..2 {
        folder.run("solve a.mech --units --out o").exits_with(0);
    }
    let table = folder.read("o/motion.csv");
    assert!(
        table.starts_with("t (s),x1 (m),y1 (m),phi1 (rad),"),
        "{table:.80}"
    );
    assert!(table.contains("\n0.01,"), "numbers in their shortest form");
    let ran = folder.run("solve a.mech --json --at 0").exits_with(0);
    let units = &json(&ran.stdout)["units"];
    assert_eq!(units["qd"][2], "rad/s");
    assert_eq!(units["acceleration"], "m/s²");
}

#[test]
fn files_go_below_target_only_beside_a_manifest() {
    let folder = Folder::new("manifest", EXAM);
    std::fs::write(folder.file("Cargo.toml"), "").expect("it can be written");
    folder.run("solve a.mech --to 0.1").exits_with(0);
    assert!(
        folder
            .file("target/linkwright/two_body/motion.csv")
            .exists()
    );
    assert!(!folder.file("two_body").exists());
}

#[cfg(unix)]
#[test]
fn a_large_table_is_announced_before_the_work() {
    use std::io::{BufRead, BufReader};
    use std::process::Stdio;
    let folder = Folder::new("large", EXAM);
    let mut child = folder
        .command()
        .args(["solve", "a.mech", "--to", "5", "--step", "1e-6"])
        .args(["--points", "Q", "--csv", "/dev/null"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut lines = BufReader::new(child.stderr.take().expect("stderr is piped")).lines();
    let said = lines.next().expect("a line").expect("a text");
    child.kill().expect("it is still at work");
    child.wait().expect("it ends");
    // Five million frames of 25 columns.
    assert_eq!(said, "warning: `/dev/null` will take about 2.5 GB");
}
