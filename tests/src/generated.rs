//! *The compiled modules of `linkwright-mechanisms`* → *one list*, each module wrapped as a [`Solver`].
//!
//! Modules have no names at run time, so the build script writes the list from the descriptions.

use linkwright::{Failure, Frame, Motion, Settings, Step};
use nalgebra::{DMatrix, DVector, Dyn};

use crate::solver::{Functions, Solver};

/// A compiled module.
pub struct Module {
    /// The mechanism's name.
    pub name: &'static str,
    /// Its points, in the order of their declaration.
    pub points: &'static [&'static str],
    /// Makes a solver that is not yet assembled.
    pub make: fn() -> Box<dyn Solver>,
    /// The pose to which the mechanism is assembled from an estimate at a time, in the modes of the drawing.
    pub assemble_from: fn(&[f64], f64) -> Result<Vec<f64>, Failure>,
}

/// The module of a mechanism.
///
/// # Panics
/// If the list lacks it.
pub fn module(name: &str) -> &'static Module {
    MODULES
        .iter()
        .find(|module| module.name == name)
        .unwrap_or_else(|| panic!("`{name}` is not compiled"))
}

macro_rules! registry {
    ($($module:ident: $mechanism:ident { $($point:literal => $motion:ident,)+ })+) => {
        /// Every compiled module.
        pub const MODULES: &[Module] = &[$(Module {
            name: stringify!($module),
            points: &[$($point),+],
            make: || Box::new($module::Generated::default()),
            assemble_from: $module::assemble_from,
        }),+];

        $(mod $module {
            use linkwright::Equations;
            use linkwright_mechanisms::$module::{self as generated, $mechanism, Coordinates};
            use nalgebra::SVector;

            use super::*;

            const N: usize = Coordinates::COUNT;

            /// The generated solver, and its last frame as vectors.
            #[derive(Default)]
            pub struct Generated(Option<($mechanism, Frame<f64, Dyn>)>);

            fn named(values: &[f64]) -> Coordinates {
                Coordinates::from_array(values.try_into().expect("a value per coordinate"))
            }

            pub fn assemble_from(estimate: &[f64], t: f64) -> Result<Vec<f64>, Failure> {
                let mechanism = $mechanism::assemble_from(&named(estimate), t, Settings::default())?;
                Ok(mechanism.frame().q.to_array().to_vec())
            }

            impl Generated {
                fn store(&mut self, mechanism: $mechanism) {
                    let frame = mechanism.frame();
                    let vector = |it: &Coordinates| DVector::from_column_slice(&it.to_array());
                    let (q, qd, qdd) = (vector(&frame.q), vector(&frame.qd), vector(&frame.qdd));
                    let frame = Frame { t: frame.t, q, qd, qdd };
                    self.0 = Some((mechanism, frame));
                }

                fn solved(&self) -> &($mechanism, Frame<f64, Dyn>) {
                    self.0.as_ref().expect("the mechanism has been assembled")
                }
            }

            impl Solver for Generated {
                fn kind(&self) -> &'static str {
                    "generated"
                }

                fn functions(&self, q: &[f64], qd: &[f64], t: f64) -> Functions {
                    let (q, qd) = (named(q), named(qd));
                    let vector = |it: SVector<f64, N>| DVector::from_column_slice(it.as_slice());
                    let phi_q = generated::phi_q(&q, t);
                    let functions = Functions {
                        phi: vector(generated::phi(&q, t)),
                        phi_q: DMatrix::from_column_slice(N, N, phi_q.as_slice()),
                        phi_t: vector(generated::phi_t(&q, t)),
                        gamma: vector(generated::gamma(&q, &qd, t)),
                    };
                    // The interface of the runtime must give what the free functions give.
                    let mut jacobian = phi_q * f64::NAN;
                    generated::Textbook.jacobian(&SVector::from(q.to_array()), t, &mut jacobian);
                    assert_eq!(jacobian, phi_q);
                    functions
                }

                fn residual(&self, q: &[f64], t: f64) -> DVector<f64> {
                    DVector::from_column_slice(generated::phi(&named(q), t).as_slice())
                }

                fn assemble(&mut self, t: f64) {
                    self.store($mechanism::assemble(t).unwrap_or_else(|failure| panic!("{failure}")));
                }

                fn advance(&mut self, t: f64) {
                    let mut mechanism = self.solved().0;
                    if let Err(failure) = mechanism.advance(t) {
                        panic!("{failure}");
                    }
                    self.store(mechanism);
                }

                fn frame(&self) -> &Frame<f64, Dyn> {
                    &self.solved().1
                }

                fn point(&self, name: &str) -> Motion {
                    let frame = self.solved().0.frame();
                    match name {
                        $($point => frame.$motion(),)+
                        _ => panic!("no point {name}"),
                    }
                }

                fn newton_step(&self, q: &[f64], t: f64) -> Step<f64, Dyn> {
                    let step = $mechanism::newton_step(&named(q), t).unwrap_or_else(|failure| panic!("{failure}"));
                    let vector = |it: SVector<f64, N>| DVector::from_column_slice(it.as_slice());
                    Step {
                        jacobian: DMatrix::from_column_slice(N, N, step.jacobian.as_slice()),
                        right_hand_side: vector(step.right_hand_side),
                        update: vector(step.update),
                        pose: vector(step.pose),
                    }
                }
            }
        })+
    };
}

include!(concat!(env!("OUT_DIR"), "/registry.rs"));
