//! Declares the textbook formulation: Φ, Φ_q, Φ_t and γ of a module as one dense system.

/// All equations as one type, with their Newton-Raphson steps as a function of the mechanism's type.
///
/// The module supplies `Coordinates` and the functions `phi`, `phi_q`, `phi_t` and `gamma`.
#[doc(hidden)]
#[macro_export]
macro_rules! generated_textbook {
    (@structure) => {
        /// All equations as one dense system, as `linkwright::newton` solves it.
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct Textbook;
    };
    (@structure $($fields:tt)+) => {
        /// All equations as one dense system, as `linkwright::newton` solves it.
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct Textbook {
            $($fields)+
        }
    };
    (
        $mechanism:ident, $size:literal;
        parameters: $($parameters:ident)?;
        inputs: $($inputs:ident)?;
        $(lengths: $length:ident = $of_parameters:ident(parameters);)?
        rows: $rows:expr;
        columns: $columns:expr;
    ) => {
        $crate::generated::textbook! {
            @structure
            $(
                /// Parameters of the mechanism.
                pub parameters: $parameters,
            )?
            $(
                /// Signals at the time for which the equations are evaluated.
                pub inputs: $inputs,
            )?
        }

        impl BlockEquations<Scalar, $size> for Textbook {
            fn residual(&self, q: &[Scalar; $size], t: Scalar) -> [Scalar; $size] {
                let q = Coordinates::from_array(*q);
                phi(&q, $($crate::generated::only!(&self.parameters, $parameters),)? $($crate::generated::only!(&self.inputs, $inputs),)? t).data.0[0]
            }

            fn jacobian(&self, q: &[Scalar; $size], t: Scalar) -> Matrix<$size, $size> {
                let q = Coordinates::from_array(*q);
                phi_q(&q, $($crate::generated::only!(&self.parameters, $parameters),)? $($crate::generated::only!(&self.inputs, $inputs),)? t)
            }

            fn time_derivative(&self, q: &[Scalar; $size], t: Scalar) -> [Scalar; $size] {
                let q = Coordinates::from_array(*q);
                phi_t(&q, $($crate::generated::only!(&self.parameters, $parameters),)? $($crate::generated::only!(&self.inputs, $inputs),)? t).data.0[0]
            }

            fn gamma(&self, q: &[Scalar; $size], qd: &[Scalar; $size], t: Scalar) -> [Scalar; $size] {
                let (q, qd) = (Coordinates::from_array(*q), Coordinates::from_array(*qd));
                gamma(&q, &qd, $($crate::generated::only!(&self.parameters, $parameters),)? $($crate::generated::only!(&self.inputs, $inputs),)? t).data.0[0]
            }

            fn row_scales(&self) -> [Scalar; $size] {
                $(
                    #[allow(unused_variables)]
                    let $length = $of_parameters(&self.parameters);
                )?
                $rows
            }

            fn column_scales(&self) -> [Scalar; $size] {
                $(
                    #[allow(unused_variables)]
                    let $length = $of_parameters(&self.parameters);
                )?
                $columns
            }
        }

        $crate::generated::equations!(Textbook, $size);

        #[allow(dead_code)]
        impl $mechanism {
            /// Takes one Newton-Raphson step of the textbook formulation from the pose `q` at time `t` (s), with its
            /// matrix and right-hand side.
            ///
            /// # Errors
            /// Returns a [`Failure`] if the Jacobian is singular.
            pub fn newton_step(
                q: &Coordinates,
                $(parameters: &$parameters,)?
                t: Scalar
                $(, inputs: &$inputs)?
            ) -> Result<Step<$size>, Failure> {
                let equations = Textbook {
                    $(parameters: *$crate::generated::only!(parameters, $parameters),)?
                    $(inputs: *$crate::generated::only!(inputs, $inputs),)?
                };
                newton::step(&equations, &Vector::from(q.to_array()), t, &Settings::default())
            }
        }
    };
}
