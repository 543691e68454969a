//! Motions through poses with collinear links pass straight through, wherever frames fall.

use std::f64::consts::PI;
use std::fmt::Write as _;

use linkwright::{Blocks, Branch, FailureKind, Settings, Shell};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::read;
use linkwright_solver::{Interpreted, View};
use linkwright_tests::values::assembled_from;

/// Cranks of one length in a row, each of which turns the next one through a coupler of the length of the ground
/// between them.
struct Row {
    loops: usize,
    coupler: f64,
    crank: f64,
    /// The direction of the ground (rad).
    turned: f64,
}

const ROWS: [Row; 5] = [
    Row {
        loops: 1,
        coupler: 0.5,
        crank: 0.2,
        turned: 0.0,
    },
    Row {
        loops: 1,
        coupler: 500.0,
        crank: 450.0,
        turned: 0.3,
    },
    Row {
        loops: 1,
        coupler: 1e-3,
        crank: 7e-4,
        turned: -1.2,
    },
    Row {
        loops: 2,
        coupler: 0.5,
        crank: 0.2,
        turned: 0.0,
    },
    Row {
        loops: 3,
        coupler: 1.4,
        crank: 0.28,
        turned: 0.4,
    },
];

/// Motion of the first crank: the law, its value with rate and acceleration, and the time at which the links are
/// first collinear.
type Law = (&'static str, fn(f64) -> [f64; 3], f64);

const LAWS: [Law; 3] = [
    ("t", |t| [t, 1.0, 0.0], 2.0 * PI / 3.0),
    ("-t", |t| [-t, -1.0, 0.0], PI / 3.0),
    (
        "t + 0.2*t*t",
        |t| [t + 0.2 * t * t, 1.0 + 0.4 * t, 0.4],
        1.589_251_228_815_651_7,
    ),
];

/// Steps from a thousandth of a radian to three turns.
const STEPS: [f64; 6] = [1e-3, 1e-2, 0.1, 1.0, 2.5, 6.0 * PI];

/// Distances of a frame from the pose in which the links are collinear.
const OFFSETS: [f64; 17] = [
    0.0, 1e-12, -1e-12, 1e-10, -1e-10, 1e-8, -1e-8, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4, -1e-4, 1e-3,
    -1e-3, 0.1, -0.1,
];

impl Row {
    fn description(&self, law: &str) -> String {
        let Self {
            loops,
            coupler,
            crank,
            turned,
        } = self;
        let start = turned + PI / 3.0;
        let mut text = format!(
            "mechanism row {{
                point G0 = (0, 0);
                body crank0 at (0, 0, {start:?}) {{ G0: (0, 0), T0: ({crank:?}, 0) }}
                revolute G0(ground, crank0);
                drive phi(crank0) = {start:?} + {law};\n"
        );
        for k in 1..=*loops {
            let before = k - 1;
            let [x, y] = self.ground(k);
            let [tip_x, tip_y] = self.tip(before, start);
            write!(
                text,
                "point G{k} = ({x:?}, {y:?});
                body coupler{k} at ({tip_x:?}, {tip_y:?}, {turned:?}) {{ T{before}: (0, 0), T{k}: ({coupler:?}, 0) }}
                body crank{k} at ({x:?}, {y:?}, {start:?}) {{ G{k}: (0, 0), T{k}: ({crank:?}, 0) }}
                revolute T{before}(crank{before}, coupler{k});
                revolute T{k}(coupler{k}, crank{k});
                revolute G{k}(ground, crank{k});\n"
            )
            .expect("a string");
        }
        text + "}"
    }

    fn ground(&self, k: usize) -> [f64; 2] {
        let length = self.coupler * k as f64;
        [length * self.turned.cos(), length * self.turned.sin()]
    }

    fn tip(&self, k: usize, angle: f64) -> [f64; 2] {
        let [x, y] = self.ground(k);
        [x + self.crank * angle.cos(), y + self.crank * angle.sin()]
    }

    /// All coordinates with rates and accelerations where the first crank has turned by an angle, on the path of parallelograms.
    fn exact(&self, [turn, rate, acceleration]: [f64; 3]) -> [Vec<f64>; 3] {
        let angle = self.turned + PI / 3.0 + turn;
        let [c, s] = [self.crank * angle.cos(), self.crank * angle.sin()];
        let mut levels = [
            vec![0.0, 0.0, angle],
            vec![0.0, 0.0, rate],
            vec![0.0, 0.0, acceleration],
        ];
        for k in 1..=self.loops {
            let [x, y] = self.ground(k);
            let [tip_x, tip_y] = self.tip(k - 1, angle);
            levels[0].extend([tip_x, tip_y, self.turned, x, y, angle]);
            levels[1].extend([-s * rate, c * rate, 0.0, 0.0, 0.0, rate]);
            levels[2].extend([
                -s * acceleration - c * rate * rate,
                c * acceleration - s * rate * rate,
                0.0,
                0.0,
                0.0,
                acceleration,
            ]);
        }
        levels
    }

    /// The mechanism at a time, on that path.
    fn assembled(&self, blocks: &Interpreted, law: &Law, t: f64) -> Option<Shell<Interpreted>> {
        let [q, _, _] = self.exact(law.1(t));
        let parameters = blocks.nominal_parameters();
        let (mut pose, mut branches) = (blocks.drawn_pose(&parameters), blocks.drawn_branches());
        if (q[2] - self.turned).sin() < 0.0 {
            branches.closed = branches.closed.into_iter().map(Branch::opposite).collect();
        }
        pose.0 = q;
        let (inputs, settings) = (blocks.input_laws().at(t), Settings::default());
        Shell::assemble(
            blocks.clone(),
            &parameters,
            &pose,
            branches,
            t,
            &inputs,
            settings,
        )
        .ok()
    }

    /// Drives through the first pose with collinear links, with a frame at a distance from it; returns the errors of
    /// values, rates and accelerations, relative to lengths.
    fn driven(&self, blocks: &Interpreted, law: &Law, step: f64, offset: f64) -> [f64; 3] {
        let hit = law.2 + offset;
        let before = (0.05 / step).ceil();
        let start = hit - before * step;
        let case = format!(
            "{} loops of {} m, {}, step {step}, offset {offset}",
            self.loops, self.coupler, law.0
        );
        let mut off = [0.0_f64; 3];
        // It cannot be assembled in that pose itself.
        let Some(mut shell) = self.assembled(blocks, law, start) else {
            let [q, _, _] = self.exact(law.1(start));
            assert!(
                (q[2] - self.turned).sin().abs() < 1e-6,
                "{case}: not assembled"
            );
            return off;
        };
        for k in 1..=2 * before as i32 + 3 {
            let from_hit = f64::from(k) - before;
            let t = hit + from_hit * step;
            let inputs = blocks.input_laws().at(t);
            let frame = shell.advance(t, &inputs);
            let frame = frame.unwrap_or_else(|failure| panic!("{case}: to {t}: {failure}"));
            for (level, exact) in self.exact(law.1(t)).into_iter().enumerate() {
                for (index, exact) in exact.into_iter().enumerate() {
                    let coordinate = blocks.coordinate(frame, index).expect("a coordinate")[level];
                    let error = (coordinate - exact).abs() / self.coupler.max(1.0);
                    off[level] = off[level].max(error);
                }
            }
        }
        assert!(
            off[0] < 1e-9 && off[1] < 1e-8 && off[2] < 1e-5,
            "{case}: {off:?}"
        );
        off
    }
}

fn blocks(text: String) -> Interpreted {
    let derived = read(&Source::new("row.mech", text)).expect("no errors");
    Interpreted::new(&derived.only().expect("one motion")).expect("its blocks")
}

/// Mechanism at t = 0 in the branches of the design configuration.
fn as_drawn(blocks: &Interpreted) -> Shell<Interpreted> {
    assembled_from(blocks.clone(), &[], 0.0, Settings::default()).expect("as drawn")
}

/// One to three loops are singular at once, and a frame falls on that pose, beside it, or beyond.
#[test]
fn rows_of_parallelograms_are_driven_straight_on() {
    for row in &ROWS {
        for law in &LAWS {
            let blocks = blocks(row.description(law.0));
            for step in STEPS {
                // An acceleration of 0.4 rad/s² over three turns passes dozens of these poses in one step.
                if law.0.contains("t*t") && step > PI {
                    continue;
                }
                for offset in OFFSETS {
                    row.driven(&blocks, law, step, offset);
                }
            }
        }
    }
}

/// Steps far smaller than the nearly singular range: every frame there is interpolated, and each continues from the
/// last one.
#[test]
fn many_frames_may_fall_beside_a_change_point() {
    let row = &ROWS[3];
    let blocks = blocks(row.description(LAWS[0].0));
    for offset in [0.0, -1e-5, 3.7e-5] {
        row.driven(&blocks, &LAWS[0], 1e-4, offset);
    }
}

/// Links that differ by a millionth have no common pose of both branches: the mechanism turns back before it, or its
/// links pass quickly.
#[test]
fn nearly_equal_links_keep_their_mode() {
    for difference in [1e-4, -1e-4, 1e-6, -1e-6] {
        let text = format!(
            "mechanism nearly {{
                point A = (0, 0), D = (0.5, 0);
                body crank at (0, 0, 90deg) {{ A: (0, 0), B: (0.2, 0) }}
                body coupler at (0, 0.2) {{ B: (0, 0), C: ({:?}, 0) }}
                body follower at (0.5, 0, 90deg) {{ D: (0, 0), C: (0.2, 0) }}
                revolute A(ground, crank);
                revolute B(crank, coupler);
                revolute C(coupler, follower);
                revolute D(ground, follower);
                drive phi(crank) = 90deg + t;
            }}",
            0.5 + difference
        );
        let blocks = blocks(text);
        for step in [0.003, 0.02, 0.1, 0.7] {
            let branches = blocks.drawn_branches();
            let mut shell = as_drawn(&blocks);
            for k in 1..=200 {
                let t = f64::from(k) * step;
                if shell.advance(t, &blocks.input_laws().at(t)).is_err() {
                    break;
                }
                assert_eq!(
                    shell.branches(),
                    &branches,
                    "{difference}, step {step}, {t}"
                );
            }
        }
    }
}

/// Parallelogram whose first crank turns by a law, collinear at t = 1 s.
fn resting(law: &str, crank: f64) -> Interpreted {
    let [x, y] = [0.2 * crank.cos(), 0.2 * crank.sin()];
    blocks(format!(
        "mechanism resting {{
            point A = (0, 0), D = (0.5, 0);
            body crank at (0, 0, {crank:?}) {{ A: (0, 0), B: (0.2, 0) }}
            body coupler at ({x:?}, {y:?}) {{ B: (0, 0), C: (0.5, 0) }}
            body follower at (0.5, 0, {crank:?}) {{ D: (0, 0), C: (0.2, 0) }}
            revolute A(ground, crank);
            revolute B(crank, coupler);
            revolute C(coupler, follower);
            revolute D(ground, follower);
            drive phi(crank) = {law};
        }}"
    ))
}

/// A motion that rests at a change point may continue on either branch, and a shorter step cannot decide which.
#[test]
fn a_motion_that_rests_where_modes_meet_is_undecided() {
    for power in [2, 3, 5] {
        let blocks = resting(
            &format!("pi + 0.5*(t - 1)^{power}"),
            PI + 0.5 * (-1.0_f64).powi(power),
        );
        for step in [0.01, 0.03, 0.1, 0.4] {
            let mut shell = as_drawn(&blocks);
            let failure = (1..=200).find_map(|k| {
                let t = f64::from(k) * step;
                shell.advance(t, &blocks.input_laws().at(t)).err()
            });
            let failure = failure.expect("an end");
            assert_eq!(
                failure.kind,
                FailureKind::Undecided,
                "power {power}, step {step}"
            );
            assert!(failure.time < 1.0, "power {power}, step {step}: {failure}");
        }
    }
}
