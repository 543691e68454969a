//! The study of stability in short: every family, and no wrong answer in any cell.

use linkwright_tests::description;
use linkwright_tests::stability::families::families;
use linkwright_tests::stability::precise::{Precise, pi};
use linkwright_tests::stability::report::{Counts, judged};
use linkwright_tests::stability::texts;
use linkwright_tests::stability::truth::{Given, Truth};
use linkwright_tests::stability::verdict::{Scalar, Verdict};

#[test]
fn every_cell_is_within_its_bound_or_a_typed_failure() {
    let mut counts = Counts::default();
    let mut wrong = Vec::new();
    for family in families() {
        // Every third sample, and fewer steps in high precision: the report has all of them.
        let judged = judged(family, 3);
        for (sample, verdicts) in judged.family.samples.iter().zip(&judged.verdicts) {
            for (way, verdict) in judged.ways().iter().zip(verdicts) {
                counts.add(verdict, Scalar::F64);
                if let Verdict::Wrong { why } = verdict {
                    wrong.push(format!(
                        "{}, {:e}, {way}: {why}",
                        judged.family.title, sample.x
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // Otherwise nothing would have been looked at.
    assert!(
        counts.solved > 2 * counts.failures() && counts.failures() > 0,
        "{counts:?}"
    );
}

/// Sizes that are set by parameters, far from the default ones, which are about 1 m.
#[test]
fn every_size_from_a_nanometer_to_a_million_kilometers_is_solved_in_every_way() {
    let sizes = families()
        .into_iter()
        .filter(|family| family.title.starts_with("Sizes: "));
    let mut looked_at = 0;
    for family in sizes {
        let judged = judged(family, 6);
        for (sample, verdicts) in judged.family.samples.iter().zip(&judged.verdicts) {
            for (way, verdict) in judged.ways().iter().zip(verdicts) {
                let Verdict::Solved(answer) = verdict else {
                    panic!(
                        "{}, {:e} m, {way}: {verdict:?}",
                        judged.family.title, sample.x
                    );
                };
                let digits = if way.ends_with("f64") { 1e-12 } else { 1e-3 };
                assert!(answer.bound < digits, "{:e} m, {way}: {answer:?}", sample.x);
                looked_at += 1;
            }
        }
    }
    assert_eq!(looked_at, 3 * 4 * 6);
}

#[test]
fn no_number_in_a_text_is_answered_wrongly() {
    let mut solved = 0;
    for (name, text) in texts::cases() {
        let (verdict, _) = texts::judged(&text);
        assert!(!verdict.is_wrong(), "{name}: {verdict:?}");
        solved += usize::from(matches!(verdict, Verdict::Solved(_)));
    }
    assert!(solved >= 10, "{solved}");
}

/// cos φ2 = 1 - cos φ1 / √3 (with rod and wall of one length), not from the equations of the description.
#[test]
fn the_truth_is_the_closed_form() {
    let truth = Truth::new(&description::system("study_exam"));
    let rod = 3.0_f64.sqrt();
    for angle in [0.5, 1.2, 1.57, std::f64::consts::FRAC_PI_2 - 3e-8] {
        let instant_inputs = Given {
            parameters: vec![1.0, rod, rod],
            signals: vec![[angle, 1.0, 0.0]],
            t: 0.0,
        };
        let one = Precise::from_f64(1.0);
        let phi1 = Precise::from_f64(angle);
        let cosine = one.minus(&phi1.cos().over(&Precise::from_f64(rod)));
        let phi2 = cosine.acos();
        let start = [0.0, 0.0, angle, rod, 1.5, phi2.to_f64() * 1.001].map(Precise::from_f64);
        let exact = truth.solve(&instant_inputs, &start).expect("a pose");
        let off = exact.levels[0][5].minus(&phi2).to_f64();
        assert!(off.abs() < 1e-90, "{off}");
        // The rate: sin φ1 + √3 sin φ2 φ̇2 = 0.
        let rate = phi1.sin().over(&phi2.sin().times(&Precise::from_f64(rod)));
        let off = exact.levels[1][5].plus(&rate).to_f64();
        assert!(off.abs() < 1e-80 * rate.to_f64(), "{off}");
        assert!(truth.residual(&instant_inputs, &exact.levels[0]) < 1e-90);
    }
    assert!(pi().sin().to_f64().abs() < 1e-110);
}
