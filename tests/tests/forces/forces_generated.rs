//! Forces of generated code are those of the interpreter, in both precisions, in closed form and by a linear system;
//! their cost is bounded.

use linkwright::{Blocks, FailureKind, Settings, Shell, Signal, Values};
use linkwright_mechanisms::andrews;
use linkwright_solver::{InputSignals, Interpreted};
use linkwright_tests::description;
use linkwright_tests::forces::{Followed, systems};
use linkwright_tests::plan::report;
use linkwright_tests::values::assembled_with;

mod endless_loads {
    linkwright::include_mechanism!(endless_loads);
}
mod forced_linkage {
    linkwright::include_mechanism!(forced_linkage);
}
mod forced_platform {
    linkwright::include_mechanism!(forced_platform);
}
mod forced_slider {
    linkwright::include_mechanism!(forced_slider);
}
mod shared_cranks {
    linkwright::include_mechanism!(shared_cranks);
}
mod shared_rails {
    linkwright::include_mechanism!(shared_rails);
}
mod toothed_planetary {
    linkwright::include_mechanism!(toothed_planetary);
}
mod weighed_given {
    linkwright::include_mechanism!(weighed_given);
}

/// Compares the bits of named values with those of the interpreter.
fn compare(followed: &Followed, found: &[(&str, f64)], t: f64) {
    assert_eq!(found.len(), followed.all().len());
    for (name, value) in found {
        let expected = followed.value(name);
        assert_eq!(
            value.to_bits(),
            expected.to_bits(),
            "{name} at t = {t}: generated {value}, interpreted {expected}"
        );
    }
}

fn interpreted(name: &str) -> Followed {
    let text = description::source(name).text;
    Followed::new(&systems(name, &text)[0], 0.0).expect("as drawn")
}

#[test]
fn a_linkage_with_every_load_has_the_forces_of_the_interpreter() {
    let mut followed = interpreted("forced_linkage");
    let inputs = forced_linkage::Inputs {
        push: Signal {
            value: 3.0,
            rate: 0.0,
            acceleration: 0.0,
        },
    };
    let mut mechanism = forced_linkage::ForcedLinkage::assemble(0.0, &inputs).expect("as drawn");
    for step in 0..200 {
        let t = 0.02 * f64::from(step);
        assert!(followed.advance(t));
        let frame = mechanism.advance(t, &inputs).expect("a crank");
        let pins = [
            frame.reaction_a(),
            frame.reaction_b(),
            frame.reaction_c(),
            frame.reaction_d(),
        ];
        let mut values = vec![
            ("effort_crank", frame.effort_crank()),
            ("power_crank", frame.power_crank()),
            ("kinetic_energy", frame.kinetic_energy()),
            ("potential_energy", frame.potential_energy()),
            ("added_power", frame.added_power()),
        ];
        let names = [
            ["reaction_a_x", "reaction_a_y"],
            ["reaction_b_x", "reaction_b_y"],
            ["reaction_c_x", "reaction_c_y"],
            ["reaction_d_x", "reaction_d_y"],
        ];
        for (names, pin) in names.into_iter().zip(pins) {
            values.extend(names.into_iter().zip(pin));
        }
        compare(&followed, &values, t);
    }
}

/// 1/(φ − 0.5), 1/(t − 1) and a force that an input divides are infinite at φ = 0.5, at t = 1 s and at a gap of zero.
/// Module and interpreter name the load, agree on the failure, and continue afterwards.
#[test]
fn a_load_that_is_not_finite_is_named() {
    let gap = |value| Signal {
        value,
        rate: 0.0,
        acceleration: 0.0,
    };
    let inputs = |value| endless_loads::Inputs { gap: gap(value) };
    let mut mechanism =
        endless_loads::EndlessLoads::assemble(0.0, &inputs(0.25)).expect("as drawn");
    let derived = &systems("endless_loads", &description::source("endless_loads").text)[0];
    let view = Interpreted::new(derived).expect("two cranks");
    let parameters = view.nominal_parameters();
    let mut interpreted = Shell::assemble(
        view.clone(),
        &parameters,
        &view.drawn_pose(&parameters),
        view.drawn_branches(),
        0.0,
        &InputSignals(vec![gap(0.25)]),
        Settings::default(),
    )
    .expect("as drawn");
    for (t, value, load) in [
        (0.25, 0.25, None),
        (0.5, 0.25, Some("torque on crank")),
        (0.75, 0.25, None),
        (0.875, 0.0, Some("force on crank.P")),
        (0.875, 0.25, None),
        (1.0, 0.25, Some("torque on wheel")),
        (1.25, 0.25, None),
    ] {
        let generated = mechanism.advance(t, &inputs(value)).map(|frame| frame.t);
        let signals = InputSignals(vec![gap(value)]);
        let read = interpreted.advance(t, &signals).map(|frame| frame.t());
        assert_eq!(generated, read, "t = {t}");
        let Some(load) = load else {
            assert_eq!(generated, Ok(t));
            continue;
        };
        let failure = generated.expect_err("an infinite load");
        // The time is that to which the motion could be followed; until then the gap is positive.
        assert!((0.0..1e-6).contains(&(t - failure.time)), "{failure}");
        let FailureKind::LoadNotFinite { load: place } = failure.kind else {
            panic!("{failure}");
        };
        assert_eq!(endless_loads::LOADS[usize::from(place)], load);
        let message = format!("{load} is not finite, at t = {} s", failure.time);
        assert_eq!(endless_loads::describe(&failure).to_string(), message);
        let blocks = interpreted.blocks();
        assert_eq!(blocks.explained(&failure).to_string(), message);
    }
}

/// The powers of the driver and of the loads are the rate of both energies: a central difference of those, to its own error.
#[test]
fn powers_of_generated_code_are_the_rate_of_its_energies() {
    const STEP: f64 = 1e-4;
    let inputs = forced_linkage::Inputs {
        push: Signal {
            value: 3.0,
            rate: 0.0,
            acceleration: 0.0,
        },
    };
    let mut mechanism = forced_linkage::ForcedLinkage::assemble(0.0, &inputs).expect("as drawn");
    let (mut before, mut now) = (f64::NAN, [f64::NAN; 2]);
    for step in 0..2000 {
        let frame = mechanism
            .advance(STEP * f64::from(step), &inputs)
            .expect("a crank");
        let energy = frame.kinetic_energy() + frame.potential_energy();
        let rate = (energy - before) / (2.0 * STEP);
        if rate.is_finite() {
            assert!(
                (rate - now[1]).abs() < 1e-4 * now[1].abs().max(10.0),
                "{rate} {now:?}"
            );
        }
        before = now[0];
        now = [energy, frame.power_crank() + frame.added_power()];
    }
}

#[test]
fn gears_have_the_forces_of_the_interpreter() {
    let mut followed = interpreted("toothed_planetary");
    let inputs = toothed_planetary::Inputs {
        load: Signal {
            value: 7.0,
            rate: 0.0,
            acceleration: 0.0,
        },
    };
    let mut mechanism =
        toothed_planetary::ToothedPlanetary::assemble(0.0, &inputs).expect("as drawn");
    for step in 0..100 {
        let t = 0.02 * f64::from(step);
        assert!(followed.advance(t));
        let frame = mechanism.advance(t, &inputs).expect("explicit");
        let [[sx, sy], [rx, ry], [cx, cy]] =
            [frame.reaction_s(), frame.reaction_r(), frame.reaction_c()];
        let [[ix, iy], [ox, oy]] = [frame.reaction_inner(), frame.reaction_outer()];
        let values = [
            ("effort_input_shaft", frame.effort_input_shaft()),
            ("power_input_shaft", frame.power_input_shaft()),
            ("reaction_s_x", sx),
            ("reaction_s_y", sy),
            ("reaction_r_x", rx),
            ("reaction_r_y", ry),
            ("reaction_c_x", cx),
            ("reaction_c_y", cy),
            ("reaction_inner_x", ix),
            ("reaction_inner_y", iy),
            ("reaction_inner_moment", frame.reaction_inner_moment()),
            ("reaction_outer_x", ox),
            ("reaction_outer_y", oy),
            ("reaction_outer_moment", frame.reaction_outer_moment()),
        ];
        compare(&followed, &values, t);
    }
}

#[test]
fn a_platform_that_is_iterated_has_the_forces_of_the_interpreter() {
    let mut followed = interpreted("forced_platform");
    let mut mechanism = forced_platform::ForcedPlatform::assemble(0.0).expect("as drawn");
    for step in 0..100 {
        let t = 0.02 * f64::from(step);
        assert!(followed.advance(t));
        let frame = mechanism.advance(t).expect("within reach");
        let [px, py] = frame.reaction_p();
        let [cx, cy] = frame.reaction_c();
        let values = [
            ("effort_drive_length_a_p", frame.effort_drive_length_a_p()),
            ("power_drive_length_a_p", frame.power_drive_length_a_p()),
            ("effort_drive_length_b_q", frame.effort_drive_length_b_q()),
            ("power_drive_length_b_q", frame.power_drive_length_b_q()),
            ("effort_drive_length_c_r", frame.effort_drive_length_c_r()),
            ("power_drive_length_c_r", frame.power_drive_length_c_r()),
            ("reaction_p_x", px),
            ("reaction_p_y", py),
            ("reaction_c_x", cx),
            ("reaction_c_y", cy),
            ("kinetic_energy", frame.kinetic_energy()),
            ("potential_energy", frame.potential_energy()),
            ("added_power", frame.added_power()),
        ];
        compare(&followed, &values, t);
    }
}

#[test]
fn a_slider_crank_has_the_forces_of_the_interpreter() {
    let mut followed = interpreted("forced_slider");
    let mut mechanism = forced_slider::ForcedSlider::assemble(0.0).expect("as drawn");
    for step in 0..100 {
        let t = 0.01 * f64::from(step);
        assert!(followed.advance(t));
        let frame = mechanism.advance(t).expect("a crank");
        let [ox, oy] = frame.reaction_o();
        let [bx, by] = frame.reaction_b();
        let [px, py] = frame.reaction_p();
        let values = [
            ("effort_drive_phi_crank", frame.effort_drive_phi_crank()),
            ("power_drive_phi_crank", frame.power_drive_phi_crank()),
            ("reaction_o_x", ox),
            ("reaction_o_y", oy),
            ("reaction_b_x", bx),
            ("reaction_b_y", by),
            ("reaction_p_x", px),
            ("reaction_p_y", py),
            ("reaction_guide_normal", frame.reaction_guide_normal()),
            ("reaction_guide_moment", frame.reaction_guide_moment()),
            ("kinetic_energy", frame.kinetic_energy()),
            ("potential_energy", frame.potential_energy()),
            ("added_power", frame.added_power()),
        ];
        compare(&followed, &values, t);
    }
}

#[test]
fn single_precision_has_the_forces_of_double_precision() {
    let mut double = andrews::Andrews::assemble(0.0).expect("as drawn");
    let mut single = linkwright_tests::single::andrews::Andrews::assemble(0.0).expect("as drawn");
    for step in 0..20 {
        let t = 5e-4 * f64::from(step);
        let exact = double.advance(t).expect("in reach");
        let rounded = single.advance(t as f32).expect("in reach");
        let [x, y] = exact.reaction_e();
        let [rx, ry] = rounded.reaction_e().map(f64::from);
        let size = x.hypot(y).max(1.0);
        assert!(
            (x - rx).hypot(y - ry) < 2e-3 * size,
            "{t}: {x} {y} {rx} {ry}"
        );
        let torque = f64::from(rounded.effort_motor());
        assert!(
            (exact.effort_motor() - torque).abs() < 2e-3 * exact.effort_motor().abs().max(0.033)
        );
    }
}

/// Cost of the forces beside that of the frame, in operations, for the excavator with a mass on every body.
#[test]
fn forces_cost_less_than_the_frame() {
    let text = description::source("excavator").text;
    let bodies: Vec<String> = (1..=10)
        .map(|body| format!("mass c{body} = {body}kg inertia 0.5;\n"))
        .collect();
    let with = |asked: &str| {
        let end = text.rfind('}').expect("its end");
        let all = format!(
            "{}{}gravity = (0, -9.81);\n{asked}\n}}",
            &text[..end],
            bodies.concat()
        );
        report(&systems("excavator", &all)[0])
    };
    let frame: usize = with("energy;").operations.iter().map(|it| it.total()).sum();
    let efforts = with("effort;").forces.expect("asked for").total();
    let reactions = with("effort; reactions;")
        .forces
        .expect("asked for")
        .total();
    assert!(2 * efforts <= frame, "{efforts} beside {frame}");
    assert!(2 * reactions <= 3 * frame, "{reactions} beside {frame}");
    // Values without weight that are not requested are not computed.
    assert!(with("energy;").forces.expect("asked for").total() < efforts);
    assert!(report(&systems("excavator", &text)[0]).forces.is_none());
}

/// Kinds of the parameters of `weighed_given`, and the words for a negative one.
const WEIGHED: [&str; 7] = [
    "body crank: the mass, unless zero,",
    "body crank: the moment of inertia, unless zero,",
    "spring main: the stiffness, unless zero,",
    "spring main: the free length, unless zero,",
    "damper (ground.W, crank.B): the damping, unless zero,",
    "spring (ground, crank): the stiffness, unless zero,",
    "damper (ground, crank): the damping, unless zero,",
];

#[test]
fn forces_refused_in_a_description_are_refused_at_run_time() {
    use weighed_given::{Parameters, WeighedGiven, describe};
    let systems = systems("weighed_given", &description::source("weighed_given").text);
    let blocks = Interpreted::new(&systems[0]).expect("its blocks");
    let nominal = blocks.nominal_parameters();
    let mut interpreted = assembled_with(
        blocks.clone(),
        &[],
        0.0,
        &blocks.initial_inputs(),
        Settings::default(),
    )
    .expect("as drawn");
    let mut generated = WeighedGiven::assemble(0.0).expect("as drawn");
    for (place, said) in WEIGHED.iter().enumerate() {
        for (value, figure) in [
            (-2.0, "-2.00"),
            (-1e-300, "-1.0e-300"),
            (f64::MIN, "-1.8e308"),
        ] {
            let mut wrong = Parameters::default();
            wrong.set(place, value);
            let failure = generated.set_parameters(&wrong).expect_err("negative");
            assert_eq!(failure.kind, FailureKind::NotPositive { value });
            let words = format!("{said} must be positive, and would be {figure}");
            assert_eq!(describe(&failure).to_string(), words);
            assert_eq!(*generated.parameters(), Parameters::default());
            assert!(WeighedGiven::assemble_for(&wrong, 0.0).is_err());
            let mut wrong = nominal.clone();
            wrong.set(place, value);
            let same = interpreted.set_parameters(&wrong).expect_err("negative");
            assert_eq!((same.kind, same.block), (failure.kind, failure.block));
            assert_eq!(blocks.explained(&same).to_string(), words);
            assert_eq!(*interpreted.parameters(), nominal);
        }
        // Masses, springs and frictions may vanish; but a body with a moment of inertia has a mass.
        let mut zero = Parameters::default();
        zero.set(place, 0.0);
        let mut also = nominal.clone();
        also.set(place, 0.0);
        let refusals = [
            generated.set_parameters(&zero).map_err(|it| it.kind),
            interpreted.set_parameters(&also).map_err(|it| it.kind),
        ];
        let expected = match place {
            0 => Err(FailureKind::NotPositive { value: 0.0 }),
            _ => Ok(()),
        };
        assert_eq!(refusals, [expected; 2], "{said}");
        generated
            .set_parameters(&Parameters::default())
            .expect("the defaults");
        interpreted.set_parameters(&nominal).expect("the defaults");
    }
    let without = Parameters {
        load: 0.0,
        inertia: 0.0,
        ..Parameters::default()
    };
    generated
        .set_parameters(&without)
        .expect("nothing to accelerate");
    generated.advance(0.1).expect("as drawn");
}

#[test]
fn joints_that_share_have_the_forces_of_the_interpreter() {
    let mut cranks = interpreted("shared_cranks");
    let mut rails = interpreted("shared_rails");
    let mut four = shared_cranks::SharedCranks::assemble(0.0).expect("as drawn");
    let mut two = shared_rails::SharedRails::assemble(0.0).expect("as drawn");
    for step in 1..100 {
        let t = 0.02 * f64::from(step);
        assert!(cranks.advance(t) && rails.advance(t));
        let frame = four.advance(t).expect("a path");
        let [[ax, ay], [cx, cy]] = [frame.reaction_a(), frame.reaction_c()];
        let [[dx, dy], [kx, ky]] = [frame.reaction_d(), frame.reaction_k()];
        let [[mx, my], [nx, ny]] = [frame.reaction_m(), frame.reaction_n()];
        let [[bx, by], [lx, ly]] = [frame.reaction_b(), frame.reaction_l()];
        let values = [
            ("effort_crank", frame.effort_crank()),
            ("power_crank", frame.power_crank()),
            ("reaction_a_x", ax),
            ("reaction_a_y", ay),
            ("reaction_b_x", bx),
            ("reaction_b_y", by),
            ("reaction_c_x", cx),
            ("reaction_c_y", cy),
            ("reaction_d_x", dx),
            ("reaction_d_y", dy),
            ("reaction_k_x", kx),
            ("reaction_k_y", ky),
            ("reaction_l_x", lx),
            ("reaction_l_y", ly),
            ("reaction_m_x", mx),
            ("reaction_m_y", my),
            ("reaction_n_x", nx),
            ("reaction_n_y", ny),
        ];
        compare(&cranks, &values, t);
        let frame = two.advance(t).expect("a path");
        let values = [
            ("effort_lift", frame.effort_lift()),
            ("power_lift", frame.power_lift()),
            ("reaction_front_normal", frame.reaction_front_normal()),
            ("reaction_front_moment", frame.reaction_front_moment()),
            ("reaction_back_normal", frame.reaction_back_normal()),
            ("reaction_back_moment", frame.reaction_back_moment()),
        ];
        compare(&rails, &values, t);
    }
}
