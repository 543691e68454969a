//! Work of `advance` and `recover` in headers follows from the numbers of the runtime, and from the functions that
//! are emitted.

use std::fs;

use linkwright_codegen::stages::program::{STEPS, work};
use linkwright_tests::embedded::work::work_of;
use linkwright_tests::files;

/// The value of a constant in a source of the runtime.
fn constant(file: &str, name: &str) -> f64 {
    let text =
        fs::read_to_string(files::repository().join("runtime/src").join(file)).expect("a source");
    let line = text.lines().find(|line| {
        line.trim_start()
            .trim_start_matches("pub ")
            .trim_start_matches("pub(crate) ")
            .starts_with(&format!("const {name}:"))
    });
    let line = line.unwrap_or_else(|| panic!("{file} has no {name}"));
    let value = line
        .rsplit_once("= ")
        .expect("a value")
        .1
        .trim_end_matches(';');
    value.parse().unwrap_or_else(|_| panic!("{name} = {value}"))
}

#[test]
fn bounds_are_those_of_the_runtime() {
    let same = [
        ("settings.rs", "ITERATIONS", STEPS),
        ("settings.rs", "SUBSTEPS", work::SUBSTEPS),
        ("way.rs", "CROSSINGS", work::CROSSINGS),
        ("crossing.rs", "REFINEMENTS", work::REFINEMENTS),
        ("crossing.rs", "WAYS", work::WAYS),
        ("continuation.rs", "NEARER", work::NEARER),
        ("continuation.rs", "BLOCKS", work::BLOCKS),
        ("deviations.rs", "WIDENED", work::WIDENED),
        ("least_squares.rs", "STEPS", work::LEAST_SQUARES),
        ("friction.rs", "STEPS", work::FRICTION_STEPS),
    ];
    for (file, name, value) in same {
        assert_eq!(constant(file, name), value as f64, "{name}");
    }
    // A guard verifies ever shorter windows between the most steps and the least, and the step alone.
    let [most, least, shrinking] =
        ["MOST_STEPS", "LEAST_STEPS", "SHRINKING"].map(|name| constant("guard.rs", name));
    let mut looks = 1;
    let mut stretch = most;
    while stretch >= least {
        looks += 1;
        stretch *= shrinking;
    }
    assert_eq!(looks, work::LOOKS);
    let [residuals, jacobians] = [work::AFAR_RESIDUALS, work::AFAR_JACOBIANS];
    let stated = format!(
        "at most {} N + {} evaluations of the residual, {} N + {} of the Jacobian",
        residuals[0], residuals[1], jacobians[0], jacobians[1]
    );
    let assembly = fs::read_to_string(files::repository().join("runtime/src/assembly.rs"));
    assert!(assembly.expect("a source").contains(&stated));
}

/// The four-bar linkage as counted by hand: two additions and one multiplication for the crank's angle and so on, all
/// levels together; see its module.
#[test]
fn closed_forms_are_counted_exactly() {
    let work = work_of("four_bar");
    assert!(!work.is_iterated);
    let attempt = work.attempt;
    // One driven angle, one triangle: its root, two divisions, two angles.
    let counted = (
        attempt.sines,
        attempt.square_roots,
        attempt.divisions,
        attempt.arctangents,
    );
    assert_eq!(counted, (2, 1, 2, 2));
    assert_eq!((attempt.additions, attempt.multiplications), (18, 44));
    assert_eq!(work.recover, attempt);
    // Each attempt once and twice for each dead point, with its windows.
    let [fixed, each] = work.whole();
    let looks = work.window.expect("it is guarded").total();
    assert_eq!(
        each,
        (1 + 2 * (work::CROSSINGS + work::ENDS)) * (attempt.total() + looks)
    );
    assert!(fixed + 256 * each > work.poses(256) * attempt.total());
    let platform = work_of("platform_3rpr");
    assert!(platform.is_iterated && platform.attempt.total() > 25 * 4 * 4);
    assert!(platform.recover.total() > platform.attempt.total());
}
