//! Andrews' mechanism has the multipliers that are published.

use linkwright_mechanisms::andrews;
use linkwright_tests::description;

use super::{close, followed};

/// The published multipliers and torque, of which all digits are right (30 of them at t = 0).
#[test]
fn andrews_mechanism_has_its_published_multipliers_at_rest() {
    let mechanism = andrews::Andrews::assemble(0.0).expect("as drawn");
    let frame = mechanism.frame();
    let [x, y] = frame.reaction_e();
    let published = [98.566_870_396_241_1, -6.122_688_344_255_66];
    assert!((frame.effort_motor() - 0.033).abs() <= 1e-13 * 0.033 * 10.0);
    assert!((x - published[0]).abs() <= 1e-13 * published[0]);
    assert!((y - published[1]).abs() <= 1e-13 * published[0]);
    for [x, y] in [frame.reaction_e_2(), frame.reaction_e_3()] {
        assert!(x.hypot(y) <= 1e-13 * published[0]);
    }
    assert!(frame.kinetic_energy().abs() <= f64::MIN_POSITIVE);
}

/// Another text of the mechanism: drawn where it is after 0.03 s, and driven as it moves there.
#[test]
fn andrews_mechanism_has_its_multipliers_in_motion() {
    let q = [
        ("beta", 15.810_771_195_153_707),
        ("theta", -15.756_370_558_411_84),
        ("gamma", 0.040_822_240_119_645_85),
        ("phi", -0.534_730_116_342_079_6),
        ("delta", 0.524_409_965_879_954_1),
        ("omega", 0.534_730_116_342_079_6),
        ("epsilon", 1.048_080_741_041_938),
    ];
    let mut text = description::source("andrews").text;
    for (name, value) in q {
        let start = text.find(&format!("const {name} = ")).expect("the angle");
        let end = start + text[start..].find(';').expect("its end");
        text.replace_range(start..end, &format!("const {name} = {value}"));
    }
    let start = text.find("drive motor").expect("the driver");
    let end = start + text[start..].find(';').expect("its end");
    let law = "drive motor: phi(k1) = beta + 1139.92030225910606*t - 24631.7631228746345*t^2/2";
    text.replace_range(start..end, law);
    let andrews = followed(&text);
    // Relative to 128-bit references; the pose is rounded, and rates of 1e3 rad/s and spins of 5e5 rad/s² magnify that.
    let rates = andrews.instant().qd();
    let rate = |body: usize| rates[3 * body + 2];
    close(rate(2), 11.032_911_910_618_594, 1e-11, "the rate of gamma");
    close(rate(4), 0.573_569_914_829_502_5, 1e-10, "the rate of delta");
    close(
        rate(6),
        0.323_179_149_249_130_9,
        1e-10,
        "the rate of epsilon",
    );
    close(andrews.value("effort_motor"), 0.033, 1e-9, "the torque");
    let multipliers = [
        ("reaction_e_x", 199.175_348_104_538_63),
        ("reaction_e_y", -29.755_309_974_971_763),
        ("reaction_e_2_x", 23.066_543_611_622_15),
        ("reaction_e_2_y", 31.452_725_275_771_07),
        ("reaction_e_3_x", 22.642_494_786_394_29),
        ("reaction_e_3_y", 11.617_392_352_611_256),
    ];
    for (name, published) in multipliers {
        close(andrews.value(name), published, 1e-10, name);
    }
}
