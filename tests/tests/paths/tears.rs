//! Blocks without a closed form, solved by tearing: the motion is the known one, or that of all equations at once,
//! also if the explicit system is singular and the block is not.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use linkwright::generated::torn;
use linkwright::{Frame, Settings, Shell};
use linkwright_codegen::stages::program::{EVALUATIONS, STEPS};
use linkwright_solver::assemblies::assemblies;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{Assemblies, Interpreted, View};
use linkwright_tests::description::written;
use linkwright_tests::pantograph::{OPENING, Pantograph, SWING};
use linkwright_tests::values::assembled_from;

fn methods(solved: &Interpreted) -> Vec<String> {
    let forms = solved.program().forms.iter().flatten();
    forms.map(|form| form.name()).collect()
}

/// Three legs between these pins on the ground and those of a platform. The lengths of the legs are those of a known
/// motion: x = 0.7 + 0.2 sin t, y = 1.1 + 0.1 sin 1.3 t, φ = a sin(t − b).
fn platform(base: [[f64; 2]; 3], pins: [[f64; 2]; 3], [a, b]: [f64; 2]) -> String {
    let mut text = String::from("mechanism platform {\n");
    for (name, [x, y]) in ["A", "B", "C"].iter().zip(base) {
        writeln!(text, "point {name} = ({x}, {y});").expect("room");
    }
    let marks = ["P", "Q", "R"].iter().zip(pins);
    let marks: Vec<String> = marks
        .map(|(name, [x, y])| format!("{name}: ({x}, {y})"))
        .collect();
    let turned = a * (-b).sin();
    let marks = marks.join(", ");
    writeln!(text, "body platform at (0.7, 1.1, {turned}) {{ {marks} }}").expect("room");
    let (sine, cosine) = (
        format!("sin({a}*sin(t - {b}))"),
        format!("cos({a}*sin(t - {b}))"),
    );
    for (place, ([bx, by], [sx, sy])) in base.into_iter().zip(pins).enumerate() {
        let (ground, pin) = (["A", "B", "C"][place], ["P", "Q", "R"][place]);
        writeln!(
            text,
            "drive distance(ground.{ground}, platform.{pin}) = \
             sqrt((0.7 + 0.2*sin(t) + ({sx})*{cosine} - ({sy})*{sine} - ({bx}))^2 \
             + (1.1 + 0.1*sin(1.3*t) + ({sx})*{sine} + ({sy})*{cosine} - ({by}))^2);"
        )
        .expect("room");
    }
    text + "}\n"
}

/// Largest errors of the platform's x, y and φ, of their rates and of their accelerations.
fn errors(text: &str, [a, b]: [f64; 2]) -> [f64; 3] {
    let solved = Interpreted::new(&written(text)).expect("a plan");
    assert_eq!(methods(&solved), ["Newton of size 1 for 4 unknowns"]);
    let laws = solved.input_laws();
    let mut shell = assembled_from(solved, &[], 0.0, Settings::default()).expect("as drawn");
    let mut worst = [0.0_f64; 3];
    for step in 1..=5000 {
        let t = 0.002 * f64::from(step);
        let moved = shell.advance(t, &laws.at(t)).expect("a regular pose");
        let frame = moved.frame();
        let exact = [
            [
                0.7 + 0.2 * t.sin(),
                1.1 + 0.1 * (1.3 * t).sin(),
                a * (t - b).sin(),
            ],
            [0.2 * t.cos(), 0.13 * (1.3 * t).cos(), a * (t - b).cos()],
            [-0.2 * t.sin(), -0.169 * (1.3 * t).sin(), -a * (t - b).sin()],
        ];
        let moved = [&frame.q, &frame.qd, &frame.qdd];
        for (worst, (moved, exact)) in worst.iter_mut().zip(moved.into_iter().zip(exact)) {
            for (moved, exact) in moved.iter().zip(exact) {
                *worst = worst.max((moved - exact).abs());
            }
        }
    }
    worst
}

/// With φ = 0 the two linear equations for the platform's position coincide, although its legs constrain it.
#[test]
fn a_platform_moves_through_poses_at_which_its_linear_equations_vanish() {
    let base = [[0.0, 0.0], [1.5, 0.3], [1.8, 0.8]];
    let pins = [[0.0, 0.0], [0.5, 0.3], [-0.2, 0.8]];
    for law in [[0.3, 0.5], [0.3, 1.5]] {
        let worst = errors(&platform(base, pins, law), law);
        println!("{law:?}: {worst:?}");
        assert!(worst.iter().all(|&it| it < 5e-14), "{law:?}: {worst:?}");
    }
    let elsewhere = [[0.0, 0.0], [1.6, -0.4], [0.4, 2.3]];
    let worst = errors(&platform(elsewhere, pins, [0.5, 1.0]), [0.5, 1.0]);
    assert!(worst.iter().all(|&it| it < 2e-13), "{worst:?}");
}

/// Largest difference from all textbook equations at once, relative to the largest value of each level (or 1).
fn difference(text: &str, frames: u32) -> [f64; 3] {
    let derived = written(text);
    let textbook = TextbookEquations::new(&derived.pool, &derived.system);
    let solved = Interpreted::new(&derived).expect("a plan");
    let (laws, settings) = (solved.input_laws(), Settings::default());
    let mut shell: Shell<Interpreted> =
        assembled_from(solved, &[], 0.0, settings).expect("as drawn");
    let mut frame =
        Frame::assemble(&textbook, &shell.frame().frame().q, 0.0, &settings).expect("a pose");
    let branch = Frame::branch_of(&textbook, &frame.q, 0.0, &settings).expect("a regular pose");
    let mut worst = [0.0_f64; 3];
    for step in 1..=frames {
        let t = 0.01 * f64::from(step);
        let torn = shell
            .advance(t, &laws.at(t))
            .expect("a regular pose")
            .frame();
        frame = frame
            .follow(&textbook, branch, t, &settings)
            .expect("a regular pose");
        let levels = [
            (&frame.q, &torn.q),
            (&frame.qd, &torn.qd),
            (&frame.qdd, &torn.qdd),
        ];
        for (worst, (one, other)) in worst.iter_mut().zip(levels) {
            *worst = worst.max((one - other).amax() / one.amax().max(1.0));
        }
    }
    worst
}

const BUTTERFLY: &str = "mechanism butterfly {
    point A = (0, 0), B = (6.17, 0), C = (-0.21, 1.94), D = (1.4, 0.48), E = (2.69, 3.37);
    point F = (5.84, 3.17), G = (5.37, 1.82), H = (3.63, 1.03), I = (4.67, -1.09), J = (4.13, 2.05);
    body acd at A { A, C, D }
    body ce at C { C, E }
    body efg at E { E, F, G }
    body bfj at B { B, F, J }
    body dhi at D { D, H, I }
    body gh at G { G, H }
    body ij at I { I, J }
    revolute A(ground, acd);
    revolute B(ground, bfj);
    revolute C(acd, ce);
    revolute D(acd, dhi);
    revolute E(ce, efg);
    revolute F(efg, bfj);
    revolute G(efg, gh);
    revolute H(dhi, gh);
    revolute I(dhi, ij);
    revolute J(bfj, ij);
    drive phi(acd) = 0.1*sin(t);
}";

#[test]
fn the_double_butterfly_needs_one_guess() {
    let solved = Interpreted::new(&written(BUTTERFLY)).expect("a plan");
    assert_eq!(methods(&solved), ["Newton of size 1 for 6 unknowns"]);
    let worst = difference(BUTTERFLY, 100);
    assert!(worst.iter().all(|&it| it < 1e-13), "{worst:?}");
}

#[test]
fn chains_that_are_driven_at_their_end_are_as_accurate_as_all_equations_at_once() {
    for (cells, growth) in [(6, 1.0), (6, 0.8), (6, 1.4), (24, 1.0)] {
        let text = Pantograph::new(cells, growth).text("");
        let solved = Interpreted::new(&written(&text)).expect("a plan");
        // The difference of both drivers turns one bar.
        let rest = format!("Newton of size 1 for {} unknowns", 2 * cells - 1);
        assert_eq!(methods(&solved), ["one angle", &rest]);
        let worst = difference(&text, 50);
        println!("{cells} cells, {growth}: {worst:?}");
        assert!(worst.iter().all(|&it| it < 1e-11), "{growth}: {worst:?}");
    }
}

/// In another order of bodies and joints the remaining loops are long, and have to be shortened.
#[test]
fn chains_are_torn_in_whatever_order_they_are_written() {
    let text = Pantograph::new(10, 0.875).text("");
    let kinds = [" body", " revolute"];
    let all = kinds.map(|kind| -> Vec<&str> {
        let lines = text.lines();
        lines.filter(|line| line.starts_with(kind)).collect()
    });
    // Coprime to the numbers of bodies and joints.
    for step in [1, 3, 7, 11, 17, 19] {
        let mut places = [0; 2];
        let lines = text.lines().map(|line| {
            let Some(kind) = kinds.iter().position(|kind| line.starts_with(kind)) else {
                return line;
            };
            places[kind] += step;
            all[kind][places[kind] % all[kind].len()]
        });
        let text: Vec<&str> = lines.collect();
        let text = text.join("\n");
        let solved = Interpreted::new(&written(&text)).expect("a plan");
        let methods = methods(&solved);
        let [first, rest] = &methods[..] else {
            panic!("{methods:?}");
        };
        assert_eq!(first, "one angle");
        assert!(rest.ends_with("for 19 unknowns"), "{rest}");
        let worst = difference(&text, 50);
        println!("{step}: {rest}, {worst:?}");
        assert!(worst.iter().all(|&it| it < 1e-11), "{step}: {worst:?}");
    }
}

/// Half bars of a cell are equal, so that all bars of a family are parallel, and the driver of the last cell gives
/// both angles. Without iterations and substeps, only tearing yields a frame, and the path is proven from frame to
/// frame.
#[test]
fn long_chains_do_without_all_equations_at_once() {
    for (cells, length, statements) in [(60, 0.1, ""), (120, 0.1, ""), (120, 0.01, "unguarded;")] {
        let chain = Pantograph::new(cells, 1.0);
        let text = chain.text(statements);
        let solved = Interpreted::new(&written(&text)).expect("a plan");
        let laws = solved.input_laws();
        let settings = Settings {
            iterations: 0,
            substeps: 1,
            ..Settings::default()
        };
        let mut shell = assembled_from(solved, &[], 0.0, settings).expect("as drawn");
        let mut worst = 0.0_f64;
        for step in 1..=30 {
            let t = length * f64::from(step);
            let moved = shell.advance(t, &laws.at(t)).expect("a regular pose");
            let moved = moved.frame();
            // Half of one bar and pairs of both families give x(M); v(B) lies half a bar beyond.
            let half = chain.halves[0];
            let width = chain.end - chain.middle + OPENING * (2.0 * t).sin();
            let pairs = (cells - 1) as f64;
            let whole = chain.middle + SWING * t.sin() - pairs * width;
            let known = [
                (whole / (half + pairs * half)).acos(),
                -(width / half).acos(),
            ];
            let bodies = moved.q.as_slice().chunks_exact(3).enumerate();
            worst = bodies.fold(worst, |worst, (body, place)| {
                worst.max((place[2] - known[body % 2]).abs())
            });
        }
        println!("{cells} cells: {worst:e}");
        assert!(worst < 2e-13, "{cells} cells: {worst:e}");
    }
}

/// The report's limit on evaluations is that of the runtime.
#[test]
fn reports_count_as_the_runtime_does() {
    assert_eq!(EVALUATIONS, torn::EVALUATIONS);
    assert_eq!(STEPS, usize::from(Settings::<f64>::default().iterations));
}

/// Values of a coordinate in all assemblies, ascending; angles lie within half a turn of zero.
fn values(all: &Assemblies, coordinate: usize) -> Vec<f64> {
    let coordinates = all.found.iter().map(|it| it.instant.q()[coordinate]);
    let mut values: Vec<f64> = coordinates
        .map(|it| it - TAU * (it / TAU).round())
        .collect();
    values.sort_by(f64::total_cmp);
    values
}

fn are_near(found: &[f64], known: &[f64]) -> bool {
    let both = found.iter().zip(known);
    found.len() == known.len()
        && both
            .into_iter()
            .all(|(one, other)| (one - other).abs() < 1e-12)
}

/// Poses that satisfy the equations to 3e-49; at most six exist (Gosselin and Sefrioui 1991).
#[test]
fn all_six_assemblies_of_a_platform_are_found_and_proven_to_be_all() {
    let text = "mechanism six {
        point A = (-0.35, 0.35), B = (0.14, 0.15), C = (-0.99, -0.85);
        body platform at (0.25490278778833248, 0.76949078446582015, -2.358515217542195) {
            P: (0.6, 0.6), Q: (-0.78, -0.77), R: (0.36, 0.74)
        }
        drive distance(ground.A, platform.P) = 0.74;
        drive distance(ground.B, platform.Q) = 1.72;
        drive distance(ground.C, platform.R) = 1.73;
    }";
    let all = assemblies(&Interpreted::new(&written(text)).expect("a plan"), 0.0);
    assert!(all.proven && all.undecided.is_empty());
    let known: [(usize, [f64; 6]); 3] = [
        (
            0,
            [
                -0.959_392_594_586_477_6,
                -0.413_574_419_606_397_7,
                -0.404_857_785_911_819_5,
                0.248_050_945_015_301_65,
                0.254_902_787_788_332_5,
                0.860_985_291_694_353_1,
            ],
        ),
        (
            1,
            [
                -0.142_211_391_163_463_9,
                0.023_775_074_797_310_785,
                0.067_208_068_612_647_78,
                0.461_155_971_865_945_55,
                0.769_490_784_465_820_2,
                1.203_950_730_100_441_7,
            ],
        ),
        (
            2,
            [
                -2.358_515_217_542_195,
                -1.430_003_692_123_384_5,
                -0.393_551_074_410_366_96,
                0.641_003_085_193_397_3,
                1.483_701_918_930_377_8,
                2.537_254_498_814_142,
            ],
        ),
    ];
    for (coordinate, known) in known {
        let computed = values(&all, coordinate);
        assert!(are_near(&computed, &known), "{coordinate}: {computed:?}");
    }
}

/// Sixteen complex solutions were found from 60,000 starts, eight of them real.
#[test]
fn all_eight_assemblies_of_the_double_butterfly_are_found_and_proven_to_be_all() {
    let all = assemblies(&Interpreted::new(&written(BUTTERFLY)).expect("a plan"), 0.0);
    assert!(all.proven && all.undecided.is_empty());
    let known = [
        -1.876_897_840_511_715,
        -1.586_790_534_670_632,
        -0.844_665_431_213_196,
        -0.132_215_929_979_034,
        0.0,
        0.145_862_654_494_25,
        0.454_975_827_511_359,
        0.469_997_567_774_262,
    ];
    let computed = values(&all, 5);
    assert!(are_near(&computed, &known), "{computed:?}");
}
