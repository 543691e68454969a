//! What each mechanism of the gallery is known for, from the generated code.

use linkwright_mechanisms::{jansen, peaucellier};

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
