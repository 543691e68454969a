//! Points on lines of bodies that turn: the pin in a slot, the block on a lever, the pinion on a rack.

use std::f64::consts::FRAC_PI_6;

use linkwright_tests::jet::Jet;

use super::exact::follows;

#[test]
fn a_pin_in_a_slot_turns_the_lever_towards_it() {
    follows!(slotted_link, SlottedLink, 5.0, 1e-12, |t| {
        let crank = FRAC_PI_6 + t;
        let lever = (crank.sin() + 2.0).atan2(crank.cos());
        vec![("phi_crank", crank), ("phi_lever", lever)]
    });
}

#[test]
fn a_block_beside_a_lever_turns_it_by_the_angle_of_its_offset_less() {
    follows!(offset_slot, OffsetSlot, 5.0, 1e-12, |t| {
        let crank = FRAC_PI_6 + t;
        let (x, y) = (crank.cos(), crank.sin() + 2.0);
        let along = (x.square() + y.square() - 0.04).sqrt();
        vec![("phi_lever", y.atan2(x) - Jet::from(-0.2).atan2(along))]
    });
}

/// On a guide that turns by θ the rack is moved by sin t and the pinion's centre to (c, 2): in the guide's frame the wheel of radius 1
/// rolls clockwise by what it gets ahead of the rack.
#[test]
fn a_pinion_rolls_on_a_rack_that_slides_and_turns() {
    follows!(rolling_pinion, RollingPinion, 5.0, 1e-12, |t| {
        let theta = 0.5 * t;
        let (slid, centre) = (t.sin(), 0.5 - 0.2 * t);
        vec![
            ("x_rack", slid * theta.cos()),
            ("y_rack", slid * theta.sin()),
            ("phi_rack", theta),
            ("x_pinion", centre * theta.cos() - 2.0 * theta.sin()),
            ("y_pinion", centre * theta.sin() + 2.0 * theta.cos()),
            ("phi_pinion", theta - (centre - slid)),
        ]
    });
}

/// The pin is 0.35 m from its lever's pivot, 0.6 m beside the pivot of the slot: across the slot, 0.35 sin δ = 0.6 sin φ.
#[test]
fn a_slot_moves_in_the_orientation_that_a_driven_relative_angle_turns() {
    follows!(angle_and_slot, AngleAndSlot, 5.0, 1e-12, |t| {
        let delta = 5.0 * FRAC_PI_6 + 0.1 * t.sin();
        let sine = (0.35 / 0.6) * delta.sin();
        let slotted = sine.atan2((1.0 - sine.square()).sqrt());
        vec![("phi_slotted", slotted), ("phi_pinned", slotted + delta)]
    });
}

/// Rail with an offset: 0.35 sin δ − 0.6 sin φ = 0.03.
#[test]
fn a_rail_moves_in_the_orientation_that_a_driven_relative_angle_turns() {
    follows!(angle_and_block, AngleAndBlock, 5.0, 1e-12, |t| {
        let delta = 5.0 * FRAC_PI_6 + 0.1 * t.sin();
        let sine = (0.35 / 0.6) * delta.sin() - 0.05;
        let rail = sine.atan2((1.0 - sine.square()).sqrt());
        vec![("phi_rail", rail), ("phi_swing", rail + delta)]
    });
}
