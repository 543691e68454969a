//! Defines quantities of values and residuals.

/// Quantity of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Length in m.
    Length,
    /// Angle in rad.
    Angle,
    /// Length to a power other than one: 2 for squared distances, 0 for ratios.
    Power(i32),
}

impl Quantity {
    /// Returns the power of the characteristic length that scales tolerances of this quantity.
    pub fn power_of_length(self) -> i32 {
        match self {
            Quantity::Length => 1,
            Quantity::Angle => 0,
            Quantity::Power(exponent) => exponent,
        }
    }
}
