//! Angles that a search from afar winds up: whole turns are taken off where the equations do not count them.

use std::f64::consts::{PI, TAU};

use linkwright::nalgebra::DVector;
use linkwright::{Equations as _, Settings};
use linkwright_solver::Interpreted;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_tests::description::written;
use linkwright_tests::random::Random;
use linkwright_tests::values::{assembled_from, levels};

/// A wheel on an arm, with a pin that stays above a point, rolls along a bar that turns. Its angle is found with that of the arm, by
/// Newton-Raphson.
const ROLLING: &str = "mechanism rolling {
    point O = (0.1, 0.03);
    body bar at (0.1, -0.03, -1.14) { U: (-0.05, 0.09), V: (-0.13, 0.11) }
    body arm at (0.1, 0.02, -1.5) { O, W: (-0.14, -0.06) }
    body wheel at (0.016, 0.064, -2.6) { C: (-0.06, -0.07), Q: (-0.14, -0.003), R: (-0.1, 0.1) }
    absolute_x(bar) = 0.1;
    absolute_y(bar) = -0.03;
    revolute O(ground, arm);
    revolute (arm.W, wheel.C);
    absolute_x(wheel.Q) = 0.13;
    rack (wheel.R, bar) along bar.U -> bar.V = 0.009;
    drive phi(bar) = -1.14 + t;
}";

#[test]
fn whole_turns_that_are_counted_stay() {
    let derived = written(ROLLING);
    let interpreted = Interpreted::new(&derived).expect("a plan");
    let textbook = TextbookEquations::new(&derived.pool, &derived.system);
    let drawn = textbook.estimate().clone();
    let mut random = Random::new(7);
    let (mut found, mut wound) = (0, 0);
    let mut phi = DVector::zeros(drawn.len());
    for _ in 0..2000 {
        let estimate: Vec<f64> = drawn
            .iter()
            .enumerate()
            .map(|(place, value)| {
                let reach = if place % 3 == 2 { 3.0 } else { 0.2 };
                value + reach * random.between(-1.0, 1.0)
            })
            .collect();
        let t = random.between(-0.2, 0.2);
        let Ok(motion) = assembled_from(interpreted.clone(), &estimate, t, Settings::default())
        else {
            continue;
        };
        let [q, _, _] = levels(&interpreted, motion.frame());
        let q = DVector::from_vec(q);
        textbook.residual(&q, t, &mut phi);
        assert!(phi.amax() < 1e-9, "{:e} from {estimate:?}", phi.amax());
        found += 1;
        let angles = [5, 8].map(|place| (q[place] - estimate[place]).abs());
        assert!(
            angles[0] <= PI,
            "the arm may go round: {} turns",
            angles[0] / TAU
        );
        wound += usize::from(angles[1] > PI);
    }
    println!("{found} assembled, the wheel wound {wound} times");
    assert!(found > 100 && wound > 10);
}
