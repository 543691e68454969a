//! Statements in the braces of a motion, and braces that are missing there.

use super::super::*;
use super::{codes, good};

fn named(document: &Document) -> Vec<(&str, usize)> {
    let motions = document.mechanism.motions();
    motions
        .map(|motion| (motion.name.text.as_str(), motion.statements.len()))
        .collect()
}

#[test]
fn a_motion_holds_statements() {
    let document = good(
        "mechanism m {
            body 1 at (0, 0) { P: (1, 0) }
            /// Above.
            motion forward {
                //! Inside.
                const a = 2;
                /// The crank.
                drive phi(1) = a*t;
                output P;
            }
            absolute_x(1) = 0;
            motion backward { absolute_x(1.P) = 1; drive x(1) = t; }
        }",
    );
    assert_eq!(named(&document), [("forward", 3), ("backward", 2)]);
    assert_eq!(document.mechanism.statements.len(), 4);
    let first = document.mechanism.motions().next().expect("two motions");
    assert_eq!(first.docs, ["Above.", "Inside."]);
    let Statement::Drive(drive) = &first.statements[1] else {
        panic!("a driver");
    };
    assert_eq!(drive.docs, ["The crank."]);
}

#[test]
fn a_motion_may_be_called_like_a_word_of_the_language() {
    let document = good("mechanism m { motion motion { } motion body {} motion phi { } }");
    let names = [("motion", 0), ("body", 0), ("phi", 0)];
    assert_eq!(named(&document), names);
}

#[test]
fn errors_in_a_motion_are_found_one_by_one() {
    let text = "mechanism m {
        motion a {
            drive phi(1) = ;
            drive phi 2 = t;
            body 1 at (0, 0) { P: (1, 0) }
            motion b { drive phi(3) = t; }
        }
        motion { drive phi(1) = ; }
        motion 2 { drive phi(1) = ; }
        motion c drive phi(1) = t;
    }";
    let expected = [
        "K02 3:28",
        "K02 4:23",
        "K02 5:13",
        "K02 6:13",
        "K02 8:16",
        "K02 8:33",
        "K10 9:16",
        "K02 9:35",
        "K02 10:18",
    ];
    assert_eq!(codes(text), expected);
}

/// A line that starts a motion ends the one before it.
#[test]
fn a_forgotten_brace_of_a_motion_is_said_once() {
    let text = "mechanism m {
        motion a {
            drive phi(1) = t;
            output P;
        motion b {
            drive phi(1) = 2*t;
        }
    }";
    assert_eq!(codes(text), ["K04 4:22"]);
    let inner = "mechanism m {
        motion a {
            drive phi(1 = t;
            revolute P(1, 2);
        }
        body 1 at (0, 0) { P: (1, 0)
        motion b { output P; }
    }";
    assert_eq!(codes(inner), ["K04 3:28", "K04 6:37"]);
}
