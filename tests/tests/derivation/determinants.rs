//! The determinants of the blocks against that of the whole Φ_q, and the closed forms that are printed.

use linkwright::{Settings, advance, assemble};
use linkwright_codegen::stages::emit::derivation::Script;
use linkwright_codegen::stages::emit::{Notation, derivation};
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::program::forms_of;
use linkwright_codegen::stages::structure::Shift;
use linkwright_solver::condition::{Condition, jacobian};
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::reader::Reader;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::view::View;
use linkwright_tests::description;
use linkwright_tests::random::Random;
use linkwright_tests::values::assembled_from;
use nalgebra::DMatrix;

/// The product of the determinants of all parts, and det Φ_q, at times of a motion.
fn products(name: &str, times: &[f64]) -> Vec<(f64, f64)> {
    let derived = description::system(name);
    let textbook = TextbookEquations::new(&derived.pool, &derived.system);
    let solved = Interpreted::new(&derived).expect("a plan");
    let mut draft = solved.pool().draft();
    let parts = solved.program().forms.iter().flatten();
    let parts = parts.map(|part| {
        let found = part.determinant(&mut draft);
        let roots: Vec<ExprId> = match found.value {
            Some(value) => vec![value],
            None => found.jacobian.concat(),
        };
        let size = if found.value.is_some() {
            0
        } else {
            found.jacobian.len()
        };
        (size, Reader::new(&draft.graph, solved.layout(), &roots))
    });
    let parts: Vec<(usize, Reader)> = parts.collect();
    let settings = Settings::default();
    let mut frame = assemble(&textbook, textbook.estimate(), 0.0, &settings).expect("assembled");
    let mut found = Vec::new();
    for &t in times {
        while frame.t < t {
            let next = (frame.t + 0.01).min(t);
            frame = advance(&textbook, &frame, next, &settings).expect("advanced");
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
        found.push((product, whole));
    }
    found
}

/// Random times, ascending.
fn times(count: usize) -> Vec<f64> {
    let mut random = Random::new(7);
    let mut times: Vec<f64> = (0..count).map(|_| random.between(0.0, 2.0)).collect();
    times.sort_by(f64::total_cmp);
    times
}

/// What det Φ_q is in multiples of the product, up to the sign: constants that elimination divides out. A held distance is
/// |d|² = L² in Φ and a vector of length L in the plan, which is a factor of 2 for each of the two links; the teeth of a planet
/// are counted against a carrier.
fn factor(name: &str) -> f64 {
    match name {
        "planetary_gear" => 1.4,
        "rack_steering" => 4.0,
        _ => 1.0,
    }
}

/// At random poses on the way, for every mechanism. Larger ones are left out for the time that their dense matrices take.
#[test]
fn the_product_of_the_blocks_is_the_determinant_of_the_whole() {
    let mut compared = 0;
    for name in description::whole() {
        if description::system(&name).system.coordinates.len() > 60 {
            continue;
        }
        let found = products(&name, &times(12));
        let sign = (found[0].0 * found[0].1).signum();
        for (product, whole) in found {
            let wanted = sign * factor(&name) * product;
            assert!(
                (whole - wanted).abs() <= 1e-11 * wanted.abs() && wanted != 0.0,
                "{name}: {whole} instead of {wanted}"
            );
        }
        compared += 1;
    }
    assert!(compared >= 19, "only {compared} mechanisms");
}

/// The exam's own: det Φ_q = ±√3 sin φ2, and one block has all of it.
#[test]
fn the_exam_has_the_determinant_of_its_solution() {
    for (product, whole) in products("two_body", &times(100)) {
        assert!(
            (product.abs() - whole.abs()).abs() < 1e-12,
            "{product} {whole}"
        );
    }
    let mut derived = description::system("two_body");
    let plan = linkwright_codegen::stages::structure::plan(
        &mut derived.pool,
        &derived.system,
        Shift::Directions,
    )
    .expect("a plan");
    let forms = forms_of(&mut derived.pool, &derived.system, &plan);
    let poses = derivation::singular_poses(
        &derived.pool,
        &derived.system,
        &plan,
        &forms,
        Script::Text(Notation::Unicode),
    );
    assert_eq!(poses.len(), 1);
    assert_eq!(poses[0].determinant.as_deref(), Some("√3·sin φ₂"));
}
