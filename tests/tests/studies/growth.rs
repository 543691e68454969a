//! The path guard of a row of dyads takes no more than a frame itself, however long the row.

use std::time::Instant;

use linkwright::Settings;
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::{InputSignals, Interpreted};
use linkwright_tests::dyad_chain;
use linkwright_tests::values::assembled_with;

/// The largest ratio of the times of frames with and without the guard.
const MAX_GUARD_RATIO: f64 = 2.0;

const DYADS: usize = 300;

/// The steps (s), and how many of them a run takes.
const STEPS: [(f64, u32); 2] = [(0.001, 100), (0.01, 50)];

const RUNS: usize = 5;

fn blocks(text: &str) -> Interpreted {
    let source = Source::new("dyad_chain.mech", text);
    let derived = linkwright_codegen::read(&source);
    let derived = derived.unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
    let derived = derived.only().expect("one motion");
    Interpreted::new(&derived).expect("its blocks")
}

/// The time of a run (s).
fn run(blocks: &Interpreted, step: f64, count: u32) -> f64 {
    let none = InputSignals::default();
    let settings = Settings::default();
    let shell = assembled_with(blocks.clone(), &[], 0.0, &none, settings);
    let mut shell = shell.unwrap_or_else(|failure| panic!("{failure}"));
    let start = Instant::now();
    for place in 1..=count {
        let t = f64::from(place) * step;
        if let Err(failure) = shell.advance(t, &none) {
            panic!("{failure}");
        }
    }
    start.elapsed().as_secs_f64()
}

#[test]
fn guarding_three_hundred_dyads_takes_less_than_a_frame() {
    let both = [dyad_chain::description(DYADS), dyad_chain::unguarded(DYADS)];
    let both = both.map(|text| blocks(&text));
    for (step, count) in STEPS {
        // In turn; the shortest runs are those that nothing else on the machine has slowed.
        let mut shortest = [f64::INFINITY; 2];
        for _ in 0..RUNS {
            for (shortest, blocks) in shortest.iter_mut().zip(&both) {
                *shortest = shortest.min(run(blocks, step, count));
            }
        }
        let [guarded, unguarded] = shortest;
        let ratio = guarded / unguarded;
        assert!(ratio < MAX_GUARD_RATIO, "steps of {step} s: {ratio}");
    }
}
