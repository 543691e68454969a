//! Draws parameters from their distributions.

use std::f64::consts::TAU;

use linkwright_codegen::stages::model::Distribution;

use super::first_order::Toleranced;
use crate::sets::{BITS, Sobol, normal_quantile, random_coordinate};

/// Sequence from which mechanisms are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Sobol's sequence, scrambled as Owen does.
    Sobol,
    /// Independent random numbers.
    Random,
}

/// Sampled parameters of mechanisms, each by its index.
#[derive(Clone, Debug)]
pub struct ToleranceSamples<'a> {
    toleranced: &'a [Toleranced],
    /// Sequence; `None` for independent random numbers.
    sobol: Option<Sobol>,
    seed: u64,
}

impl<'a> ToleranceSamples<'a> {
    /// Creates the samples of these parameters; `None` for more parameters than Sobol's sequence has dimensions.
    pub fn new(
        toleranced: &'a [Toleranced],
        sampling: Sampling,
        seed: u64,
    ) -> Option<ToleranceSamples<'a>> {
        let sobol = match sampling {
            Sampling::Sobol => Some(Sobol::new(toleranced.len(), Some(seed))?),
            Sampling::Random => None,
        };
        Some(ToleranceSamples {
            toleranced,
            sobol,
            seed,
        })
    }

    /// Writes the values of a mechanism over its nominal parameters.
    pub fn write(&self, index: u32, parameters: &mut [f64]) {
        let share = |dimension: usize| match &self.sobol {
            // The middle of its interval: neither 0 nor 1.
            Some(sobol) => sobol.coordinate(index, dimension) + 0.5 / (1_u64 << BITS) as f64,
            None => random_coordinate(self.seed, index, dimension),
        };
        for (dimension, it) in self.toleranced.iter().enumerate() {
            let departure = match it.distribution {
                Distribution::Clearance { radius, axis } => {
                    // The first component has the distance in its share, the second one the direction.
                    let first = dimension - axis;
                    let (sine, cosine) = (TAU * share(first + 1)).sin_cos();
                    radius * share(first).sqrt() * [cosine, sine][axis]
                }
                Distribution::Uniform { half_width } => half_width * (2.0 * share(dimension) - 1.0),
                Distribution::Normal { deviation } => deviation * normal_quantile(share(dimension)),
            };
            parameters[it.parameter] = it.nominal + departure;
        }
    }
}
