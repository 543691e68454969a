//! Derivation as `linkwright plan` prints it: its words, and that its formulas give the motion.

use std::collections::BTreeSet;

use linkwright_codegen::stages::emit::Notation;
use linkwright_codegen::stages::expr::Tape;
use linkwright_tests::plan::{derivation, form_names, forms};
use linkwright_tests::printed::{Values, value};
use linkwright_tests::reference::{REFERENCES, reference, yardsticks};
use linkwright_tests::{description, files};

fn page(name: &str) -> String {
    derivation(description::system(name)).text(Notation::Ascii)
}

fn snapshot(name: &str, printed: &str) {
    crate::assert_snapshot("plans", name, printed);
}

/// Pages with a snapshot of the whole text: each solution method in its plainest example, and the excavator.
const PAGES: [&str; 13] = [
    "planetary_gear",
    "leveled_slider",
    "two_body",
    "inclined_slider",
    "four_bar",
    "rack_steering",
    "excavator",
    "turning_rail",
    "quick_return",
    "inverted_slider_crank",
    "two_lines",
    "platform_3rpr",
    "cam_dwell",
];

/// Pages in the other notations: the exam, and one page with vectors and a driven length.
const TYPESET: [&str; 2] = ["two_body", "crane"];

#[test]
fn pages_are_written_as_in_their_snapshots() {
    for name in PAGES {
        snapshot(name, &page(name));
    }
}

#[test]
fn the_exam_and_a_crane_are_typeset_as_in_their_snapshots() {
    for name in TYPESET {
        let derivation = derivation(description::system(name));
        let unicode = derivation.text(Notation::Unicode);
        snapshot(&format!("{name}.unicode"), &unicode);
        snapshot(&format!("{name}.latex"), &derivation.latex());
    }
}

/// Every solution method of any described mechanism, except for the size of a Newton-Raphson.
#[test]
fn every_form_has_a_page() {
    let kinds = |names: &[String]| -> BTreeSet<String> {
        let forms = names.iter().flat_map(|name| form_names(name));
        let kind = |form: String| form.split(" of size").next().unwrap_or(&form).to_string();
        forms.map(kind).collect()
    };
    let described = [description::whole(), description::small()].concat();
    assert_eq!(kinds(&PAGES.map(str::to_string)), kinds(&described));
}

#[test]
fn every_outline_is_as_in_the_snapshot() {
    let outlines: Vec<String> = description::whole()
        .iter()
        .map(|name| {
            let outline = derivation(description::system(name)).outline(Notation::Ascii);
            format!("{name}\n{outline}")
        })
        .collect();
    snapshot("outlines", &outlines.join("\n"));
}

#[test]
fn no_snapshot_is_orphaned() {
    for path in files::with_extension(&files::package("snapshots/plans"), "snap") {
        let stem = files::stem(&path);
        let typeset = TYPESET
            .iter()
            .any(|name| stem == format!("{name}.unicode") || stem == format!("{name}.latex"));
        let printed = stem == "outlines" || PAGES.contains(&stem);
        assert!(typeset || printed, "{stem} is printed by no test");
    }
}

/// Solution methods with the names of their unknowns, in solve order.
fn named_forms(name: &str) -> Vec<(Vec<String>, String)> {
    forms(description::system(name))
}

/// With pins instead of centers of mass as origins, equal angles are solved in the same order by the same methods.
#[test]
fn the_frames_make_no_difference_to_the_steps() {
    let dyads = [
        ["phi_c3", "phi_c10"],
        ["phi_c2", "phi_c8"],
        ["phi_c4", "phi_c6"],
        ["phi_c1", "phi_c5"],
    ];
    let expected = dyads.map(|pair| (pair.map(str::to_string).to_vec(), "RRR dyad".to_string()));
    assert_eq!(named_forms("excavator"), expected);
    assert_eq!(named_forms("excavator_pins"), expected);
}

/// The headings name the pins as the description does.
#[test]
fn the_dyads_are_named_after_their_pins() {
    for name in ["excavator", "excavator_pins"] {
        let text = page(name);
        for heading in [
            "Block 2. phi_c3 and phi_c10 from the triangle L-H-G with |HG| known from the driver",
            "Block 3. phi_c2 and phi_c8 from the triangle F-N-M with |NM| known from the driver",
            "Block 4. phi_c4 and phi_c6 from the triangle I-E-D",
            "Block 5. phi_c1 and phi_c5 from the triangle A-J-B",
        ] {
            assert!(
                text.contains(&format!("\n{heading}\n")),
                "{heading}\n{text}"
            );
        }
    }
}

/// The exam's hand solution: the angle from the x row, then y2 from the y row.
#[test]
fn the_exam_is_derived_as_its_hand_solution() {
    let text = page("two_body");
    let lines: Vec<&str> = text
        .lines()
        .map(|line| line.split("  [").next().unwrap_or(line).trim())
        .collect();
    for line in [
        "x2 = sqrt(3)",
        "phi1 = pi/6 + sin(2*t)",
        "cos(phi1) + sqrt(3)*cos(phi2) - sqrt(3) = 0",
        "cos(phi2) = 1 - sqrt(3)*cos(phi1)/3",
        "sin(phi2) = sqrt((1 - cos(phi2))*(cos(phi2) + 1))",
        "y2 = sin(phi1) + sqrt(3)*sin(phi2)",
    ] {
        assert!(lines.contains(&line), "{line}\n{text}");
    }
}

/// Values of a page read line by line: by name, and the names of those that were not printed but needed.
struct Calculated {
    values: Values,
    /// The names with a formula on the page.
    printed: Vec<String>,
}

/// Evaluates the displayed equations in order. `others` are values that the page uses without a formula of its own:
/// the tearing variables of Newton-Raphson, and accelerations that it leaves to the reader.
fn calculated(text: &str, t: f64, others: &Values) -> Calculated {
    let mut values = others.clone();
    values.insert("t".to_string(), t);
    let mut printed = Vec::new();
    // A wide choice continues over several lines.
    let mut lines: Vec<String> = Vec::new();
    for line in text.lines().filter_map(|line| line.strip_prefix("    ")) {
        match lines.last_mut() {
            Some(begun) if line.trim_start().starts_with("else ") => {
                *begun = format!("{begun} {}", line.trim());
            }
            _ => lines.push(line.to_string()),
        }
    }
    for line in lines {
        let line = line.split("  [").next().unwrap_or(&line).trim();
        let Some((left, right)) = line.split_once(" = ") else {
            continue;
        };
        if let Some((x, y)) = right
            .strip_prefix('(')
            .and_then(|it| it.strip_suffix(')'))
            .and_then(|it| it.split_once(", "))
        {
            for (axis, part) in [("x", x), ("y", y)] {
                if let Some(found) = value(part, &values) {
                    values.insert(format!("{left}_{axis}"), found);
                }
            }
            continue;
        }
        // Lines with sums on the left, vectors and lengths without a value define nothing.
        let Some(found) = value(right, &values) else {
            continue;
        };
        match left.strip_suffix("^2") {
            Some(name) => {
                values.insert(name.to_string(), found.sqrt());
            }
            None => {
                values.insert(left.to_string(), found);
                printed.push(left.to_string());
            }
        }
    }
    Calculated { values, printed }
}

/// Every printed formula of every mechanism, evaluated as printed, against the high-precision references:
/// coordinates, velocities and the accelerations that are printed.
#[test]
fn the_printed_formulas_give_the_motion() {
    for (name, _) in REFERENCES {
        let table = reference(name);
        let scales = yardsticks(&table);
        let derived = description::system(name);
        let text = page(name);
        let names: Vec<String> = ["", "'", "''"]
            .iter()
            .flat_map(|dots| {
                let coordinates = derived.system.coordinates.iter();
                coordinates.map(move |coordinate| format!("{}{dots}", coordinate.name))
            })
            .collect();
        let tears: usize = named_forms(name)
            .iter()
            .filter(|(_, method)| method.starts_with("Newton"))
            .map(|(unknowns, _)| unknowns.len())
            .sum();
        for row in table.rows.iter().step_by(7) {
            let exact: Values = names
                .iter()
                .cloned()
                .zip(row[1..].iter().copied())
                .collect();
            // A value with a formula on the page must come from that formula, and before its use.
            let printed = calculated(&text, row[0], &exact).printed;
            let mut others = exact.clone();
            others.retain(|name, _| !printed.contains(name));
            let page = calculated(&text, row[0], &others);
            let compared = |level: std::ops::Range<usize>| {
                names[level]
                    .iter()
                    .filter(|it| page.printed.contains(it))
                    .count()
            };
            let size = derived.system.coordinates.len();
            assert_eq!(compared(0..size), size - tears, "{name} prints no formula");
            for (column, quantity) in names.iter().enumerate() {
                if !page.printed.contains(quantity) {
                    continue;
                }
                let mut error = page.values[quantity] - exact[quantity];
                if quantity.starts_with("phi") && !quantity.ends_with('\'') {
                    // An angle is unique up to whole turns.
                    error = (error / std::f64::consts::TAU).fract();
                    error = (error - error.round()) * std::f64::consts::TAU;
                }
                let allowed = 1e-12 * scales[column].max(1e-3);
                assert!(
                    error.abs() <= allowed,
                    "{name}: {quantity} at t = {} is off by {error:e}",
                    row[0]
                );
            }
        }
    }
}

/// Solution methods that no described mechanism has: the printed formulas satisfy the textbook's equations and their
/// first derivative. The residuals are judged against lengths of 1 to 4 m.
#[test]
fn the_other_forms_satisfy_the_textbook_equations() {
    for (name, method) in [
        ("two_lines", "PRP or RPP dyad"),
        ("turning_rail", "RRP dyad"),
        ("inclined_slider", "one angle"),
        // Links without a body, a driven one, a block beside its line, a rack, and an angle that follows another in its loop.
        ("coupled_rockers", "RRR dyad"),
        ("pushed_apart", "RRR dyad"),
        ("offset_slot", "RPR dyad"),
        ("rolling_pinion", "PRP or RPP dyad"),
        ("driven_coupler", "RRR dyad"),
    ] {
        let derived = description::system(name);
        let solved_forms = forms(derived.clone());
        let methods: Vec<&str> = solved_forms.iter().map(|(_, form)| form.as_str()).collect();
        assert_eq!(methods, [method]);
        let text = derivation(derived.clone()).text(Notation::Ascii);
        for t in [0.0, 0.4, 1.1, 2.7] {
            let solved_forms = calculated(&text, t, &Values::new()).values;
            let graph = &derived.pool.graph;
            let mut symbols = vec![0.0; graph.symbol_count()];
            symbols[derived.system.mechanism.time.index()] = t;
            for coordinate in &derived.system.coordinates {
                symbols[coordinate.position.index()] = solved_forms[&coordinate.name];
            }
            let rate = |coordinate: usize| {
                solved_forms[&format!("{}'", derived.system.coordinates[coordinate].name)]
            };
            let evaluated = |expr| {
                let mut result = [0.0];
                Tape::new(graph, &[expr]).evaluate(&symbols, &mut Vec::new(), &mut result);
                result[0]
            };
            for row in &derived.system.rows {
                let residual = evaluated(row.residual);
                assert!(
                    residual.abs() < 1e-14,
                    "{name}: {} at {t}: {residual:e}",
                    row.name
                );
                // A constant has no formula for its rate, which is zero.
                let moving = row.jacobian.iter().filter(|entry| {
                    let name = &derived.system.coordinates[entry.coordinate].name;
                    solved_forms.contains_key(&format!("{name}'"))
                });
                let moved: f64 = moving
                    .map(|entry| evaluated(entry.value) * rate(entry.coordinate))
                    .sum();
                let drift = moved + evaluated(row.time_derivative);
                assert!(
                    drift.abs() < 1e-14,
                    "{name}: the rate of {} at {t}: {drift:e}",
                    row.name
                );
            }
        }
    }
}

#[test]
fn a_wrong_formula_would_be_found() {
    let none = Values::new();
    let right = calculated("    x1 = 2*sin(t)  [driver]\n", 0.5, &none);
    assert_eq!(right.values["x1"], 2.0 * 0.5_f64.sin());
    assert_eq!(right.printed, ["x1"]);
    let squared = calculated(
        "    |AB|^2 = 3^2 + (1 + 3)^2\n    k = -|AB|/2\n",
        0.0,
        &none,
    );
    assert_eq!(squared.values["k"], -2.5);
    let pair = calculated("    AB = (0.1, -0.7)\n    h = AB_x - AB_y\n", 0.0, &none);
    assert_eq!(pair.values["h"], 0.1 + 0.7);
    let chain = calculated(
        "    cos(phi2) = 0.6\n    sin(phi2) = sqrt(1 - cos(phi2)^2)\n    phi2 = atan2(sin(phi2), cos(phi2))\n",
        0.0,
        &none,
    );
    assert!((chain.values["phi2"] - 0.8_f64.atan2(0.6)).abs() < 1e-15);
    let pieces = calculated(
        "    turn_1 = t - 2*floor(t/2)\n    k = if turn_1 < 0.5 { 1 }\n        else if turn_1 > 1.5 { 2*t }\n        else { 3 }\n    z = -(if k > 2 { k } else { 0 })\n",
        3.75,
        &none,
    );
    assert_eq!(pieces.values["turn_1"], 1.75);
    assert_eq!(pieces.values["k"], 7.5);
    assert_eq!(pieces.values["z"], -7.5);
    assert!(
        calculated("    LG + GH = LH\n    x = y'\n", 0.0, &none)
            .printed
            .is_empty()
    );
}
