//! Characters of formulas in plain text.

/// Notation of plain text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Notation {
    /// `x1 + cos(phi1) - x2 + sqrt(3)*cos(phi2)`
    #[default]
    Ascii,
    /// `x₁ + cos φ₁ − x₂ + √3·cos φ₂`
    Unicode,
}
