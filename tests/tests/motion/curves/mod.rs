//! Points, rollers and flat faces on curves: closed forms, derivatives against differences, generated code against
//! the interpreter, and messages about curves that cannot be followed.

mod derivatives;
mod said;

use linkwright::Equations;
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::textbook::TextbookEquations;

macro_rules! modules {
    ($($name:ident),+) => {$(
        mod $name {
            linkwright::include_mechanism!($name);
        }
    )+};
}

modules!(
    cam_flat,
    cam_flat_slanted,
    cam_roller,
    cam_polar,
    cam_param,
    cam_law,
    trammel,
    rocking_cams
);

/// Compares a position, a velocity and an acceleration with those of a closed form, relative to `scale`.
fn assert_motion(found: [f64; 3], wanted: [f64; 3], scale: f64, place: &str) {
    for level in 0..3 {
        let error = (found[level] - wanted[level]).abs();
        assert!(
            error <= 1e-13 * scale,
            "{place}, level {level}: {} and {}, {error:e}",
            found[level],
            wanted[level]
        );
    }
}

/// The y components of a motion.
fn vertical(motion: &linkwright::PointMotion) -> [f64; 3] {
    [
        motion.position[1],
        motion.velocity[1],
        motion.acceleration[1],
    ]
}

const STEPS: i32 = 700;

/// A face oblique to the axes: its position follows from three simultaneous equations.
#[test]
fn a_slanted_flat_face_is_lifted_as_an_upright_one() {
    let mut cam = cam_flat_slanted::CamFlatSlanted::assemble(0.0).expect("the drawing assembles");
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = cam.advance(t).expect("a turn of the cam");
        let (sine, cosine) = (2.0 * t).sin_cos();
        let lift = [0.03 + 0.01 * cosine, -0.02 * sine, -0.04 * cosine];
        let face = frame.point_g();
        for (axis, along) in [-0.8, 0.6].into_iter().enumerate() {
            let component = [
                face.position[axis],
                face.velocity[axis],
                face.acceleration[axis],
            ];
            let lift = lift.map(|value| along * value);
            assert_motion(component, lift, 0.04, &format!("t = {t}"));
        }
    }
}

/// A flat face rises by r + e sin θ, with θ = π/2 + 2t the angle of the cam (Norton 2009).
#[test]
fn a_flat_face_on_an_eccentric_disc_is_lifted_harmonically() {
    let mut cam = cam_flat::CamFlat::assemble(0.0).expect("the drawing assembles");
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = cam.advance(t).expect("a turn of the cam");
        let (sine, cosine) = (2.0 * t).sin_cos();
        let expected = [0.03 + 0.01 * cosine, -0.02 * sine, -0.04 * cosine];
        assert_motion(
            vertical(&frame.point_g()),
            expected,
            0.1,
            &format!("t = {t}"),
        );
        // The contact is straight above the center of the disc.
        let touched = (frame.q.s_flat_follower_rim + frame.q.phi_cam).sin();
        assert!((touched - 1.0).abs() < 1e-13, "{touched}");
    }
}

/// A roller's center is (R + ρ) from the center of the disc: y = e sin θ + √((R + ρ)² − e² cos² θ).
#[test]
fn a_roller_on_an_eccentric_disc_follows_the_slider_crank() {
    let mut cam = cam_roller::CamRoller::assemble(0.0).expect("the drawing assembles");
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = cam.advance(t).expect("a turn of the cam");
        let (sine, cosine) = (std::f64::consts::FRAC_PI_2 + 2.0 * t).sin_cos();
        let (e, reach, rate) = (0.01, 0.038_f64, 2.0);
        // With w² = (R + ρ)² − e² cos² θ: w w' = e² cos θ sin θ θ', and once more.
        let w = (reach * reach - e * e * cosine * cosine).sqrt();
        let first = e * e * cosine * sine * rate / w;
        let second = (e * e * (cosine * cosine - sine * sine) * rate * rate - first * first) / w;
        let expected = [
            e * sine + w,
            e * cosine * rate + first,
            -e * sine * rate * rate + second,
        ];
        assert_motion(
            vertical(&frame.point_p()),
            expected,
            0.1,
            &format!("t = {t}"),
        );
    }
}

/// The tip of a radial follower is at r(a), where the angle from the curve's axis to the follower is a = π/2 − φ = t.
#[test]
fn a_tip_follows_the_radius_of_its_pitch_curve() {
    let mut cam = cam_polar::CamPolar::assemble(0.0).expect("the drawing assembles");
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = cam.advance(t).expect("a turn of the cam");
        let (sine, cosine) = t.sin_cos();
        let expected = [0.04 + 0.01 * cosine, -0.01 * sine, -0.01 * cosine];
        assert_motion(
            vertical(&frame.point_p()),
            expected,
            0.1,
            &format!("t = {t}"),
        );
    }
}

/// A pin on a turning arm in an elliptic groove is at r(φ) = a b / √(b² cos² φ + a² sin² φ).
#[test]
fn a_pin_in_an_elliptic_groove_is_on_the_ellipse() {
    let mut arm = trammel::Trammel::assemble(0.0).expect("the drawing assembles");
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = arm.advance(t).expect("a turn of the arm");
        let (sine, cosine) = t.sin_cos();
        let (a, b) = (0.06, 0.04);
        // 1/r² = u with u' = (1/b² − 1/a²) 2 sin φ cos φ.
        let u = (cosine / a).powi(2) + (sine / b).powi(2);
        let excess = 1.0 / (b * b) - 1.0 / (a * a);
        let (u1, u2) = (
            2.0 * excess * sine * cosine,
            2.0 * excess * (cosine * cosine - sine * sine),
        );
        let r = u.powf(-0.5);
        let r1 = -0.5 * u.powf(-1.5) * u1;
        let r2 = 0.75 * u.powf(-2.5) * u1 * u1 - 0.5 * u.powf(-1.5) * u2;
        let motion = frame.point_p();
        let along = |v: [f64; 2]| v[0] * cosine + v[1] * sine;
        let across = |v: [f64; 2]| v[1] * cosine - v[0] * sine;
        assert_motion(
            [motion.position, motion.velocity, motion.acceleration].map(along),
            [r, r1, r2 - r],
            0.3,
            &format!("along the arm at t = {t}"),
        );
        assert_motion(
            [motion.position, motion.velocity, motion.acceleration].map(across),
            [0.0, r, 2.0 * r1],
            0.3,
            &format!("across the arm at t = {t}"),
        );
    }
}

/// At the contact the levers touch the oval: the roller's center is 25 mm off it along its normal, and no point of the oval is
/// on the other side of the face.
#[test]
fn rocking_levers_touch_their_cam_and_do_not_cut_it() {
    let mut cams = rocking_cams::RockingCams::assemble(0.0).expect("the drawing assembles");
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let q = cams.advance(t).expect("a turn of the cam").q;
        let point = |s: f64| {
            let (x, y) = (0.04 * s.cos(), 0.032 * s.sin() + 0.005);
            let (sine, cosine) = q.phi_cam.sin_cos();
            [cosine * x - sine * y, sine * x + cosine * y]
        };
        let (mut nearest, mut lowest) = (f64::MAX, f64::MAX);
        let motion = cams.frame().point_p().position;
        let (sine, cosine) = q.phi_rocker.sin_cos();
        for sample in 0..20_000 {
            let [x, y] = point(f64::from(sample) * std::f64::consts::TAU / 20_000.0);
            nearest = nearest.min((motion[0] - x).hypot(motion[1] - y));
            let height = cosine * (y - q.y_rocker) - sine * (x - q.x_rocker);
            lowest = lowest.min(0.045 - height);
        }
        // Sampling misses the contact by at most d = 6.3 µm, and the distance by d²/2 (1/ρ + κ) with curvatures κ up to
        // a/b² = 39/m of the oval.
        assert!((nearest - 0.025).abs() < 1.6e-9, "{t}: {nearest}");
        assert!(lowest.abs() < 0.8e-9, "{t}: {lowest}");
    }
}

/// The roller stays on its side of the design configuration: inside a ring its center is 8 mm nearer to the middle
/// than the ring.
#[test]
fn a_roller_runs_inside_where_it_is_drawn_inside() {
    let text = "mechanism ring {
        point O = (0, 0), P = (31mm, 0);
        body arm at O { O }
        body hub at P { P }
        curve bore(a) on ground = polar 40mm;
        revolute O(ground, arm);
        translational (arm, hub) along O -> P;
        roller (hub.P, bore) = 8mm;
        drive phi(arm) = t;
    }";
    let read = linkwright_codegen::read(&Source::new("ring.mech", text)).expect("no errors");
    let equations = TextbookEquations::new(&read.motions[0].pool, &read.motions[0].system);
    let settings = linkwright::Settings::default();
    let pose = linkwright::Frame::assemble(&equations, equations.estimate(), 0.5, &settings)
        .expect("a pose");
    let place = |name: &str| {
        let names = read.motions[0].system.coordinates.iter();
        names.map(|it| it.name.as_str()).position(|it| it == name)
    };
    let [x, y] = ["x_hub", "y_hub"].map(|name| pose.q[place(name).expect("a coordinate")]);
    assert!((x.hypot(y) - 0.032).abs() < 1e-14, "{}", x.hypot(y));
    assert_eq!(equations.dimension().0, 7);
}

/// tan α = |dr/da| / r for a tip on the line through the axle (Norton 2009, section 7.2).
#[test]
fn the_pressure_angle_of_a_polar_cam_is_that_of_the_textbook() {
    let mut cam = cam_polar::CamPolar::assemble(0.0).expect("the drawing assembles");
    let mut resting = 0;
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = cam.advance(t).expect("a turn of the cam");
        let tangent = (0.01 * t.sin()).abs() / (0.04 + 0.01 * t.cos());
        match frame.pressure_angle_tip() {
            Some(angle) => assert!((angle.tan() - tangent).abs() < 1e-13, "{t}: {angle}"),
            None => {
                assert!(tangent < 1e-7, "{t}: {tangent}");
                resting += 1;
            }
        }
    }
    assert_eq!(resting, 1, "at the top of the lift");
}

/// The normal of a disc passes through its center: sin α = e |cos θ| / (R + ρ). A flat face across its guide has
/// none.
#[test]
fn pressure_angles_of_an_eccentric_disc_are_those_of_its_triangle() {
    let mut roller = cam_roller::CamRoller::assemble(0.0).expect("the drawing assembles");
    let mut face = cam_flat::CamFlat::assemble(0.0).expect("the drawing assembles");
    for step in 1..=STEPS {
        let t = f64::from(step) / 100.0;
        let angle = roller
            .advance(t)
            .expect("a turn of the cam")
            .pressure_angle_wheel();
        let sine = 0.01 * (2.0 * t).sin().abs() / 0.038;
        let angle = angle.expect("it moves");
        assert!((angle.sin() - sine).abs() < 1e-13, "{t}: {angle}");
        let frame = face.advance(t).expect("a turn of the cam");
        let angle = frame.pressure_angle_flat_follower_rim().expect("it moves");
        assert!(angle < 1e-13, "{t}: {angle}");
    }
}

/// The point of a lever moves across the line to its pivot, so the angle between the normal and that line is the
/// complement.
#[test]
fn the_pressure_angle_of_a_lever_is_measured_against_its_arc() {
    let mut cams = rocking_cams::RockingCams::assemble(0.0).expect("the drawing assembles");
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = cams.advance(t).expect("a turn of the cam");
        let Some(angle) = frame.pressure_angle_roller_lever_p_oval() else {
            continue;
        };
        let (q, p) = (frame.q, frame.point_p().position);
        // The normal from the slope of the oval, and the arm from the pivot.
        let (x, y) = (
            0.032 * q.s_roller_lever_p_oval.cos(),
            0.04 * q.s_roller_lever_p_oval.sin(),
        );
        let (sine, cosine) = q.phi_cam.sin_cos();
        let normal = [cosine * x - sine * y, sine * x + cosine * y];
        let arm = [p[0] - q.x_lever, p[1] - q.y_lever];
        let sine = (normal[0] * arm[0] + normal[1] * arm[1])
            / (normal[0].hypot(normal[1]) * arm[0].hypot(arm[1]));
        assert!(
            (angle.sin() - sine.abs()).abs() < 1e-12,
            "{t}: {angle} and {sine}"
        );
    }
}

/// The pressure angle and the lift follow the eccentricity e and the roller's radius ρ that are set at run time.
#[test]
fn curves_and_rollers_take_their_sizes_from_parameters() {
    let parameters = cam_param::Parameters {
        e: 0.012,
        rho: 0.005,
    };
    let mut cam = cam_param::CamParam::assemble_for(&parameters, 0.0).expect("the drawing is near");
    for step in 1..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = cam.advance(t).expect("a turn of the cam");
        let (sine, cosine) = (2.0 * t).sin_cos();
        let reach = 0.035_f64;
        let height = 0.012 * cosine + (reach * reach - (0.012 * sine).powi(2)).sqrt();
        let roller_height = frame.point_p().position[1];
        assert!(
            (roller_height - height).abs() < 1e-15,
            "{t}: {roller_height} and {height}"
        );
        let angle = frame.pressure_angle_wheel().expect("it moves");
        assert!(
            (angle.sin() - 0.012 * sine.abs() / reach).abs() < 1e-13,
            "{t}: {angle}"
        );
    }
}

/// A follower on the pitch curve of a law obeys it, turn after turn: s = h (x − sin 2πx / 2π) over a rise (Norton 2009,
/// section 2.3), with x the share of the rise that has passed.
#[test]
fn a_cam_designed_from_a_law_moves_its_follower_by_it() {
    use std::f64::consts::{PI, TAU};
    let mut cam = cam_law::CamLaw::assemble(0.0).expect("the drawing assembles");
    let (lift, rate, beta) = (0.012, 3.0, 2.0 * PI / 3.0);
    let rise = |x: f64| {
        [
            lift * (x - (TAU * x).sin() / TAU),
            lift * (1.0 - (TAU * x).cos()) * rate / beta,
            lift * TAU * (TAU * x).sin() * (rate / beta).powi(2),
        ]
    };
    for step in 0..=STEPS {
        let t = f64::from(step) / 100.0;
        let frame = cam.advance(t).expect("the cam turns");
        let angle = (rate * t).rem_euclid(TAU);
        let law = if angle < beta {
            rise(angle / beta)
        } else if angle < PI {
            [lift, 0.0, 0.0]
        } else if angle < PI + beta {
            let fall = rise((angle - PI) / beta);
            [lift - fall[0], -fall[1], -fall[2]]
        } else {
            [0.0; 3]
        };
        let tip = vertical(&frame.point_p());
        assert_motion(
            tip,
            [0.04 + law[0], law[1], law[2]],
            1.0,
            &format!("t = {t}"),
        );
        match frame.pressure_angle_tip() {
            Some(angle) => {
                let tangent = (law[1] / rate).abs() / (0.04 + law[0]);
                assert!((angle.tan() - tangent).abs() < 1e-12, "{t}: {angle}");
            }
            None => assert!(law[1].abs() < 1e-8, "{t}: {law:?}"),
        }
    }
}
