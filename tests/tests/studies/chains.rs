//! Chains whose block is torn: ratio of the errors by tearing to those by all equations at once, in f64 and in f32.
//! The short form of `tests/reports/chains.md`.

use linkwright_tests::chains::compiled::CHAINS;
use linkwright_tests::chains::measure::{COARSE, FINE, QUANTITIES, Sweep, measure};
use linkwright_tests::stability::verdict::Scalar;

/// Largest ratio of errors to those of all equations at once.
const ALLOWED: f64 = 3.0;

const SCALARS: [Scalar; 2] = [Scalar::F64, Scalar::F32];

/// Positions, velocities and accelerations, in the mean over all bars and frames and in the worst of them. No frame
/// is refused, and none of a torn chain needs all equations at once.
#[test]
fn errors_by_way_of_the_tears_are_at_most_three_times_as_large() {
    let short = Sweep { stride: 10, ..FINE };
    for chain in CHAINS {
        for (scalar, sweep) in SCALARS
            .into_iter()
            .flat_map(|it| [(it, short), (it, COARSE)])
        {
            let measured = measure(chain, scalar, sweep);
            let of = format!(
                "{} cells, growth {}, {scalar:?}, steps of {} s",
                chain.cells, chain.growth, sweep.step
            );
            assert_eq!(measured.torn.refused, [""; 0], "{of}");
            assert_eq!(measured.dense.refused, [""; 0], "{of}");
            assert_eq!(measured.torn.by_tears, sweep.frames as usize, "{of}");
            println!("{of}: {:?}", measured.largest_ratios());
            for (quantity, name) in QUANTITIES.iter().enumerate() {
                for level in 0..3 {
                    let ratios = measured.ratios(quantity, level);
                    // NaN is refused.
                    let allowed = ratios.iter().all(|&it| it <= ALLOWED);
                    assert!(allowed, "{of}, {name} {level}: {ratios:?}");
                }
            }
        }
    }
}

/// The dense half of every comparison.
#[test]
fn monitored_chains_are_solved_by_all_equations_at_once() {
    for chain in CHAINS {
        for ways in [&chain.double, &chain.single] {
            assert_eq!((ways.dense)(&[0.01, 0.02]).by_tears, 0);
            assert_eq!((ways.torn)(&[0.01, 0.02]).by_tears, 2);
        }
    }
}
