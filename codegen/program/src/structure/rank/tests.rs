//! Checks ranks against counts by hand.

use super::{FreeMotion, Moves, Survey, released};
use crate::diagnostic::{Diagnostics, Source};
use crate::model::Naming;
use crate::system::Derived;

/// Naming without changes.
const ANY: Naming = Naming {
    mechanism: |_| None,
    motion: |_| None,
    apart: |name, _| name.to_string(),
};

/// Assembles the equations of a mechanism's statements.
fn derived(statements: &str) -> Derived {
    let source = Source::new("case.mech", format!("mechanism case {{\n{statements}\n}}"));
    let mut diagnostics = Diagnostics::new();
    let document = linkwright_description::syntax::parse(&source, &mut diagnostics);
    let motions =
        document.and_then(|document| crate::model::resolve(&document, &ANY, &mut diagnostics));
    assert!(!diagnostics.has_errors(), "{}", diagnostics.render(&source));
    let motion = motions.and_then(|mut all| all.pop());
    let (mut pool, mechanism) = motion.expect("a mechanism");
    let system = released(&mut pool, mechanism);
    Derived { pool, system }
}

const PARALLELOGRAM: &str = "
    point A = (0, 0), B = (1, 0), C = (2, 0), K = (0.3, 0.4), L = (1.3, 0.4), M = (2.3, 0.4);
    body 1 at A { A, K }
    body 2 at B { B, L }
    body 3 at C { C, M }
    body 4 at K { K, L, M }
    revolute A(ground, 1);
    revolute B(ground, 2);
    revolute C(ground, 3);
    revolute K(1, 4);
    revolute L(2, 4);
";

fn survey(statements: &str) -> Survey {
    let Derived { pool, system } = derived(statements);
    Survey::of(&pool, &system).expect("poses")
}

/// Has twelve coordinates and twelve pin equations: immobile by Grübler's count, and yet it moves.
#[test]
fn a_parallelogram_with_three_cranks_moves_although_grubler_forbids_it() {
    let result = survey(&format!("{PARALLELOGRAM} revolute M(3, 4);"));
    assert_eq!((result.kinematic, result.net), (1, 1));
    assert_eq!(result.dependences.len(), 1);
    // All pin equations matter; the last row repeats x and y of all others.
    assert_eq!(result.dependences[0].row, 11);
    assert_eq!(result.dependences[0].repeats, (0..11).collect::<Vec<_>>());
    let about = Moves::About("A".to_string());
    assert_eq!(
        result.motions,
        [FreeMotion {
            leader: Some(1),
            moves: about,
            others: vec![2, 3, 4]
        }]
    );
}

#[test]
fn a_driven_parallelogram_with_a_third_crank_is_determined() {
    let result = survey(&format!(
        "{PARALLELOGRAM} redundant revolute M(3, 4); drive phi(1) = t;"
    ));
    assert_eq!((result.kinematic, result.net), (1, 0));
    assert_eq!((result.dependences.len(), result.motions.len()), (1, 0));
}

/// Has a third crank of another length: twelve independent equations fix all coordinates.
#[test]
fn a_crank_of_another_length_holds_the_parallelogram() {
    let statements = PARALLELOGRAM.replace("C = (2, 0)", "C = (2.1, -0.1)");
    let result = survey(&format!("{statements} revolute M(3, 4);"));
    assert_eq!((result.kinematic, result.net), (0, 0));
    assert_eq!(result.dependences, []);
}

/// Has two sliders of three equations, which repeat the second slider's angle and its position across the line.
#[test]
fn a_body_between_parallel_sliders_repeats_both_equations() {
    let result = survey(
        "point P = (0, 0), Q = (1, 0), R = (0, 1), S = (1, 1);
         body 1 at P { Q, S }
         translational (ground, 1) along P -> Q;
         translational (ground, 1) along R -> S;",
    );
    assert_eq!((result.kinematic, result.net), (1, 1));
    let pairs: Vec<_> = result
        .dependences
        .iter()
        .map(|it| (it.row, it.repeats.clone()))
        .collect();
    assert_eq!(pairs[0], (2, vec![0]));
    assert_eq!(pairs[1].0, 3);
    assert_eq!(result.motions[0].moves, Moves::Along("P -> Q".to_string()));
}

#[test]
fn a_pendulum_on_a_slider_has_two_motions() {
    let result = survey(
        "point P = (0, 0), Q = (1, 0), E = (1, -1);
         body c at Q { Q }
         body d at Q { Q, E }
         translational (ground, c) along P -> Q;
         revolute Q(c, d);",
    );
    assert_eq!((result.kinematic, result.net), (2, 2));
    assert_eq!(
        result.motions,
        [
            FreeMotion {
                leader: Some(1),
                moves: Moves::Along("P -> Q".to_string()),
                others: vec![2]
            },
            FreeMotion {
                leader: Some(2),
                moves: Moves::About("Q".to_string()),
                others: vec![]
            }
        ]
    );
}

#[test]
fn a_marked_joint_keeps_the_rows_that_determine_something() {
    let system = derived(&format!(
        "{PARALLELOGRAM} redundant revolute M(3, 4); drive phi(1) = t;"
    ))
    .system;
    let names = |rows: &[crate::system::Row]| -> Vec<String> {
        rows.iter().map(|row| row.name.clone()).collect()
    };
    assert_eq!(names(&system.monitored).len(), 1);
    assert_eq!(system.rows.len(), system.coordinates.len());
    // The third crank rotates about its other pin, so the row across it determines its angle equally in every pose.
    assert_eq!(names(&system.monitored), ["m_along"]);
}
