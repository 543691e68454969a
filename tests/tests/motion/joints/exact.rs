//! Largest errors of the solved and of the textbook formulation against the exact motion of a mechanism.

use linkwright_tests::description;
use linkwright_tests::jet::Jet;
use linkwright_tests::solver::{Interpreted, Solver};

/// Positions, rates and accelerations of all coordinates.
pub type Frame = [Vec<f64>; 3];

/// Both views at 501 times must have these coordinates, with their rates and accelerations, to `tolerance` of what is larger, 1 or
/// the value.
pub fn check(
    name: &str,
    until: f64,
    tolerance: f64,
    exact: impl Fn(Jet) -> Vec<(&'static str, Jet)>,
    mut solved: impl FnMut(f64) -> Frame,
) {
    let names: Vec<String> = description::system(name)
        .system
        .coordinates
        .iter()
        .map(|coordinate| coordinate.name.clone())
        .collect();
    let mut textbook = Interpreted::new(name);
    textbook.assemble(0.0);
    let mut largest = [[0.0_f64; 3]; 2];
    for step in 0..=500 {
        let t = until * f64::from(step) / 500.0;
        textbook.advance(t);
        let frame = textbook.frame();
        let by_textbook =
            [&frame.q, &frame.qd, &frame.qdd].map(|values| values.as_slice().to_vec());
        let views = [solved(t), by_textbook];
        for (coordinate, expected) in exact(Jet::time(t)) {
            let at = names.iter().position(|it| it == coordinate);
            let at = at.unwrap_or_else(|| panic!("{name} has no coordinate {coordinate}"));
            for (view, found) in views.iter().enumerate() {
                for order in 0..3 {
                    let (found, expected) = (found[order][at], expected.0[order]);
                    let error = (found - expected).abs() / expected.abs().max(1.0);
                    assert!(
                        error <= tolerance,
                        "{name}, view {view}: {coordinate} of order {order} at {t}: {found} instead of {expected}"
                    );
                    largest[view][order] = largest[view][order].max(error);
                }
            }
        }
    }
    println!(
        "{name:<20} solved {:.1e} {:.1e} {:.1e}, textbook {:.1e} {:.1e} {:.1e}",
        largest[0][0], largest[0][1], largest[0][2], largest[1][0], largest[1][1], largest[1][2]
    );
}

/// `follows!(name, Type, until, tolerance, |t| vec![("x1", …)])`: includes the generated module and checks it.
macro_rules! follows {
    ($module:ident, $mechanism:ident, $until:expr, $tolerance:expr, $exact:expr) => {{
        mod $module {
            linkwright::include_mechanism!($module);
        }
        let mut mechanism = $module::$mechanism::assemble(0.0).expect("the drawing assembles");
        super::exact::check(stringify!($module), $until, $tolerance, $exact, |t| {
            let frame = *mechanism
                .advance(t)
                .unwrap_or_else(|failure| panic!("{failure}"));
            [frame.q, frame.qd, frame.qdd].map(|values| values.to_array().to_vec())
        });
    }};
}

pub(crate) use follows;
