//! Assemblies that `linkwright check` lists.

use std::collections::BTreeSet;

use crate::check::{close, described, object};
use crate::folder::Folder;
use crate::printed::number;

/// The pin C is where circles about B and D meet; coupler and rocker are closest to being collinear at the smallest and
/// the largest distance of B and D. The crank then lies along the ground link.
#[test]
fn a_four_bar_has_the_two_assemblies_of_two_circles() {
    let folder = Folder::new("check_four_bar", described("four_bar"));
    let report = object(&folder, "", 0);
    let all = report["assemblies"].as_array().expect("a list");
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
        for (report, wanted) in [
            (b[0] + 0.12 * coupler.cos(), b[0] + c[0]),
            (b[1] + 0.12 * coupler.sin(), b[1] + c[1]),
            (0.1 + 0.08 * rocker.cos(), b[0] + c[0]),
            (0.08 * rocker.sin(), b[1] + c[1]),
        ] {
            assert!(
                (report - wanted).abs() < 1e-12,
                "{report} instead of {wanted}"
            );
        }
    }
    // sin of the angle between links of 120 and 80 mm that span 60 mm, at a crank angle of 2π.
    let cosine: f64 =
        (0.12_f64.powi(2) + 0.08_f64.powi(2) - 0.06_f64.powi(2)) / (2.0 * 0.12 * 0.08);
    let closest = &report["blocks"][0]["closest"];
    close(
        "sine",
        &closest["measure"],
        (1.0 - cosine * cosine).sqrt(),
        1e-12,
    );
    let first = (std::f64::consts::TAU - crank) / 3.0;
    close("t", &closest["t"], first, 1e-9);
    assert_eq!(
        report["blocks"][0]["singular_where"],
        "B-C and C-D are collinear"
    );
}

#[test]
fn the_excavator_has_sixteen_assemblies_that_all_differ() {
    let folder = Folder::new("check_excavator", described("excavator"));
    let report = object(&folder, "--to 2", 0);
    assert_eq!(report["assembly_modes"], 4);
    let all = report["assemblies"].as_array().expect("a list");
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
    for block in report["blocks"].as_array().expect("a list") {
        let t = number(&block["closest"]["t"]);
        assert!((t - std::f64::consts::FRAC_PI_3).abs() < 1e-9, "{block}");
    }
}

/// Number of assemblies of the platform of three legs in a turn. For a given angle, two differences of the legs'
/// equations are linear in its position; changes of sign of the first leg's equation are counted.
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
        // Multiplied by the determinant, which removes the pole at parallel differences of the legs.
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
    let report = object(&folder, "", 0);
    let all = report["assemblies"].as_array().expect("a list");
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

/// The ground link is longer than the sum of all others.
#[test]
fn mechanism_out_of_reach_has_no_assemblies() {
    let apart = described("four_bar").replace("D = (100mm, 0)", "D = (300mm, 0)");
    let folder = Folder::new("check_apart", apart);
    let report = object(&folder, "", 1);
    assert_eq!(report["assemblies"].as_array().map(Vec::len), Some(0));
    assert!(report["error"].is_string());
}

/// The excavator's four dyads, each with its sign; the rack's angles are not coordinates; a cam's contact is an angle
/// of its curve.
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
        ["phi_left", "phi_u_s", "phi_right", "phi_v_t"]
    );
    assert!(rack.contains("explicit: phi_rack 0.0000°"), "{rack}");
    let cam = table("cam_dwell");
    assert_eq!(names(&cam), ["s_tip"]);
    assert!(cam.contains("  b      b  -180.0000°"), "{cam}");
    let lever = table("quick_return");
    assert!(lever.contains("0.223607 m"), "{lever}");
}
