//! Time per frame in the textbook view: position to 1e-12, velocity, acceleration, by steps of 0.01 s over 0 to 5 s.
//!
//! `generated` and `interpreted` use the default settings, with the polishing step; `unpolished` stops at the tolerance, as
//! the solvers do that the figures in the literature are about.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use linkwright::Settings;
use linkwright::nalgebra::SVector;
use linkwright_mechanisms::{excavator, two_body};
use linkwright_tests::solver::Interpreted;

/// The frames of a sweep; the next one starts from its beginning.
const FRAMES: u32 = 500;

/// Times `advance` for one instant of the sweep after the other, each sweep from `start`.
fn sweep<S: Clone>(criterion: &mut Criterion, name: &str, start: S, advance: impl Fn(&mut S, f64)) {
    let mut state = start.clone();
    let mut frame = 0;
    criterion.bench_function(name, |bencher| {
        bencher.iter(|| {
            if frame == FRAMES {
                frame = 0;
                state.clone_from(&start);
            }
            frame += 1;
            advance(black_box(&mut state), f64::from(frame) / 100.0);
        });
    });
}

macro_rules! generated {
    ($criterion:ident, $label:literal, $module:ident) => {
        for (kind, polish) in [("generated", true), ("unpolished", false)] {
            let settings = Settings {
                polish,
                ..Settings::default()
            };
            let equations = $module::Textbook;
            let drawn = SVector::from($module::Coordinates::DESIGN.to_array());
            let start = linkwright::Frame::assemble(&equations, &drawn, 0.0, &settings);
            let start = start.unwrap_or_else(|failure| panic!("{failure}"));
            sweep(
                $criterion,
                &format!("{}/{kind}", $label),
                start,
                |frame, t| {
                    *frame = frame
                        .advance(&equations, t, &settings)
                        .unwrap_or_else(|failure| panic!("{failure}"));
                },
            );
        }
    };
}

fn interpreted(criterion: &mut Criterion, label: &str, name: &str) {
    let equations = Interpreted::new(name).equations;
    let settings = Settings::default();
    let start = linkwright::Frame::assemble(&equations, equations.estimate(), 0.0, &settings);
    let start = start.unwrap_or_else(|failure| panic!("{failure}"));
    sweep(
        criterion,
        &format!("{label}/interpreted"),
        start,
        |frame, t| {
            *frame = frame
                .advance(&equations, t, &settings)
                .unwrap_or_else(|failure| panic!("{failure}"));
        },
    );
}

fn textbook(criterion: &mut Criterion) {
    generated!(criterion, "exam", two_body);
    interpreted(criterion, "exam", "two_body");
    generated!(criterion, "excavator", excavator);
    interpreted(criterion, "excavator", "excavator");
}

criterion_group!(benches, textbook);
criterion_main!(benches);
