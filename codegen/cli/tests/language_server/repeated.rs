//! Parts and repetitions: each has one name and one entry in the outline, and is completed and renamed as one.

use crate::client::UNSAVED;
use crate::completion::offered;
use crate::editing::{hover, opened, place, places};
use crate::layout::{names, outline};
use crate::renaming::renamed;

/// Repeated statements, and a mechanism as a part of another.
const WALKER: &str = "\
/// A crank.
mechanism leg {
    param size = 20mm;
    point A = (0, 0), B = (0, size);
    body crank at A { A, B }
    revolute A(ground, crank);
}

mechanism walker {
    const n = 3;
    repeat i from 1 to n {
        part leg[i] = leg(size = 18mm + 2mm*i) at (100mm*i, 0);
        drive phi(leg[i].crank) = i*t;
    }
    point P[0] = (1, 0);
    repeat k from 1 to n {
        point P[k] = (1, 0.1*k);
        body rod[k] at P[k] { P[k - 1], P[k] }
    }
    output leg[n].crank.B, rod[2].P[2];
}
";

#[test]
fn repeated_element_has_one_name() {
    let mut client = opened(WALKER);
    let mut ask = |method: &str, part: &str, number| {
        let answer = client.ask_at(method, UNSAVED, place(WALKER, part, number));
        places(&answer.expect("an answer"))
    };
    assert_eq!(ask("definition", "k - 1", 0), [(15, 11)]);
    assert_eq!(ask("references", "k from", 0).len(), 7);
    assert_eq!(
        ask("references", "n = 3", 0),
        [(9, 10), (10, 23), (15, 23), (19, 15)]
    );
    // One point for each statement that declares one.
    assert_eq!(ask("definition", "P[k - 1]", 0), [(14, 10), (16, 14)]);
    assert_eq!(
        ask("references", "P[2]", 0),
        [(14, 10), (16, 14), (17, 23), (17, 30), (17, 40), (19, 34)]
    );
    // Declaration in a part, the part, and its mechanism.
    assert_eq!(ask("definition", "crank) = i", 0), [(4, 9)]);
    assert_eq!(
        ask("references", "crank at", 0),
        [(4, 9), (5, 23), (12, 25), (19, 18)]
    );
    assert_eq!(ask("definition", "leg[i].crank", 0), [(11, 13)]);
    assert_eq!(ask("definition", "leg(size", 0), [(1, 10)]);
    assert_eq!(
        ask("references", "size = 20mm", 0),
        [(2, 10), (3, 30), (11, 26)]
    );
    let hover_text = hover(&mut client, WALKER, "crank.B", 0);
    assert!(
        hover_text.starts_with("```mech\nbody crank at A { A, B }\n```\n\nbody"),
        "{hover_text}"
    );
    assert!(hover_text.contains("`phi_leg3_crank`"), "{hover_text}");
    let hover_text = hover(&mut client, WALKER, "crank at", 0);
    assert!(!hover_text.contains("coordinates"), "{hover_text}");
    let hover_text = hover(&mut client, WALKER, "leg[n]", 0);
    assert!(hover_text.contains("\n\npart"), "{hover_text}");
    client.finish();
}

#[test]
fn repeated_element_is_renamed_as_one() {
    let mut client = opened(WALKER);
    let expected = WALKER
        .replace("body crank", "body arm")
        .replace("ground, crank", "ground, arm")
        .replace("].crank", "].arm");
    assert_eq!(
        renamed(&mut client, WALKER, "crank at", "arm"),
        Ok(expected)
    );
    let expected = WALKER
        .replace("point P[", "point pin[")
        .replace("at P[", "at pin[")
        .replace("{ P[", "{ pin[")
        .replace(", P[", ", pin[")
        .replace("].P[", "].pin[");
    assert_eq!(renamed(&mut client, WALKER, "P[0]", "pin"), Ok(expected));
    let expected = WALKER
        .replace("part leg[", "part foot[")
        .replace("(leg[", "(foot[")
        .replace("output leg[", "output foot[");
    assert_eq!(
        renamed(&mut client, WALKER, "leg[i] =", "foot"),
        Ok(expected)
    );
    let expected = WALKER
        .replace("repeat k", "repeat row")
        .replace("[k", "[row")
        .replace("*k", "*row");
    assert_eq!(renamed(&mut client, WALKER, "k from", "row"), Ok(expected));
    assert!(renamed(&mut client, WALKER, "k from", "n").is_err());
    client.finish();
}

#[test]
fn parts_and_repetitions_are_completed() {
    let offered_in =
        |statement: &str| offered(&WALKER.replace("output", &format!("{statement}\n    output")));
    assert_eq!(
        offered_in("drive phi(leg[2].|) = t;"),
        ["size", "A", "B", "crank"]
    );
    assert_eq!(
        offered_in("drive near: leg[1].crank.|"),
        ["A", "B", "x", "y"]
    );
    let bodies = offered_in("absolute_angle(|) = 0;");
    assert!(bodies.iter().any(|it| it == "rod[2]"), "{bodies:?}");
    assert!(bodies.iter().any(|it| it == "leg[3].crank"), "{bodies:?}");
    let inside = offered_in("repeat j from 1 to 2 { absolute_angle(rod[j]) = | }");
    assert!(inside.iter().any(|it| it == "j"), "{inside:?}");
    assert!(!inside.iter().any(|it| it == "k"), "{inside:?}");
}

#[test]
fn the_outline_lists_mechanisms_and_what_is_repeated_once() {
    let mut client = opened(WALKER);
    let answer = outline(&mut client);
    assert_eq!(names(&answer), ["mechanism leg", "mechanism walker"]);
    assert_eq!(
        names(&answer[0]["children"]),
        [
            "param size = 20mm",
            "A",
            "B",
            "body crank at A",
            "revolute A(ground, crank)"
        ]
    );
    assert_eq!(
        names(&answer[1]["children"]),
        [
            "const n = 3",
            "drive phi(leg[i].crank) = i*t",
            "P[0]",
            "P[k]",
            "body rod[k] at P[k]",
            "output leg[n].crank.B, rod[2].P[2]",
        ]
    );
    client.finish();
}
