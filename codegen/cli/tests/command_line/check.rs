//! `linkwright check` from the outside.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::folder::{EXAM, Folder};
use crate::printed::{json, number};

/// The object that is printed for the options.
#[track_caller]
fn object(folder: &Folder, options: &str, code: i32) -> Value {
    let ran = folder
        .run(&format!("check a.mech --json {options}"))
        .exits_with(code);
    json(&ran.stdout)
}

#[track_caller]
fn close(what: &str, found: &Value, wanted: f64, tolerance: f64) {
    let found = number(found);
    assert!(
        (found - wanted).abs() <= tolerance,
        "{what}: {found} instead of {wanted}"
    );
}

fn described(name: &str) -> String {
    let path = format!(
        "{}/../../mechanisms/{name}.mech",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::read_to_string(path).expect("a description")
}

/// cos φ2 = 1 − cos φ1/√3, so that φ2 is smallest where φ1 = π/6 + sin 2t is closest to π/2: at t = π/4, π/4 + π, …
#[test]
fn the_exam_comes_closest_to_singular_where_its_drive_turns_back() {
    let folder = Folder::new("check_exam", EXAM);
    let found = object(&folder, "", 0);
    assert_eq!((&found["kdof"], &found["ndof"]), (&1.into(), &0.into()));
    let block = &found["blocks"][0];
    assert_eq!(block["unknowns"], "phi2");
    assert_eq!(block["method"], "one angle");
    assert_eq!(block["determinant"], "sqrt(3)*sin(phi2)");
    let meaning = block["singular_where"].as_str().expect("words");
    assert!(meaning.contains("parallel to the x axis"), "{meaning}");
    let phi1 = std::f64::consts::FRAC_PI_6 + 1.0;
    let cosine = 1.0 - phi1.cos() / 3_f64.sqrt();
    let closest = &block["closest"];
    close("t", &closest["t"], std::f64::consts::FRAC_PI_4, 1e-9);
    close(
        "sine",
        &closest["measure"],
        (1.0 - cosine * cosine).sqrt(),
        1e-12,
    );
    assert_eq!(
        (&closest["times"], &closest["at_end"]),
        (&2.into(), &false.into())
    );
    // Φ_q of the exam has the determinant ±√3 sin φ2, so its condition is finite there.
    assert!(number(&closest["rcond"]) > 1e-3);
    // Coarse frames are refined to the same time.
    let coarse = object(&folder, "--step 0.3 --to 1.5", 0);
    let closest = &coarse["blocks"][0]["closest"];
    close("t", &closest["t"], std::f64::consts::FRAC_PI_4, 1e-9);
}

/// The rod may point up or down from the pin: φ2 and −φ2.
#[test]
fn the_exam_has_two_assemblies() {
    let folder = Folder::new("check_exam_assemblies", EXAM);
    let found = object(&folder, "", 0);
    let all = found["assemblies"].as_array().expect("a list");
    assert_eq!((all.len(), &found["assembly_modes"]), (2, &1.into()));
    assert_eq!(
        (&all[0]["drawn"], &all[1]["drawn"]),
        (&true.into(), &false.into())
    );
    close("phi2", &all[0]["q"][5], std::f64::consts::FRAC_PI_3, 1e-12);
    close("phi2", &all[1]["q"][5], -std::f64::consts::FRAC_PI_3, 1e-12);
}

/// With another drive the crank goes on to φ1 = π/2, where the rod lies across the line on which its end moves.
#[test]
fn the_exam_driven_through_its_singular_pose_ends_there() {
    let driven = EXAM.replace("pi/6 + sin(2*t)", "pi/6 + t");
    assert_ne!(driven, EXAM);
    let folder = Folder::new("check_singular", driven);
    let found = object(&folder, "", 1);
    let closest = &found["blocks"][0]["closest"];
    assert_eq!(closest["at_end"], true);
    let end = std::f64::consts::FRAC_PI_3;
    close("t", &closest["t"], end, 1e-8);
    // sin φ2 falls as the root of the time that is left.
    assert!(number(&closest["measure"]) < 1e-4, "{closest}");
    let error = found["error"].as_str().expect("why it ends");
    let time: f64 = error
        .split("beyond t = ")
        .nth(1)
        .and_then(|rest| rest.split(" s").next())
        .and_then(|text| text.parse().ok())
        .expect("a time");
    assert!((time - end).abs() <= 2e-9, "{error}");
    let warnings = found["warnings"].as_array().expect("a list");
    assert!(
        warnings.iter().any(|it| it.as_str().is_some_and(|text| text
            .contains("the line from P to the origin of body 2 is parallel to the x axis"))),
        "{warnings:?}"
    );
}

/// The pin C is where circles about B and D meet; coupler and rocker are closest to being in line where the distance between
/// B and D is smallest or largest, which is where the crank lies along the ground link.
#[test]
fn a_four_bar_has_the_two_assemblies_of_two_circles() {
    let folder = Folder::new("check_four_bar", described("four_bar"));
    let found = object(&folder, "", 0);
    let all = found["assemblies"].as_array().expect("a list");
    assert_eq!(all.len(), 2);
    let crank = 40_f64.to_radians();
    let b = [0.04 * crank.cos(), 0.04 * crank.sin()];
    let d = [0.1 - b[0], -b[1]];
    let distance = d[0].hypot(d[1]);
    let along = (0.12_f64.powi(2) - 0.08_f64.powi(2) + distance.powi(2)) / (2.0 * distance);
    let across = (0.12_f64.powi(2) - along * along).sqrt();
    let unit = [d[0] / distance, d[1] / distance];
    for (assembly, side) in all.iter().zip([1.0, -1.0]) {
        let c = [
            along * unit[0] - side * across * unit[1],
            along * unit[1] + side * across * unit[0],
        ];
        let coupler = number(&assembly["q"][5]);
        let rocker = number(&assembly["q"][8]);
        for (found, wanted) in [
            (b[0] + 0.12 * coupler.cos(), b[0] + c[0]),
            (b[1] + 0.12 * coupler.sin(), b[1] + c[1]),
            (0.1 + 0.08 * rocker.cos(), b[0] + c[0]),
            (0.08 * rocker.sin(), b[1] + c[1]),
        ] {
            assert!(
                (found - wanted).abs() < 1e-12,
                "{found} instead of {wanted}"
            );
        }
    }
    // sin of the angle between links of 120 and 80 mm that span 60 mm, at a crank angle of 2π.
    let cosine: f64 =
        (0.12_f64.powi(2) + 0.08_f64.powi(2) - 0.06_f64.powi(2)) / (2.0 * 0.12 * 0.08);
    let closest = &found["blocks"][0]["closest"];
    close(
        "sine",
        &closest["measure"],
        (1.0 - cosine * cosine).sqrt(),
        1e-12,
    );
    let first = (std::f64::consts::TAU - crank) / 3.0;
    close("t", &closest["t"], first, 1e-9);
    assert_eq!(
        found["blocks"][0]["singular_where"],
        "B-C and C-D are in line"
    );
}

#[test]
fn the_excavator_has_sixteen_assemblies_that_all_differ() {
    let folder = Folder::new("check_excavator", described("excavator"));
    let found = object(&folder, "--to 2", 0);
    assert_eq!(found["assembly_modes"], 4);
    let all = found["assemblies"].as_array().expect("a list");
    assert_eq!(all.len(), 16);
    assert_eq!(all.iter().filter(|it| it["drawn"] == true).count(), 1);
    let poses: Vec<Vec<f64>> = all
        .iter()
        .map(|it| it["q"].as_array().expect("q").iter().map(number).collect())
        .collect();
    for (index, pose) in poses.iter().enumerate() {
        for other in &poses[..index] {
            let gap = pose.iter().zip(other).map(|(a, b)| (a - b).abs());
            assert!(gap.fold(0.0, f64::max) > 1e-3);
        }
        // L-G and G-H: the joint G is held at its distances from the ground pins L and H in each of them.
        let (sine, cosine) = pose[8].sin_cos();
        let g = [
            pose[6] - 0.1 * sine - 0.3 * cosine,
            pose[7] - 0.3 * sine + 0.1 * cosine,
        ];
        let from_l = (g[0] - 0.6).hypot(g[1] - 0.3);
        assert!((from_l - 0.18_f64.sqrt()).abs() < 1e-12, "{from_l}");
    }
    // The cylinders are longest at t = π/3.
    for block in found["blocks"].as_array().expect("a list") {
        let t = number(&block["closest"]["t"]);
        assert!((t - std::f64::consts::FRAC_PI_3).abs() < 1e-9, "{block}");
    }
}

/// How often the platform of three legs closes on its way round. For a given angle two differences of the legs' equations are
/// linear in its position; what is left is the first leg's equation, whose changes of sign are counted.
fn poses_of_the_platform() -> usize {
    let pins = [[-0.8, -0.5], [0.8, -0.5], [0.0, 0.9]];
    let corners = [[-0.05, -0.3], [0.28, 0.1], [-0.23, 0.2]];
    let squared: Vec<f64> = (0..3)
        .map(|leg| {
            (0..2)
                .map(|k| f64::powi(corners[leg][k] - pins[leg][k], 2))
                .sum()
        })
        .collect();
    let excess = |angle: f64| -> f64 {
        let (sine, cosine) = angle.sin_cos();
        // |x + w|² = ℓ² with w = R b − a.
        let w: Vec<[f64; 2]> = (0..3)
            .map(|leg| {
                let [x, y] = corners[leg];
                let [a, b] = pins[leg];
                [cosine * x - sine * y - a, sine * x + cosine * y - b]
            })
            .collect();
        let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let difference = |leg: usize| {
            let row = [w[leg][0] - w[0][0], w[leg][1] - w[0][1]];
            let right = 0.5 * (squared[leg] - squared[0] - square(w[leg]) + square(w[0]));
            (row, right)
        };
        let ((p, r), (q, s)) = (difference(1), difference(2));
        let determinant = p[0] * q[1] - p[1] * q[0];
        // Multiplied by the determinant, so that there is no pole where the legs' differences are parallel.
        let x = r * q[1] - s * p[1];
        let y = p[0] * s - q[0] * r;
        square([x + determinant * w[0][0], y + determinant * w[0][1]])
            - squared[0] * determinant * determinant
    };
    const STEPS: u32 = 100_000;
    let at = |step: u32| excess(f64::from(step) * std::f64::consts::TAU / f64::from(STEPS) - 3.0);
    (0..STEPS)
        .filter(|&step| at(step) * at(step + 1) < 0.0)
        .count()
}

#[test]
fn the_platform_has_as_many_assemblies_as_its_polynomial_roots() {
    let folder = Folder::new("check_platform", described("platform_3rpr"));
    let found = object(&folder, "", 0);
    let all = found["assemblies"].as_array().expect("a list");
    assert_eq!(all.len(), poses_of_the_platform());
    assert_eq!(all[0]["drawn"], true);
    let poses: BTreeSet<Option<u64>> = all.iter().map(|it| it["poses"][0].as_u64()).collect();
    assert_eq!(poses, (0..all.len() as u64).map(Some).collect());
    let text = folder.run("check a.mech").exits_with(0).stdout;
    let counted = format!("assemblies at t = 0 s: {}; these are all", all.len());
    assert!(text.contains(&counted), "{text}");
    assert!(
        text.contains("\n  a  ") && text.contains("\n  b  "),
        "{text}"
    );
}

/// The ground link is longer than all others together.
#[test]
fn what_cannot_be_assembled_has_no_assemblies() {
    let apart = described("four_bar").replace("D = (100mm, 0)", "D = (300mm, 0)");
    let folder = Folder::new("check_apart", apart);
    let found = object(&folder, "", 1);
    assert_eq!(found["assemblies"].as_array().map(Vec::len), Some(0));
    assert!(found["error"].is_string());
}

#[test]
fn text_pictures_and_exit_codes_follow_the_options() {
    let folder = Folder::new("check_options", EXAM);
    let ran = folder.run("check a.mech --plot pictures").exits_with(0);
    for text in [
        "KDOF = 6 - 5 = 1",
        "NDOF = 1 - 1 = 0",
        "singular where sqrt(3)*sin(phi2) = 0",
        "2 of 2^1 = 2",
        "as drawn",
        "t = 0.785398163 s",
    ] {
        assert!(ran.stdout.contains(text), "{text} in {}", ran.stdout);
    }
    assert_eq!(ran.stderr, "");
    let picture = folder.read("pictures/assemblies.svg");
    // The crank of length 1 and the rod of length √3 are drawn to scale, at one scale in both panels.
    let length = |id: &str| -> f64 {
        let shape = picture
            .split(&format!("id=\"{id}\""))
            .nth(1)
            .expect("a body");
        let shape = shape
            .split("<path class=\"body\" d=\"M")
            .nth(1)
            .expect("its shape");
        let edge = shape.split('A').next().expect("its first edge");
        let ends: Vec<f64> = edge
            .split([' ', 'L'])
            .map(|it| it.parse().expect("a number"))
            .collect();
        (ends[2] - ends[0]).hypot(ends[3] - ends[1])
    };
    for panel in [1, 2] {
        let crank = length(&format!("assembly-{panel}-body-1"));
        let rod = length(&format!("assembly-{panel}-body-2"));
        assert!((rod / crank - 3.0_f64.sqrt()).abs() < 1e-3, "{crank} {rod}");
        assert!((crank / length("assembly-1-body-1") - 1.0).abs() < 1e-3);
    }
    assert!(picture.contains(">+ as drawn</text>") && picture.contains(">−</text>"));
    folder.run("check a.mech --deny-warnings").exits_with(0);
    // A rod that comes within half a degree of the x axis, between two frames.
    let near = Folder::new(
        "check_near",
        EXAM.replace("pi/6 + sin(2*t)", "pi/6 + (pi/3 - 0.00001)*sin(2*t)"),
    );
    near.run("check a.mech").exits_with(0);
    let ran = near.run("check a.mech --deny-warnings").exits_with(1);
    assert!(
        ran.stderr.contains("warning: block 2, phi2: only "),
        "{}",
        ran.stderr
    );
    let closest = &object(&near, "", 0)["blocks"][0]["closest"];
    close("t", &closest["t"], std::f64::consts::FRAC_PI_4, 1e-7);
    folder.run("check a.mech --to -1").exits_with(2);
    let help = folder.run("check --help").exits_with(0).stdout;
    assert!(help.contains("--deny-warnings"), "{help}");
}

/// The column of a block is |sin φ2| in the exam, and |sin(φ_rocker − φ_coupler)| in the four-bar.
#[test]
fn solve_monitors_how_close_each_block_is() {
    let folder = Folder::new("monitor_exam", EXAM);
    let ran = folder
        .run("solve a.mech --monitor --csv - --to 1 --step 0.1")
        .exits_with(0);
    let mut lines = ran
        .stdout
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let place = |name: &str| {
        let found = header.iter().position(|it| *it == name);
        found.unwrap_or_else(|| panic!("no {name} in {header:?}"))
    };
    let mut count = 0;
    for line in lines {
        let read = |name: &str| line[place(name)].parse::<f64>().expect("a number");
        let (found, wanted) = (
            read("normalized_determinant_phi2"),
            read("phi2").sin().abs(),
        );
        assert!(
            (found - wanted).abs() < 1e-14,
            "{found} instead of {wanted}"
        );
        count += 1;
    }
    assert_eq!(count, 11);
    assert!(
        ran.stderr.contains("normalized_determinant_phi2 = 0.2")
            && ran.stderr.contains("at t = 0.8 s"),
        "{}",
        ran.stderr
    );
    let plain = folder
        .run("solve a.mech --csv - --to 1 --step 0.1")
        .exits_with(0);
    assert!(!plain.stdout.contains("determinant"));
    folder.run("solve a.mech --monitor --json").exits_with(2);
}

/// The excavator's four dyads, each with its sign; the rack's angles are no coordinates; a cam's contact is an angle of its curve.
#[test]
fn the_table_shows_every_unknown_of_every_block_beside_its_signs() {
    let table = |name: &str| {
        let folder = Folder::new(&format!("check_table_{name}"), described(name));
        let text = folder
            .run("check a.mech --to 0.1")
            .exits_with(0)
            .stdout
            .clone();
        let (_, rest) = text.split_once("\nassemblies at t").expect("assemblies");
        let (table, _) = rest.split_once("\n\n").expect("an end");
        assert!(table.lines().all(|it| it.chars().count() <= 110), "{table}");
        table.to_string()
    };
    let names = |table: &str| -> Vec<String> {
        let lines = table.lines().filter(|it| it.starts_with("  signs "));
        let names = lines.flat_map(|it| it.split_whitespace().skip(1));
        names.map(String::from).collect()
    };
    let excavator = table("excavator");
    assert_eq!(
        names(&excavator),
        [
            "phi_c3", "phi_c10", "phi_c9", "phi_c2", "phi_c8", "phi_c7", "phi_c4", "phi_c6",
            "phi_c1", "phi_c5"
        ]
    );
    let lines: Vec<&str> = excavator.lines().collect();
    let starts = lines.iter().filter(|it| it.starts_with("  +--+ "));
    let signs: String = starts
        .flat_map(|it| it.split_whitespace().skip(1))
        .filter(|it| ["+", "-"].contains(it))
        .collect();
    assert_eq!(signs, "+--+", "{excavator}");
    let headings = lines.iter().filter(|it| it.trim().starts_with("block "));
    let headings: Vec<&str> = headings.flat_map(|it| it.trim().split("  ")).collect();
    let headings: Vec<&str> = headings.into_iter().filter(|it| !it.is_empty()).collect();
    assert_eq!(
        headings.iter().map(|it| it.trim()).collect::<Vec<_>>(),
        ["block 2", "block 3", "block 4", "block 5"]
    );
    let rack = table("rack_steering");
    assert_eq!(
        names(&rack),
        ["phi_left", "psi_u_s", "phi_right", "psi_v_t"]
    );
    assert!(rack.contains("explicit: phi_rack 0.0000°"), "{rack}");
    let cam = table("cam_dwell");
    assert_eq!(names(&cam), ["s_tip"]);
    assert!(cam.contains("  b      b  -180.0000°"), "{cam}");
    let lever = table("quick_return");
    assert!(lever.contains("0.223607 m"), "{lever}");
}

/// A crank-rocker with links of 35, 100, 75 and 90 mm, whose crank is at φ(t).
fn crank_rocker(drive: &str) -> String {
    format!(
        "mechanism a {{
    point A = (0, 0), D = (90mm, 0);
    body crank   at (0, 0, 30deg)       {{ A: (0, 0), B: (35mm, 0) }}
    body coupler at (30mm, 18mm, 30deg) {{ B: (0, 0), C: (100mm, 0) }}
    body rocker  at (90mm, 0, 70deg)    {{ D: (0, 0), C: (75mm, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = {drive};
}}
"
    )
}

/// The sine of the smallest transmission angle, cos μ = (b² + c² − (g − a)²) / 2bc, where the crank lies along the ground link.
fn smallest_transmission() -> f64 {
    let cosine = (0.1_f64.powi(2) + 0.075_f64.powi(2) - 0.055_f64.powi(2)) / (2.0 * 0.1 * 0.075);
    (1.0 - cosine * cosine).sqrt()
}

/// The range is shorter than the step.
#[test]
fn a_range_within_one_step_is_examined() {
    let text =
        crank_rocker("-30deg + 150*t").replace("at (30mm, 18mm, 30deg)", "at (30mm, -18mm, 45deg)");
    let folder = Folder::new(
        "check_short",
        text.replace("at (0, 0, 30deg)", "at (0, 0, -30deg)"),
    );
    let found = object(&folder, "--to 0.008", 0);
    let closest = &found["blocks"][0]["closest"];
    close("t", &closest["t"], std::f64::consts::PI / 6.0 / 150.0, 1e-9);
    close("sine", &closest["measure"], smallest_transmission(), 1e-12);
    assert_eq!(closest["at_end"], false);
}

/// The crank turns ten times in a second: it is along the ground link at (k + 11/12) / 10 s.
#[test]
fn equal_minima_are_counted_and_the_first_is_named() {
    let folder = Folder::new("check_many", crank_rocker("30deg + 20*pi*t"));
    let found = object(&folder, "--to 20 --step 0.005", 0);
    let closest = &found["blocks"][0]["closest"];
    close("sine", &closest["measure"], smallest_transmission(), 1e-12);
    close("t", &closest["t"], 11.0 / 120.0, 1e-9);
    assert_eq!(closest["times"], 200);
}

#[test]
fn the_rest_of_the_last_step_is_examined() {
    let folder = Folder::new("check_rest", crank_rocker("30deg + 20*pi*t"));
    let ran = folder
        .run("check a.mech --to 0.25 --step 0.03")
        .exits_with(0);
    assert!(
        ran.stdout.contains("from t = 0 s to 0.25 s"),
        "{}",
        ran.stdout
    );
    // It is along the ground link at 0.992 s, in the last step alone.
    let found = object(&folder, "--from 0.93 --to 0.9925 --step 0.05", 0);
    close(
        "t",
        &found["blocks"][0]["closest"]["t"],
        119.0 / 120.0,
        1e-9,
    );
}

/// Whether one range lies in another, and is not more than a tenth wider.
#[track_caller]
fn encloses(found: &Value, [low, high]: [f64; 2]) {
    let [least, most] = [number(&found[0]), number(&found[1])];
    assert!(least <= low && high <= most, "{found} around {low}, {high}");
    assert!(
        most - least <= 1.1 * (high - low),
        "{found} around {low}, {high}"
    );
}

/// The rocker turns back where crank and coupler are in line: (b ∓ a)² = g² + c² + 2 g c cos ψ, with ψ from the line D to A on.
#[test]
fn a_turning_crank_rocker_is_proven() {
    let folder = Folder::new("check_prove", crank_rocker("30deg + 20*pi*t"));
    let found = object(&folder, "--to 0.3 --prove", 0);
    let proof = &found["proof"];
    assert_eq!(proof["status"], "proven");
    let least = number(&proof["determinants"][0]["at_least"]);
    let exact = smallest_transmission();
    assert!(0.5 * exact <= least && least <= exact, "{least} of {exact}");
    let psi = |span: f64| {
        let cosine = (0.09_f64.powi(2) + 0.075_f64.powi(2) - span * span) / (2.0 * 0.09 * 0.075);
        std::f64::consts::PI - cosine.acos()
    };
    encloses(
        &proof["coordinates"]["phi_rocker"],
        [psi(0.135), psi(0.065)],
    );
    encloses(
        &proof["coordinates"]["phi_crank"],
        [
            std::f64::consts::PI / 6.0,
            std::f64::consts::PI * (1.0 / 6.0 + 6.0),
        ],
    );
    let text = folder
        .run("check a.mech --to 0.3 --prove")
        .exits_with(0)
        .stdout;
    assert!(
        text.contains("proven: `a` moves on one smooth path from t = 0 s to 0.3 s"),
        "{text}"
    );
}

/// Where crank and rod of the exam come to be in line, the pose is singular.
#[test]
fn what_ends_at_a_singular_pose_is_not_proven() {
    let folder = Folder::new(
        "check_unproven",
        EXAM.replace("pi/6 + sin(2*t)", "pi/6 + t"),
    );
    let found = object(&folder, "--prove", 1);
    let proof = &found["proof"];
    assert_eq!(proof["status"], "sampled");
    let end = std::f64::consts::FRAC_PI_3;
    let window = &proof["unproven"];
    let [from, to] = [number(&window["from"]), number(&window["to"])];
    assert!(from <= end && end - from < 1e-2 && from <= to, "{window}");
    let ran = folder.run("check a.mech --prove").exits_with(1);
    assert!(ran.stdout.contains("*sampled*"), "{}", ran.stdout);
    // Before it the motion is one smooth path.
    let found = object(&folder, "--to 1 --prove", 0);
    assert_eq!(found["proof"]["status"], "proven");
}

/// A parallelogram goes straight on where all links are in line, but its equations do not say so.
#[test]
fn a_change_point_is_not_proven() {
    let text = "mechanism a {
    point A = (0, 0), D = (1, 0);
    body crank    at (0, 0, 90deg) { A: (0, 0), B: (0.3, 0) }
    body coupler  at (0, 0.3, 0)   { B: (0, 0), C: (1, 0) }
    body follower at (1, 0, 90deg) { D: (0, 0), C: (0.3, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, follower);
    revolute D(ground, follower);
    drive phi(crank) = pi/2 + 2*pi*t;
}
";
    let folder = Folder::new("check_change", text);
    let proof = object(&folder, "--to 0.2 --prove", 0);
    assert_eq!(proof["proof"]["status"], "proven");
    let found = object(&folder, "--to 0.4 --step 0.02 --prove", 1);
    let window = &found["proof"]["unproven"];
    let [from, to] = [number(&window["from"]), number(&window["to"])];
    assert!(from <= 0.25 && 0.25 <= to + 1e-3, "{window}");
}

#[test]
fn points_are_those_of_a_proof() {
    let folder = Folder::new("check_points", described("excavator"));
    let found = object(&folder, "--to 0.2 --prove --points K", 0);
    let points = found["proof"]["points"].as_object().expect("points");
    assert_eq!(points.keys().collect::<Vec<_>>(), ["K"]);
    folder.run("check a.mech --points K").exits_with(2);
    folder
        .run("check a.mech --prove --points Kay")
        .exits_with(2);
}
