//! Synthesis: published cases are solved as well as by others, by a closed form of its own, and each design is proven to turn.

use linkwright_calibrate::StartSampling;
use linkwright_tests::synthesis::CASES;

/// Excess over a published error that the rounding of printed designs explains.
const ROUNDED: f64 = 1e-6;

/// Samples, fits and seeds that suffice; `tests/reports/synthesis.md` counts how many seeds of five do with more of both.
const SAMPLINGS: [(u32, usize, u64); 5] = [
    (4096, 80, 3),
    (1024, 20, 0),
    (1024, 20, 0),
    (2048, 40, 0),
    (4096, 80, 0),
];

/// Errors that the papers state for their designs, to the digits that are left of printed numbers.
#[test]
fn published_designs_have_their_published_errors() {
    let stated = [2.0627e-4, 1.284e-6, 0.016_077_7, 2.580_36, 4.01992e-4];
    for (case, stated) in CASES.iter().zip(stated) {
        let error = case.published_error();
        assert!(
            (error / stated - 1.0).abs() < 1e-4,
            "{}: {error}",
            case.name
        );
    }
}

#[test]
fn published_cases_are_solved_as_well_and_proven_to_turn() {
    for (case, (count, fits, seed)) in CASES.iter().zip(SAMPLINGS) {
        let sampling = StartSampling { count, fits, seed };
        let solved = case.solved(sampling, 4, 2).expect("a solution");
        let largest = match case.is_exact {
            true => 1e-12,
            false => case.published_error() * (1.0 + ROUNDED),
        };
        println!("{}: {:e}, at most {largest:e}", case.name, solved.error);
        assert!(solved.error <= largest, "{}: {}", case.name, solved.error);
        assert!(solved.design.turns(), "{}: {:?}", case.name, solved.design);
        let ends = case.bounds[0];
        let mut links = solved.design.links.into_iter();
        assert!(
            links.all(|it| ends[0] <= it && it <= ends[1]),
            "{:?}",
            solved.design
        );
        let certificate = case.certificate(&solved);
        assert!(
            certificate.proof.proven.is_some(),
            "{:?}",
            certificate.proof.unproven
        );
    }
}
