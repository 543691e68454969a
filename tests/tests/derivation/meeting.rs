//! Blocks whose two branches never meet for any drivers: by Grashof's inequalities, for cranks and for driven
//! lengths.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::assemblies;
use linkwright_codegen::{Options, generate, read};
use linkwright_tests::description;
use linkwright_tests::plan::solved;
use linkwright_tests::random::Random;

/// True if a block of a description may have branches that meet.
fn may_meet(text: &str) -> bool {
    let read = read(&Source::new("meeting.mech", text)).expect("no errors");
    let solved = solved(read.only().expect("one motion"));
    let program = solved.program();
    let apart = assemblies::never_meet(solved.pool(), solved.system(), program);
    let closes = |name: &str| name.starts_with("loop");
    let mut blocks = program.blocks.iter().zip(apart);
    blocks.any(|(block, apart)| closes(&block.name) && !apart)
}

/// A four-bar linkage with these lengths of ground, crank, coupler and rocker.
fn four_bar([ground, crank, coupler, rocker]: [f64; 4], given: &str, law: &str) -> String {
    // The crank is perpendicular to the ground, and coupler and rocker meet at their distance from both ends.
    let bridged = ground.hypot(crank);
    let along = (bridged * bridged + coupler * coupler - rocker * rocker) / (2.0 * bridged);
    let coupler_angle = (along / coupler).clamp(-1.0, 1.0).acos() - crank.atan2(ground);
    let [x, y] = [
        coupler * coupler_angle.cos(),
        crank + coupler * coupler_angle.sin(),
    ];
    let rocker_angle = y.atan2(x - ground);
    format!(
        "mechanism four_bar {{
            {given}
            point A = (0, 0), D = ({ground:?}, 0);
            body crank at (0, 0, 90deg) {{ A: (0, 0), B: ({crank:?}, 0) }}
            body coupler at (0, {crank:?}, {coupler_angle:?}) {{ B: (0, 0), C: ({coupler:?}, 0) }}
            body rocker at ({ground:?}, 0, {rocker_angle:?}) {{ D: (0, 0), C: ({rocker:?}, 0) }}
            revolute A(ground, crank);
            revolute B(crank, coupler);
            revolute C(coupler, rocker);
            revolute D(ground, rocker);
            drive phi(crank) = {law};
        }}"
    )
}

#[test]
fn modes_of_four_bar_linkages_stay_apart_where_the_crank_turns_all_round() {
    let mut random = Random::new(5);
    let mut proven = 0;
    for _ in 0..200 {
        let lengths: [f64; 4] = std::array::from_fn(|_| random.between(0.1, 1.0));
        let [ground, crank, coupler, rocker] = lengths;
        let bridged = ground.hypot(crank);
        if bridged > coupler + rocker || bridged < (coupler - rocker).abs() {
            continue;
        }
        // Distance of the bridged length from that at which both links are collinear.
        let folded = (ground - crank).abs() - (coupler - rocker).abs();
        let stretched = coupler + rocker - (ground + crank);
        let may_meet = may_meet(&four_bar(lengths, "", "pi/2 + 3*t"));
        assert!(
            may_meet || folded.min(stretched) > 0.0,
            "{lengths:?} are in line somewhere"
        );
        if folded.min(stretched) > 0.02 {
            assert!(!may_meet, "{lengths:?} are never in line");
            proven += 1;
        }
    }
    assert!(proven >= 10, "{proven} of 200");
}

#[test]
fn a_crank_may_be_given_and_lengths_may_not() {
    let lengths = [1.0, 0.4, 1.2, 0.8];
    assert!(!may_meet(&four_bar(lengths, "", "pi/2 + sin(t)")));
    assert!(!may_meet(&four_bar(
        lengths,
        "input turned = 90deg;",
        "turned"
    )));
    let text = four_bar(lengths, "param throw = 0.4;", "pi/2 + t");
    assert!(may_meet(&text.replace("B: (0.4, 0)", "B: (throw, 0)")));
}

/// A crank that is geared to a driven wheel turns by any angle, however small the range of the wheel.
#[test]
fn geared_cranks_are_looked_at_all_round() {
    let geared = |lengths, ratio: &str| {
        let text = four_bar(lengths, "", "pi/2 + t");
        let wheel = format!(
            "body wheel at (-1, 0, 0) {{ O: (0, 0) }}
            point O = (-1, 0);
            revolute O(ground, wheel);
            external_gear (wheel, crank) = {ratio};
            drive phi(wheel) = t;"
        );
        text.replace("drive phi(crank) = pi/2 + t;", &wheel)
    };
    for ratio in ["1/7", "1", "7/2"] {
        assert!(!may_meet(&geared([1.0, 0.4, 1.2, 0.8], ratio)), "{ratio}");
        // Collinear only if the crank points away from the other pin, unlike in the design configuration.
        assert!(may_meet(&geared([1.0, 0.4, 0.7, 0.7], ratio)), "{ratio}");
    }
}

#[test]
fn driven_lengths_are_bounded_by_their_laws() {
    let hoist = |law: &str| {
        format!(
            "mechanism hoist {{
                point A = (0, 0), C = (0.9, 0);
                body arm at (0, 0, 80deg) {{ A: (0, 0), B: (0.5, 0) }}
                revolute A(ground, arm);
                drive distance(arm.B, ground.C) = {law};
            }}"
        )
    };
    // Both ends are 0.4 to 1.4 m apart.
    assert!(!may_meet(&hoist("0.9 + 0.4*sin(t)")));
    assert!(may_meet(&hoist("0.9 + 0.6*sin(t)")));
    assert!(may_meet(&hoist("0.9 + 0.1*t")));
}

/// If branches never meet, no block of a program has a crossing.
#[test]
fn branches_that_never_meet_are_not_exchanged() {
    let exchanges = |name: &str| {
        let source = description::source(name);
        let generated = generate(&source, &Options::default())
            .unwrap_or_else(|found| panic!("{}", found.render(&source)));
        generated.code().contains(", block ")
    };
    for name in ["four_bar", "slider_crank", "two_body"] {
        assert!(!exchanges(name), "{name}");
    }
    for name in ["parallelogram", "kite"] {
        assert!(exchanges(name), "{name}");
    }
}
