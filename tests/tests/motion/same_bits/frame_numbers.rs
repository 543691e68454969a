//! Lists every number of a frame of generated code, private ones included.

use std::fmt::Debug;

/// Numbers of a value in the order of its fields.
///
/// `Debug` writes the shortest text of each number that is read as the same bits.
pub fn numbers_of(value: &impl Debug) -> Vec<f64> {
    let text = format!("{value:?}");
    let tokens = text.split([' ', ',', '[', ']', '(', ')', '{', '}']);
    // Names of fields end with a colon.
    tokens.filter_map(|token| token.parse().ok()).collect()
}

#[test]
fn every_number_is_found_with_its_bits() {
    #[derive(Debug)]
    #[allow(dead_code)]
    struct Inner {
        inf: f64,
        x1: [f64; 2],
    }
    let value = (
        -0.0,
        Inner {
            inf: f64::NEG_INFINITY,
            x1: [0.1 + 0.2, 5e-324],
        },
    );
    let bits = |values: &[f64]| values.iter().map(|it| it.to_bits()).collect::<Vec<_>>();
    let expected = [-0.0, f64::NEG_INFINITY, 0.1 + 0.2, 5e-324];
    assert_eq!(bits(&numbers_of(&value)), bits(&expected));
}
