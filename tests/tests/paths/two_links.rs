//! The proof of a path by the bounds of two links never accepts a window in which the links become collinear.
//!
//! Windows of every size of chains of random dyads are verified. If their path is proven, poses exist all over the
//! window, follow one another without a jump, and turn no link by more than is assumed.

mod rows;

use std::f64::consts::PI;
use std::fmt::Write as _;

use linkwright::generated::{Conditions, Pair, Start, TimeWindow};
use linkwright::{Blocks, Settings, Signal};
use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::read;
use linkwright_solver::{InputSignals, Instant, Interpreted, Modes};
use linkwright_tests::description;
use linkwright_tests::random::Random;
use linkwright_tests::values::assembled_with;

/// Number of times in a window at which poses are computed.
const SAMPLES: i32 = 300;

/// Largest turn of a link in a window, in rad.
const LARGEST_TURN: f64 = 1.5;

/// Mechanism without its path.
struct Poses<'a> {
    blocks: &'a Interpreted,
    modes: Modes,
    settings: Settings<f64>,
}

impl Poses<'_> {
    /// Pose at a time in these branches, with angles near another one; `None` if the links do not reach.
    fn at(&self, t: f64, near: &Instant, inputs: &InputSignals) -> Option<Instant> {
        let mut at = near.clone();
        let conditions = self.conditions(t, inputs);
        let solved = self
            .blocks
            .solve(&mut at, near, &mut self.modes.clone(), &conditions);
        solved.ok().map(|()| at)
    }

    fn conditions<'b>(
        &'b self,
        t: f64,
        inputs: &'b InputSignals,
    ) -> Conditions<'b, f64, <Interpreted as Blocks>::Parameters, InputSignals> {
        Conditions {
            t,
            start: Start::LastFrame,
            parameters: no_parameters(),
            inputs,
            settings: &self.settings,
        }
    }
}

fn no_parameters() -> &'static <Interpreted as Blocks>::Parameters {
    static NONE: <Interpreted as Blocks>::Parameters = linkwright_solver::Numbers(Vec::new());
    &NONE
}

/// Outcome of one window.
#[derive(Debug, PartialEq)]
enum Outcome {
    /// A frame of the window does not exist.
    NoFrames,
    /// The path is proven, and is smooth.
    Vouched,
    /// The path is not proven, and is not smooth over the window.
    Broken,
    /// The path is not proven.
    Undecided,
}

/// Verifies a window about the frames at `t - h` and `t`, between which inputs go.
fn looked(blocks: &Interpreted, [t, h, stretch]: [f64; 3], inputs: [&InputSignals; 2]) -> Outcome {
    let settings = Settings::default();
    let Ok(shell) = assembled_with(blocks.clone(), &[], t - h, inputs[0], settings) else {
        return Outcome::NoFrames;
    };
    let (last, modes) = (shell.frame(), shell.branches().clone());
    let poses = Poses {
        blocks,
        modes,
        settings,
    };
    let Some(at) = poses.at(t, last, inputs[1]) else {
        return Outcome::NoFrames;
    };
    let conditions = poses.conditions(t, inputs[1]);
    let pair = Pair {
        at: &at,
        last,
        before: inputs[0],
        conditions: &conditions,
    };
    let span = match stretch > 1.0 {
        true => TimeWindow::around(h, stretch),
        false => TimeWindow::between(h),
    };
    let is_vouched = blocks.verify_nonsingular(&pair, &span).is_ok();
    // Without look-ahead the path ends with the frames.
    let ends: &[f64] = if stretch > 1.0 { &[-1.0, 1.0] } else { &[-1.0] };
    let is_smooth = ends
        .iter()
        .all(|end| is_smooth(&poses, &at, [t, h, end * span.time], inputs));
    match (is_vouched, is_smooth) {
        (true, _) => {
            assert!(is_smooth, "t = {t}, h = {h}, {stretch} steps");
            Outcome::Vouched
        }
        (false, false) => Outcome::Broken,
        (false, true) => Outcome::Undecided,
    }
}

/// True if the sampled poses from `t` on follow one another without a jump.
fn is_smooth(
    poses: &Poses<'_>,
    first: &Instant,
    [t, h, way]: [f64; 3],
    inputs: [&InputSignals; 2],
) -> bool {
    let mut before = first.clone();
    for sample in 1..=SAMPLES {
        let time = t + way * f64::from(sample) / f64::from(SAMPLES);
        let part = (1.0 + (time - t) / h).clamp(0.0, 1.0);
        let signals = inputs[0].0.iter().zip(&inputs[1].0);
        let signals = signals.map(|(from, to)| from.towards(to, h, part));
        let interpolated = InputSignals(signals.collect());
        let Some(at) = poses.at(time, &before, &interpolated) else {
            return false;
        };
        let turned = |from: &Instant, most: f64| {
            let mut both = at.q().iter().zip(from.q()).skip(2).step_by(3);
            both.all(|(now, then)| (now - then).abs() <= most)
        };
        // The drive is unbounded; links turn by much less than a quarter of a turn from one sample to the next.
        if !turned(&before, LARGEST_TURN / 2.0) || !turned(first, LARGEST_TURN) {
            return false;
        }
        before = at;
    }
    true
}

/// Chain of dyads behind a crank, each of which ends at the ground or at the link before.
fn chain(random: &mut Random, drive: &str) -> String {
    let mut text = String::from("mechanism chain {\n");
    let count = 1 + (random.bits() % 4) as usize;
    let mut place = |x: [f64; 2], y: [f64; 2]| {
        let [x, y] = [random.between(x[0], x[1]), random.between(y[0], y[1])];
        format!("({x:.4}, {y:.4})")
    };
    let (unit, tall) = ([-1.0, 1.0], [0.3, 1.2]);
    let _ = writeln!(
        text,
        "    point O = (0, 0), P0 = {};",
        place([0.05, 0.6], [0.05, 0.6])
    );
    for k in 1..=count {
        let ground = place([0.7, 2.0], unit);
        let apex = place([0.0, 1.8], tall);
        let (tip, side) = (place(unit, tall), place(unit, tall));
        let _ = writeln!(
            text,
            "    point G{k} = {ground}, Q{k} = {apex}, P{k} = {tip}, S{k} = {side};"
        );
    }
    let mut dyads = String::from("    revolute O(ground, crank);\n");
    text.push_str("    body crank at O { O, P0 }\n");
    for k in 1..=count {
        let last = k - 1;
        let before = match k {
            1 => "crank".to_string(),
            _ => format!("b{last}"),
        };
        let (outer, base) = match k >= 2 && random.bits().is_multiple_of(2) {
            true => (format!("S{last}"), format!("a{last}")),
            false => (format!("G{k}"), "ground".to_string()),
        };
        let _ = writeln!(text, "    body a{k} at P{last} {{ P{last}, Q{k}, S{k} }}");
        let _ = writeln!(text, "    body b{k} at {outer} {{ {outer}, Q{k}, P{k} }}");
        let _ = writeln!(dyads, "    revolute P{last}({before}, a{k});");
        let _ = writeln!(dyads, "    revolute Q{k}(a{k}, b{k});");
        let _ = writeln!(dyads, "    revolute {outer}({base}, b{k});");
    }
    format!("{text}{dyads}    {drive}\n}}\n")
}

fn blocks_of(source: &Source) -> Interpreted {
    let derived = read(source);
    let derived = derived.unwrap_or_else(|errors| panic!("{}\n{errors:?}", source.text));
    let derived = derived.only().expect("one motion");
    let blocks = Interpreted::new(&derived).expect("its blocks");
    assert!(blocks.is_closed());
    blocks
}

/// Size of a step or of a window, even in its logarithm.
fn size(random: &mut Random, least: f64, most: f64) -> f64 {
    random.between(least.ln(), most.ln()).exp()
}

#[test]
fn paths_proven_for_laws_are_smooth() {
    let mut random = Random::new(1966);
    let mut counts = [0; 3];
    for number in 0..150 {
        let (swing, pace) = (random.between(0.1, 3.0), random.between(0.5, 3.0));
        // With an output of single values, frames hold the direction of a link and not its angle.
        let output = ["", "\n    output P1;"][number % 2];
        let drive = format!("drive phi(crank) = {swing:.3}*sin({pace:.3}*t);{output}");
        let text = chain(&mut random, &drive);
        let blocks = blocks_of(&Source::new("chain.mech", &text));
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
    // Each outcome occurs, so that each is tested.
    assert!(counts.iter().all(|&count| count > 200), "{counts:?}");
}

#[test]
fn paths_proven_for_inputs_are_smooth() {
    let mut random = Random::new(1969);
    let mut counts = [0; 3];
    for _ in 0..100 {
        let text = chain(
            &mut random,
            "input turn = 0deg;\n    drive phi(crank) = turn;",
        );
        let blocks = blocks_of(&Source::new("chain.mech", &text));
        for _ in 0..24 {
            let (h, step) = (size(&mut random, 1e-3, 1.0), size(&mut random, 1e-4, 3.0));
            let first = random.between(-1.0, 1.0);
            let signal = |value: f64, random: &mut Random| {
                InputSignals(vec![Signal {
                    value,
                    rate: random.between(-2.0, 2.0) * step / h,
                    acceleration: random.between(-3.0, 3.0) * step / (h * h),
                }])
            };
            let both = [first, first + step].map(|value| signal(value, &mut random));
            match looked(&blocks, [0.0, h, 1.0], [&both[0], &both[1]]) {
                Outcome::NoFrames => {}
                Outcome::Vouched => counts[0] += 1,
                Outcome::Broken => counts[1] += 1,
                Outcome::Undecided => counts[2] += 1,
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 50), "{counts:?}");
}

#[test]
fn cylinders_are_vouched_for_as_far_as_they_reach() {
    // The arm of the excavator, also with its cylinders driven farther than its links reach, and with one that passes
    // beside its pin.
    let drawn = description::source("excavator").text;
    let beside = [
        ("point K =", "point T = (0.25, 0.75);\n    point K ="),
        ("facing N -> M { M }", "facing N -> T { M, T }"),
        ("facing N -> M { N }", "facing N -> T { N }"),
        ("along N -> M", "along N -> T"),
        (
            "length(N, M) = distance(N, M)",
            "length(N, T) = distance(N, T)",
        ),
    ];
    let beside = beside.iter().fold(drawn.clone(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    let mut counts = [0; 3];
    let mut random = Random::new(1970);
    let kinds = [&drawn, &beside].into_iter();
    for (text, stroke) in kinds.flat_map(|text| ["0.05", "0.2", "0.6"].map(|it| (text, it))) {
        let text = text.replace("0.05*sin", &format!("{stroke}*sin"));
        let blocks = blocks_of(&Source::new("excavator.mech", &text));
        let none = InputSignals::default();
        for _ in 0..150 {
            let (t, h) = (random.between(-3.0, 3.0), size(&mut random, 1e-4, 1.0));
            let stretch = size(&mut random, 2.0, 300.0);
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

#[test]
fn no_span_with_a_change_point_is_vouched_for() {
    // Crank and coupler are collinear at every half turn, although the links always reach.
    for name in ["parallelogram", "kite"] {
        let blocks = blocks_of(&description::source(name));
        let none = InputSignals::default();
        let mut random = Random::new(1971);
        let mut vouched = 0;
        for _ in 0..2000 {
            let (t, h) = (random.between(-4.0, 4.0), size(&mut random, 1e-5, 3.0));
            let stretch = size(&mut random, 2.0, 500.0);
            let settings = Settings::default();
            let Ok(shell) = assembled_with(blocks.clone(), &[], t - h, &none, settings) else {
                continue;
            };
            let (last, modes) = (shell.frame(), shell.branches().clone());
            let poses = Poses {
                blocks: &blocks,
                modes,
                settings,
            };
            let Some(at) = poses.at(t, last, &none) else {
                continue;
            };
            let conditions = poses.conditions(t, &none);
            let pair = Pair {
                at: &at,
                last,
                before: &none,
                conditions: &conditions,
            };
            for (span, ends) in [
                (TimeWindow::between(h), [t - h, t]),
                (
                    TimeWindow::around(h, stretch),
                    [t - h * stretch, t + h * stretch],
                ),
            ] {
                let turns = ends.map(|end| ((PI / 2.0 + end) / PI).floor());
                let is_vouched = blocks.verify_nonsingular(&pair, &span).is_ok();
                assert!(
                    !is_vouched || turns[0] == turns[1],
                    "{name}: t = {t}, h = {h}, {stretch} steps"
                );
                vouched += usize::from(is_vouched);
            }
        }
        assert!(vouched > 500, "{name}: {vouched}");
    }
}
