//! The ten-body arm against MSC ADAMS.

use linkwright_tests::solver::both;
use linkwright_tests::table::Table;

/// Half a unit of the last digit that ADAMS prints is 5e-7 where values are below 10; the rest is ADAMS's own error.
const TOLERANCE: f64 = 6e-7;

#[test]
fn every_row_and_column_agrees_with_adams() {
    let table = Table::read("arm_adams.csv");
    assert_eq!((table.names.len(), table.rows.len()), (17, 101));
    for mut solver in both("arm") {
        // The driven lengths differ from the drawing at t = 0, so this is a real assembly.
        solver.assemble(0.0);
        let mut largest = (0.0_f64, String::new());
        for row in &table.rows {
            solver.sweep_to(row[0]);
            let point = solver.point("K");
            let frame = solver.frame();
            let (c8, c10) = (7 * 3, 9 * 3);
            let computed = [
                ("c10_x", frame.q[c10]),
                ("c10_y", frame.q[c10 + 1]),
                ("c10_phid", frame.qd[c10 + 2]),
                ("c10_phidd", frame.qdd[c10 + 2]),
                ("c10_xd", frame.qd[c10]),
                ("c10_yd", frame.qd[c10 + 1]),
                ("c10_xdd", frame.qdd[c10]),
                ("c10_ydd", frame.qdd[c10 + 1]),
                ("K_x", point.position[0]),
                ("K_y", point.position[1]),
                ("K_xd", point.velocity[0]),
                ("K_yd", point.velocity[1]),
                ("K_xdd", point.acceleration[0]),
                ("K_ydd", point.acceleration[1]),
                ("K_phid", frame.qd[c8 + 2]),
                ("K_phidd", frame.qdd[c8 + 2]),
            ];
            let names: Vec<&str> = computed.iter().map(|(name, _)| *name).collect();
            assert_eq!(names, table.names[1..]);
            for ((name, computed), wanted) in computed.into_iter().zip(&row[1..]) {
                let error = (computed - wanted).abs();
                let place = format!(
                    "{} {name} at t = {}: {computed} instead of {wanted}",
                    solver.kind(),
                    row[0]
                );
                assert!(error <= TOLERANCE, "{place}, {error:e}");
                if error > largest.0 {
                    largest = (error, place);
                }
            }
        }
        println!("largest error {:.2e}: {}", largest.0, largest.1);
    }
}
