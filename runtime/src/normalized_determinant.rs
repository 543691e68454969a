//! Selects the block of a mechanism that is closest to a singular pose.
//!
//! A mechanism whose description says `monitor;` offers its [`NormalizedDeterminant`] with every frame. The number goes
//! to zero with the distance to the singular pose, and is comparable between blocks and mechanisms. It is the sine of
//! an angle, or for more than two vectors the corresponding [`Measure`]. At 0.1, a rate, a force and an error of the
//! drivers are magnified about ten times.

use core::fmt;

use crate::failure_message::BlockName;
use crate::linear::Measure;
use crate::math::Real;

/// Distance of a block of equations from a singular pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalizedDeterminant<T = f64> {
    /// Block in solve order, as a [`crate::Failure`] counts it.
    pub block: u16,
    /// Determinant of the block divided by the lengths of the columns of its Jacobian, from -1 to 1. Its sign is that
    /// of the assembly mode.
    pub determinant: T,
    /// Reciprocal condition of the Jacobian with columns of length 1, from 0 to 1; for a block in closed form, the
    /// magnitude of the determinant.
    pub reciprocal_condition: T,
    /// Name of the block, with its state at a singular pose.
    pub name: BlockName<'static>,
}

/// Name for the normalized determinant of a mechanism that has no singular pose.
const EVERYTHING: BlockName<'static> = BlockName {
    name: "the mechanism",
    singular: "",
};

impl<T: Real> NormalizedDeterminant<T> {
    /// Returns the normalized determinant of a block with this measure.
    #[doc(hidden)]
    #[inline]
    pub fn new(block: u16, measure: Measure<T>, name: BlockName<'static>) -> Self {
        Self {
            block,
            determinant: measure.determinant,
            reciprocal_condition: measure.reciprocal_condition,
            name,
        }
    }

    /// Returns the block closest to singular, the first of equal ones. If no block can be singular, the numbers are 1.
    pub fn closest(blocks: &[Self]) -> Self {
        let mut closest = Self::new(0, Measure::sine(T::ONE), EVERYTHING);
        for (place, block) in blocks.iter().enumerate() {
            if place == 0 || block.reciprocal_condition < closest.reciprocal_condition {
                closest = *block;
            }
        }
        closest
    }

    /// True if the reciprocal condition is below `limit`, or if `limit` is NaN.
    #[inline]
    pub fn is_below(&self, limit: T) -> bool {
        // Written so that NaN warns.
        let is_clear = self.reciprocal_condition >= limit;
        !is_clear
    }
}

impl<T: Real> fmt::Display for NormalizedDeterminant<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let BlockName { name, singular } = self.name;
        if singular.is_empty() {
            return write!(formatter, "{name}: never singular");
        }
        write!(
            formatter,
            "{name}: {:.1e} from singular, where {singular}",
            self.reciprocal_condition
        )
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::string::ToString;

    use super::*;

    const LOOP: BlockName<'static> = BlockName {
        name: "loop F-N-M",
        singular: "c2 and the actuator c8-c7 are in line",
    };

    fn at(block: u16, sine: f64) -> NormalizedDeterminant {
        NormalizedDeterminant::new(block, Measure::sine(sine), LOOP)
    }

    #[test]
    fn the_closest_block_is_found_and_named() {
        let closest = NormalizedDeterminant::closest(&[at(1, 0.5), at(2, -0.125), at(3, 0.125)]);
        assert_eq!((closest.block, closest.determinant), (2, -0.125));
        assert_eq!(closest.reciprocal_condition, 0.125);
        assert_eq!(
            closest.to_string(),
            "loop F-N-M: 1.2e-1 from singular, where c2 and the actuator c8-c7 are in line"
        );
        assert!(closest.is_below(0.2) && !closest.is_below(0.125) && closest.is_below(f64::NAN));
    }

    #[test]
    fn mechanism_without_loops_is_never_singular() {
        let none = NormalizedDeterminant::<f32>::closest(&[]);
        assert_eq!((none.determinant, none.reciprocal_condition), (1.0, 1.0));
        assert_eq!(none.to_string(), "the mechanism: never singular");
        assert!(!none.is_below(1.0));
    }
}
