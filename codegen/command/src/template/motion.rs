//! Checks that the links keep their lengths, and that one turn leads back.

use {{module}}::four_bar::FourBar;

/// Rounding error of a length of a tenth of a meter, in m.
const ROUNDING: f64 = 1e-14;

fn distance(from: [f64; 2], to: [f64; 2]) -> f64 {
    (to[0] - from[0]).hypot(to[1] - from[1])
}

#[test]
fn the_links_keep_their_lengths() -> Result<(), linkwright::Failure> {
    let mut linkage = FourBar::assemble(0.0)?;
    for step in 0..=1000 {
        let frame = linkage.advance(0.002 * f64::from(step))?;
        let (b, c) = (frame.point_b().position, frame.point_c().position);
        assert!((distance([0.0, 0.0], b) - 0.04).abs() < ROUNDING);
        assert!((distance(b, c) - 0.12).abs() < ROUNDING);
        assert!((distance([0.1, 0.0], c) - 0.08).abs() < ROUNDING);
    }
    Ok(())
}

#[test]
fn one_turn_leads_back() -> Result<(), linkwright::Failure> {
    let mut linkage = FourBar::assemble(0.0)?;
    let first = linkage.advance(0.0)?.point_p().position;
    for step in 1..200 {
        linkage.advance(0.01 * f64::from(step))?;
    }
    let last = linkage.advance(2.0)?.point_p().position;
    assert!(distance(first, last) < ROUNDING);
    Ok(())
}
