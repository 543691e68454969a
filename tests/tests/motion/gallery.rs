//! Characteristic property of each mechanism of the gallery, from the generated code.

use linkwright_mechanisms::{
    cam_dwell, disc_cam, double_wishbone, jansen, pantograph, peaucellier, planetary_gear,
    quick_return, rack_steering, scotch_yoke,
};

/// Instants of five seconds.
fn instants() -> impl Iterator<Item = f64> {
    (0..=5000).map(|step| f64::from(step) / 1000.0)
}

/// x = (l² − s²)/(2 r) (Lipkin 1871), with neither velocity nor acceleration across the line.
#[test]
fn peaucelliers_point_stays_on_a_straight_line() {
    let mut cell = peaucellier::Peaucellier::assemble(0.0).expect("the drawing assembles");
    let line = (0.25_f64.powi(2) - 0.15_f64.powi(2)) / (2.0 * 0.075);
    let mut worst = [0.0_f64; 3];
    let mut highest = 0.0_f64;
    for t in instants() {
        let point = cell.advance(t).expect("the motion is regular").point_r();
        worst[0] = worst[0].max((point.position[0] - line).abs());
        worst[1] = worst[1].max(point.velocity[0].abs());
        worst[2] = worst[2].max(point.acceleration[0].abs());
        highest = highest.max(point.position[1].abs());
    }
    println!("off the line by {worst:?} m, m/s, m/s²");
    assert!(worst[0] < 1e-13 && worst[1] < 1e-12 && worst[2] < 1e-11);
    // y = x tan(θ/2) at the crank angle θ, here up to 60°.
    assert!((highest - line * (std::f64::consts::PI / 6.0).tan()).abs() < 1e-6);
}

/// The foot stays within 13 mm of its lowest point over a step of 60 cm, and is lifted by 22 cm to return.
#[test]
fn jansens_foot_walks_on_level_ground() {
    let mut leg = jansen::Jansen::assemble(0.0).expect("the drawing assembles");
    let path: Vec<[f64; 2]> = instants()
        .map(|t| {
            leg.advance(t)
                .expect("the motion is regular")
                .point_t()
                .position
        })
        .collect();
    let lowest = path.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let highest = path.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    let down: Vec<f64> = path
        .iter()
        .filter(|p| p[1] < lowest + 0.013)
        .map(|p| p[0])
        .collect();
    let step = down.iter().fold(f64::NEG_INFINITY, |a, &b| a.max(b))
        - down.iter().fold(f64::INFINITY, |a, &b| a.min(b));
    println!("a step of {step} m, lifted by {} m", highest - lowest);
    assert!(step > 0.6 && highest - lowest > 0.22);
}

/// x = r cos φ, and nothing else: the yoke's rates and accelerations are those of a cosine.
#[test]
fn a_scotch_yoke_is_harmonic() {
    let mut yoke = scotch_yoke::ScotchYoke::assemble(0.0).expect("the drawing assembles");
    for t in instants() {
        let frame = yoke.advance(t).expect("the motion is regular");
        let (sine, cosine) = (3.0 * t).sin_cos();
        for (found, wanted) in [
            (frame.q.x_yoke, 0.05 * cosine),
            (frame.qd.x_yoke, -0.15 * sine),
            (frame.qdd.x_yoke, -0.45 * cosine),
        ] {
            assert!(
                (found - wanted).abs() <= 1e-15,
                "{found} for {wanted} at {t}"
            );
        }
    }
}

/// Willis: the carrier turns 20/(20 + 50) as fast as the sun, and seen from it sun and planet turn as 15 to −20.
#[test]
fn a_planetary_gear_obeys_willis() {
    let mut gear = planetary_gear::PlanetaryGear::assemble(0.0).expect("the drawing assembles");
    for t in instants() {
        let frame = gear.advance(t).expect("gears have no singular pose");
        for (sun, carrier, planet) in [
            (frame.q.phi_sun, frame.q.phi_carrier, frame.q.phi_planet),
            (frame.qd.phi_sun, frame.qd.phi_carrier, frame.qd.phi_planet),
        ] {
            let size = sun.abs().max(1.0);
            assert!((carrier - sun * 20.0 / 70.0).abs() <= 1e-15 * size);
            assert!(((planet - carrier) * 15.0 + (sun - carrier) * 20.0).abs() <= 1e-14 * size);
        }
    }
}

/// The right wheel turned to one side is the left one turned to the other.
#[test]
fn rack_steering_is_odd() {
    let angles = |t: f64| {
        let steering = rack_steering::RackSteering::assemble(t).expect("the drawing assembles");
        let frame = steering.frame();
        [frame.q.phi_left, frame.q.phi_right]
    };
    let mut widest = 0.0_f64;
    for t in instants() {
        let ([left, right], [mirrored_left, mirrored_right]) = (angles(t), angles(-t));
        assert!((left + mirrored_right).abs() <= 1e-15 && (right + mirrored_left).abs() <= 1e-15);
        // Ackermann: the inner wheel turns more.
        let (inner, outer) = if left > 0.0 {
            (left, right)
        } else {
            (right, left)
        };
        assert!(inner.abs() >= outer.abs() - 1e-15, "{left} {right}");
        widest = widest.max(inner.abs());
    }
    println!("up to {} deg", widest.to_degrees());
    assert!(widest.to_degrees() > 15.0);
}

/// The pen enlarges the path of the tracer by 2.5, with its velocity and acceleration.
#[test]
fn a_pantograph_draws_larger() {
    let mut links = pantograph::Pantograph::assemble(0.0).expect("the drawing assembles");
    for t in instants() {
        let frame = links.advance(t).expect("the motion is regular");
        let (traced, drawn) = (frame.point_p(), frame.point_q());
        for axis in 0..2 {
            for (small, large) in [
                (traced.position[axis], drawn.position[axis]),
                (traced.velocity[axis], drawn.velocity[axis]),
                (traced.acceleration[axis], drawn.acceleration[axis]),
            ] {
                assert!((large - 2.5 * small).abs() < 1e-14, "{large} for {small}");
            }
        }
    }
}

/// The ram's velocity vanishes where the crank is perpendicular to the lever, at −30° and 210°: forward through 240°, back
/// through 120°.
#[test]
fn a_quick_return_takes_half_the_time() {
    let mut shaper = quick_return::QuickReturn::assemble(0.0).expect("the drawing assembles");
    let mut speed = |angle: f64| {
        let frame = shaper
            .advance(angle.to_radians() / 3.0)
            .expect("the motion is regular");
        frame.point_d().velocity[0]
    };
    for turn in [-30.0, 210.0, 330.0, 570.0] {
        assert!(speed(turn).abs() < 1e-14, "{} at {turn}", speed(turn));
    }
    for forward in [-20.0, 90.0, 200.0] {
        assert!(speed(forward) < 0.0);
    }
    for back in [220.0, 270.0, 320.0] {
        assert!(speed(back) > 0.0);
    }
}

/// The wheel's center is as high as it is driven; the wheel leans inwards at full bump, because the upper wishbone is
/// shorter.
#[test]
fn a_double_wishbone_gains_camber() {
    let mut wheel = double_wishbone::DoubleWishbone::assemble(0.0).expect("the drawing assembles");
    let mut camber = Vec::new();
    for t in instants() {
        let frame = wheel.advance(t).expect("the motion is regular");
        let height = 0.3 + 0.06 * (2.0 * t).sin();
        assert!((frame.point_w().position[1] - height).abs() < 1e-15);
        camber.push(frame.q.phi_upright);
    }
    // Full bump is at t = π/4, full droop at 3π/4.
    println!(
        "camber {} deg at bump, {} deg at droop",
        camber[785].to_degrees(),
        camber[2356].to_degrees()
    );
    assert!(camber[785] > 0.0 && camber[2356] < camber[785]);
}

/// y = e sin φ + sqrt((R + r)² − e² cos² φ), and sin α = e |cos φ|/(R + r) for the pressure angle.
#[test]
fn a_roller_follows_an_eccentric_disc() {
    let mut cam = disc_cam::DiscCam::assemble(0.0).expect("the drawing assembles");
    let (e, reach) = (0.01, 0.038_f64);
    for t in instants() {
        let frame = cam.advance(t).expect("the motion is regular");
        let (sine, cosine) = frame.q.phi_cam.sin_cos();
        let height = e * sine + (reach * reach - e * e * cosine * cosine).sqrt();
        assert!(
            (frame.q.y_follower - height).abs() < 1e-16,
            "{} for {height}",
            frame.q.y_follower
        );
        if let Some(angle) = frame.pressure_angle_wheel() {
            // At the follower's reversal, the direction of its velocity is lost in rounding.
            if frame.qd.y_follower.abs() > 1e-6 {
                let expected = (e * cosine / reach).asin().abs();
                assert!(
                    (angle.abs() - expected).abs() < 1e-9,
                    "{angle} for {expected} at {t}"
                );
            }
        }
    }
}

/// The cycloid of the text: rest, rise, dwell and return, with two derivatives; tan α = |dr/da|/r.
#[test]
fn a_cam_follower_obeys_its_law() {
    use std::f64::consts::{FRAC_PI_2, PI, TAU};
    let mut cam = cam_dwell::CamDwell::assemble(0.0).expect("the drawing assembles");
    let cycloid = |s: f64| {
        [
            s - (TAU * s).sin() / TAU,
            1.0 - (TAU * s).cos(),
            TAU * (TAU * s).sin(),
        ]
    };
    let mut worst = [0.0_f64; 3];
    for t in instants() {
        let a = (3.0 * t).rem_euclid(TAU);
        let (length, h0, h1, s) = if a < FRAC_PI_2 {
            (1.0, 0.04, 0.04, 0.0)
        } else if a < PI {
            (FRAC_PI_2, 0.04, 0.06, (a - FRAC_PI_2) / FRAC_PI_2)
        } else if a < 4.0 * PI / 3.0 {
            (1.0, 0.06, 0.06, 0.0)
        } else {
            (TAU / 3.0, 0.06, 0.04, (a - 4.0 * PI / 3.0) / (TAU / 3.0))
        };
        let [y, slope, bend] = cycloid(s);
        let rate = 3.0 / length;
        let expected = [
            h0 + (h1 - h0) * y,
            (h1 - h0) * slope * rate,
            (h1 - h0) * bend * rate * rate,
        ];
        let frame = cam.advance(t).expect("the motion is regular");
        let levels = [
            frame.q.x_follower,
            frame.qd.x_follower,
            frame.qdd.x_follower,
        ];
        for level in 0..3 {
            worst[level] = worst[level].max((levels[level] - expected[level]).abs());
        }
        if let Some(angle) = frame.pressure_angle_tip()
            && expected[1].abs() > 1e-6
        {
            let tangent = (expected[1] / 3.0 / expected[0]).abs();
            assert!((angle.abs().tan() - tangent).abs() < 1e-9, "{angle} at {t}");
        }
    }
    println!("off the law by {worst:?} m, m/s, m/s²");
    assert!(worst[0] < 1e-13 && worst[1] < 1e-13 && worst[2] < 1e-12);
}
