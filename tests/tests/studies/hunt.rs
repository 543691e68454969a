//! The hunt in short, without a compiler: no wrong answer, and mechanisms of every kind in it.

use std::collections::BTreeSet;

use linkwright_codegen::diagnostic::Source;
use linkwright_tests::hunt::mechanism;
use linkwright_tests::hunt::run::{MAX_BODIES, interpret, prepare};
use linkwright_tests::hunt::tally::Tally;
use linkwright_tests::random::cases;

use linkwright_tests::hunt::paths::families::FAMILIES;
use linkwright_tests::hunt::paths::run;
use linkwright_tests::hunt::paths::tally;

/// Another seed than that of the report.
const SEED: u64 = 5;

#[test]
fn no_answer_is_wrong() {
    let mut tally = Tally::default();
    for number in 0..cases(7) {
        if let Some(hunted) = prepare(SEED, number, &mut tally) {
            interpret(&hunted, &mut tally);
        }
    }
    assert!(tally.wrong.is_empty(), "{:#?}", tally.wrong);
    let reasons: Vec<&String> = tally.unused.keys().collect();
    assert!(
        !reasons.iter().any(|it| it.starts_with("CONTRADICTION")),
        "{reasons:?}"
    );
    // Otherwise nothing would have been looked at.
    let total = tally.total();
    assert!(
        total.total() > 1000 && total.correct > 10 * total.failed && total.ended > 0,
        "{total:?}"
    );
}

#[test]
fn mechanisms_of_every_kind_are_constructed() {
    let groups: BTreeSet<&str> = (0..200)
        .flat_map(|number| mechanism(SEED, number, MAX_BODIES).groups)
        .collect();
    assert_eq!(groups.len(), 19, "{groups:?}");
    let text = |number| mechanism(SEED, number, MAX_BODIES).text();
    assert_eq!(text(3), text(3));
    assert_ne!(text(3), text(4));
}

/// The description with its first body that has points placed by the first of them; `None` where there is none.
fn self_referring(text: &str) -> Option<String> {
    let body = text
        .lines()
        .find(|it| it.starts_with("    body ") && it.contains("{ P"))?;
    let (before, rest) = body.split_once(" at ")?;
    let (_, points) = rest.split_once('{')?;
    let (point, _) = points.trim_start().split_once(':')?;
    let placed = format!("{before} at {point} {{{points}");
    Some(text.replace(body, &placed))
}

#[test]
fn bodies_that_are_placed_by_their_own_points_are_refused() {
    let mut refused = 0;
    for number in 0..60 {
        let text = mechanism(SEED, number, MAX_BODIES).text();
        let Some(text) = self_referring(&text) else {
            continue;
        };
        let source = Source::new("found.mech", text.as_str());
        let errors = linkwright_codegen::read(&source).expect_err("a point without a place");
        let rendered = errors.render(&source);
        assert!(rendered.contains("error[K11]"), "{rendered}\n{text}");
        refused += 1;
    }
    assert!(refused > 40, "{refused}");
}

#[test]
fn no_frame_is_off_the_path() {
    let mut tally = tally::Tally::default();
    for family in 0..FAMILIES.len() {
        // The first that is not refused.
        let count = cases(1) as usize;
        let prepared = (0..6 * cases(1)).filter_map(|number| {
            let hunted = run::prepare(family, SEED, number, 0.04, &mut tally)?;
            hunted.interpret(&mut tally)
        });
        assert_eq!(prepared.take(count).count(), count, "family {family}");
    }
    assert!(tally.wrong.is_empty(), "{:#?}", tally.wrong);
    // Otherwise nothing would have been looked at.
    let total = tally.total();
    assert!(total.correct > 500 && total.ended > 5, "{total:?}");
    assert!(
        tally.courses.values().filter(|it| it[1] > 0).count() == FAMILIES.len(),
        "{:?}",
        tally.courses
    );
    assert!(
        tally.courses.values().any(|it| it[2] > 0) && tally.courses.values().any(|it| it[3] > 0)
    );
    assert!(
        total.refused * 5 < total.correct && total.unjudged * 5 < total.correct,
        "{total:?}"
    );
}
