//! The two interpreters agree: textbook and solved formulation of every description, along its motion, in pose,
//! velocity and acceleration. The first iterates on all rows, the second takes block after block by the statements of
//! the generated code.

use linkwright::{FailureKind, Frame, Settings, Shell};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::values::{assembled_from, assembled_with};

/// Duration of a motion (s); the number of frames follows.
const END: f64 = 0.5;
const FRAMES: u32 = 50;

/// Bound on rounding of a pose, velocity or acceleration of these mechanisms, none of which comes near a singular
/// pose.
const LIMIT: f64 = 1e-13;

/// Largest difference of q, q̇ and q̈, relative to the largest value of each level (or 1).
fn difference(derived: &Derived) -> Option<[f64; 3]> {
    let textbook = TextbookEquations::new(&derived.pool, &derived.system);
    let solved = Interpreted::new(derived)?;
    let laws = solved.input_laws();
    let settings = Settings::default();
    let mut shell: Option<Shell<Interpreted>> = None;
    let mut last: Option<(Frame<f64, _>, _)> = None;
    let mut worst = [0.0_f64; 3];
    for step in 0..=FRAMES {
        let t = END * f64::from(step) / f64::from(FRAMES);
        let solved_frame = match &mut shell {
            None => {
                let assembled = assembled_with(solved.clone(), &[], t, &laws.at(t), settings);
                assembled.map(|assembled| {
                    let instant = assembled.frame().clone();
                    shell = Some(assembled);
                    instant
                })
            }
            Some(shell) => shell.advance(t, &laws.at(t)).cloned(),
        };
        let frame = match (&last, &solved_frame) {
            (Some((frame, branch)), _) => frame.follow(&textbook, *branch, t, &settings),
            // A poor estimate may be nearer to another assembly than to the one with its branches.
            (None, Ok(instant)) => Frame::assemble(&textbook, &instant.frame().q, t, &settings),
            (None, Err(_)) => return None,
        };
        let (frame, solved_frame) = match (frame, solved_frame) {
            (Ok(frame), Ok(solved_frame)) => (frame, solved_frame.frame()),
            // A motion ends in both formulations.
            (Err(_), Err(_)) => break,
            // The textbook formulation of this test has no loads.
            (Ok(_), Err(failure)) if matches!(failure.kind, FailureKind::LoadNotFinite { .. }) => {
                break;
            }
            (one, other) => panic!("t = {t}: textbook {one:?}, solved {other:?}"),
        };
        for (level, (one, other)) in [&frame.q, &frame.qd, &frame.qdd]
            .into_iter()
            .zip([&solved_frame.q, &solved_frame.qd, &solved_frame.qdd])
            .enumerate()
        {
            let size = one.amax().max(1.0);
            worst[level] = worst[level].max((one - other).amax() / size);
        }
        let branch = Frame::branch_of(&textbook, &frame.q, t, &settings).expect("a regular pose");
        last = Some((frame, branch));
    }
    last.map(|_| worst)
}

#[test]
fn both_views_describe_the_same_motion() {
    for name in [description::names(), description::small()].concat() {
        for derived in description::motions(&name) {
            let Some(worst) = difference(&derived) else {
                panic!("{name}: no frame in one of the views");
            };
            for (level, difference) in ["q", "q̇", "q̈"].iter().zip(worst) {
                println!("{name}, {level}: {difference:.1e}");
                assert!(difference < LIMIT, "{name}, {level}: {difference:e}");
            }
        }
    }
}

/// One leg of the platform is driven beyond the reach of the others: the attempt fails in a substep, and leaves no
/// trace.
#[test]
fn a_motion_that_ends_leaves_the_last_pose() {
    let text = description::source("platform_3rpr").text.clone();
    let longer = text.replace("0.08*sin(t)", "0.9*sin(t)");
    assert_ne!(text, longer);
    let source = Source::new("platform.mech", longer);
    let read = linkwright_codegen::read(&source).expect("a description");
    let solved = Interpreted::new(&read.only().expect("one motion")).expect("a plan");
    let laws = solved.input_laws();
    let mut shell = assembled_from(solved, &[], 0.0, Settings::default()).expect("as drawn");
    let before = shell.frame().clone();
    let failure = shell.advance(1.5, &laws.at(1.5));
    assert!(failure.is_err_and(|failure| failure.block == 1 && failure.time > 0.5));
    assert_eq!(*shell.frame(), before);
    shell.advance(0.1, &laws.at(0.1)).expect("a short step");
}

/// A page or a server solves in a thread besides that of its interface.
#[test]
fn an_interpreted_mechanism_may_be_moved_to_another_thread() {
    let derived = description::system("four_bar");
    let mechanism = Interpreted::new(&derived).expect("blocks");
    let count = std::thread::spawn(move || mechanism.plan().blocks.len());
    assert!(count.join().expect("no panic") > 0);
}
