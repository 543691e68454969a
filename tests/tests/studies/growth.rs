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

/// Steps (s), and the number of them in a run.
const STEPS: [(f64, usize); 2] = [(0.001, 100), (0.01, 50)];

const RUNS: usize = 5;

fn blocks(text: &str) -> Interpreted {
    let source = Source::new("dyad_chain.mech", text);
    let derived = linkwright_codegen::read(&source);
    let derived = derived.unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
    let derived = derived.only().expect("one motion");
    Interpreted::new(&derived).expect("its blocks")
}

/// Lowers the times of the frames of a run (s) to those of another run.
fn run(blocks: &Interpreted, step: f64, fastest: &mut [f64]) {
    let none = InputSignals::default();
    let settings = Settings::default();
    let shell = assembled_with(blocks.clone(), &[], 0.0, &none, settings);
    let mut shell = shell.unwrap_or_else(|failure| panic!("{failure}"));
    for (place, fastest) in fastest.iter_mut().enumerate() {
        let t = (place + 1) as f64 * step;
        let start = Instant::now();
        if let Err(failure) = shell.advance(t, &none) {
            panic!("{failure}");
        }
        *fastest = fastest.min(start.elapsed().as_secs_f64());
    }
}

#[test]
fn guarding_three_hundred_dyads_takes_less_than_a_frame() {
    let both = [dyad_chain::description(DYADS), dyad_chain::unguarded(DYADS)];
    let both = both.map(|text| blocks(&text));
    for (step, count) in STEPS {
        // In turn; the fastest run of each frame is one that nothing else on the machine has slowed.
        let mut fastest = [(); 2].map(|()| vec![f64::INFINITY; count]);
        for _ in 0..RUNS {
            for (fastest, blocks) in fastest.iter_mut().zip(&both) {
                run(blocks, step, fastest);
            }
        }
        let [guarded, unguarded] = fastest.map(|times| times.iter().sum::<f64>());
        let ratio = guarded / unguarded;
        assert!(ratio < MAX_GUARD_RATIO, "steps of {step} s: {ratio}");
    }
}
