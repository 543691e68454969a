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

    /// Returns the SI unit: `m`, `rad`, `m^2`; empty for plain numbers.
    pub fn unit(self) -> String {
        match self {
            Quantity::Length => "m".to_string(),
            Quantity::Angle => "rad".to_string(),
            Quantity::Power(0) => String::new(),
            Quantity::Power(exponent) => format!("m^{exponent}"),
        }
    }
}
