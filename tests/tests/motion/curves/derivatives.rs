//! Derivatives against differences, and generated code against the interpreter.

use linkwright::nalgebra::{SMatrix, SVector};
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_tests::files;
use linkwright_tests::random::Random;

use super::{cam_flat, cam_polar, cam_roller, rocking_cams, trammel};

/// Φ_q, Φ_t and γ against differences of Φ at random places, which need not satisfy Φ.
macro_rules! derivatives {
    ($test:ident, $module:ident) => {
        #[test]
        fn $test() {
            const N: usize = $module::Coordinates::COUNT;
            let phi = |q: &SVector<f64, N>, t: f64| {
                $module::phi(&$module::Coordinates::from_array(q.data.0[0]), t)
            };
            let mut random = Random::new(7);
            for _ in 0..200 {
                let mut draw = || SVector::<f64, N>::from_fn(|_, _| random.between(-1.0, 1.0));
                let (q, qd) = (draw(), draw());
                let t = random.between(0.0, 2.0);
                let [named, rates] =
                    [q, qd].map(|values| $module::Coordinates::from_array(values.data.0[0]));
                let h = 1.0 / 1024.0;
                // Fourth-order differences: what is left is h⁴/30 of the fifth derivative, and rounding over h.
                let first = |values: [SVector<f64, N>; 4]| {
                    (values[0] - values[3] + (values[2] - values[1]) * 8.0) / (12.0 * h)
                };
                let mut jacobian = SMatrix::<f64, N, N>::zeros();
                for column in 0..N {
                    let values = [-2.0, -1.0, 1.0, 2.0].map(|step| {
                        let mut moved = q;
                        moved[column] += step * h;
                        phi(&moved, t)
                    });
                    jacobian.set_column(column, &first(values));
                }
                let error = ($module::phi_q(&named, t) - jacobian).abs().max();
                assert!(error < 1e-9, "Φ_q: {error:e}");
                let values = [-2.0, -1.0, 1.0, 2.0].map(|step| phi(&q, t + step * h));
                let error = ($module::phi_t(&named, t) - first(values)).abs().max();
                assert!(error < 1e-9, "Φ_t: {error:e}");
                // −γ is the second derivative of Φ along (q + q̇ s, t + s).
                let h = 1.0 / 256.0;
                let along = |step: f64| phi(&(q + qd * (step * h)), t + step * h);
                let second = (along(-1.0) + along(1.0)) * 16.0 - along(-2.0) - along(2.0);
                let second = (second - along(0.0) * 30.0) / (12.0 * h * h);
                let error = ($module::gamma(&named, &rates, t) + second).abs().max();
                assert!(error < 1e-7, "γ: {error:e}");
            }
        }
    };
}

derivatives!(derivatives_of_flat_agree_with_differences, cam_flat);
derivatives!(derivatives_of_roller_agree_with_differences, cam_roller);
derivatives!(
    derivatives_of_point_on_curve_agree_with_differences,
    cam_polar
);
derivatives!(derivatives_on_the_ground_agree_with_differences, trammel);
derivatives!(
    derivatives_with_all_bodies_turning_agree_with_differences,
    rocking_cams
);

/// Generated code and interpreter find the same motion.
#[test]
fn generated_code_agrees_with_the_interpreter() {
    let path = files::package("descriptions/rocking_cams.mech");
    let text = std::fs::read_to_string(path).expect("the description");
    let read =
        linkwright_codegen::read(&Source::new("rocking_cams.mech", text)).expect("no errors");
    let equations = TextbookEquations::new(&read.motions[0].pool, &read.motions[0].system);
    let mut generated = rocking_cams::RockingCams::assemble(0.0).expect("the drawing assembles");
    let start = equations.estimate().clone();
    let settings = linkwright::Settings::default();
    let mut interpreted = linkwright::Frame::assemble(&equations, &start, 0.0, &settings)
        .expect("the drawing assembles");
    for step in 1..=300 {
        let t = f64::from(step) / 50.0;
        interpreted = interpreted
            .advance(&equations, t, &settings)
            .expect("a turn of the cam");
        let frame = generated.advance(t).expect("a turn of the cam");
        let pairs = [
            (frame.q, &interpreted.q),
            (frame.qd, &interpreted.qd),
            (frame.qdd, &interpreted.qdd),
        ];
        for (one, other) in pairs {
            for (one, other) in one.to_array().iter().zip(other.iter()) {
                assert!((one - other).abs() < 1e-11, "{t}: {one} and {other}");
            }
        }
    }
}
