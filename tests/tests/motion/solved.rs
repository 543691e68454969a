//! The solved formulation satisfies the textbook formulation, keeps its branch, and reports the missing length if it
//! cannot be assembled.

use linkwright::nalgebra::{SMatrix, SVector};
use linkwright::{Branch, FailureKind};
use linkwright_mechanisms::{
    arm, excavator, excavator_pins, excavator_tool, four_bar, inverted_slider_crank, platform_3rpr,
    scissor, slider_crank, stephenson, two_body,
};
use linkwright_tests::single;

mod asked {
    linkwright::include_mechanism!(asked);
}

mod folding {
    linkwright::include_mechanism!(folding);
}

mod turning_guide {
    linkwright::include_mechanism!(turning_guide);
}

mod two_guides {
    linkwright::include_mechanism!(two_guides);
}

mod leveled_slider {
    linkwright::include_mechanism!(leveled_slider);
}

/// Sum Σ|a_ij x_j|: scale for the rounding of a product.
fn product_scale<const N: usize>(
    matrix: &SMatrix<f64, N, N>,
    x: &SVector<f64, N>,
) -> SVector<f64, N> {
    matrix.map(f64::abs) * x.map(f64::abs)
}

/// Largest |value| / scale; rows without any scale must be zero.
fn largest<const N: usize>(values: &SVector<f64, N>, scales: &SVector<f64, N>) -> f64 {
    values
        .iter()
        .zip(scales)
        .fold(0.0, |largest, (value, scale)| {
            assert!(
                *scale > 0.0 || *value == 0.0,
                "{value} in a row without terms"
            );
            if *scale > 0.0 {
                f64::max(largest, value.abs() / scale)
            } else {
                largest
            }
        })
}

/// Residuals of the solved formulation in Φ, Φ_q q̇ + Φ_t and Φ_q q̈ − γ over the whole motion, relative to the
/// terms.
macro_rules! defects {
    ($module:ident, $mechanism:ident) => {{
        let mut defects = [0.0_f64; 3];
        let mut mechanism = $module::$mechanism::assemble(0.0).expect("the drawing assembles");
        for step in 0..=500 {
            let frame = *mechanism.advance(f64::from(step) / 100.0).expect("the motion can be followed");
            let (q, t) = (frame.q, frame.t);
            let phi_q = $module::phi_q(&q, t);
            let [qv, qd, qdd] = [frame.q, frame.qd, frame.qdd].map(|values| SVector::from(values.to_array()));
            let phi_t = $module::phi_t(&q, t);
            let gamma = $module::gamma(&q, &frame.qd, t);
            // A row of Φ consists of the coordinates and of rotated vectors of the size of the mechanism.
            let size = qv.map(f64::abs).max().max(1.0);
            let phi = $module::phi(&q, t);
            defects[0] = defects[0].max(largest(&phi, &SVector::repeat(size)));
            let velocity = phi_q * qd + phi_t;
            defects[1] = defects[1].max(largest(&velocity, &(product_scale(&phi_q, &qd) + phi_t.map(f64::abs))));
            let acceleration = phi_q * qdd - gamma;
            let scale = product_scale(&phi_q, &qdd) + gamma.map(f64::abs);
            // If a row's accelerations happen to vanish, the squares of its rates were its terms.
            let floor = qd.map(|rate| rate * rate).max().max(qdd.map(f64::abs).max());
            let scale = scale.zip_map(&acceleration, |scale, value| if value == 0.0 { scale } else { scale.max(floor) });
            defects[2] = defects[2].max(largest(&acceleration, &scale));
        }
        println!("{:<24} {:.1e} {:.1e} {:.1e}", stringify!($module), defects[0], defects[1], defects[2]);
        for defect in defects {
            assert!(defect < 1e-13, "{}: {defects:?}", stringify!($module));
        }
    }};
}

#[test]
fn every_motion_satisfies_the_textbook_equations() {
    defects!(two_body, TwoBody);
    defects!(excavator, Excavator);
    defects!(excavator_pins, ExcavatorPins);
    defects!(arm, Arm);
    defects!(four_bar, FourBar);
    defects!(slider_crank, SliderCrank);
    defects!(inverted_slider_crank, InvertedSliderCrank);
    defects!(scissor, Scissor);
    defects!(platform_3rpr, Platform3rpr);
    defects!(stephenson, Stephenson);
    defects!(turning_guide, TurningGuide);
    defects!(two_guides, TwoGuides);
    defects!(leveled_slider, LeveledSlider);
}

#[test]
fn limited_outputs_equal_those_of_the_whole() {
    let mut whole = excavator::Excavator::assemble(0.0).expect("the drawing assembles");
    let mut tool = excavator_tool::ExcavatorTool::assemble(0.0).expect("the drawing assembles");
    for step in 0..=500 {
        let t = f64::from(step) / 100.0;
        let expected = whole
            .advance(t)
            .expect("the motion can be followed")
            .point_k();
        let limited = tool
            .advance(t)
            .expect("the motion can be followed")
            .point_k();
        let pairs = [
            (expected.position, limited.position),
            (expected.velocity, limited.velocity),
            (expected.acceleration, limited.acceleration),
        ];
        for (expected, limited) in pairs {
            for axis in 0..2 {
                let error = (expected[axis] - limited[axis]).abs();
                assert!(
                    error <= 1e-13 * expected[axis].abs().max(1.0),
                    "t = {t}: {expected:?} {limited:?}"
                );
            }
        }
    }
}

#[test]
fn single_quantities_are_those_of_the_whole_up_to_their_level() {
    let mut whole = two_body::TwoBody::assemble(0.0).expect("the drawing assembles");
    let mut single = asked::Asked::assemble(0.0).expect("the drawing assembles");
    for step in 0..=500 {
        let t = f64::from(step) / 100.0;
        let expected = *whole.advance(t).expect("the motion can be followed");
        let limited = single.advance(t).expect("the motion can be followed");
        let pairs = [
            (
                expected.point_p().position[0],
                limited.point_p_position()[0],
            ),
            (
                expected.point_p().position[1],
                limited.point_p_position()[1],
            ),
            (
                expected.point_q().position[0],
                limited.point_q_position()[0],
            ),
            (
                expected.point_q().velocity[1],
                limited.point_q_velocity()[1],
            ),
            (expected.q.phi2, limited.phi2()),
            (expected.qd.phi2, limited.phi2_rate()),
            (expected.q.y2, limited.y2()),
            (expected.qd.y2, limited.y2_rate()),
            (expected.qdd.y2, limited.y2_acceleration()),
        ];
        for (expected, limited) in pairs {
            assert!(
                (expected - limited).abs() <= 1e-14 * expected.abs().max(1.0),
                "{expected} {limited} at {t}"
            );
        }
    }
}

#[test]
fn the_other_branch_is_the_mirror_assembly_and_stays() {
    let mut branches = two_body::Branches::DESIGN;
    let drawn = two_body::TwoBody::assemble(0.0).expect("the drawing assembles");
    branches.phi2 = branches.phi2.opposite();
    let mut mirrored =
        two_body::TwoBody::assemble_on(branches, 0.0).expect("the mirror image assembles");
    // The exam's rod can hang below the crank's pin: φ2 = −π/3 and y2 = 1/2 − 3/2.
    let frame = *mirrored.frame();
    assert!((frame.q.phi2 + std::f64::consts::FRAC_PI_3).abs() < 1e-14);
    assert!((frame.q.y2 + 1.0).abs() < 1e-14);
    assert!((drawn.frame().q.y2 - 2.0).abs() < 1e-14);
    for step in 1..=500 {
        let frame = mirrored
            .advance(f64::from(step) / 100.0)
            .expect("the motion can be followed");
        assert!(frame.q.phi2 < 0.0, "the rod changed sides at {}", frame.t);
    }
    assert_eq!(mirrored.branches(), branches);
    assert_eq!(two_body::Branches::DESIGN.phi2, Branch::Positive);
}

#[test]
fn a_rod_that_does_not_reach_says_by_how_much() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut mechanism = folding::Folding::assemble(0.5).expect("the drawing assembles");
    mechanism.advance(1.5).expect("the rod still reaches");
    let before = *mechanism.frame();
    for t in [1.6, 2.0, 3.0] {
        let failure = mechanism.advance(t).expect_err("the rod is too short");
        // The pin is √3 − cos t from the line, and the rod is √3 long.
        let FailureKind::OutOfReach { by } = failure.kind else {
            panic!("{failure}")
        };
        assert!((by + t.cos()).abs() < 1e-15 * 4.0, "{failure}");
        assert!((failure.time - quarter).abs() < 1e-9, "{failure}");
        assert_eq!(failure.block, 1);
        assert_eq!(*mechanism.frame(), before, "the last frame is intact");
    }
    // If crank and rod are collinear the rates are infinite, for any last digit of the angle.
    let failure = mechanism.advance(quarter).expect_err("a singular pose");
    let in_line = matches!(
        failure.kind,
        FailureKind::Singular { .. } | FailureKind::OutOfReach { .. }
    );
    assert!(in_line, "{failure}");
    let again = mechanism.advance(1.4).expect("the way back is open");
    assert!(again.q.phi2 > 0.0);
}

#[test]
fn a_time_that_is_no_number_leaves_the_last_frame() {
    let mut mechanism = excavator::Excavator::assemble(0.0).expect("the drawing assembles");
    let before = *mechanism.frame();
    for t in [f64::NAN, f64::INFINITY] {
        let failure = mechanism.advance(t).expect_err("a NaN as time");
        assert_eq!(failure.kind, FailureKind::NotFinite);
        assert_eq!(*mechanism.frame(), before);
    }
    let after = mechanism.advance(0.01).expect("the next frame works");
    assert!(after.q.x_c1.is_finite());
}

/// Largest relative deviation of single from double precision over the motion, per level.
macro_rules! single_precision {
    ($module:ident, $mechanism:ident) => {{
        let mut double = $module::$mechanism::assemble(0.0).expect("the drawing assembles");
        let mut single = single::$module::$mechanism::assemble(0.0)
            .expect("the drawing assembles in single precision");
        let mut largest = [0.0_f64; 3];
        for step in 0..=500 {
            // Both precisions get the time in single precision.
            let t = step as f32 / 100.0;
            let exact = *double
                .advance(f64::from(t))
                .expect("the motion can be followed");
            let frame = *single
                .advance(t)
                .expect("the motion can be followed in single precision");
            let levels = [
                (exact.q, frame.q),
                (exact.qd, frame.qd),
                (exact.qdd, frame.qdd),
            ];
            for (largest, (exact, frame)) in largest.iter_mut().zip(levels) {
                let scale = exact
                    .to_array()
                    .iter()
                    .fold(1.0, |scale: f64, value| scale.max(value.abs()));
                for (exact, frame) in exact.to_array().iter().zip(frame.to_array()) {
                    *largest = largest.max((exact - f64::from(frame)).abs() / scale);
                }
            }
        }
        println!(
            "{:<24} {:.1e} {:.1e} {:.1e}",
            stringify!($module),
            largest[0],
            largest[1],
            largest[2]
        );
        // The condition of these motions magnifies the rounding of 6e-8 by less than a thousand.
        assert!(
            largest.iter().all(|&error| error < 6e-5),
            "{}: {largest:?}",
            stringify!($module)
        );
    }};
}

#[test]
fn single_precision_follows_double() {
    single_precision!(two_body, TwoBody);
    single_precision!(excavator, Excavator);
    single_precision!(arm, Arm);
    single_precision!(four_bar, FourBar);
    single_precision!(slider_crank, SliderCrank);
    single_precision!(inverted_slider_crank, InvertedSliderCrank);
    single_precision!(scissor, Scissor);
    single_precision!(platform_3rpr, Platform3rpr);
    single_precision!(stephenson, Stephenson);
}
