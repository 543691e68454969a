//! Long ways of described mechanisms: where they end is where many short steps lead, or the failure says that they are too long.

use linkwright::nalgebra::SVector;
use linkwright::{FailureKind, Frame, Settings};

/// A reproducible sequence of places in 0 .. `count` (xorshift64*, Vigna 2016).
struct Places(u64);

impl Places {
    fn next(&mut self, count: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33;
        usize::try_from(bits).expect("31 bits") % count
    }
}

/// Follows random ways within ten seconds; returns how many led nowhere, and how many a plain advance took wrongly.
macro_rules! refused {
    ($module:ident, $ways:literal ways, $budget:literal attempts) => {{
        use linkwright_mechanisms::$module::{Coordinates, Textbook};
        let settings = Settings {
            substeps: $budget,
            ..Settings::default()
        };
        let drawn = SVector::from(Coordinates::DESIGN.to_array());
        let first = Frame::assemble(&Textbook, &drawn, 0.0, &settings).expect("as drawn");
        let branch = Frame::branch_of(&Textbook, &first.q, 0.0, &settings).expect("regular");
        let mut frames = vec![first];
        for step in 1..1000 {
            let last = frames[step - 1];
            let t = 0.01 * f64::from(u16::try_from(step).expect("small"));
            frames.push(last.advance(&Textbook, t, &settings).expect("a short step"));
        }
        let mut places = Places(5);
        let (mut refused, mut astray) = (0, 0);
        for _ in 0..$ways {
            let (from, to) = (places.next(1000), places.next(1000));
            let (start, end) = (&frames[from], &frames[to]);
            let differs = |q: &SVector<f64, _>| (q - end.q).amax() > 1e-9;
            match start.follow(&Textbook, branch, end.t, &settings) {
                Ok(frame) => assert!(!differs(&frame.q), "from {} to {}", start.t, end.t),
                Err(failure) => {
                    assert_eq!(failure.kind, FailureKind::StepTooLarge, "{failure}");
                    refused += 1;
                }
            }
            let plain = start.advance(&Textbook, end.t, &settings);
            astray += i32::from(plain.is_ok_and(|frame| differs(&frame.q)));
        }
        println!(
            "{}: {refused} refused, {astray} astray",
            stringify!($module)
        );
        (refused, astray)
    }};
}

#[test]
fn a_way_that_is_followed_is_the_way_of_short_steps() {
    for (refused, astray) in [
        refused!(two_body, 1000 ways, 200 attempts),
        refused!(four_bar, 1000 ways, 200 attempts),
        refused!(stephenson, 100 ways, 200 attempts),
        refused!(platform_3rpr, 50 ways, 200 attempts),
    ] {
        // A plain advance takes many of these ways to another pose, or through whole turns.
        assert!(refused == 0 && astray >= 5, "{refused} {astray}");
    }
}

#[test]
fn a_small_budget_refuses_long_ways_and_calls_no_regular_pose_singular() {
    let (refused, _) = refused!(four_bar, 1000 ways, 32 attempts);
    assert!((1..500).contains(&refused), "{refused}");
    let (refused, _) = refused!(four_bar, 1000 ways, 5 attempts);
    assert!((500..1000).contains(&refused), "{refused}");
}
