//! Long rows of dyads: windows stay wide, and what is vouched for is one path.

use std::fmt::Write as _;

use linkwright::generated::{Pair, TimeWindow};
use linkwright::{Blocks, Settings};
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::InputSignals;
use linkwright_tests::dyad_chain;
use linkwright_tests::random::Random;
use linkwright_tests::values::assembled_with;

use super::{Outcome, Poses, blocks_of, looked, size};

/// A row of dyads whose pins are up to `off` (m) from those of [`dyad_chain`]. Some rockers hold the pin of the next but one, which is
/// near their own: two arms move its dyad.
fn irregular(random: &mut Random, count: usize, off: f64) -> String {
    let mut text = String::from("mechanism row {\n");
    for k in 0..=count {
        let places = match k % 2 {
            0 => [[0.0, 0.0], [0.0, 0.5]],
            _ => [[1.0, 0.0], [1.1, 0.4]],
        };
        let [[gx, gy], [tx, ty]] =
            places.map(|place| place.map(|value| value + random.between(-off, off)));
        let _ = writeln!(
            text,
            "    point G{k} = ({gx:.4}, {gy:.4}), T{k} = ({tx:.4}, {ty:.4});"
        );
    }
    let mut joints = String::from("    revolute G0(ground, crank);\n");
    text.push_str("    body crank at G0 { G0, T0 }\n");
    let holds: Vec<bool> = (0..=count)
        .map(|k| k > 0 && k + 2 <= count && random.bits().is_multiple_of(3))
        .collect();
    for k in 1..=count {
        let last = k - 1;
        let before = match k {
            1 => "crank".to_string(),
            _ => format!("rocker{last}"),
        };
        let base = match k >= 2 && holds[k - 2] {
            true => format!("rocker{}", k - 2),
            false => "ground".to_string(),
        };
        let held = match holds[k] {
            true => format!(", G{}", k + 2),
            false => String::new(),
        };
        let _ = writeln!(text, "    body coupler{k} at T{last} {{ T{last}, T{k} }}");
        let _ = writeln!(text, "    body rocker{k} at G{k} {{ G{k}, T{k}{held} }}");
        let _ = writeln!(joints, "    revolute T{last}({before}, coupler{k});");
        let _ = writeln!(joints, "    revolute T{k}(coupler{k}, rocker{k});");
        let _ = writeln!(joints, "    revolute G{k}({base}, rocker{k});");
    }
    format!("{text}{joints}")
}

#[test]
fn what_is_vouched_for_in_long_rows_is_one_path() {
    let mut random = Random::new(1974);
    let mut counts = [0; 3];
    for number in 0..30 {
        let (swing, pace) = (random.between(0.1, 1.5), random.between(0.5, 3.0));
        let asked = ["", "    output T3;\n"][number % 2];
        let count = 16 + number % 5;
        let text = format!(
            "{}    drive phi(crank) = {swing:.3}*sin({pace:.3}*t);\n{asked}}}\n",
            irregular(&mut random, count, 0.06)
        );
        let blocks = blocks_of(&Source::new("row.mech", &text));
        let none = InputSignals::default();
        for _ in 0..24 {
            let (t, h) = (random.between(-2.0, 2.0), size(&mut random, 1e-4, 2.0));
            let stretch = match random.bits() % 3 {
                0 => 1.0,
                _ => size(&mut random, 2.0, 1000.0_f64.min(4.0 / h).max(2.5)),
            };
            match looked(&blocks, [t, h, stretch], [&none, &none]) {
                Outcome::NoFrames => {}
                Outcome::Vouched => counts[0] += 1,
                Outcome::Broken => counts[1] += 1,
                Outcome::Undecided => counts[2] += 1,
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 20), "{counts:?}");
}

/// Bounds that grew by more than what they bound would leave no window of two steps, and rows of 1000 dyads no step.
#[test]
fn windows_of_a_hundred_dyads_hold_eight_steps() {
    let blocks = blocks_of(&Source::new("row.mech", dyad_chain::description(100)));
    let none = InputSignals::default();
    let settings = Settings::default();
    let h = 0.01;
    for place in 1..25 {
        let t = 0.2 * f64::from(place);
        let shell = assembled_with(blocks.clone(), &[], t - h, &none, settings);
        let shell = shell.unwrap_or_else(|failure| panic!("{t}: {failure}"));
        let (last, modes) = (shell.frame(), shell.branches().clone());
        let poses = Poses {
            blocks: &blocks,
            modes,
            settings,
        };
        let at = poses.at(t, last, &none).expect("a pose");
        let conditions = poses.conditions(t, &none);
        let pair = Pair {
            at: &at,
            last,
            before: &none,
            conditions: &conditions,
        };
        let shown = blocks.verify_nonsingular(&pair, &TimeWindow::around(h, 8.0));
        assert_eq!(shown, Ok(()), "{t}");
    }
}
