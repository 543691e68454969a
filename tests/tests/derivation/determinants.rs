//! Determinants of the blocks against that of the whole Φ_q, and the closed forms that are printed.

use linkwright::{Frame, Settings};
use linkwright_codegen::stages::emit::derivation::Script;
use linkwright_codegen::stages::emit::{Notation, derivation};
use linkwright_codegen::stages::expr::ExprId;
use linkwright_solver::condition::Condition;
use linkwright_solver::condition::jacobian;
use linkwright_solver::reader::Reader;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::plan::solved;
use linkwright_tests::random::Random;
use linkwright_tests::values::assembled_from;
use nalgebra::DMatrix;

/// Product of the determinants of all subsystems, and det Φ_q, at times of a motion.
fn products(name: &str, times: &[f64]) -> Vec<(f64, f64)> {
    let derived = description::system(name);
    let textbook = TextbookEquations::new(&derived.pool, &derived.system);
    let solved = Interpreted::new(&derived).expect("a plan");
    let mut draft = solved.pool().draft();
    let parts = solved.program().forms.iter().flatten();
    let parts = parts.map(|part| {
        let evaluated = part.determinant(&mut draft);
        let roots: Vec<ExprId> = match evaluated.value {
            Some(value) => vec![value],
            None => evaluated.jacobian.concat(),
        };
        let size = if evaluated.value.is_some() {
            0
        } else {
            evaluated.jacobian.len()
        };
        (size, Reader::new(&draft.graph, solved.layout(), &roots))
    });
    let parts: Vec<(usize, Reader)> = parts.collect();
    let settings = Settings::default();
    let mut frame =
        Frame::assemble(&textbook, textbook.estimate(), 0.0, &settings).expect("assembled");
    let mut pairs = Vec::new();
    for &t in times {
        while frame.t < t {
            let next = (frame.t + 0.01).min(t);
            frame = frame.advance(&textbook, next, &settings).expect("advanced");
        }
        let shell = assembled_from(solved.clone(), frame.q.as_slice(), t, settings)
            .unwrap_or_else(|_| panic!("{name} at {t}"));
        let instant = shell.frame();
        let gap = (instant.frame().q - &frame.q).amax();
        assert!(gap < 1e-9, "{name}: the views differ by {gap:e} at {t}");
        let determinant = |(size, reader): &(usize, Reader)| {
            let values = reader.values(instant);
            match size {
                0 => values[0],
                _ => DMatrix::from_row_slice(*size, *size, &values).determinant(),
            }
        };
        let product: f64 = parts.iter().map(determinant).product();
        let whole = Condition::of(&jacobian(&textbook, &frame.q, t)).determinant;
        pairs.push((product, whole));
    }
    pairs
}

/// Random times, ascending.
fn times(count: usize) -> Vec<f64> {
    let mut random = Random::new(7);
    let mut times: Vec<f64> = (0..count).map(|_| random.between(0.0, 2.0)).collect();
    times.sort_by(f64::total_cmp);
    times
}

/// Ratio of det Φ_q to the product, up to the sign: constants that elimination divides out. A fixed distance is |d|²
/// = L² in Φ and a vector of length L in the plan, which is a factor of 2 for each of the two links. The teeth of a
/// planet are counted against a carrier.
fn factor(name: &str) -> f64 {
    match name {
        "planetary_gear" => 1.4,
        "rack_steering" => 4.0,
        _ => 1.0,
    }
}

/// At random poses of the motion, for every mechanism except for large ones, whose dense matrices take too long.
#[test]
fn the_product_of_the_blocks_is_the_determinant_of_the_whole() {
    let mut compared = 0;
    for name in description::whole() {
        if description::system(&name).system.coordinates.len() > 60 {
            continue;
        }
        let pairs = products(&name, &times(12));
        let sign = (pairs[0].0 * pairs[0].1).signum();
        for (product, whole) in pairs {
            let expected = sign * factor(&name) * product;
            assert!(
                (whole - expected).abs() <= 1e-11 * expected.abs() && expected != 0.0,
                "{name}: {whole} instead of {expected}"
            );
        }
        compared += 1;
    }
    assert!(compared >= 19, "only {compared} mechanisms");
}

/// The exam: det Φ_q = ±√3 sin φ2, all of it in one block.
#[test]
fn the_exam_has_the_determinant_of_its_solution() {
    for (product, whole) in products("two_body", &times(100)) {
        assert!(
            (product.abs() - whole.abs()).abs() < 1e-12,
            "{product} {whole}"
        );
    }
    let solved = solved(description::system("two_body"));
    let poses = derivation::singular_poses(
        solved.pool(),
        solved.system(),
        solved.plan(),
        &solved.program().forms,
        Script::Text(Notation::Unicode),
    );
    assert_eq!(poses.len(), 1);
    assert_eq!(poses[0].determinant.as_deref(), Some("√3·sin φ₂"));
}
