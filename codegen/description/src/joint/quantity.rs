//! What a value or a residual is measured in.

/// What a value is measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Metres.
    Length,
    /// Radians.
    Angle,
    /// Metres to a power other than one: 2 for squared distances, 0 for ratios.
    Power(i32),
}

impl Quantity {
    /// The power of the characteristic length that values of this quantity are judged against.
    pub fn power_of_length(self) -> i32 {
        match self {
            Quantity::Length => 1,
            Quantity::Angle => 0,
            Quantity::Power(exponent) => exponent,
        }
    }
}
