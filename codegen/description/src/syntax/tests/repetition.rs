//! Tests expansion: repetitions, indices and parts.

use super::super::*;
use super::{codes, good};

/// Returns the names that statements declare, in order.
fn declared(document: &Document) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for statement in &document.mechanism.statements {
        match statement {
            Statement::Points(it) => names.extend(it.points.iter().map(|it| it.name.text.as_str())),
            Statement::Body(it) => names.push(&it.name.text),
            Statement::Constant(it) => names.push(&it.name.text),
            Statement::Parameter(it) => names.push(&it.constant.name.text),
            Statement::Joint(it) => names.extend(it.name.iter().map(|it| it.text.as_str())),
            _ => names.push("?"),
        }
    }
    names
}

#[test]
fn statements_are_written_out_in_order() {
    let document = good(
        "mechanism m {
            const n = 2;
            repeat i from 0 to n { point P[i] = (i, -i); }
            repeat i from 1 to n {
                repeat j from i to n { body rod[i][j + 1] at P[i - 1]; }
                revolute K2[2*n/4](rod[1][2], ground);
            }
            repeat i from 2 to 1 { body none[i] at (0, 0); }
        }",
    );
    let names = [
        "n", "P0", "P1", "P2", "rod1_2", "rod1_3", "K2_1", "rod2_3", "K2_1",
    ];
    assert_eq!(declared(&document), names);
    let written = &document.spellings;
    assert_eq!(written["rod1_3"], "rod[1][3]");
    assert_eq!(written["K2_1"], "K2[1]");
    let Statement::Points(points) = &document.mechanism.statements[3] else {
        panic!("points");
    };
    let [x, y] = [&points.points[0].position.x, &points.points[0].position.y];
    let digits = |it: &Expression| match &it.kind {
        ExpressionKind::Number { digits, unit: None } => digits.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!(digits(x), "2");
    assert!(matches!(&y.kind, ExpressionKind::Negative(it) if digits(it) == "2"));
}

#[test]
fn motions_are_repeated_and_repeat() {
    let document = good(
        "mechanism m {
            body a[1] at (0, 0);
            body a[2] at (0, 0);
            repeat k from 1 to 2 {
                motion way[k] {
                    repeat i from 1 to 2 { drive phi(a[i]) = k*i*t; }
                }
            }
        }",
    );
    let motions = document.mechanism.motions();
    let motions: Vec<_> = motions
        .map(|it| (it.name.text.as_str(), it.statements.len()))
        .collect();
    assert_eq!(motions, [("way1", 2), ("way2", 2)]);
}

#[test]
fn a_part_is_called_after_its_name() {
    let document = good(
        "mechanism inner { param L = 1; point A = (0, L); body rod at A { A, Q: (L, 0) } }
         mechanism outer {
             const n = 1;
             repeat i from 1 to n { part inner[i] = inner(L = 2*i); }
             revolute K(inner[1].rod, ground);
             weld (inner[1].rod.Q, inner[1].A);
         }
         mechanism m {
             const L = 3;
             part o = outer(n = 2);
             body rod at o.inner[2].A { o.inner[2].A }
             revolute (o.inner[2].rod.Q, rod);
             drive o.inner[1].A.x = L;
         }",
    );
    let names = [
        "L",
        "o_n",
        "o_inner1_L",
        "o_inner1_A",
        "o_inner1_rod",
        "o_inner2_L",
        "o_inner2_A",
        "o_inner2_rod",
        "o_K",
        "rod",
    ];
    assert_eq!(declared(&document)[..10], names);
    let mut references = Vec::new();
    for statement in &document.mechanism.statements {
        if let Statement::Joint(Joint { operands, .. }) | Statement::Drive(Drive { operands, .. }) =
            statement
        {
            references.extend(operands.iter().map(|it| match &it.body {
                Some(body) => format!("{}.{}", body.text, it.name.text),
                None => it.name.text.clone(),
            }));
        }
    }
    let written = [
        "o_inner1_rod",
        "ground",
        "o_inner1_rod.o_inner1_Q",
        "o_inner1_A",
        "o_inner2_rod.o_inner2_Q",
        "rod",
        "o_inner1_A",
    ];
    assert_eq!(references, written);
    assert_eq!(document.spellings["o_inner2_Q"], "o.inner[2].Q");
}

#[test]
fn locates_errors_in_the_source_text() {
    // One finding, although the statement is repeated and a part is used twice.
    let text = "mechanism cell {
        body rod at (0, 0) { P: (1) }
    }
    mechanism m {
        repeat i from 1 to 3 {
            part cell[i] = cell;
            body b[i] at (i, 0) { Q: (1) }
        }
        body c[1 at (0, 0);
        point A = (0, 0);
    }";
    assert_eq!(codes(text), ["K30 2:33", "K30 7:38", "K04 9:27"]);
    // A part can be a part neither of itself nor of a mechanism above it.
    let text =
        "mechanism a { part b = b; } mechanism b { part b = b; } mechanism m { part x = b; }";
    assert_eq!(codes(text), ["K11 1:24", "K11 1:52"]);
}

#[test]
fn a_brace_that_is_missing_is_found_near_its_place() {
    let text = "mechanism m {
        repeat i from 1 to 2 {
            body a[i] at (0, 0) { P: (1, 0)
            body b[i] at (0, 0);
        }
    }";
    assert_eq!(codes(text), ["K04 3:44"]);
}
