//! Unused points, bodies and curves in sizes from 1e-9 to 1e9 change a mechanism by rounding alone.

use linkwright::{Blocks, Settings, Shell};
use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{InputSignals, Interpreted};
use linkwright_tests::hunt::paths::families::{course, junk, with};
use linkwright_tests::random::{Random, cases};
use linkwright_tests::{description, files};

/// Largest change of a coordinate, in its scale.
const ROUNDING: f64 = 1e-9;

/// Number and length (s) of the steps of a motion.
const STEPS: (u8, f64) = (24, 0.083);

fn systems(text: &str) -> Result<Vec<Derived>, String> {
    let source = Source::new("beside.mech", text);
    let refused = |found: Diagnostics| found.render(&source);
    let read = linkwright_codegen::read(&source).map_err(refused)?;
    linkwright_codegen::stages::check_all(&read.motions).map_err(refused)?;
    Ok(read.motions)
}

/// The coordinates after every step, or the kind of the failure.
fn moved(derived: &Derived) -> Vec<Result<Vec<f64>, String>> {
    let blocks = Interpreted::new(derived).expect("determined");
    let parameters = blocks.nominal_parameters();
    let (pose, branches) = (blocks.drawn_pose(&parameters), blocks.drawn_branches());
    let inputs = InputSignals::initial(&derived.pool, &derived.system);
    let kind = |failure: linkwright::Failure| {
        let text = format!("{:?}", failure.kind);
        text.split([' ', '{'])
            .next()
            .unwrap_or_default()
            .to_string()
    };
    let settings = Settings::default();
    let shell = Shell::assemble(blocks, &parameters, &pose, branches, 0.0, &inputs, settings);
    let mut shell = match shell {
        Ok(shell) => shell,
        Err(failure) => return vec![Err(kind(failure))],
    };
    let mut frames = vec![Ok(shell.frame().q().to_vec())];
    for step in 1..=STEPS.0 {
        let frame = shell.advance(f64::from(step) * STEPS.1, &inputs);
        frames.push(frame.map(|it| it.q().to_vec()).map_err(kind));
    }
    frames
}

/// Changed coordinates of bodies, and of contacts, which follow all bodies.
fn changed(before: &Derived, after: &Derived) -> Option<String> {
    let names = |derived: &Derived| -> Vec<String> {
        derived
            .system
            .coordinates
            .iter()
            .map(|it| it.name.clone())
            .collect()
    };
    let (own, all) = (names(before), names(after));
    let places: Vec<usize> = own
        .iter()
        .map(|name| all.iter().position(|it| it == name).expect("still there"))
        .collect();
    for (step, (was, is)) in moved(before).iter().zip(moved(after)).enumerate() {
        match (was, is) {
            (Ok(was), Ok(is)) => {
                let scale = was.iter().map(|it| it.abs()).fold(0.0, f64::max);
                for ((name, was), place) in own.iter().zip(was).zip(&places) {
                    let off = (was - is[*place]).abs();
                    // NaN counts as a change.
                    let is_rounding = off <= ROUNDING * scale;
                    if !is_rounding {
                        return Some(format!("step {step}: {name} = {was} became {}", is[*place]));
                    }
                }
            }
            (Err(was), Err(is)) if *was == is => {}
            (was, is) => {
                return Some(format!(
                    "step {step}: {:?} became {:?}",
                    was.as_ref().err(),
                    is.err()
                ));
            }
        }
    }
    None
}

fn is_unchanged(name: &str, text: &str, far: bool, random: &mut Random, counts: &mut [usize; 2]) {
    let Ok(before) = systems(text) else {
        counts[1] += 1;
        return;
    };
    // At least as large as the largest links.
    let more = junk(random, if far { 1.0 } else { 1e-10 });
    let text = with(text, &more);
    let after =
        systems(&text).unwrap_or_else(|found| panic!("{name} is refused with\n{more}\n{found}"));
    for (before, after) in before.iter().zip(&after) {
        counts[0] += 1;
        if let Some(change) = changed(before, after) {
            panic!("{name}: {change}, beside\n{more}");
        }
    }
}

fn mechanisms_of_the_repository(far: bool) {
    let mut random = Random::new(3);
    let mut counts = [0; 2];
    for path in files::with_extension(&files::repository().join("mechanisms"), "mech") {
        let name = files::stem(&path);
        let source = description::source(name);
        // Statements after motions belong to none of them.
        if !source.text.contains("motion ") {
            is_unchanged(name, &source.text, far, &mut random, &mut counts);
        }
    }
    assert!(counts[0] > 15 && counts[1] == 0, "{counts:?}");
}

fn mechanisms_of_the_hunt(far: bool) {
    let mut random = Random::new(4);
    let mut counts = [0; 2];
    let numbers = cases(8);
    let families = [0, 4, 7, 12, 14, 15, 16];
    for number in 0..numbers {
        for family in families {
            let text = course(family, 7, number).text;
            let name = format!("family {family}, number {number}");
            is_unchanged(&name, &text, far, &mut random, &mut counts);
        }
    }
    // Most are accepted.
    let all = numbers as usize * families.len();
    assert!(5 * counts[0] > 3 * all, "{counts:?} of {all}");
}

#[test]
fn nothing_small_beside_the_mechanisms_of_the_repository_changes_them() {
    mechanisms_of_the_repository(false);
}

#[test]
fn nothing_small_beside_mechanisms_of_the_hunt_changes_them() {
    mechanisms_of_the_hunt(false);
}

#[test]
fn nothing_far_beside_the_mechanisms_of_the_repository_changes_them() {
    mechanisms_of_the_repository(true);
}

#[test]
fn nothing_far_beside_mechanisms_of_the_hunt_changes_them() {
    mechanisms_of_the_hunt(true);
}
