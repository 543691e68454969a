//! The baseline solves the same mechanisms: the reference of the methods must be right.

use linkwright_tests::baseline::Baseline;
use linkwright_tests::description;
use linkwright_tests::method::studied;
use linkwright_tests::reference::{reference, yardsticks};

/// It stops at 1e-12, so that its error is that times the condition of the mechanism, and more in the derivatives.
#[test]
fn the_baseline_agrees_with_the_references_as_far_as_its_stopping_rule_allows() {
    for name in studied() {
        let table = reference(name);
        let mut baseline = Baseline::new(&description::system(name));
        baseline.advance(0.0);
        let mut frame = 0;
        let yardsticks = yardsticks(&table);
        let mut largest = 0.0_f64;
        for row in &table.rows {
            while f64::from(frame) / 100.0 < row[0] {
                frame += 1;
                baseline.advance(f64::from(frame) / 100.0);
            }
            let levels = [&baseline.q, &baseline.qd, &baseline.qdd];
            let levels = levels.into_iter().flat_map(|vector| vector.iter());
            for (column, (levels, wanted)) in levels.zip(&row[1..]).enumerate() {
                largest = largest.max((levels - wanted).abs() / yardsticks[column]);
            }
        }
        println!("{name}: {largest:.1e}");
        assert!(largest <= 1e-9, "{name}: {largest:e}");
    }
}
