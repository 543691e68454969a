//! `linkwright compare` from the outside.

use serde_json::Value;

use crate::folder::{EXAM, Folder};
use crate::printed::{json, number};

fn repository(path: &str) -> String {
    format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"))
}

/// The exam with a table beside it: φ1 = π/6 + sin 2t and P = (cos φ1, sin φ1).
fn with_table(name: &str, table: impl AsRef<[u8]>) -> Folder {
    let folder = Folder::new(name, EXAM);
    std::fs::write(folder.file("data.csv"), table).expect("it can be written");
    folder
}

fn phi1(t: f64) -> f64 {
    std::f64::consts::FRAC_PI_6 + (2.0 * t).sin()
}

/// Half a unit of the last digit that ADAMS prints is 5e-7; the test of the arm itself has the same bound.
#[test]
fn the_exports_of_adams_work_out_of_the_box() {
    let folder = Folder::new("compare_adams", "");
    let (arm, table) = (
        repository("mechanisms/arm.mech"),
        repository("tests/data/arm_adams.csv"),
    );
    let ran = folder
        .run(&format!("compare {arm} {table} --tolerance 6e-7 --json"))
        .exits_with(0);
    let report = json(&ran.stdout);
    assert_eq!(
        (&report["rows"], &report["within"]),
        (&101.into(), &true.into())
    );
    let columns = report["columns"].as_array().expect("columns");
    let taken: Vec<[&str; 3]> = columns
        .iter()
        .map(|it| ["column", "quantity", "how"].map(|key| it[key].as_str().expect("words")))
        .collect();
    let expected = [
        ["c10_x", "x_c10", "guess"],
        ["c10_y", "y_c10", "guess"],
        ["c10_phid", "phi_c10_d", "guess"],
        ["c10_phidd", "phi_c10_dd", "guess"],
        ["c10_xd", "x_c10_d", "guess"],
        ["c10_yd", "y_c10_d", "guess"],
        ["c10_xdd", "x_c10_dd", "guess"],
        ["c10_ydd", "y_c10_dd", "guess"],
        ["K_x", "K_x", "name"],
        ["K_y", "K_y", "name"],
        ["K_xd", "K_vx", "guess"],
        ["K_yd", "K_vy", "guess"],
        ["K_xdd", "K_ax", "guess"],
        ["K_ydd", "K_ay", "guess"],
        ["K_phid", "phi_c8_d", "guess"],
        ["K_phidd", "phi_c8_dd", "guess"],
    ];
    assert_eq!(taken, expected);
    assert!(
        columns
            .iter()
            .all(|it| number(&it["largest"]).abs() <= 6e-7 && it["count"] == 101)
    );
    // A bound that the digits of the file cannot meet.
    folder
        .run(&format!("compare {arm} {table} --tolerance 4e-7"))
        .exits_with(1);
}

#[test]
fn differences_are_those_of_the_formula_in_the_unit_of_the_column() {
    let mut table = "time [ms];angle [deg];px [mm]\n".to_string();
    let mut angles: Vec<f64> = Vec::new();
    for step in 0..50 {
        let t = f64::from(step) * 0.03;
        let off = 0.01 * f64::from(step);
        angles.push(off);
        // A whole turn does not count as a difference.
        let angle = phi1(t).to_degrees() + off + 360.0;
        table += &format!("{};{angle};{}\n", t * 1e3, 1e3 * phi1(t).cos() - 2.0);
    }
    let folder = with_table("compare_units", table.replace('.', ","));
    let options = "compare a.mech data.csv --column angle=phi1,px=P_x --time time --json";
    let report = json(&folder.run(options).exits_with(0).stdout);
    let [angle, point] = report["columns"].as_array().expect("columns").as_slice() else {
        panic!("{report}");
    };
    let close = |report: &Value, expected: f64| {
        let value = number(report);
        assert!((value - expected).abs() < 1e-9, "{value} {expected}");
    };
    close(&angle["largest"], 0.49);
    close(&angle["t"], 1.47);
    close(
        &angle["rms"],
        (angles.iter().map(|it| it * it).sum::<f64>() / 50.0).sqrt(),
    );
    close(&point["largest"], -2.0);
    close(&point["rms"], 2.0);
    assert_eq!(
        (&angle["unit"], &angle["unit_from"], &angle["how"]),
        (&"deg".into(), &"header".into(), &"option".into())
    );
    for (tolerance, code) in [
        ("3mm,1deg", 0),
        ("1mm,1deg", 1),
        ("px=3mm", 0),
        ("px=3mm,0.1deg", 1),
        ("2.5e-3", 1),
    ] {
        let options = format!("{} --tolerance {tolerance}", options.replace(" --json", ""));
        folder.run(&options).exits_with(code);
    }
}

#[test]
fn nothing_is_guessed_in_silence() {
    let folder = with_table(
        "compare_guesses",
        "t,P_X,noise,phi1\n0,0.866,1,30\n0.1,0.8,2,41\n",
    );
    let ran = folder.run("compare a.mech data.csv").exits_with(0);
    for said in [
        "read as UTF-8, `,` between cells, decimal points, names in line 1",
        "times are `t` in s, as no unit is given",
        "P_x (guessed)",
        "m (assumed)",
        "left out: `noise`, no quantity of the mechanism has this name",
    ] {
        assert!(ran.stdout.contains(said), "{said}: {}", ran.stdout);
    }
    assert!(
        ran.stderr.contains("pass `--unit phi1=deg`"),
        "{}",
        ran.stderr
    );
    let ran = folder
        .run("compare a.mech data.csv --unit deg --skip noise")
        .exits_with(0);
    assert!(
        !ran.stderr.contains("deg") && ran.stdout.contains("left out: `noise`, `--skip`"),
        "{ran:?}"
    );
}

#[test]
fn errors_have_their_place_and_a_remedy() {
    for (name, table, options, said) in [
        (
            "word",
            "t,phi1\n0,0.5\n0.1,abc\n",
            "",
            "error[K29]: `abc` is not a number\n --> data.csv:3:5",
        ),
        (
            "back",
            "t,phi1\n0.1,0.5\n0,0.6\n",
            "",
            "error[K29]: the time decreases\n --> data.csv:3:1",
        ),
        (
            "untimed",
            "t,phi1\n0.1,0.5\n,0.6\n",
            "",
            "error[K29]: a row without a time\n --> data.csv:3:1",
        ),
        (
            "dated",
            "t,phi1,P_x\n2026-01-01,0.5,1\n2026-01-02,0.6,1\n",
            "",
            "error[K29]: the cells of `t` are words, not times",
        ),
        (
            "timeless",
            "a,phi1\n0,0.5\n",
            "",
            "no column of `data.csv` is called `t` or `time`\n  = help: name the column of times with `--time`: a, phi1",
        ),
        (
            "unit",
            "t,phi1 (mm)\n0,0.5\n",
            "",
            "`phi1` cannot be in mm: it measures `phi1`\n --> data.csv:1:3",
        ),
        (
            "unknown",
            "t,u\n0,0.5\n",
            "",
            "no column of `data.csv` matches a quantity of `two_body`: u",
        ),
        (
            "meant",
            "t,u\n0,0.5\n",
            "--column u=phi11",
            "nothing of `two_body` is called `phi11`; did you mean `phi1`?",
        ),
        (
            "missed",
            "t,uu\n0,0.5\n",
            "--column u=phi1",
            "no column of `data.csv` is called `u`; did you mean `uu`?",
        ),
        (
            "twice",
            "t,u,u\n0,0.5,1\n",
            "--column u=phi1",
            "columns 2 and 3 of `data.csv` are both called `u`",
        ),
        (
            "form",
            "t,u\n0,0.5\n",
            "--column u",
            "`--column` takes `COLUMN=QUANTITY`",
        ),
        (
            "unitless",
            "t,phi1\n0,0.5\n",
            "--unit parsec",
            "`parsec` is not a unit",
        ),
        (
            "tolerance",
            "t,phi1\n0,0.5\n",
            "--tolerance x",
            "`--tolerance x` is not a number",
        ),
        (
            "none",
            "t,phi1\n0,0.5\n",
            "--tolerance 1mm",
            "`--tolerance 1mm` matches none of the compared columns",
        ),
        (
            "missing",
            "t,phi1\n0,0.5\n",
            "--time u",
            "no column of `data.csv` is called `u`",
        ),
    ] {
        let folder = with_table(&format!("compare_{name}"), table);
        let ran = folder
            .run(&format!("compare a.mech data.csv {options}"))
            .exits_with(2);
        assert!(ran.stderr.contains(said), "{name}: {}", ran.stderr);
        assert!(ran.stdout.is_empty(), "{name}");
    }
    let folder = Folder::new("compare_absent", EXAM);
    let ran = folder.run("compare a.mech none.csv").exits_with(2);
    assert!(
        ran.stderr
            .contains("cannot read `none.csv`: the file does not exist"),
        "{}",
        ran.stderr
    );
}

#[test]
fn pictures_show_both_curves_and_nothing_else_is_replaced() {
    let folder = with_table(
        "compare_plots",
        "t,phi1,a/b\n0,0.5,0.9\n0.1,0.7,0.8\n0.2,0.9,0.6\n",
    );
    let run = |code| {
        folder
            .run("compare a.mech data.csv --column a/b=P_x --plot pictures")
            .exits_with(code)
    };
    let ran = run(0);
    assert!(
        ran.stdout.contains("wrote pictures/phi1.svg"),
        "{}",
        ran.stdout
    );
    assert_eq!(folder.list("pictures"), ["a_b.svg", "phi1.svg"]);
    let picture = folder.read("pictures/phi1.svg");
    for word in [
        "data",
        "solved",
        "data - solved (rad)",
        "phi1 and phi1 of two_body",
    ] {
        assert!(picture.contains(word), "{word}");
    }
    run(0);
    assert_eq!(
        picture,
        folder.read("pictures/phi1.svg"),
        "the same bytes again"
    );
    std::fs::write(folder.file("pictures/phi1.svg"), "mine").expect("written");
    let ran = run(2);
    assert!(
        ran.stderr.contains("`--force`") || ran.stderr.contains("not a picture"),
        "{}",
        ran.stderr
    );
    assert_eq!(folder.read("pictures/phi1.svg"), "mine");
}

/// A motion that ends before the table is compared up to its end.
#[test]
fn a_motion_that_ends_early_is_an_outcome() {
    let folder = Folder::new("compare_early", crate::folder::driven_by("pi/6 + 2*t"));
    std::fs::write(folder.file("data.csv"), "t,phi1\n0,0.52\n0.1,0.72\n5,10\n").expect("written");
    let ran = folder.run("compare a.mech data.csv --json").exits_with(1);
    let report = json(&ran.stdout);
    assert!(
        report["error"]
            .as_str()
            .is_some_and(|it| it.contains("cannot be solved beyond")),
        "{report}"
    );
    assert_eq!(report["columns"][0]["count"], 2);
}

/// A crank that turns at 30 turns in a minute.
const TURNING: &str = "mechanism turning {
    point O = (0, 0);
    body arm at O { O, P: (50mm, 0) }
    revolute O(ground, arm);
    drive turn: phi(arm) = 30rpm*t;
    mass arm = 2kg at P inertia 0.4;
    gravity = (0, -9.81);
    effort;
}
";

/// The torque is m g r cos φ = 2 · 9.81 · 0.05 N·m at t = 0, and cos(π/3) = 1/2 of that after a third of a second.
#[test]
fn units_of_logs_are_those_of_descriptions() {
    for (name, header, values, scale) in [
        (
            "u",
            "phi_arm_d (U/min)",
            ["30", "30"],
            std::f64::consts::PI / 30.0,
        ),
        (
            "r",
            "phi_arm_d (r/min)",
            ["30", "30"],
            std::f64::consts::PI / 30.0,
        ),
        (
            "rpm",
            "phi_arm_d (rpm)",
            ["30", "30"],
            std::f64::consts::PI / 30.0,
        ),
        (
            "minute",
            "phi_arm_d (1/min)",
            ["30", "30"],
            std::f64::consts::PI / 30.0,
        ),
        (
            "hertz",
            "phi_arm_d (Hz)",
            ["0.5", "0.5"],
            std::f64::consts::TAU,
        ),
        ("knm", "effort_turn (kNm)", ["0.000981", "0.0004905"], 1e3),
        ("nmm", "effort_turn (Nmm)", ["981", "490.5"], 1e-3),
        ("mnm", "effort_turn (mNm)", ["981", "490.5"], 1e-3),
        (
            "meganewton",
            "effort_turn (MN*m)",
            ["9.81e-7", "4.905e-7"],
            1e6,
        ),
        (
            "foot",
            "effort_turn (lbf*ft)",
            ["0.7235484684410", "0.3617742342205"],
            1.355_817_948_331_400_4,
        ),
    ] {
        let folder = Folder::new(&format!("compare_unit_{name}"), TURNING);
        let table = format!(
            "t (s),{header}\n0,{}\n0.3333333333333333,{}\n",
            values[0], values[1]
        );
        std::fs::write(folder.file("data.csv"), table).expect("it can be written");
        let ran = folder.run("compare a.mech data.csv --json").exits_with(0);
        let report = json(&ran.stdout);
        let largest = number(&report["columns"][0]["largest"]).abs() * scale;
        assert!(largest < 1e-9, "{header}: {largest}");
        let counts = ["minute", "hertz"].contains(&name);
        assert_eq!(
            report["columns"][0]["counts_turns"] == true,
            counts,
            "{header}"
        );
        let stdout = folder.run("compare a.mech data.csv").exits_with(0).stdout;
        assert_eq!(
            stdout.contains("`phi_arm_d` counts turns: 1 "),
            counts,
            "{stdout}"
        );
    }
    let folder = Folder::new("compare_contradiction", TURNING);
    std::fs::write(folder.file("data.csv"), "t (s),P_x (mm)\ns,m\n0,50\n")
        .expect("it can be written");
    let ran = folder.run("compare a.mech data.csv").exits_with(2);
    assert!(ran.stderr.contains(" --> data.csv:2:3"), "{}", ran.stderr);
}

/// A crank whose angle the table holds, in degrees that begin anew with each turn.
#[test]
fn measured_inputs_drive_the_mechanism() {
    let folder = Folder::new(
        "compare_input",
        "mechanism measured_input {
    param reach = 102mm;
    input turned = 0deg;
    point O = (0, 0);
    body arm at O { O, P: (reach, 0) }
    revolute O(ground, arm);
    drive phi(arm) = turned;
}
",
    );
    let rows = (0..40).map(|step| {
        let t = 0.05 * f64::from(step);
        let angle = 3.0 * t + 0.4 * (2.0 * t).sin();
        let rate = 3.0 + 0.8 * (2.0 * t).cos();
        let logged = angle.to_degrees() % 360.0;
        format!("{t},{logged},{},{}\n", 102.0 * angle.cos(), rate)
    });
    let table =
        "t (s),turned (deg),P_x (mm),phi_arm_d (rad/s)\n".to_string() + &rows.collect::<String>();
    std::fs::write(folder.file("data.csv"), &table).expect("it can be written");
    let report = json(
        &folder
            .run("compare a.mech data.csv --json")
            .exits_with(0)
            .stdout,
    );
    assert!(
        number(&report["columns"][0]["largest"]).abs() < 1e-9,
        "{report}"
    );
    // Rates are those of the spline: 0.05 s of a motion of 2 rad/s leave some (2·0.05)⁴.
    assert!(
        number(&report["columns"][1]["largest"]).abs() < 1e-3,
        "{report}"
    );
    let ran =
        folder.run("calibrate a.mech data.csv --param reach --set reach=95mm --skip phi_arm_d");
    let stdout = ran.exits_with(0).stdout;
    assert!(
        stdout.contains("`turned` in deg drives the input"),
        "{stdout}"
    );
    assert!(stdout.contains("0.102"), "{stdout}");
    let holed = table.replacen("0,0,102", "0,,102", 1);
    std::fs::write(folder.file("data.csv"), holed).expect("it can be written");
    let ran = folder.run("compare a.mech data.csv").exits_with(2);
    assert!(
        ran.stderr.contains("has no value in its first or last row"),
        "{}",
        ran.stderr
    );
}
