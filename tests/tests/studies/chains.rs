//! Chains whose block is torn: how much more is rounded by way of the tears than by all equations at once, in f64 and in f32? The short
//! form of `tests/reports/chains.md`.

use linkwright_tests::chains::compiled::CHAINS;
use linkwright_tests::chains::measure::{COARSE, FINE, QUANTITIES, Sweep, measure};
use linkwright_tests::stability::verdict::Scalar;

/// How many times as large as those of all equations at once errors may be.
const ALLOWED: f64 = 3.0;

const SCALARS: [Scalar; 2] = [Scalar::F64, Scalar::F32];

/// Positions, velocities and accelerations, in the mean over all bars and frames and in the worst of them. No frame is refused, and
/// none of a torn chain needs all equations at once.
#[test]
fn errors_by_way_of_the_tears_are_at_most_three_times_as_large() {
    let short = Sweep { stride: 10, ..FINE };
    for chain in CHAINS {
        for (scalar, sweep) in SCALARS
            .into_iter()
            .flat_map(|it| [(it, short), (it, COARSE)])
        {
            let found = measure(chain, scalar, sweep);
            let of = format!(
                "{} cells, growth {}, {scalar:?}, steps of {} s",
                chain.cells, chain.growth, sweep.step
            );
            assert_eq!(found.torn.refused, [""; 0], "{of}");
            assert_eq!(found.dense.refused, [""; 0], "{of}");
            assert_eq!(found.torn.by_tears, sweep.frames as usize, "{of}");
            println!("{of}: {:?}", found.largest_ratios());
            for (quantity, name) in QUANTITIES.iter().enumerate() {
                for level in 0..3 {
                    let ratios = found.ratios(quantity, level);
                    // Written so that NaN is refused.
                    let allowed = ratios.iter().all(|&it| it <= ALLOWED);
                    assert!(allowed, "{of}, {name} {level}: {ratios:?}");
                }
            }
        }
    }
}

/// The other half of every comparison.
#[test]
fn monitored_chains_are_solved_by_all_equations_at_once() {
    for chain in CHAINS {
        for ways in [&chain.double, &chain.single] {
            assert_eq!((ways.dense)(&[0.01, 0.02]).by_tears, 0);
            assert_eq!((ways.torn)(&[0.01, 0.02]).by_tears, 2);
        }
    }
}
