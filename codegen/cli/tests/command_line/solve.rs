//! `linkwright solve` from the outside: exit codes and output.

use serde_json::Value;

use crate::folder::{EXAM, Folder};
use crate::printed::{json, number};

pub fn assert_close(value: &Value, expected: &[f64]) {
    let values = value.as_array().expect("an array");
    assert_eq!(values.len(), expected.len(), "{value}");
    for (found, expected) in values.iter().zip(expected) {
        assert!((number(found) - expected).abs() <= 1e-14, "{value}");
    }
}

/// Eight points that move and one that does not.
pub const NINE_POINTS: &str = "mechanism wheel {
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
        (
            "solve a.mech --to -1",
            "the end, t = -1 s, lies before the start, t = 0 s\n  = help: name earlier instants with `--at`",
        ),
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
