//! The report's arm: its determinant, and both descriptions against a high-precision reference.

use linkwright::generated::{Factorization, Scales};
use linkwright_tests::deviation::{REST_MAGNITUDE, deviations, worst};
use linkwright_tests::solver::both;
use linkwright_tests::table::Table;
use nalgebra::Dyn;

/// The bodies' origins in the reference, c1 to c10. Only those of c1, c2, c3, c4, c6, c8, c9 and c10 are attached to points
/// of the same letter; B and M are pins, where two bodies have the same motion.
const ORIGINS: [&str; 10] = ["A", "J", "L", "I", "B", "D", "M", "N", "G", "H"];

/// The report's number. It does not depend on where the frames are: shifting an origin is a unimodular change of q.
#[test]
fn the_determinant_at_the_start_is_the_reports() {
    for name in ["excavator", "excavator_pins"] {
        for mut solver in both(name) {
            solver.assemble(0.0);
            let matrix = solver
                .functions(solver.frame().q.as_slice(), &[0.0; 30], 0.0)
                .phi_q;
            let factorization =
                Factorization::new(&matrix, &Scales::unit(Dyn(30)), 0.0).expect("a regular matrix");
            let determinant = factorization.determinant();
            println!("{name}, {}: {determinant}", solver.kind());
            assert_eq!(
                format!("{determinant:.6e}"),
                "-1.343628e-2",
                "{name}, {}",
                solver.kind()
            );
        }
    }
}

#[test]
fn coordinates_agree_with_the_reference_at_all_times() {
    let table = Table::read("excavator.csv");
    for mut solver in both("excavator_pins") {
        let deviations = deviations(&mut *solver, &table);
        let moving: Vec<_> = deviations
            .iter()
            .filter(|it| it.magnitude > 0.0)
            .cloned()
            .collect();
        println!(
            "{}, what moves: relative {:.1e}",
            solver.kind(),
            worst(&moving).relative()
        );
        let worst = worst(&deviations);
        println!(
            "{}: {worst:?}, relative {:.1e}",
            solver.kind(),
            worst.relative()
        );
        assert!(worst.relative() <= 1e-12, "{}: {worst:?}", solver.kind());
    }
}

#[test]
fn points_agree_with_the_origins_of_the_reference() {
    let table = Table::read("excavator.csv");
    for name in ["excavator", "excavator_pins"] {
        for mut solver in both(name) {
            solver.assemble(0.0);
            let mut largest = 0.0_f64;
            for row in &table.rows {
                solver.sweep_to(row[0]);
                for (index, point) in ORIGINS.iter().enumerate() {
                    let motion = solver.point(point);
                    let levels = [
                        ("q", motion.position),
                        ("qd", motion.velocity),
                        ("qdd", motion.acceleration),
                    ];
                    for ((level, [x, y]), axes) in levels.into_iter().zip([["x", "y"]; 3]) {
                        for (levels, axis) in [x, y].into_iter().zip(axes) {
                            let column = table.column(&format!("{level}_{axis}{}", index + 1));
                            let error = (levels - row[column]).abs();
                            let magnitude = table.magnitude(column).max(REST_MAGNITUDE);
                            largest = largest.max(error / magnitude);
                            assert!(
                                error <= 1e-12 * magnitude,
                                "{name}, {}: {level} of {point} at t = {}: {levels} instead of {}, {error:e}",
                                solver.kind(),
                                row[0],
                                row[column]
                            );
                        }
                    }
                }
            }
            println!(
                "{name}, {}: largest relative error of a point {largest:.1e}",
                solver.kind()
            );
        }
    }
}
