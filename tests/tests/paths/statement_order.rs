//! The permitted step is the same in whatever order bodies, joints and drivers are written.

use linkwright::{Blocks, Failure, Settings, Shell, Signal, Values};
use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::syntax::parse;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::Interpreted;
use linkwright_tests::hunt::paths::course::Course;
use linkwright_tests::hunt::paths::families::{FAMILIES, course};
use linkwright_tests::metamorphic::order::reordered;
use linkwright_tests::{description, files};

/// Instants from which steps are taken, in shortest periods.
const INSTANTS: [f64; 3] = [0.0, 0.21, 0.47];

/// Steps of one call, in shortest periods: powers of the square root of 2 from the first to the last exponent.
const EXPONENTS: [i32; 2] = [-24, 3];

/// Largest relative difference of two largest steps.
const ROUNDING: f64 = 1e-6;

/// Seed of the mechanisms of the hunts.
const SEED: u64 = 3;

/// Least number of bounded steps that are compared: of mechanisms of the repository and of the hunts.
const BOUNDED: [usize; 2] = [400, 400];

/// Motion of a description from which steps are taken.
struct Case {
    name: String,
    source: Source,
    course: Course,
}

/// The equations of every motion; `None` where the description is refused.
fn systems(source: &Source) -> Option<Vec<Derived>> {
    let read = linkwright_codegen::read(source).ok()?;
    linkwright_codegen::stages::check_all(&read.motions).ok()?;
    Some(read.motions)
}

/// The inputs at a time, as they are declared where the course has none.
fn given(blocks: &Interpreted, case: &Case, t: f64) -> <Interpreted as Blocks>::Inputs {
    let mut inputs = blocks.initial_inputs();
    for (index, [value, rate, acceleration]) in case.course.given(t).into_iter().enumerate() {
        inputs.set(index, Signal::new(value, rate, acceleration));
    }
    inputs
}

/// Steps that are permitted from all instants, forward and backward.
#[derive(Default)]
struct Permitted {
    /// Largest steps below the first refused one.
    largest: Vec<f64>,
    /// True for each permitted step.
    verdicts: Vec<bool>,
}

/// A failure as text.
fn failed(failure: Failure) -> String {
    format!("{:?} at {}", failure.kind, failure.time)
}

/// The permitted steps from all instants.
///
/// # Errors
/// The failure, where the mechanism does not move as far.
fn permitted(derived: &Derived, case: &Case, start: &[(usize, f64)]) -> Result<Permitted, String> {
    let blocks = Interpreted::new(derived).ok_or("no plan")?;
    let parameters = blocks.nominal_parameters();
    let mut pose = blocks.drawn_pose(&parameters);
    for (index, value) in start {
        pose.set(*index, *value);
    }
    let many = Settings::default();
    let one = Settings {
        substeps: 1,
        ..many
    };
    let mut shell = Shell::assemble(
        blocks.clone(),
        &parameters,
        &pose,
        blocks.drawn_branches(),
        case.course.span[0],
        &given(&blocks, case, case.course.span[0]),
        many,
    )
    .map_err(failed)?;
    let mut permitted = Permitted::default();
    for part in INSTANTS {
        let t = case.course.span[0] + part * case.course.period;
        shell.advance(t, &given(&blocks, case, t)).map_err(failed)?;
        let mut from = blocks.drawn_pose(&parameters);
        let coordinates = (0..).map_while(|index| blocks.coordinate(shell.frame(), index));
        for (index, coordinate) in coordinates.enumerate() {
            from.set(index, coordinate[0]);
        }
        let base = Shell::assemble(
            blocks.clone(),
            &parameters,
            &from,
            shell.branches().clone(),
            t,
            &given(&blocks, case, t),
            one,
        )
        .map_err(failed)?;
        let passes = |h: f64| {
            let mut shell = base.clone();
            shell.advance(t + h, &given(&blocks, case, t + h)).is_ok()
        };
        for sense in [1.0, -1.0] {
            let mut last = 0.0;
            let mut is_bounded = false;
            for exponent in EXPONENTS[0]..=EXPONENTS[1] {
                let step = sense * case.course.period * 2.0_f64.powf(0.5 * f64::from(exponent));
                let passed = passes(step);
                permitted.verdicts.push(passed);
                if passed || is_bounded {
                    last = if is_bounded { last } else { step };
                    continue;
                }
                is_bounded = true;
                let (mut low, mut high) = (last, step);
                for _ in 0..30 {
                    let middle = 0.5 * (low + high);
                    if passes(middle) {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                permitted.largest.push(low);
            }
            if !is_bounded {
                permitted.largest.push(f64::INFINITY);
            }
        }
    }
    Ok(permitted)
}

/// Places and values of the start in a description with these coordinates.
fn start(before: &Derived, after: &Derived, start: &[f64]) -> Vec<(usize, f64)> {
    let known = before.system.coordinates.iter().zip(start);
    let all = known.map(|(coordinate, value)| {
        let mut others = after.system.coordinates.iter();
        let place = others.position(|it| it.name == coordinate.name);
        (place.expect("the same coordinates"), *value)
    });
    all.collect()
}

/// Results of the comparison.
#[derive(Default)]
struct Counts {
    /// Number of verdicts.
    compared: usize,
    /// Number of largest steps.
    bounded: usize,
    /// Everything that differs by more than rounding.
    different: Vec<String>,
}

/// Compares the permitted steps of a description with those of its permutations.
fn compare(case: &Case, seeds: u64, counts: &mut Counts) {
    let Some(before) = systems(&case.source) else {
        return;
    };
    let document = parse(&case.source, &mut Diagnostics::new()).expect("no errors");
    let text = case.source.text.as_str();
    let was: Vec<_> = before
        .iter()
        .map(|it| permitted(it, case, &start(it, it, &case.course.start)))
        .collect();
    for seed in 0..seeds {
        let source = Source {
            text: reordered(text, &document, 77 + seed),
            ..case.source.clone()
        };
        let after = systems(&source).expect("the same mechanism");
        for ((before, after), was) in before.iter().zip(&after).zip(&was) {
            let is = permitted(after, case, &start(before, after, &case.course.start));
            let (was, is) = match (was, is) {
                (Ok(was), Ok(is)) => (was, is),
                (Err(_), Err(_)) => continue,
                (was, is) => {
                    let both = [was.as_ref().err(), is.as_ref().err()];
                    counts.different.push(format!("{}: {both:?}", case.name));
                    continue;
                }
            };
            counts.compared += was.verdicts.len();
            for (place, (one, other)) in was.largest.iter().zip(&is.largest).enumerate() {
                counts.bounded += usize::from(one.is_finite());
                if one == other || (one - other).abs() <= ROUNDING * one.abs().max(other.abs()) {
                    continue;
                }
                counts.different.push(format!(
                    "{} seed {seed} place {place}: {one:e} {other:e} ratio {}",
                    case.name,
                    other / one
                ));
            }
            let differ = was
                .verdicts
                .iter()
                .zip(&is.verdicts)
                .filter(|(a, b)| a != b)
                .count();
            if differ > 0 {
                counts
                    .different
                    .push(format!("{} seed {seed}: {differ} verdicts", case.name));
            }
        }
    }
}

fn of_course(name: String, course: Course) -> Case {
    Case {
        name,
        source: Source::new("ordered.mech", course.text.as_str()),
        course,
    }
}

fn of_file(name: &str) -> Case {
    let source = description::source(name);
    Case {
        name: name.to_string(),
        course: Course::drawn(source.text.clone(), 1.0, 1.0),
        source,
    }
}

/// Descriptions in which an angle follows another one by a driven difference: the plan keeps the one whose body is written first, and the
/// line between two frames is that of the angle that is kept.
const FOLLOWING: [&str; 5] = [
    "angle_and_block",
    "angle_and_slot",
    "driven_coupler",
    "mirrored_cranks",
    "torn_by_angles",
];

/// Families of which the same is true, and chains, whose closing equations have several shortest ways.
const OPEN: [&str; 2] = [
    "chain driven at its end",
    "six-bar driven between its links",
];

/// Asks that nothing but rounding differs, of enough steps that are bounded.
fn assert_same(counts: &Counts, bounded: usize) {
    let Counts {
        compared,
        bounded: found,
        different,
    } = counts;
    println!("{compared} verdicts and {found} largest steps compared");
    assert!(different.is_empty(), "{}", different.join("\n"));
    // Otherwise nothing would have been looked at.
    assert!(*found > bounded, "{found}");
}

#[test]
fn mechanisms_of_the_repository_permit_the_same_steps_in_every_order() {
    let mut names = description::names();
    let small = files::with_extension(&files::package("descriptions"), "mech");
    names.extend(small.iter().map(|path| files::stem(path).to_string()));
    names.retain(|name| !FOLLOWING.contains(&name.as_str()));
    let mut counts = Counts::default();
    for name in names {
        compare(&of_file(&name), 3, &mut counts);
    }
    assert_same(&counts, BOUNDED[0]);
}

#[test]
fn mechanisms_of_the_hunts_permit_the_same_steps_in_every_order() {
    let mut counts = Counts::default();
    for (family, (name, _)) in FAMILIES.iter().enumerate() {
        if OPEN.contains(name) {
            continue;
        }
        for number in 0..3 {
            let course = course(family, SEED, number);
            // Of a drawing that does not fit, equations say which assembly is meant.
            if !course.is_drawn {
                continue;
            }
            compare(
                &of_course(format!("{name} {number}"), course),
                2,
                &mut counts,
            );
        }
    }
    assert_same(&counts, BOUNDED[1]);
}
