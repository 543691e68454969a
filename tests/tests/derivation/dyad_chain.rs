//! The chain that growth is measured on is a mechanism that moves.

use linkwright::Settings;
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_tests::dyad_chain;

#[test]
fn chains_of_one_to_twenty_dyads_assemble_and_move() {
    for n in 1..=20 {
        let source = Source::new("dyad_chain.mech", dyad_chain::description(n));
        let read = linkwright_codegen::read(&source)
            .unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
        assert!(
            read.warnings.render(&source).is_empty(),
            "{}",
            read.warnings.render(&source)
        );
        let derived = read.only().expect("one motion");
        if let Err(errors) = linkwright_codegen::stages::check(&derived) {
            panic!("{}", errors.render(&source));
        }
        let chain = TextbookEquations::new(&derived.pool, &derived.system);
        assert_eq!(chain.estimate().len(), 3 + 6 * n);
        let settings = Settings::default();
        let start = linkwright::Frame::assemble(&chain, chain.estimate(), 0.0, &settings);
        let mut frame = start.unwrap_or_else(|failure| panic!("{n}: {failure}"));
        // Assembled as drawn.
        assert!((&frame.q - chain.estimate()).amax() <= 1e-12, "{n}");
        // Both extremes of the driver, by coarse steps: the last is at t = 4.8, past 3/2 π.
        for step in 1..=24 {
            let t = 0.2 * f64::from(step);
            frame = frame
                .advance(&chain, t, &settings)
                .unwrap_or_else(|failure| panic!("{n} at {t}: {failure}"));
            // Every second rocker repeats the crank.
            for k in (2..=n).step_by(2) {
                let difference = frame.q[2] - frame.q[6 * k + 2];
                assert!(difference.abs() <= 1e-12, "{n}, rocker {k}: {difference}");
            }
        }
    }
}
