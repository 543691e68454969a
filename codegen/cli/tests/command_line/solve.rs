//! `linkwright solve` from the outside: exit codes, output and files.

use crate::folder::{EXAM, Folder, driven_by};
use serde_json::Value;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

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
    let names = folder.list("target/linkwright/two_body");
    assert_eq!(names, ["P.svg", "Q.svg", "motion.csv"]);
    let table = folder.read("target/linkwright/two_body/motion.csv");
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
    let picture = folder.read("target/linkwright/two_body/Q.svg");
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
fn the_rod_that_folds_ends_the_motion() {
    let folder = Folder::new("fold", driven_by("t"));
    let ran = folder.run("solve a.mech --json").exits_with(1);
    let object = json(&ran.stdout);
    assert_eq!(object["frames"].as_array().map(Vec::len), Some(158));
    let error = object["error"].as_str().expect("a sentence");
    let time = error
        .strip_prefix("cannot be solved beyond t = ")
        .and_then(|rest| rest.split(' ').next())
        .and_then(|time| time.parse::<f64>().ok())
        .unwrap_or_else(|| panic!("{error}"));
    assert!((time - std::f64::consts::FRAC_PI_2).abs() < 1e-8, "{error}");
    for text in [
        "revolute P(1, 2): the line from P to the origin of body 2 is parallel to the x axis; beyond, its links do not reach;",
        "Φ_q is singular there",
        "revolute P(1, 2)",
        "drive phi(1)",
        "can move: 2",
    ] {
        assert!(error.contains(text), "{text} in {error}");
    }
    let ran = folder.run("solve a.mech").exits_with(1);
    assert!(ran.stderr.contains(error), "{}", ran.stderr);
    assert_eq!(
        folder
            .read("target/linkwright/two_body/motion.csv")
            .lines()
            .count(),
        159
    );
}

#[test]
fn a_pose_close_to_singular_is_found_between_frames() {
    // The crank comes within 1e-7 rad of the fold at t = 1.00325, between two frames, and turns back.
    let folder = Folder::new("close", driven_by("pi/2 - 1e-7 - (t - 1.00325)^2/2"));
    let ran = folder
        .run("solve a.mech --json --to 2 --step 0.0005")
        .exits_with(0);
    let warnings = json(&ran.stdout)["warnings"].clone();
    let [Value::String(warning)] = warnings.as_array().expect("an array").as_slice() else {
        panic!("{warnings}");
    };
    let time = warning
        .strip_prefix("Φ_q is close to singular at t = ")
        .and_then(|rest| rest.split(' ').next())
        .and_then(|time| time.parse::<f64>().ok())
        .unwrap_or_else(|| panic!("{warning}"));
    assert!((time - 1.00325).abs() < 1e-6, "{warning}");
    assert!(warning.contains("revolute P(1, 2)"), "{warning}");
    let ran = folder
        .run("solve a.mech --to 2 --step 0.0005")
        .exits_with(0);
    assert_eq!(ran.stderr, format!("warning: {warning}\n"));
}

/// As before, but closer to the fold than a step of 0.01 can resolve: without sub-steps the rod would come out on the other
/// side. cos φ2 = 1 − cos φ1/√3 with φ2 positive, all along.
#[test]
fn a_step_does_not_lead_into_another_assembly_mode() {
    let folder = Folder::new("jump", driven_by("pi/2 - 1e-8 - (t - 1.003)^2/2"));
    let ran = folder.run("solve a.mech --json --to 2").exits_with(0);
    let object = json(&ran.stdout);
    let frames = object["frames"].as_array().expect("a list");
    assert_eq!(frames.len(), 201);
    for frame in frames {
        let t = number(&frame["t"]);
        // cos φ1 = sin(π/2 − φ1).
        let cosine = (1e-8 + (t - 1.003).powi(2) / 2.0).sin();
        // 1 − cos φ2 = 2 sin²(φ2/2).
        let wanted = 2.0 * (cosine / (2.0 * 3.0_f64.sqrt())).sqrt().asin();
        let found = number(&frame["q"][5]);
        assert!(
            (found - wanted).abs() < 1e-10 / wanted,
            "{t}: {found} {wanted}"
        );
    }
    let warning = object["warnings"][0].as_str().expect("a sentence");
    let time = warning
        .strip_prefix("Φ_q is close to singular at t = ")
        .and_then(|rest| rest.split(' ').next()?.parse::<f64>().ok())
        .unwrap_or_else(|| panic!("{warning}"));
    assert!((time - 1.003).abs() < 1e-8, "{warning}");
}

#[test]
fn a_determinant_that_changes_its_sign_is_located() {
    let text = "mechanism parallelogram {
        body crank at (0, 0, 0.5) { O: (0, 0), A: (1, 0) }
        body coupler at (0.877, 0.479, 0) { A: (0, 0), B: (2, 0) }
        body rocker at (2, 0, 0.5) { C: (0, 0), B: (1, 0) }
        absolute_x(crank) = 0;
        absolute_y(crank) = 0;
        revolute A(crank, coupler);
        revolute B(coupler, rocker);
        absolute_x(rocker) = 2;
        absolute_y(rocker) = 0;
        drive phi(crank) = 0.5 + t;
    }";
    let folder = Folder::new("crossing", text);
    let ran = folder.run("solve a.mech --json").exits_with(0);
    let warnings = json(&ran.stdout)["warnings"].clone();
    let warning = warnings[0].as_str().expect("a sentence");
    let time = warning
        .strip_prefix("Φ_q is singular at t = ")
        .and_then(|rest| rest.split(' ').next())
        .and_then(|time| time.parse::<f64>().ok())
        .unwrap_or_else(|| panic!("{warning}"));
    assert!(
        (time - (std::f64::consts::PI - 0.5)).abs() < 1e-7,
        "{warning}"
    );
    assert!(
        warning.ends_with("bodies that can move: coupler, rocker"),
        "{warning}"
    );
}

#[test]
fn a_drawing_that_cannot_be_assembled_is_explained() {
    let folder = Folder::new(
        "apart",
        EXAM.replace("absolute_x(2) = sqrt(3)", "absolute_x(2) = 4"),
    );
    let ran = folder.run("solve a.mech").exits_with(1);
    assert!(
        ran.stderr.contains("cannot be assembled at t = 0 s"),
        "{}",
        ran.stderr
    );
    assert!(
        ran.stderr
            .contains("the drawing violates `absolute_x(2)` most, by 2.3e+00 m"),
        "{}",
        ran.stderr
    );
    let ran = folder.run("solve a.mech --json").exits_with(1);
    let object = json(&ran.stdout);
    assert_eq!(object["frames"], Value::Array(Vec::new()));
    assert!(object["error"].is_string());
}

/// A slider that pushes crank and rod to their dead centre, where 0.1 + l = 0.48 + 0.05 t with l² = 0.4² + 0.06².
#[test]
fn the_loop_that_ends_a_motion_is_named_on_its_own_branch() {
    let folder = Folder::new(
        "dead_centre",
        "mechanism dead {
    point A = (0, 0), P = (0.08, 0.06), S = (0.48, 0);
    body crank at A facing A -> P { A, P }
    body rod at P facing P -> S { P, S }
    body slider at S { S }
    revolute A(ground, crank);
    revolute P(crank, rod);
    revolute S(rod, slider);
    absolute_y(slider) = 0;
    absolute_angle(slider) = 0;
    drive slider.x = 0.48 + 0.05*t;
}
",
    );
    let end = (0.1 + f64::hypot(0.4, 0.06) - 0.48) / 0.05;
    for branch in ["", "--branch phi_crank_phi_rod=other"] {
        let ran = folder.run(&format!("solve a.mech --json {branch}"));
        let error = json(&ran.exits_with(1).stdout)["error"].clone();
        let error = error.as_str().expect("a sentence");
        let time = error
            .strip_prefix("cannot be solved beyond t = ")
            .and_then(|rest| rest.split_once(" s: "))
            .unwrap_or_else(|| panic!("{error}"));
        let seconds: f64 = time.0.parse().expect("a time");
        assert!((seconds - end).abs() <= 1.5e-9, "{error}");
        assert!(
            time.1.starts_with(
                "loop P-S: crank and rod are in line; beyond, its links do not reach; Φ_q is singular there"
            ),
            "{error}"
        );
    }
}

#[test]
fn a_driver_that_ends_is_named() {
    let folder = Folder::new("driver", driven_by("ln(1 - t)"));
    let ran = folder.run("solve a.mech --json").exits_with(1);
    let error = json(&ran.stdout)["error"].clone();
    let error = error.as_str().expect("a sentence");
    assert!(error.contains("beyond t = "), "{error}");
    let folder = Folder::new("driver", driven_by("1 + t*sqrt(1 - t)/10"));
    let ran = folder.run("solve a.mech --json").exits_with(1);
    let error = json(&ran.stdout)["error"].clone();
    let error = error.as_str().expect("a sentence");
    assert!(
        error.starts_with("cannot be solved beyond t = 0.999999999 s: "),
        "{error}"
    );
    assert!(error.contains("of `drive phi(1)` is not finite"), "{error}");
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
        ("solve a.mech --json --csv -", "both want stdout"),
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
    assert!(ran.stdout.contains("wrote plots/Q.svg\n"), "{}", ran.stdout);
    assert!(!ran.stdout.contains("\nP:"), "{}", ran.stdout);
    assert_eq!(
        folder.list("new/folder"),
        ["q.csv"],
        "no partial file is left"
    );
    assert_eq!(folder.list("plots"), ["Q.svg"]);
    assert!(!folder.file("target").exists());
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
    assert_eq!(folder.list("plots"), ["Q.svg"]);
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
            ["P.svg", "Q.svg"],
            "files are written all the same"
        );
    }
}

#[test]
fn the_same_twice() {
    let folder = Folder::new("twice", EXAM);
    let run = || {
        let ran = folder.run("solve a.mech").exits_with(0);
        let read = |name: &str| folder.read(&format!("target/linkwright/two_body/{name}"));
        (ran.stdout, read("motion.csv"), read("P.svg"))
    };
    assert!(run() == run());
}
