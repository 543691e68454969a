//! Periodic tables: smooth at the boundaries of periods, wherever they begin.

use linkwright_tests::random::Random;

use super::{UNEQUAL, close, table};

mod from_elsewhere {
    linkwright::include_mechanism!(periodic_from_elsewhere);
}

/// Points of `periodic_from_elsewhere`. The second derivative at the boundary of two periods follows from an
/// independent solution: 70/11 1/s², by the three equations of the ring (de Boor, chapter IV), solved by hand with
/// 0.3, 0.4 and 0.3 s between points.
const SWING: [[f64; 2]; 4] = [[0.2, 0.0], [0.5, 0.6], [0.9, -0.3], [1.2, 0.0]];
const SWING_SECOND: f64 = 70.0 / 11.0;

#[test]
fn a_periodic_table_is_smooth_at_its_boundaries_wherever_it_begins() {
    let motion = table(&SWING, "periodic");
    let mut swing = from_elsewhere::PeriodicFromElsewhere::assemble(0.2).expect("an angle");
    for period in 0..200 {
        let boundary = 0.2 + f64::from(period);
        for t in [boundary.next_down(), boundary, boundary.next_up()] {
            if t < 0.2 {
                continue;
            }
            let [value, slope, second, ..] = motion.at(t);
            close(value, 0.0, 1e-11, &format!("the value at {t}"));
            close(
                second,
                SWING_SECOND,
                1e-9,
                &format!("the second derivative at {t}"),
            );
            let frame = swing.advance(t).expect("it swings");
            assert_eq!(
                [frame.q.phi_a, frame.qd.phi_a, frame.qdd.phi_a],
                [value, slope, second],
                "{t}"
            );
        }
    }
}

/// A spline has a continuous second derivative: beside a boundary it differs by the third one times the distance at
/// most.
#[test]
fn periodic_tables_of_random_places_are_smooth_at_their_boundaries() {
    const BESIDE: f64 = 1e-5;
    let mut random = Random::new(32);
    let mut looked_at = 0;
    for _ in 0..60 {
        let first = random.between(-3.0, 3.0);
        let widths = [0; 4].map(|_| random.between(0.1, 0.7));
        let heights = [0; 3].map(|_| random.between(-1.0, 1.0));
        let mut points = vec![[first, 0.0]];
        for (place, width) in widths.into_iter().enumerate() {
            let [last, _] = points[place];
            points.push([last + width, heights.get(place).copied().unwrap_or(0.0)]);
        }
        let period = points[4][0] - first;
        let motion = table(&points, "periodic");
        for number in -30..30 {
            let boundary = first + f64::from(number) * period;
            let around = [-BESIDE, 0.0, BESIDE].map(|beside| motion.at(boundary + beside));
            let third = around
                .iter()
                .fold(0.0_f64, |most, it| most.max(it[3].abs()));
            let bound = 2.0 * BESIDE * third + 1e-9;
            for beside in [around[0], around[2]] {
                let gap = (around[1][2] - beside[2]).abs();
                assert!(
                    gap <= bound,
                    "{gap:e} over {bound:e} at {boundary} of {points:?}"
                );
                looked_at += 1;
            }
        }
    }
    assert_eq!(looked_at, 7200);
}

#[test]
fn a_periodic_table_repeats_itself() {
    let motion = table(&UNEQUAL, "periodic");
    for step in 0..400 {
        let x = -0.5 + f64::from(step) / 100.0;
        let here = motion.at(x);
        for turns in [-3.0, 1.0, 25.0] {
            let there = motion.at(x + 4.0 * turns);
            for order in 0..3 {
                // An argument of 100 is rounded by 7e-15, and the slopes are up to 50.
                close(
                    there[order],
                    here[order],
                    1e-11,
                    &format!("order {order} at {x}"),
                );
            }
        }
    }
}
