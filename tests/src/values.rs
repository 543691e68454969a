//! Converts plain numbers to the values of a mechanism's own types, and back, so that code is written once for any
//! mechanism.
//!
//! The file imports only the runtime, because it is compiled in two places, as [`crate::hunt::ways`] is.

use linkwright::math::Real;
use linkwright::{Blocks, Failure, Mechanism, Settings, Shell, Values};

/// q, q̇ and q̈.
pub type Levels = [Vec<f64>; 3];

/// Values that begin with these numbers.
pub fn filled<T: Real, V: Values<T>>(mut values: V, numbers: &[f64]) -> V {
    for (index, number) in numbers.iter().enumerate() {
        values.set(index, T::from_f64(*number));
    }
    values
}

/// All values in order.
pub fn numbers<T: Real, V: Values<T>>(values: &V) -> Vec<f64> {
    let all = (0..values.count()).filter_map(|index| values.value(index));
    all.map(T::to_f64).collect()
}

/// The pose with these coordinates.
pub fn pose<B: Blocks>(blocks: &B, coordinates: &[f64]) -> B::Coordinates {
    filled(blocks.drawn_pose(&blocks.nominal_parameters()), coordinates)
}

/// The coordinates of a frame that holds them all, with their rates and accelerations.
pub fn levels<B: Blocks>(blocks: &B, frame: &B::Frame) -> Levels {
    let mut levels: Levels = Default::default();
    let all = (0..).map_while(|index| blocks.coordinate(frame, index));
    for coordinate in all {
        for (level, value) in levels.iter_mut().zip(coordinate) {
            level.push(value.to_f64());
        }
    }
    levels
}

/// The names of the points whose motion frames offer.
pub fn point_names<B: Blocks>(blocks: &B) -> Vec<&str> {
    (0..).map_while(|index| blocks.point_name(index)).collect()
}

/// Mechanism with its nominal parameters and its inputs at rest, in the branches of its design configuration and near
/// this pose.
///
/// # Errors
/// If it cannot be assembled so.
pub fn assembled_from<B: Blocks>(
    blocks: B,
    estimate: &[f64],
    t: f64,
    settings: Settings<B::Scalar>,
) -> Result<Shell<B>, Failure<B::Scalar>> {
    let inputs = blocks.initial_inputs();
    assembled_with(blocks, estimate, t, &inputs, settings)
}

/// Mechanism with these inputs, in the branches of its design configuration and near this pose.
///
/// # Errors
/// If it cannot be assembled so.
pub fn assembled_with<B: Blocks>(
    blocks: B,
    estimate: &[f64],
    t: f64,
    inputs: &B::Inputs,
    settings: Settings<B::Scalar>,
) -> Result<Shell<B>, Failure<B::Scalar>> {
    let parameters = blocks.nominal_parameters();
    let (estimate, branches) = (pose(&blocks, estimate), blocks.drawn_branches());
    let t = B::Scalar::from_f64(t);
    Shell::assemble(
        blocks,
        &parameters,
        &estimate,
        branches,
        t,
        inputs,
        settings,
    )
}

/// Generated mechanism in its design configuration, with the inputs of its description.
///
/// # Errors
/// If it cannot be assembled so.
pub fn assembled<M>(t: f64) -> Result<M, Failure<<M::Blocks as Blocks>::Scalar>>
where
    M: Mechanism<Blocks: Default>,
    Settings<<M::Blocks as Blocks>::Scalar>: Default,
{
    // Unchanged values are those of the design configuration.
    assembled_from(M::Blocks::default(), &[], t, Settings::default()).map(M::from_shell)
}
