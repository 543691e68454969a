//! Assembly of the described mechanisms from estimates that are off by up to half a radian and half a link.
//!
//! The estimate of every coordinate is moved at random. The reference is the pose to which the design configuration
//! itself leads; angles count modulo whole turns.

use std::f64::consts::TAU;

use linkwright::nalgebra::SVector;
use linkwright::{Failure, FailureKind, Frame, Settings};
use linkwright_tests::description;
use linkwright_tests::random::Random;
use linkwright_tests::starts::measure::measure;
use linkwright_tests::starts::perturbation::SEED;

/// Numbers of starts by end.
#[derive(Debug, Default, PartialEq)]
struct Outcomes {
    /// Design pose.
    drawn: u32,
    /// Another pose with the same sign of the determinant.
    same_branch: u32,
    /// Called a failure.
    refused: u32,
}

/// True if two poses (x, y, φ of each body) differ by whole turns at most.
fn coincide<const N: usize>(a: &SVector<f64, N>, b: &SVector<f64, N>) -> bool {
    a.iter().zip(b.iter()).enumerate().all(|(place, (a, b))| {
        let mut difference = a - b;
        if place % 3 == 2 {
            difference -= TAU * (difference / TAU).round();
        }
        difference.abs() <= 1e-9
    })
}

macro_rules! outcomes {
    ($module:ident, link $link:literal, $factor:literal times, $starts:literal starts) => {{
        use linkwright_mechanisms::$module::{Coordinates, Textbook};
        let settings = Settings::default();
        let drawn = SVector::from(Coordinates::DESIGN.to_array());
        let truth = Frame::assemble(&Textbook, &drawn, 0.0, &settings)
            .expect("as drawn")
            .q;
        let branch = Frame::branch_of(&Textbook, &truth, 0.0, &settings).expect("regular");
        let mut random = Random::new(99);
        let mut outcomes = Outcomes::default();
        for _ in 0..$starts {
            let start = SVector::from_fn(|place, _| {
                let reach = if place % 3 == 2 { 0.5 } else { 0.5 * $link };
                drawn[place] + $factor * reach * random.between(-1.0, 1.0)
            });
            let assembled: Result<Frame<_, _>, Failure> = Frame::assemble_from_rough_estimate(
                &Textbook,
                &start,
                Some(branch),
                0.0,
                &settings,
            );
            match assembled {
                Ok(frame) => {
                    let ends = Frame::branch_of(&Textbook, &frame.q, 0.0, &settings);
                    assert_eq!(ends, Ok(branch));
                    if coincide(&frame.q, &truth) {
                        outcomes.drawn += 1;
                    } else {
                        outcomes.same_branch += 1;
                    }
                }
                Err(failure) => {
                    assert_ne!(failure.kind, FailureKind::NotFinite);
                    outcomes.refused += 1;
                }
            }
        }
        println!("{}: {outcomes:?}", stringify!($module));
        outcomes
    }};
}

fn all_drawn(starts: u32) -> Outcomes {
    Outcomes {
        drawn: starts,
        ..Outcomes::default()
    }
}

#[test]
fn every_start_within_half_a_radian_and_half_a_link_leads_to_the_drawing() {
    let all = all_drawn(500);
    assert_eq!(outcomes!(two_body, link 1.7, 1.0 times, 500 starts), all);
    assert_eq!(outcomes!(four_bar, link 0.08, 1.0 times, 500 starts), all);
    assert_eq!(
        outcomes!(slider_crank, link 0.1, 1.0 times, 500 starts),
        all
    );
    let all = all_drawn(50);
    assert_eq!(outcomes!(stephenson, link 1.0, 1.0 times, 50 starts), all);
    assert_eq!(
        outcomes!(platform_3rpr, link 0.5, 1.0 times, 50 starts),
        all
    );
    assert_eq!(
        outcomes!(excavator, link 0.4, 1.0 times, 20 starts),
        all_drawn(20)
    );
}

#[test]
fn twice_as_far_most_lead_to_the_drawing_and_none_to_the_other_branch() {
    for (outcomes, starts) in [
        (outcomes!(four_bar, link 0.08, 2.0 times, 300 starts), 300),
        (outcomes!(stephenson, link 1.0, 2.0 times, 100 starts), 100),
        (outcomes!(platform_3rpr, link 0.5, 2.0 times, 50 starts), 50),
    ] {
        assert!(
            10 * outcomes.drawn >= 9 * starts,
            "{outcomes:?} of {starts}"
        );
    }
}

/// The short form of `tests/reports/starts.md`: no start of any mechanism ends at a wrong answer, and the work is bounded.
#[test]
fn no_start_of_any_mechanism_is_answered_wrongly() {
    println!("seed {SEED:#x}");
    for name in description::names() {
        for derived in description::motions(&name) {
            // For a large mechanism, the cost of the matrices exceeds the information of more starts.
            let starts = if derived.system.coordinates.len() <= 12 {
                200
            } else {
                20
            };
            let measured = measure(&derived, starts);
            println!(
                "{}: {} from afar, {} plain, of {starts}",
                measured.name, measured.afar.drawn, measured.plain.drawn
            );
            let ways = [
                Some(&measured.plain),
                Some(&measured.afar),
                measured.generated.as_ref(),
            ];
            for outcomes in ways.into_iter().flatten() {
                assert_eq!(outcomes.wrong, 0, "{}: {outcomes:?}", measured.name);
            }
            let iterations = u32::from(Settings::<f64>::default().iterations);
            let bounds = [5 * iterations + 79, 13 * iterations + 70];
            let counts = [&measured.afar.jacobians, &measured.afar.residuals];
            for (counts, bound) in counts.into_iter().zip(bounds) {
                assert!(
                    counts.iter().all(|count| *count <= bound),
                    "{}",
                    measured.name
                );
            }
        }
    }
}
