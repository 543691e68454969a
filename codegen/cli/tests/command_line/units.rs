//! Units of output from the outside: the statement `units`, the option `--units`, and the most frequent units of
//! descriptions.

use crate::folder::Folder;
use crate::printed::json;

/// A crank of changeable length that lifts a mass; its closed form is P = L (cos φ, sin φ) with φ = 1/2 + 3/2 t.
const CRANK: &str = "mechanism crank {
    param L = 500mm;
    point O = (0, 0);
    body arm at O { O, P: (L, 0) }
    revolute O(ground, arm);
    drive phi(arm) = 0.5rad + 1.5*t;
    mass arm = 2kg at P;
    gravity = (0, -10);
    transmission P;
    sensitivity L;
    effort;
    reaction O;
}
";

const T: f64 = 0.4;
const DEGREES: f64 = 180.0 / std::f64::consts::PI;

/// Names and values of the last row.
fn columns(text: &str) -> Vec<(String, f64)> {
    let mut lines = text.lines();
    let names = lines.next().expect("a header").split(',');
    let pairs = names.zip(lines.last().expect("a row").split(','));
    let value = |cell: &str| cell.parse().unwrap_or(f64::NAN);
    pairs
        .map(|(name, cell)| (name.to_string(), value(cell)))
        .collect()
}

#[track_caller]
fn assert_column(columns: &[(String, f64)], name: &str, expected: f64) {
    let column = columns.iter().find(|it| it.0 == name);
    let (_, column) = column.unwrap_or_else(|| panic!("no `{name}` in {columns:?}"));
    let off = (column - expected).abs();
    assert!(
        off <= 1e-13 * expected.abs().max(1.0),
        "{name}: {column}, expected {expected}"
    );
}

/// Columns of the crank at t = 0.4 s in mm, deg and N·mm.
fn assert_in_millimeters(columns: &[(String, f64)]) {
    let (length, angle, rate) = (500.0, 0.5 + 1.5 * T, 1.5_f64);
    let (sine, cosine) = angle.sin_cos();
    assert_column(columns, "t (s)", T);
    assert_column(columns, "phi_arm (deg)", angle * DEGREES);
    assert_column(columns, "phi_arm_d (deg/s)", rate * DEGREES);
    assert_column(columns, "phi_arm_dd (deg/s²)", 0.0);
    assert_column(columns, "P_x (mm)", length * cosine);
    assert_column(columns, "P_vy (mm/s)", length * cosine * rate);
    assert_column(columns, "P_ax (mm/s²)", -length * cosine * rate * rate);
    assert_column(
        columns,
        "P_x per phi(arm) (mm/deg)",
        -length * sine / DEGREES,
    );
    assert_column(columns, "phi_arm per L (deg/mm)", 0.0);
    assert_column(columns, "x_arm_d per L (1/s)", 0.0);
    // The torque that holds 2 kg at an arm of L cos φ; the arm turns at a constant rate.
    assert_column(
        columns,
        "effort_drive_phi_arm (N*mm)",
        20.0 * length * cosine,
    );
    let power = 20.0 * 0.5 * cosine * rate;
    assert_column(columns, "power_drive_phi_arm (W)", power);
}

#[test]
fn tables_are_in_the_requested_units() {
    let folder = Folder::new("units", CRANK);
    let solve = |options: &str| {
        let ran = folder.run(&format!("solve a.mech --at {T} --csv - {options}"));
        ran.exits_with(0).stdout
    };
    let by_option = solve("--units=mm,deg,N*mm");
    assert_in_millimeters(&columns(&by_option));
    let si = columns(&solve(""));
    assert_column(&si, "P_x", 0.5 * (0.5 + 1.5 * T).cos());
    let named = columns(&solve("--units"));
    assert_column(&named, "P_x (m)", 0.5 * (0.5 + 1.5 * T).cos());
    assert_column(
        &named,
        "P_x per phi(arm) (m/rad)",
        -0.5 * (0.5 + 1.5 * T).sin(),
    );
    let inches = columns(&solve("--units=inch,rpm"));
    assert_column(&inches, "P_x (inch)", 0.5 / 0.0254 * (0.5 + 1.5 * T).cos());
    assert_column(
        &inches,
        "phi_arm_d (rpm)",
        1.5 * 30.0 / std::f64::consts::PI,
    );
    assert_column(&inches, "phi_arm (rad)", 0.5 + 1.5 * T);
    // The statement has the same effect, and an option overrides it.
    let stated = CRANK.replace("crank {", "crank {\n    units mm, deg, N*mm;");
    std::fs::write(folder.file("a.mech"), stated).expect("the file is written");
    assert_eq!(solve(""), by_option);
    assert_eq!(columns(&solve("--units=m,rad")), named);
}

#[test]
fn json_is_in_the_requested_units() {
    let folder = Folder::new("units_json", CRANK);
    let ran = folder.run(&format!("solve a.mech --at {T} --json --units=mm,deg,N*mm"));
    let object = json(&ran.exits_with(0).stdout);
    assert_eq!(object["units"]["q"][2], "deg");
    assert_eq!(object["units"]["qdd"][0], "mm/s²");
    assert_eq!(object["units"]["velocity"], "mm/s");
    assert_eq!(object["derivative_units"][0], "mm/deg");
    let angle = 0.5 + 1.5 * T;
    let near = |value: &serde_json::Value, expected: f64| {
        let value = value.as_f64().expect("a number");
        assert!((value - expected).abs() < 1e-10, "{value} {expected}");
    };
    let frame = &object["frames"][0];
    near(&frame["q"][2], angle * DEGREES);
    near(&frame["qd"][2], 1.5 * DEGREES);
    near(&frame["points"]["P"]["position"][1], 500.0 * angle.sin());
    let forces = object["forces"].as_array().expect("forces");
    let effort = forces.iter().position(|it| it[0] == "effort_drive_phi_arm");
    let effort = effort.expect("an effort");
    assert_eq!(forces[effort][1], "N*mm");
    near(&frame["forces"][effort], 1e4 * angle.cos());
}

#[test]
fn summaries_and_pictures_name_the_units() {
    let folder = Folder::new("units_summary", CRANK);
    let ran = folder.run("solve a.mech --to 1 --step 0.1 --units=mm,deg,N*mm --out out");
    let summary = ran.exits_with(0).stdout;
    for wanted in [
        "P: position, velocity, acceleration in mm, mm/s, mm/s²",
        "angles in deg",
        "L = 500 mm",
        "effort_drive_phi_arm (N*mm)",
        "O stays at (0.000000, 0.000000) mm",
    ] {
        assert!(summary.contains(wanted), "{wanted}: {summary}");
    }
    assert!(folder.read("out/paths.svg").contains("x (mm)"));
    assert!(folder.read("out/P.svg").contains("(mm/s²)"));
    assert!(
        folder
            .read("out/effort_drive_phi_arm.svg")
            .contains("(N*mm)")
    );
    assert!(
        folder
            .read("out/motion.csv")
            .starts_with("t (s),x_arm (mm),")
    );
    let drawn = folder.run("draw a.mech --units=inch --out picture.svg");
    drawn.exits_with(0);
    assert!(folder.read("picture.svg").contains(" inch</text>"));
    // Printed angles may have another unit than those in files.
    let ran = folder.run("solve a.mech --to 1 --units=mm --angles deg --out out");
    assert!(ran.exits_with(0).stdout.contains("angles in deg"));
    assert!(folder.read("out/motion.csv").contains("phi_arm (rad)"));
}

#[test]
fn a_table_is_read_in_the_units_that_it_was_written_in() {
    let folder = Folder::new("units_compare", CRANK);
    let solved = folder.run("solve a.mech --to 1 --units=mm,deg --csv b.csv --no-files");
    solved.exits_with(0);
    let compared = folder.run("compare a.mech b.csv --tolerance 1e-12");
    let compared = compared.exits_with(0).stdout;
    assert!(compared.contains("mm/s²"), "{compared}");
    let fitted = folder.run("calibrate a.mech b.csv --param L --set L=450mm --units=mm --json");
    let fitted = json(&fitted.stdout);
    let length = &fitted["parameters"][0];
    assert_eq!(length["unit"], "mm");
    let value = length["value"].as_f64().expect("a number");
    assert!((value - 500.0).abs() < 1e-6, "{value}");
}

#[test]
fn checks_and_proofs_are_in_the_requested_units() {
    let folder = Folder::new("units_check", CRANK);
    let ran = folder.run("check a.mech --to 1 --prove --units=mm,deg");
    let text = ran.exits_with(0).stdout;
    assert!(text.contains("angles (deg)"), "{text}");
    assert!(text.contains("points (mm)"), "{text}");
    let ran = folder.run("check a.mech --to 1 --prove --units=mm,deg --json");
    let object = json(&ran.exits_with(0).stdout);
    assert_eq!(object["units"]["point"], "mm");
    let bounds = &object["proof"]["coordinates"]["phi_arm"];
    let [low, high] = [0, 1].map(|end| bounds[end].as_f64().expect("a bound"));
    let ends = [0.5, 2.0].map(|angle: f64| angle * DEGREES);
    assert!(
        low <= ends[0] && ends[1] <= high && high - low < 90.0,
        "{bounds}"
    );
}

/// Links of 40 mm and 60 mm between pins that are 110 mm apart.
const OPEN: &str = "mechanism open {
    point A = (0, 0), B = (50mm, 50mm), C = (110mm, 0);
    body 1 at A { A, B: (40mm, 0) }
    body 2 at C { C, B: (-60mm, 0) }
    revolute A(ground, 1);
    revolute B(1, 2);
    revolute C(2, ground);
}
";

/// Links of 40 mm and 60 mm with a foot that follows the time: it is 110 mm away at 1 s, beyond the reach of 100 mm.
const LEAVING: &str = "mechanism leaving {
    point A = (0, 0), B = (50mm, 50mm), C = (80mm, 0);
    body 1 at A { A, B: (60mm, 0) }
    body 2 at C facing C -> B { C, B: (40mm, 0) }
    body foot at C { C }
    revolute A(ground, 1);
    revolute B(1, 2);
    revolute C(2, foot);
    absolute_y(foot) = 0;
    absolute_angle(foot) = 0;
    drive x(foot) = 80mm + 30mm/s*t;
}
";

#[test]
fn messages_take_the_units_that_the_description_writes() {
    let folder = Folder::new("units_messages", OPEN);
    let stderr_with = |options: &str| {
        folder
            .run(&format!("solve a.mech {options}"))
            .exits_with(2)
            .stderr
    };
    assert!(
        stderr_with("").contains("out of reach by 10 mm"),
        "{}",
        stderr_with("")
    );
    assert!(stderr_with("--units=cm").contains("out of reach by 1 cm"));
    assert!(stderr_with("--units=m").contains("out of reach by 0.01 m"));
    let folder = Folder::new("units_leaving", LEAVING);
    let stderr_with = |options: &str| {
        folder
            .run(&format!("solve a.mech --no-files {options}"))
            .exits_with(1)
            .stderr
    };
    // 30 mm/s · 0.67 s = 20.1 mm exceed the reach.
    assert!(
        stderr_with("").contains("out of reach by 0.1000 mm"),
        "{}",
        stderr_with("")
    );
    assert!(
        stderr_with("--units=m").contains("out of reach by 1.0e-4 m"),
        "{}",
        stderr_with("--units=m")
    );
}

#[test]
fn pages_take_the_units_that_the_description_writes() {
    let folder = Folder::new("units_page", CRANK);
    folder.run("view a.mech --to 0.1").exits_with(0);
    let page = folder.read("crank.html");
    assert!(page.contains("<th>position, mm</th>"));
    assert!(page.contains("[\"mm/s²\",1000.0]"));
    // Angles are written in rad alone.
    assert!(page.contains("[\"rad\",1.0]"));
    folder
        .run("view a.mech --to 0.1 --units=inch,deg")
        .exits_with(0);
    let page = folder.read("crank.html");
    assert!(page.contains("<th>position, inch</th>"));
    assert!(page.contains("[\"deg/s\","));
}

#[test]
fn refuses_unit_that_is_not_one_of_output() {
    let folder = Folder::new("units_refused", CRANK);
    for (units, message) in [
        ("furlong", "no unit is named `furlong`"),
        ("ms", "times are in s"),
        ("mm,cm", "`mm` and `cm` measure the same"),
        ("mm,", "no unit is named ``"),
    ] {
        let ran = folder.run(&format!("solve a.mech --units={units}"));
        let stderr = ran.exits_with(2).stderr;
        assert!(stderr.contains(message), "{stderr}");
    }
    // A list behind a blank would be taken for a file.
    let stderr = folder
        .run("solve a.mech --units mm,deg")
        .exits_with(2)
        .stderr;
    assert!(stderr.contains("--units=mm,deg"), "{stderr}");
    assert_eq!(folder.list(""), ["a.mech"]);
}
