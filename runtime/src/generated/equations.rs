//! Implements [`Equations`](crate::Equations) for a generated type that implements
//! [`BlockEquations`](crate::generated::BlockEquations).
//!
//! A module does so for each of its types. A blanket implementation would prevent callers from implementing
//! [`Equations`](crate::Equations) for a scalar or a dimension of their choice.

/// Equations of a type, which states them as arrays, for the solvers. A type that borrows has a lifetime.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_equations {
    ($name:ident, $($lifetime:lifetime,)? $size:literal) => {
        impl $crate::Equations<Scalar, Const<$size>> for $name$(<$lifetime>)? {
            #[inline]
            fn dimension(&self) -> Const<$size> {
                Const
            }

            #[inline]
            fn residual(&self, q: &Vector<$size>, t: Scalar, phi: &mut Vector<$size>) {
                phi.data.0 = [BlockEquations::residual(self, &q.data.0[0], t)];
            }

            #[inline]
            fn jacobian(&self, q: &Vector<$size>, t: Scalar, phi_q: &mut Matrix<$size, $size>) {
                *phi_q = BlockEquations::jacobian(self, &q.data.0[0], t);
            }

            #[inline]
            fn time_derivative(&self, q: &Vector<$size>, t: Scalar, phi_t: &mut Vector<$size>) {
                phi_t.data.0 = [BlockEquations::time_derivative(self, &q.data.0[0], t)];
            }

            #[inline]
            fn gamma(
                &self,
                q: &Vector<$size>,
                qd: &Vector<$size>,
                t: Scalar,
                gamma: &mut Vector<$size>,
            ) {
                gamma.data.0 = [BlockEquations::gamma(self, &q.data.0[0], &qd.data.0[0], t)];
            }

            #[inline]
            fn row_scale(&self, row: usize) -> Scalar {
                self.row_scales().get(row).copied().unwrap_or(1.0)
            }

            #[inline]
            fn coordinate_scale(&self, column: usize) -> Scalar {
                self.column_scales().get(column).copied().unwrap_or(1.0)
            }

            #[inline]
            fn is_angle(&self, column: usize) -> bool {
                self.angles().get(column).copied().unwrap_or(false)
            }
        }
    };
}
