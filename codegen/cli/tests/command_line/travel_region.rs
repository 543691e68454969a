//! `linkwright travel` with two drives: borders and workspaces with closed forms.

use serde_json::Value;

use crate::folder::Folder;
use crate::printed::{json, number};

const ARM: &str = "mechanism arm {
    point O = (0, 0);
    body upper at (0, 0, 30deg) { O: (0, 0), E: (300mm, 0) }
    body lower at (260mm, 150mm, 80deg) { E: (0, 0), K: (200mm, 0) }
    revolute O(ground, upper);
    revolute E(upper, lower);
    drive phi(upper) = 30deg;
    drive elbow: relative_angle(upper, lower) = 50deg;
}
";

const CYLINDERS: &str = "mechanism cylinders {
    point O = (0, 0), P = (-100mm, -50mm);
    body boom at (0, 0, 30deg) { O: (0, 0), A: (100mm, -30mm), C: (150mm, 60mm), E: (300mm, 0) }
    body stick at (260mm, 150mm, -40deg) { E: (0, 0), D: (-80mm, 20mm), K: (200mm, 0) }
    revolute O(ground, boom);
    revolute E(boom, stick);
    drive lift: distance(ground.P, boom.A) = 212mm;
    drive curl: distance(boom.C, stick.D) = 110mm;
    measure lift_length = distance(ground.P, boom.A);
    limit lift_length from 180mm to 220mm;
    measure curl_length = distance(boom.C, stick.D);
    limit curl_length from 90mm to 160mm;
}
";

/// Pairs of numbers of a JSON array.
fn pairs(values: &Value) -> Vec<[f64; 2]> {
    let values = values.as_array().expect("an array").iter();
    values.map(|it| [number(&it[0]), number(&it[1])]).collect()
}

#[test]
fn two_cylinders_move_in_a_rectangle_of_limits_and_reach() {
    let folder = Folder::new("travel_cylinders", CYLINDERS);
    let command = "travel a.mech --drive lift --drive curl --point K --plot pictures";
    let report = json(
        &folder
            .run(&format!("{command} --json"))
            .exits_with(0)
            .stdout,
    );
    let borders = report["borders"].as_array().expect("borders");
    assert_eq!((borders.len(), &borders[0]["closed"]), (1, &true.into()));
    // The cylinder of the boom is longest with P, O and A in line.
    let longest = 100_f64.hypot(50.0) + 100_f64.hypot(30.0);
    let sections = borders[0]["sections"].as_array().expect("sections");
    let mut sides = [0; 4];
    for section in sections {
        for [lift, curl] in pairs(&section["values"]) {
            let distances = [lift - 180.0, longest - lift, curl - 90.0, 160.0 - curl];
            let nearest = distances
                .iter()
                .map(|it| it.abs())
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-3, "({lift}, {curl}) is not on the border");
            assert!(
                distances.iter().all(|it| *it > -1e-3),
                "({lift}, {curl}) is outside"
            );
            for (count, distance) in sides.iter_mut().zip(distances) {
                *count += usize::from(distance.abs() < 1e-3);
            }
        }
        let is_reach = section["end"] == "reach";
        assert!(is_reach || section["end"] == "limit", "{}", section["end"]);
    }
    assert!(sides.iter().all(|it| *it > 5), "{sides:?}");
    // The image of the border is that of its points.
    let first = &sections[0];
    let (tips, values) = (pairs(&first["tips"]), pairs(&first["values"]));
    assert_eq!(tips.len(), values.len());
    let region = folder.read("pictures/region.svg");
    let workspace = folder.read("pictures/workspace.svg");
    assert!(region.contains("limit of `curl_length`"), "{region}");
    assert!(workspace.contains("x of K (mm)"), "{workspace}");
}

#[test]
fn the_workspace_of_two_links_is_an_annulus() {
    let folder = Folder::new("travel_annulus", ARM);
    let command = "travel a.mech --drive phi(upper) --drive elbow --point K --json";
    let report = json(&folder.run(command).exits_with(0).stdout);
    let mut radii = Vec::new();
    for fold in report["folds"].as_array().expect("folds") {
        for section in fold["sections"].as_array().expect("sections") {
            let tips = pairs(&section["tips"]).into_iter();
            radii.extend(tips.map(|[x, y]| x.hypot(y)));
            // The links are in line.
            for [_, elbow] in pairs(&section["values"]) {
                let off = (elbow / 180.0 - (elbow / 180.0).round()).abs();
                assert!(off < 1e-4, "the elbow is at {elbow} degrees");
            }
        }
    }
    for radius in [500.0, 100.0] {
        let near = radii
            .iter()
            .filter(|it| (*it - radius).abs() < 1e-3 * radius);
        assert!(near.count() > 20, "{radius}");
    }
    let is_on_circle = |it: &f64| (it - 500.0).abs() < 0.1 || (it - 100.0).abs() < 0.1;
    assert!(radii.iter().all(is_on_circle), "{radii:?}");
    for border in report["borders"].as_array().expect("borders") {
        let sections = border["sections"].as_array().expect("sections");
        assert!(sections.iter().all(|it| it["end"] == "unended"));
    }
}

#[test]
fn options_of_two_drives_are_refused_for_one() {
    let folder = Folder::new("travel_two_refused", ARM);
    for (arguments, reason) in [
        ("--drive elbow --point K", "are for two drives"),
        ("--drive elbow --drive elbow", "two different drives"),
        ("--drive elbow --drive phi(upper) --point L", "`L`"),
    ] {
        let ran = folder
            .run(&format!("travel a.mech {arguments}"))
            .exits_with(2);
        assert!(ran.stderr.contains(reason), "{}", ran.stderr);
    }
}
