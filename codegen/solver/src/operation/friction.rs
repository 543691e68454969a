//! Solves for the forces of friction from registers.

use linkwright::FailureKind;
use linkwright::generated::friction;
use linkwright_codegen::stages::expr::Register;
use nalgebra::DVector;

/// Joints with friction, pins before slides.
#[derive(Clone, Debug)]
pub(crate) struct FrictionJoints {
    /// Number of pins.
    pub pins: usize,
    /// Forces over the magnitudes of reactions, with the sign of what resists sliding.
    pub coefficients: Vec<Register>,
    /// Both components of each reaction without friction.
    pub alone: Vec<[Register; 2]>,
    /// Components of each reaction to a unit of each force, joint by joint.
    pub units: Vec<[Register; 2]>,
}

impl FrictionJoints {
    /// Returns the forces, given the value of each register.
    pub fn forces(&self, of: impl Fn(Register) -> f64) -> Result<DVector<f64>, FailureKind> {
        let count = self.coefficients.len();
        let coefficients = self.coefficients.iter().map(|&it| of(it));
        let coefficients = DVector::from_iterator(count, coefficients);
        let values = |pairs: &[[Register; 2]]| -> Vec<[f64; 2]> {
            pairs.iter().map(|pair| pair.map(&of)).collect()
        };
        let (alone, units) = (values(&self.alone), values(&self.units));
        friction::settle(self.pins, &coefficients, &alone, &units)
    }

    /// Returns all registers that are read.
    pub fn read(&self) -> impl Iterator<Item = Register> {
        let pairs = self.alone.iter().chain(&self.units).flatten();
        self.coefficients.iter().chain(pairs).copied()
    }
}
