//! Equations of a fixed number of unknowns, as arrays.
//!
//! Generated code states its equations in the unknowns' own names, which a function takes out of an array. A macro
//! implements [`Equations`](crate::Equations) for each of its types.

use nalgebra::SMatrix;

/// N equations for N unknowns, and their derivatives, in the form that [`Equations`](crate::Equations) needs.
pub trait BlockEquations<T, const N: usize> {
    /// Φ: zero if the equations hold.
    fn residual(&self, q: &[T; N], t: T) -> [T; N];

    /// ∂Φ/∂q: one row per equation, one column per unknown.
    fn jacobian(&self, q: &[T; N], t: T) -> SMatrix<T, N, N>;

    /// ∂Φ/∂t at constant unknowns.
    fn time_derivative(&self, q: &[T; N], t: T) -> [T; N];

    /// γ, the right-hand side of Φ_q q̈ = γ.
    fn gamma(&self, q: &[T; N], qd: &[T; N], t: T) -> [T; N];

    /// Positive magnitude by which each residual is scaled.
    fn row_scales(&self) -> [T; N];

    /// Positive magnitude by which a change of each unknown is scaled.
    fn column_scales(&self) -> [T; N];

    /// True for unknowns that are angles.
    fn angles(&self) -> [bool; N] {
        [false; N]
    }
}
