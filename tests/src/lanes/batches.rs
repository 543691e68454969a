//! Times the interpreter: one mechanism at a time, and batches of many sets.

use std::time::Instant;

use linkwright::Settings;
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::{Batch, InputSignals, Interpreted, Observable};

use crate::values::assembled_with;

/// Number of sets, and of instants of each.
const SETS: usize = 512;
const INSTANTS: usize = 200;

/// Number of runs, of which the fastest counts.
const RUNS: usize = 7;

/// Times of the interpreter (ns a pose), and the time until the first result (ms).
#[derive(Clone, Copy, Debug)]
pub struct Times {
    /// One mechanism at a time, on one thread.
    pub alone: f64,
    /// Batches on one thread and on two.
    pub batches: [f64; 2],
    /// From the text to the first solved batch of eight sets (ms).
    pub first: f64,
}

/// Times a description in steps of `step` (s).
///
/// # Panics
/// If the description has errors, or a set has no pose.
pub fn measure(source: &Source, step: f64) -> Times {
    let begun = Instant::now();
    let read = linkwright_codegen::read(source);
    let derived = read.unwrap_or_else(|errors| panic!("{}", errors.render(source)));
    let derived = derived.only().expect("one motion");
    let blocks = Interpreted::new(&derived).expect("its blocks");
    let instants: Vec<f64> = (0..INSTANTS).map(|it| step * it as f64).collect();
    let name = &derived
        .system
        .coordinates
        .last()
        .expect("a coordinate")
        .name;
    let observables = [Observable::named(&derived, name).expect("a coordinate")];
    let count = derived.system.mechanism.parameters.len();
    assert_eq!(count, 0, "parameters of their own would have to be given");
    let mut batch = Batch::new(&blocks, &instants, &observables);
    batch.threads = 1;
    let mut values = vec![0.0; SETS * INSTANTS];
    let solve = |batch: &Batch<'_>, values: &mut [f64]| {
        let outcomes = batch.solve(&[], &[], values).expect("right lengths");
        assert!(outcomes.iter().all(|it| it.failure.is_none()));
    };
    solve(&batch, &mut values[..8 * INSTANTS]);
    let first = 1e3 * begun.elapsed().as_secs_f64();
    let none = InputSignals::default();
    let mut fastest = [f64::INFINITY; 3];
    for _ in 0..RUNS {
        let shell = assembled_with(blocks.clone(), &[], 0.0, &none, Settings::default());
        let mut shell = shell.expect("a pose");
        let begun = Instant::now();
        for t in &instants[1..] {
            shell.advance(*t, &none).expect("a frame");
        }
        let alone = begun.elapsed().as_secs_f64() / (INSTANTS - 1) as f64;
        let mut times = [alone, 0.0, 0.0];
        for (threads, time) in (1..).zip(&mut times[1..]) {
            batch.threads = threads;
            let begun = Instant::now();
            solve(&batch, &mut values);
            *time = begun.elapsed().as_secs_f64() / (SETS * INSTANTS) as f64;
        }
        for (fastest, time) in fastest.iter_mut().zip(times) {
            *fastest = fastest.min(1e9 * time);
        }
    }
    let [alone, one, two] = fastest;
    Times {
        alone,
        batches: [one, two],
        first,
    }
}
