//! Rewritten mechanisms have the original motion except for rounding: larger, smaller, displaced, turned, renamed,
//! reordered, with the bodies of each joint exchanged.
//!
//! Rounding may change a motion by the sum of the bounds (condition × rounding,
//! [`linkwright_tests::stability::truth`]) of both texts. Omitted rewritings are printed with the reason. A
//! description with the directions x and y changes its meaning when it is turned, and not every joint is symmetric in
//! i and j. Far from the origin an equation whose terms are rounded by more than the tolerance may fail, and must
//! report it.

use std::fmt::Write;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::system::Derived;
use linkwright_tests::metamorphic::frames::{
    FROM_AFAR, Moved, TIMES, is_rounded_away, motions, plan,
};
use linkwright_tests::metamorphic::rewriting::{Rewriting, SEED, all, distance, places};
use linkwright_tests::{description, files};

/// Equations of every motion, which must be determined.
fn read(source: &Source) -> Result<Vec<Derived>, String> {
    let read = linkwright_codegen::read(source).map_err(|errors| errors.render(source))?;
    linkwright_codegen::stages::check_all(&read.motions).map_err(|errors| errors.render(source))?;
    Ok(read.motions)
}

/// Changes by more than rounding in one formulation, and the largest ratio of change to bound. The bound of the rewritten text counts where
/// that of the original is exceeded.
fn compare(
    rewriting: &Rewriting,
    [before, after]: [&Derived; 2],
    [was, is]: [&Moved; 2],
    poor: bool,
    largest: &mut f64,
) -> Result<(), String> {
    let places = places(rewriting, before, after);
    let change = rewriting.change;
    // Assembly from a rough estimate promises a pose, but not the whole turns of its angles.
    let wound = change.winds() || poor;
    for (index, (was, is)) in was.iter().zip(is).enumerate() {
        let t = TIMES[index];
        let (was, is) = match (was, is) {
            (Ok(was), Ok(is)) => (was, is),
            (Err(was), Err(is)) if was == is => continue,
            (Ok(was), Err(kind)) => {
                let expected = change.apply(before, &was.values[0], 0);
                let mut pose = expected.clone();
                for (value, place) in expected.iter().zip(&places) {
                    pose[*place] = *value;
                }
                if is_rounded_away(after, t, &pose) {
                    println!(
                        "{}, t = {t}: {kind}, as no residual is that small",
                        rewriting.name
                    );
                    return Ok(());
                }
                return Err(format!("t = {t}: solved became {kind}"));
            }
            (was, is) => {
                let word = |it: &Result<_, String>| it.as_ref().err().cloned();
                return Err(format!("t = {t}: {:?} became {:?}", word(was), word(is)));
            }
        };
        for level in 0..3 {
            let expected = change.apply(before, &was.values[level], level);
            for (place, coordinate) in before.system.coordinates.iter().enumerate() {
                let rewritten = is.values[level][places[place]];
                let off = distance(before, place, [rewritten, expected[place]], wound);
                // A comparison with NaN is false. The bound of the original often suffices.
                let mut bound = change.bound(before, &was.bounds()[level], place);
                let mut within = off <= bound;
                if !within {
                    bound += is.bounds()[level][places[place]];
                    within = off <= bound;
                }
                if !within {
                    let name = ["", "rate of ", "acceleration of "][level];
                    return Err(format!(
                        "t = {t}: {name}{} is {rewritten:e} instead of {:e}, off by {off:.1e}, allowed {bound:.1e}",
                        coordinate.name, expected[place]
                    ));
                }
                if bound > 0.0 {
                    *largest = largest.max(off / bound);
                }
            }
        }
    }
    if was.len() != is.len() {
        return Err(format!("{} instants became {}", was.len(), is.len()));
    }
    Ok(())
}

/// Checks all rewritings of all descriptions with these names; all faults are reported at once.
fn hold(names: &[String]) {
    println!("seed {SEED:#x}");
    let mut findings = String::new();
    let mut count = 0;
    for name in names {
        let source = description::source(name);
        let before = read(&source).expect("a description without errors");
        let were: Vec<_> = before.iter().map(motions).collect();
        let (rewritings, left_out) = all(&source, &before);
        let mut largest = 0.0;
        for rewriting in &rewritings {
            let mut report = |what: String| {
                writeln!(findings, "{name}, {}: {what}", rewriting.name).expect("memory");
            };
            let after = match read(&rewriting.source) {
                Ok(after) => after,
                Err(errors) => {
                    report(format!("{errors}\n{}", rewriting.source.text));
                    continue;
                }
            };
            for ((before, after), were) in before.iter().zip(&after).zip(&were) {
                let [mut was, mut is] = [before, after].map(plan);
                if rewriting.change.winds() {
                    // The sine of an estimated angle may not be exact then, so that an explicit assignment becomes a
                    // step in closed form.
                    for plan in [&mut was, &mut is] {
                        plan.retain(|(step, _)| step.starts_with("Newton"));
                    }
                }
                if was != is {
                    report(format!("the plan {was:?} became {is:?}"));
                }
                for ((view, was), (_, is)) in were.iter().zip(motions(after)) {
                    count += 1;
                    if let Err(what) = compare(
                        rewriting,
                        [before, after],
                        [was, &is],
                        *view == FROM_AFAR,
                        &mut largest,
                    ) {
                        report(format!("{view}: {what}"));
                    }
                }
            }
        }
        println!(
            "{name}: {} rewritings, at most {largest:.2} of what rounding may change; left out: {left_out:?}",
            rewritings.len()
        );
    }
    println!("{count} motions compared");
    assert!(findings.is_empty(), "\n{findings}");
}

#[test]
fn mechanisms_mean_the_same_in_every_writing() {
    hold(&description::names());
}

#[test]
fn descriptions_of_tests_mean_the_same_in_every_writing() {
    let files = files::with_extension(&files::package("descriptions"), "mech");
    let names: Vec<String> = files
        .iter()
        .map(|path| files::stem(path).to_string())
        .collect();
    hold(&names);
}
