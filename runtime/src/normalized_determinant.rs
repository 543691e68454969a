//! The measures of a mechanism's blocks → the block that is closest to a singular pose, with its name.
//!
//! A mechanism whose description says `monitor;` offers its [`NormalizedDeterminant`] with every frame. The number goes to zero as the
//! distance to the singular pose does, and is comparable between blocks and mechanisms: the sine of an angle, or what takes
//! its place where more than two vectors are concerned ([`Measure`]). At 0.1 a rate, a force and an error of the drivers are
//! magnified about ten times.
//!
//! The module does not know how measures are found.

use core::fmt;

use crate::failure_message::BlockName;
use crate::linear::Measure;
use crate::math::Real;

/// How close a block of equations is to a singular pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalizedDeterminant<T = f64> {
    /// The block, in solve order, as a [`crate::Failure`] counts it.
    pub block: u16,
    /// The block's determinant divided by the lengths of the columns of its Jacobian, from -1 to 1. Its sign is that of the
    /// assembly mode.
    pub determinant: T,
    /// The reciprocal condition of the Jacobian with columns of length 1, from 0 to 1; for a block in closed form the same as
    /// the size of the determinant.
    pub reciprocal_condition: T,
    /// What the block is called, and what can be said of it where it is singular.
    pub name: BlockName<'static>,
}

/// What the normalized determinant of a mechanism is named after that nothing can bring to a singular pose.
const EVERYTHING: BlockName<'static> = BlockName {
    name: "the mechanism",
    singular: "",
};

impl<T: Real> NormalizedDeterminant<T> {
    /// That of a block with this measure.
    #[inline]
    pub fn new(block: u16, measure: Measure<T>, name: BlockName<'static>) -> Self {
        Self {
            block,
            determinant: measure.determinant,
            reciprocal_condition: measure.reciprocal_condition,
            name,
        }
    }

    /// The closest of all blocks, the first of equal ones. Where there is no block that can be singular, its numbers are 1.
    pub fn closest(blocks: &[Self]) -> Self {
        let mut found = Self::new(0, Measure::sine(T::ONE), EVERYTHING);
        for (place, block) in blocks.iter().enumerate() {
            if place == 0 || block.reciprocal_condition < found.reciprocal_condition {
                found = *block;
            }
        }
        found
    }

    /// Whether the reciprocal condition is below `limit`. True for a limit that is no number.
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
    fn what_has_no_loop_is_never_singular() {
        let none = NormalizedDeterminant::<f32>::closest(&[]);
        assert_eq!((none.determinant, none.reciprocal_condition), (1.0, 1.0));
        assert_eq!(none.to_string(), "the mechanism: never singular");
        assert!(!none.is_below(1.0));
    }
}
