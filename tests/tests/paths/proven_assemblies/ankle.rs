//! The foot of the ankle: its rods in turn, each with an equation of the roll at a pitch.

use std::f64::consts::TAU;

use linkwright_solver::Interpreted;
use linkwright_solver::assemblies::assemblies;
use linkwright_tests::files;
use linkwright_tests::forces::systems;
use linkwright_tests::random::Random;

use super::assert_agrees;

/// The equation of one rod of the ankle: the cosine and the sine of the roll with these factors are the third, at a pitch.
#[derive(Clone, Copy)]
struct Rod {
    height: f64,
    aside: f64,
    motor: f64,
}

/// In m, as in `mechanisms/ankle.mech`.
const CRANK: f64 = 0.035;
const BEHIND: f64 = 0.045;

impl Rod {
    /// |Q|² + |P|² − 2 P·Q = ℓ², where Q is as far from the joint in every pose.
    fn at(self, pitch: f64) -> [f64; 3] {
        let (sine, cosine) = pitch.sin_cos();
        let (x, z) = (
            -CRANK * self.motor.cos(),
            self.height + CRANK * self.motor.sin(),
        );
        let squares = BEHIND * BEHIND + 2.0 * self.aside * self.aside + x * x + z * z;
        let rod = self.height * self.height + (BEHIND - CRANK) * (BEHIND - CRANK);
        [
            self.aside * self.aside,
            self.aside * (x * sine + z * cosine),
            0.5 * (squares - rod) + BEHIND * (x * cosine - z * sine),
        ]
    }

    /// Beyond zero where the rod cannot be held at this pitch, whatever the roll is.
    fn beyond(self, pitch: f64) -> f64 {
        let [along, across, all] = self.at(pitch);
        all.abs() - along.hypot(across)
    }

    /// The roll at a pitch, one of two.
    fn roll(self, pitch: f64, side: f64) -> f64 {
        let [along, across, all] = self.at(pitch);
        let cosine = (all / along.hypot(across)).clamp(-1.0, 1.0);
        across.atan2(along) + side * cosine.acos()
    }

    fn remains(self, [pitch, roll]: [f64; 2]) -> f64 {
        let [along, across, all] = self.at(pitch);
        along * roll.cos() + across * roll.sin() - all
    }
}

/// Into how many parts a turn is divided.
const GRID: u32 = 20_000;

/// Where a function changes its sign in one turn that begins here.
fn changes(beginning: f64, function: impl Fn(f64) -> f64) -> Vec<f64> {
    let place = |step: u32| beginning + TAU * f64::from(step) / f64::from(GRID);
    let values: Vec<f64> = (0..=GRID).map(|step| function(place(step))).collect();
    let steps = (0..GRID).filter(|&step| {
        let [one, next] = [step, step + 1].map(|it| values[it as usize] > 0.0);
        one != next
    });
    let bisected = |step: u32| {
        let (mut low, mut high) = (place(step), place(step + 1));
        let first = function(low) > 0.0;
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            match (function(middle) > 0.0) == first {
                true => low = middle,
                false => high = middle,
            }
        }
        0.5 * (low + high)
    };
    steps.map(bisected).collect()
}

/// Pitch and roll in every pose of the foot. The left rod leaves closed curves of them: of two rolls over a whole turn of the pitch, or
/// around a range of it, at whose ends both rolls are one. Along a curve the right rod's equation changes its sign at every pose.
fn feet(left: Rod, right: Rod) -> Vec<Vec<f64>> {
    // Off the middle of a range, which should not be cut where the turn begins.
    let beginning = (0..GRID).map(|it| TAU * f64::from(it) / f64::from(GRID));
    let beginning = beginning.max_by(|a, b| left.beyond(*a).total_cmp(&left.beyond(*b)));
    let beginning = beginning.unwrap_or_default();
    let ends = changes(beginning, |pitch| left.beyond(pitch));
    let mut poses = Vec::new();
    if ends.is_empty() && left.beyond(beginning) > 0.0 {
        return poses;
    }
    let mut follow = |curve: &dyn Fn(f64) -> [f64; 2]| {
        let places = changes(0.1, |along| right.remains(curve(along)));
        poses.extend(places.into_iter().map(|it| curve(it).to_vec()));
    };
    if ends.is_empty() {
        for side in [1.0, -1.0] {
            follow(&|along| [along, left.roll(along, side)]);
        }
    }
    for range in ends.chunks_exact(2) {
        let (middle, half) = (0.5 * (range[0] + range[1]), 0.5 * (range[1] - range[0]));
        follow(&|along| {
            let pitch = middle - half * along.cos();
            [pitch, left.roll(pitch, along.sin().signum())]
        });
    }
    poses
}

#[test]
fn the_foot_of_the_ankle_stands_where_signs_change_and_nowhere_else() {
    let path = files::repository().join("mechanisms/ankle.mech");
    let text = std::fs::read_to_string(path).expect("the ankle");
    let mut random = Random::new(7);
    let mut counts = [0_usize; 9];
    for _ in 0..30 {
        let motors = [(); 2].map(|()| (1e4 * random.between(-0.5, 0.5)).round() * 1e-4);
        let [left, right] = motors.map(|it| format!("{it:.4}rad"));
        let text = text.replace("left_motor = 0deg", &format!("left_motor = {left}"));
        let text = text.replace("right_motor = 0deg", &format!("right_motor = {right}"));
        let solved = Interpreted::new(&systems("ankle", &text)[1]).expect("a plan");
        let all = assemblies(&solved, 0.0);
        let what = format!("{left} and {right}");
        assert!(all.proven && all.undecided.is_empty(), "{what}");
        // In m, as in the description.
        let sides = [(0.22, 0.028, motors[0]), (0.13, -0.028, motors[1])];
        let [left, right] = sides.map(|(height, aside, motor)| Rod {
            height,
            aside,
            motor,
        });
        let known = feet(left, right);
        assert_agrees(&all, &[0, 1], &known, &what);
        counts[known.len()] += 1;
    }
    println!("so many with 0 to 8 poses: {counts:?}");
    assert_eq!(counts[0], 0, "the angles are within reach");
}
