//! Loops that do not reach and loads that are not finite, by their names and figures.

use crate::folder::Folder;

/// End of a motion according to an error (s).
fn end_of(error: &str) -> f64 {
    let time = error.split(" beyond t = ").nth(1);
    let time = time.and_then(|rest| rest.split(' ').next()?.parse().ok());
    time.unwrap_or_else(|| panic!("{error}"))
}

/// Two four-bars in a row, with coupler lengths that are parameters; pins of the second one have names of their bodies alone.
const ROW: &str = "mechanism row {
    param first = 0.35;
    param second = 0.3;
    point A = (0, 0), D = (0.4, 0), G = (0.8, 0);
    body crank at A { A, B: (0.1, 0) }
    body rod at (0.1, 0, 30deg) { B: (0, 0), C: (first, 0) }
    body rock at D turned 90deg { D, C: (0.2, 0), E: (0.25, 0) }
    body link at (0.4, 0.25) { o: (0, 0), h: (second, 0) }
    body lever at G turned 100deg { G, F: (0.25, 0) }
    revolute A(ground, crank);
    revolute B(crank, rod);
    revolute C(rod, rock);
    revolute D(ground, rock);
    revolute (rock.E, link.o);
    revolute (link.h, lever.F);
    revolute G(ground, lever);
    drive phi(crank) = 0.3*t;
}
";

/// Distance from the end of the crank to D, the ends of the first coupler and its rocker.
fn first_base(t: f64) -> f64 {
    let (sine, cosine) = (0.3 * t).sin_cos();
    (0.4 - 0.1 * cosine).hypot(0.1 * sine)
}

/// Distance from E on the first rocker to G, with C to the left of the line from B to D.
fn second_base(t: f64, first: f64) -> f64 {
    let (sine, cosine) = (0.3 * t).sin_cos();
    let (x, y) = (0.4 - 0.1 * cosine, -0.1 * sine);
    let base = first_base(t);
    // The angle at D between the rocker, of length 0.2, and the line from D to B.
    let inner = ((0.04 + base * base - first * first) / (0.4 * base)).acos();
    let angle = (-y).atan2(-x) - inner;
    (0.4 - 0.25 * angle.cos()).hypot(0.25 * angle.sin())
}

/// The loop that does not reach is named by its pins, and the gap is that of its triangle, whichever loop of the row it is.
#[test]
fn the_loop_that_does_not_reach_is_named() {
    let folder = Folder::new("reach_row", ROW);
    let message_with = |options: &str| {
        let ran = folder.run(&format!(
            "solve a.mech --no-files --to 20 --step 0.5 {options}"
        ));
        ran.exits_with(1).stderr
    };
    // At the start: the gap of the first, of the second, and of the first where both are open.
    let first = format!(
        "loop B-C-D: out of reach by {:.4} m",
        first_base(0.0) - 0.25
    );
    let gap = second_base(0.0, 0.35) - 0.3;
    let second = format!("out of reach by {gap:.3} m, beyond where link and lever are collinear");
    for (options, loop_said) in [
        ("--set first=0.05", &first),
        ("--set second=0.05", &second),
        ("--set first=0.05 --set second=0.05", &first),
    ] {
        let message = message_with(options);
        assert!(message.contains(loop_said), "{loop_said}: {message}");
        assert_eq!(message.matches("loop ").count(), 1, "{message}");
    }
    // In motion the second loop opens between two frames: where its triangle is flat.
    let message = message_with("--set second=0.72");
    assert!(
        message.contains("loop E-h-G: out of reach by "),
        "{message}"
    );
    let time = end_of(&message);
    let flat = |t: f64| 0.72 - 0.25 - second_base(t, 0.35);
    assert!(flat(time - 1e-6) * flat(time + 1e-6) < 0.0, "{message}");
}

/// Joints that only follow from a loop, such as the pin of a coupler point with the next body, do not occur in its
/// name.
#[test]
fn a_loop_is_not_named_by_what_follows_from_it() {
    let text = "mechanism mixed {
    point A = (0, 0);
    body crank at A { A, B: (0.1, 0) }
    body rod at (0.1, 0, 30deg) { B: (0, 0), C: (0.15, 0) }
    body slider at (0.4, 0.1) { C: (0, 0), E: (0, 0.1) }
    body flag at (0.4, 0.2) { E: (0, 0) }
    revolute A(ground, crank);
    revolute B(crank, rod);
    revolute C(rod, slider);
    absolute_y(slider) = 0.1;
    absolute_angle(slider) = 0;
    revolute E(slider, flag);
    absolute_angle(flag) = 0;
    drive phi(crank) = 0.3*t;
}
";
    // The slider is 0.1 m above the axis, and the rod reaches it until its pin is 0.05 m below.
    let folder = Folder::new("reach_following", text);
    let ran = folder
        .run("solve a.mech --no-files --to 20 --step 0.5")
        .exits_with(1);
    assert!(
        ran.stderr
            .contains("s: revolute C(rod, slider): out of reach"),
        "{}",
        ran.stderr
    );
    let ended = (std::f64::consts::PI + 0.5_f64.asin()) / 0.3;
    let time = end_of(&ran.stderr);
    assert!((time - ended).abs() < 1e-8, "{}", ran.stderr);
}

/// A force that becomes infinite is named with its time; the joints are sound.
#[test]
fn a_force_that_is_not_finite_is_named() {
    let text = "mechanism endless {
    point O = (0, 0);
    body crank at O { O, P: (0.2, 0) }
    revolute O(ground, crank);
    drive turn: phi(crank) = 2*t;
    mass crank = 1kg at P;
    force on crank.P = (0, 1N);
    force on crank.P = (0, 3*(t - 0.5)^(-1));
    torque on crank = 1;
    effort;
}
";
    let folder = Folder::new("endless", text);
    let ran = folder
        .run("solve a.mech --to 1 --step 0.25 --no-files")
        .exits_with(1);
    let expected = "cannot be solved beyond t = 0.5 s: `force on crank.P` is not finite there";
    assert!(ran.stderr.contains(expected), "{}", ran.stderr);
    assert!(!ran.stderr.contains("revolute"), "{}", ran.stderr);
    // The textbook formulation has a pose there, but not forces.
    let ran = folder
        .run("solve a.mech --to 1 --step 0.25 --no-files --formulation textbook")
        .exits_with(1);
    let expected = "has no forces at t = 0.5 s: `force on crank.P` is not finite there";
    assert!(ran.stderr.contains(expected), "{}", ran.stderr);
    let moved = text.replace("drive turn: phi(crank) = 2*t", "free turn: phi(crank) = 0");
    let folder = Folder::new("endless_moved", moved);
    let ran = folder
        .run("simulate a.mech --to 1 --step 0.25 --no-files")
        .exits_with(1);
    let expected = "beyond t = 0.5 s: `force on crank.P` grows without bound toward t = 0.5 s";
    assert!(ran.stderr.contains(expected), "{}", ran.stderr);
    assert!(!ran.stderr.contains("revolute"), "{}", ran.stderr);
    // If the torque is infinite instead, it is named.
    let turned = text.replace("torque on crank = 1;", "torque on crank = (t - 0.25)^(-1);");
    let folder = Folder::new("endless_torque", turned);
    let ran = folder
        .run("solve a.mech --to 1 --step 0.25 --no-files")
        .exits_with(1);
    let expected = "beyond t = 0.25 s: `torque on crank` is not finite there";
    assert!(ran.stderr.contains(expected), "{}", ran.stderr);
}

/// Point of two circles, each by its center and radius, that is nearer to a position.
fn meeting([a, b]: [([f64; 2], f64); 2], near: [f64; 2]) -> [f64; 2] {
    let gap = [b.0[0] - a.0[0], b.0[1] - a.0[1]];
    let base = gap[0].hypot(gap[1]);
    let along = (base * base + a.1 * a.1 - b.1 * b.1) / (2.0 * base);
    let across = (a.1 * a.1 - along * along).sqrt();
    let [x, y] = gap.map(|it| it / base);
    let points = [across, -across].map(|across| {
        [
            a.0[0] + along * x - across * y,
            a.0[1] + along * y + across * x,
        ]
    });
    let distance = |point: &[f64; 2]| (point[0] - near[0]).hypot(point[1] - near[1]);
    let [one, other] = points;
    if distance(&one) < distance(&other) {
        one
    } else {
        other
    }
}

/// Of three loops in a row the one that does not reach is named: a triangle by its pins, a rod with a slide by its joint.
#[test]
fn the_third_of_three_loops_is_named_by_its_joint() {
    let more = "
    param third = 0.4;
    body pusher at (0.8, 0.25) { F: (0, 0), S: (third, 0) }
    body block at (1.1, 0) { S: (0, 0) }
    revolute F(lever, pusher);
    revolute S(pusher, block);
    absolute_y(block) = 0;
    absolute_angle(block) = 0;
    drive";
    let text = ROW.replace("\n    drive", more);
    let folder = Folder::new("reach_three", text);
    let message_with = |options: &str| {
        let ran = folder.run(&format!("solve a.mech --no-files --to 0 {options}"));
        ran.exits_with(1).stderr
    };
    let c = meeting([([0.1, 0.0], 0.35), ([0.4, 0.0], 0.2)], [0.4, 0.2]);
    let e = [0.4 + (c[0] - 0.4) * 1.25, c[1] * 1.25];
    let f = meeting([(e, 0.3), ([0.8, 0.0], 0.25)], [0.757, 0.246]);
    let third = format!(
        "revolute S(pusher, block): out of reach by {:.4} m",
        f[1] - 0.2
    );
    assert!(
        message_with("--set third=0.2").contains(&third),
        "{third}: {}",
        message_with("--set third=0.2")
    );
    let second = message_with("--set third=0.2 --set second=0.05");
    assert!(
        second.contains("s: loop E-h-G: out of reach by "),
        "{second}"
    );
    let first = message_with("--set third=0.2 --set second=0.05 --set first=0.05");
    assert!(
        first.contains("s: loop B-C-D: out of reach by 0.0500 m"),
        "{first}"
    );
}

/// Four-bar whose coupler and rocker reach as far as |BD| = 1.9.
const REACHING: &str = "mechanism reaching {
    point A = (0, 0), D = (1.5, 0);
    body crank   at (0, 0, 40deg)      { A: (0, 0), B: (1, 0) }
    body coupler at (0.77, 0.64, 0deg) { B: (0, 0), C: (1, 0) }
    body rocker  at (1.5, 0, 70deg)    { D: (0, 0), C: (0.9, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = 0.7 + t;
";

/// A message says that generated code goes on if only a loop that no output needs is out of reach.
#[test]
fn a_loop_that_no_output_needs_does_not_end_generated_code() {
    let goes_on = "; generated code, which computes its outputs alone, goes on";
    let cases = [("", ""), ("output position C;", ""), ("output B;", goes_on)];
    for (output, addition) in cases {
        let folder = Folder::new("reach_outputs", format!("{REACHING}{output}\n}}\n"));
        let ran = folder.run("solve a.mech --no-files --to 2");
        let error = ran.exits_with(1).stderr;
        // By the law of cosines: |BD|² = 1 + 1.5² − 3 cos φ.
        let limit = (-0.12_f64).acos() - 0.7;
        assert!((end_of(&error) - limit).abs() < 1e-8, "{error}");
        let ending = format!("coupler and rocker are collinear{addition}\n");
        assert!(error.contains(&ending), "{error}");
    }
}
