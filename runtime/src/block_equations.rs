//! The equations of a fixed number of unknowns, as arrays.
//!
//! Generated code states its equations in the unknowns' own names, which a function takes out of an array. Each of its types is one
//! of [`Equations`](crate::Equations) too, by a macro. The module does not know how they are solved.

use nalgebra::SMatrix;

/// N equations for N unknowns, and their derivatives, as [`Equations`](crate::Equations) wants them.
pub trait BlockEquations<T, const N: usize> {
    /// Φ: zero where the equations hold.
    fn residual(&self, q: &[T; N], t: T) -> [T; N];

    /// ∂Φ/∂q: one row per equation, one column per unknown.
    fn jacobian(&self, q: &[T; N], t: T) -> SMatrix<T, N, N>;

    /// ∂Φ/∂t with the unknowns held.
    fn time_derivative(&self, q: &[T; N], t: T) -> [T; N];

    /// γ, which Φ_q q̈ is equal to.
    fn gamma(&self, q: &[T; N], qd: &[T; N], t: T) -> [T; N];

    /// The positive magnitude by which each residual is scaled.
    fn row_scales(&self) -> [T; N];

    /// The positive magnitude by which a change of each unknown is scaled.
    fn column_scales(&self) -> [T; N];

    /// Which unknowns are angles.
    fn angles(&self) -> [bool; N] {
        [false; N]
    }
}
