//! Estimates that differ from the design configuration by up to half a radian and half a link in every coordinate.

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::Derived;
use nalgebra::DVector;

use crate::random::Random;

/// The seed of the first start; each start has its own.
pub const SEED: u64 = 0x7374_6172_7473;

/// The length of a link: the longest distance between two points of a body, for the median of the bodies that carry two.
pub fn link(derived: &Derived) -> f64 {
    let mechanism = &derived.system.mechanism;
    let value = |id| derived.pool.graph.constant_value(id).unwrap_or(f64::NAN);
    let mut lengths: Vec<f64> = mechanism.bodies[1..]
        .iter()
        .map(|body| {
            let points: Vec<[f64; 2]> = body
                .marks
                .iter()
                .map(|mark| mark.mark.local.map(value))
                .collect();
            let pairs = points
                .iter()
                .flat_map(|a| points.iter().map(move |b| (a[0] - b[0]).hypot(a[1] - b[1])));
            pairs.fold(0.0, f64::max)
        })
        .filter(|length| *length > 0.0)
        .collect();
    lengths.sort_by(f64::total_cmp);
    let middle = lengths.get(lengths.len() / 2).copied();
    middle.unwrap_or(mechanism.characteristic_length)
}

/// By how much each coordinate is off at most: half a link, half a radian.
pub fn reach(derived: &Derived) -> Vec<f64> {
    let link = link(derived);
    let coordinates = derived.system.coordinates.iter();
    coordinates
        .map(|it| match it.quantity {
            Quantity::Length => 0.5 * link,
            Quantity::Angle | Quantity::Power(_) => 0.5,
        })
        .collect()
}

/// The estimate of the start with this number.
pub fn estimate(drawn: &DVector<f64>, reach: &[f64], number: u32) -> DVector<f64> {
    let mut random = Random::new(SEED.wrapping_add(u64::from(number) << 20));
    let reach = DVector::from_column_slice(reach);
    drawn.zip_map(&reach, |drawn, reach| {
        drawn + reach * random.between(-1.0, 1.0)
    })
}
