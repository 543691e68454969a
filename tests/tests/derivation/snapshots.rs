//! The equations of both seeds as they are printed: as Rust, as text in ASCII and in Unicode, and as LaTeX.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::emit::{Notation, latex, text};
use linkwright_codegen::{Options, generate};
use linkwright_tests::{description, files};

fn snapshot(name: &str, printed: &str) {
    crate::assert_snapshot("equations", name, printed);
}

fn rust(name: &str) -> String {
    let source = description::source(name);
    generate(&source, &Options::default())
        .unwrap_or_else(|errors| panic!("{}", errors.render(&source)))
        .code()
        .to_string()
}

fn ascii(name: &str) -> String {
    text::inspect(&description::system(name), Notation::Ascii)
}

fn unicode(name: &str) -> String {
    text::inspect(&description::system(name), Notation::Unicode)
}

fn typeset(name: &str) -> String {
    latex::inspect(&[(&description::system(name), Vec::new())])
}

/// The equations of the mechanism of this name in one form.
type Print = fn(&str) -> String;

/// The forms by the ends of their file names.
const PRINTINGS: [(&str, Print); 4] = [
    ("rust", rust),
    ("ascii", ascii),
    ("unicode", unicode),
    ("latex", typeset),
];

#[test]
fn the_seeds_are_printed_as_in_their_snapshots() {
    for name in ["two_body", "excavator"] {
        for (form, print) in PRINTINGS {
            snapshot(&format!("{name}.{form}"), &print(name));
        }
    }
}

#[test]
fn no_snapshot_is_orphaned() {
    for path in files::with_extension(&files::package("snapshots/equations"), "snap") {
        let stem = files::stem(&path);
        let (name, form) = stem.split_once('.').unwrap_or((stem, ""));
        let is_printed = ["two_body", "excavator"].contains(&name)
            && PRINTINGS.iter().any(|(it, _)| *it == form);
        assert!(is_printed, "{stem} is printed by no test");
    }
}

/// Φ row by row, as the exam writes it.
const EXAM: [&str; 6] = [
    "x1",
    "y1",
    "x1 + cos(phi1) - x2 + sqrt(3)*cos(phi2)",
    "y1 + sin(phi1) - y2 + sqrt(3)*sin(phi2)",
    "x2 - sqrt(3)",
    "phi1 - pi/6 - sin(2*t)",
];

#[test]
fn the_equations_of_the_exam_are_written_as_the_exam_writes_them() {
    let derived = description::system("two_body");
    let rows: Vec<String> = derived
        .system
        .rows
        .iter()
        .map(|row| {
            text::formula(
                &derived.pool,
                &derived.system,
                &row.bodies,
                Notation::Ascii,
                row.residual,
            )
        })
        .collect();
    assert_eq!(rows, EXAM);
    let code = rust("two_body");
    for row in EXAM {
        assert!(
            code.contains(&format!("`{row}`")),
            "{row} is not in the documentation of `phi`"
        );
    }
}

/// Φ_q as the exam's question 6 prints it.
#[test]
fn the_jacobian_of_the_exam_is_written_as_the_exam_writes_it() {
    let derived = description::system("two_body");
    let printed: Vec<Vec<(usize, String)>> = derived
        .system
        .rows
        .iter()
        .map(|row| {
            let entry = |expr| {
                text::formula(
                    &derived.pool,
                    &derived.system,
                    &row.bodies,
                    Notation::Ascii,
                    expr,
                )
            };
            row.jacobian
                .iter()
                .map(|it| (it.coordinate, entry(it.value)))
                .collect()
        })
        .collect();
    let exam: [&[(usize, &str)]; 6] = [
        &[(0, "1")],
        &[(1, "1")],
        &[
            (0, "1"),
            (2, "-sin(phi1)"),
            (3, "-1"),
            (5, "-sqrt(3)*sin(phi2)"),
        ],
        &[
            (1, "1"),
            (2, "cos(phi1)"),
            (4, "-1"),
            (5, "sqrt(3)*cos(phi2)"),
        ],
        &[(3, "1")],
        &[(2, "1")],
    ];
    for (row, exam) in printed.iter().zip(exam) {
        let row: Vec<(usize, &str)> = row
            .iter()
            .map(|(column, entry)| (*column, entry.as_str()))
            .collect();
        assert_eq!(row, exam);
    }
    assert_eq!(printed.len(), exam.len());
}

/// A point given in the drawing keeps its place there exactly, also on a body drawn at an angle without an exact sine.
#[test]
fn a_direction_between_drawn_points_is_not_turned_there_and_back() {
    let source = Source::new(
        "turned.mech",
        "mechanism turned {
            point A = (0, 0), C = (3, 4);
            body q at (0, 0, 1rad) { C }
            translational (ground, q) along A -> C;
            drive length(A, C) = 5 + t;
        }",
    );
    let read = linkwright_codegen::read(&source).expect("a description without errors");
    let derived = read.only().expect("one motion");
    // The direction is (3/5, 4/5): no sine of 1 is left beside x and y.
    for (row, expected) in [(1, ["-0.8", "0.6"]), (2, ["0.6", "0.8"])] {
        let row = &derived.system.rows[row];
        for (entry, expected) in row.jacobian.iter().zip(expected) {
            let printed = text::formula(
                &derived.pool,
                &derived.system,
                &row.bodies,
                Notation::Ascii,
                entry.value,
            );
            assert_eq!(printed, expected);
        }
        let residual = text::formula(
            &derived.pool,
            &derived.system,
            &row.bodies,
            Notation::Ascii,
            row.residual,
        );
        assert!(residual.len() < 200, "{residual}");
    }
}
