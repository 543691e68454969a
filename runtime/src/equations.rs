//! Declares [`Equations`], the functions of pose and time that a solve evaluates.
//!
//! [`Equations`] is the boundary between a mechanism, generated or interpreted, and the numerical code of this crate.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use crate::math::Real;

/// Constraint and driver equations Φ(q, t) = 0 of a mechanism, as many as it has coordinates, and their derivatives.
///
/// `D` is the number of coordinates: `Const<N>` for a mechanism known at compile time, which needs no allocator, or
/// `Dyn`. Symbols follow Haug, *Computer-Aided Kinematics and Dynamics of Mechanical Systems* (1989), chapter 3.
///
/// Vectors and matrices that a function fills arrive with unspecified contents, and every entry must be written.
pub trait Equations<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Returns the number n of coordinates and of equations.
    fn dimension(&self) -> D;

    /// Fills `phi` (n) with the residual Φ(q, t): zero if the constraints hold.
    fn residual(&self, q: &OVector<T, D>, t: T, phi: &mut OVector<T, D>);

    /// Fills `phi_q` (n × n) with the Jacobian ∂Φ/∂q: one row per equation, one column per coordinate.
    ///
    /// Every entry must be written, zeros too: the matrix still holds the Jacobian of an earlier pose.
    fn jacobian(&self, q: &OVector<T, D>, t: T, phi_q: &mut OMatrix<T, D, D>);

    /// Fills `phi_t` (n) with the partial time derivative ∂Φ/∂t; the velocity solves Φ_q q̇ = -Φ_t.
    fn time_derivative(&self, q: &OVector<T, D>, t: T, phi_t: &mut OVector<T, D>);

    /// Fills `gamma` (n) with γ = -((Φ_q q̇)_q q̇ + 2 Φ_qt q̇ + Φ_tt); the acceleration solves Φ_q q̈ = γ.
    fn gamma(&self, q: &OVector<T, D>, qd: &OVector<T, D>, t: T, gamma: &mut OVector<T, D>);

    /// Positive magnitude that the residual of `row` is measured against: the characteristic length of the mechanism
    /// for an equation between lengths, 1 for one between angles.
    fn row_scale(&self, row: usize) -> T;

    /// Positive magnitude that a change of the coordinate `column` is measured against: the characteristic length for x
    /// and y, 1 for an angle.
    fn coordinate_scale(&self, column: usize) -> T;

    /// True if whole turns (2π) of the coordinate `column` leave the pose unchanged.
    fn is_angle(&self, _column: usize) -> bool {
        false
    }
}
