//! The type that a user holds, and how the runtime sees the equations.

use proc_macro2::TokenStream;
use quote::quote;

use super::docs::docs;
use super::expression::identifier;
use super::given::{Given, access, drawn_pose, finite_check, kept_in_frame, only};
use super::literal::{count, float};
use crate::joint::Quantity;
use crate::model::type_name;
use crate::program::Program;
use crate::system::{Coordinate, System};

/// What lengths are judged against.
pub(super) fn characteristic_length(system: &System) -> TokenStream {
    let length = float(system.mechanism.characteristic_length);
    quote! {
        /// The largest coordinate in the drawing, in m: residuals in m are judged against it.
        const CHARACTERISTIC_LENGTH: f64 = #length;
    }
}

/// What values of a quantity are judged against.
pub(super) fn scale(quantity: Quantity) -> TokenStream {
    let power = quantity.power_of_length();
    let product = (1..power.unsigned_abs()).fold(
        quote!(CHARACTERISTIC_LENGTH),
        |product, _| quote!(#product * CHARACTERISTIC_LENGTH),
    );
    match power {
        0 => quote!(1.0),
        1.. => product,
        _ => quote!(1.0 / (#product)),
    }
}

/// `struct Textbook`: the dense system as the runtime solves it.
pub(super) fn textbook(system: &System) -> TokenStream {
    let size = count(system.rows.len());
    let given = Given::of(system);
    let (fields, passed) = (given.fields(), given.of_self());
    let structure = if given.any() {
        quote!(pub struct Textbook { #fields })
    } else {
        quote!(
            pub struct Textbook;
        )
    };
    let scales = system.rows.iter().map(|row| scale(row.quantity));
    let column_scales = system
        .coordinates
        .iter()
        .map(|coordinate| scale(coordinate.quantity));
    let is_pose = |coordinate: &Coordinate| coordinate.describes.body().is_some();
    let coordinate_scale = if system.coordinates.iter().all(is_pose) {
        quote!(if column % 3 == 2 {
            1.0
        } else {
            CHARACTERISTIC_LENGTH
        })
    } else {
        quote! {
            const SCALES: [f64; #size] = [#(#column_scales),*];
            SCALES.get(column).copied().unwrap_or(1.0)
        }
    };
    quote! {
        /// What the residual of each row is judged against.
        const ROW_SCALES: [f64; #size] = [#(#scales),*];

        /// All equations as one dense system, as `linkwright::newton` solves it.
        #[derive(Clone, Copy, Debug, Default)]
        #structure

        impl Textbook {
            fn named(values: &SVector<f64, #size>) -> Coordinates {
                Coordinates::from_array(values.data.0[0])
            }
        }

        impl Equations<f64, Const<#size>> for Textbook {
            fn dimension(&self) -> Const<#size> {
                Const
            }

            fn residual(&self, q: &SVector<f64, #size>, t: f64, residual: &mut SVector<f64, #size>) {
                *residual = phi(&Self::named(q), #passed t);
            }

            fn jacobian(&self, q: &SVector<f64, #size>, t: f64, jacobian: &mut SMatrix<f64, #size, #size>) {
                *jacobian = phi_q(&Self::named(q), #passed t);
            }

            fn time_derivative(&self, q: &SVector<f64, #size>, t: f64, derivative: &mut SVector<f64, #size>) {
                *derivative = phi_t(&Self::named(q), #passed t);
            }

            fn gamma(
                &self,
                q: &SVector<f64, #size>,
                qd: &SVector<f64, #size>,
                t: f64,
                right_hand_side: &mut SVector<f64, #size>,
            ) {
                *right_hand_side = gamma(&Self::named(q), &Self::named(qd), #passed t);
            }

            fn row_scale(&self, row: usize) -> f64 {
                ROW_SCALES.get(row).copied().unwrap_or(1.0)
            }

            fn coordinate_scale(&self, column: usize) -> f64 {
                #coordinate_scale
            }
        }
    }
}

/// The mechanism's own type.
pub(super) fn mechanism(system: &System, program: &Program) -> TokenStream {
    let size = count(system.rows.len());
    let name = identifier(&type_name(&system.mechanism.name));
    let mut lines = system.mechanism.docs.clone();
    if lines.is_empty() {
        lines.push(format!("The mechanism `{}`.", system.mechanism.name));
    }
    let text = docs(lines);
    let given = Given::of(system);
    let field = only(given.parameters, quote!(parameters: Parameters,));
    let kept = only(given.parameters, quote!(parameters: *parameters,));
    let (with, passed) = (given.parameters_declared(), given.parameters_passed());
    let (inputs, inputs_passed) = (given.inputs_declared(), given.inputs_passed());
    let (equations, own) = (given.copied(), own_parameters(given));
    let nominal = only(
        given.parameters,
        quote!(let parameters = &Parameters::NOMINAL;),
    );
    let in_frame = only(kept_in_frame(program), quote!(parameters: *parameters,));
    let (frame_with, frame_passed) = if kept_in_frame(program) {
        (quote!(, parameters: &Parameters), quote!(, parameters))
    } else {
        Default::default()
    };
    let (drawn, check, access) = (
        drawn_pose(program),
        finite_check(system),
        access(system, &TokenStream::new()),
    );
    let start = quote! {
        #check
        let estimate = SVector::from(estimate.to_array());
        let solved = kinematics::assemble(&Textbook #equations, &estimate, t, &settings)?;
        Ok(Self { frame: Self::frame_of(&solved #frame_passed), #kept settings })
    };
    let (start, with_parameters) = if given.parameters {
        let variant = quote! {
            /// Assembles the mechanism of these parameters at time `t` (s), starting from a measured or estimated pose.
            ///
            /// # Errors
            /// A [`Failure`] where no pose near the estimate satisfies the equations.
            pub fn assemble_with(
                #with
                estimate: &Coordinates,
                t: f64
                #inputs,
                settings: Settings,
            ) -> Result<Self, Failure> {
                #start
            }
        };
        let call = quote!(Self::assemble_with(#passed estimate, t #inputs_passed, settings));
        (quote!(#nominal #call), variant)
    } else {
        (start, TokenStream::new())
    };
    quote! {
        #text
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name {
            frame: Frame,
            #field
            settings: Settings,
        }

        #[allow(dead_code)]
        impl #name {
            /// Assembles the mechanism at time `t` (s), starting from the drawing.
            ///
            /// # Errors
            /// A [`Failure`] where no pose near the drawing satisfies the equations.
            pub fn assemble(t: f64 #inputs) -> Result<Self, Failure> {
                #nominal
                Self::assemble_from(#drawn, t #inputs_passed, Settings::default())
            }

            /// Assembles the mechanism at time `t` (s), starting from a measured or estimated pose.
            ///
            /// # Errors
            /// A [`Failure`] where no pose near the estimate satisfies the equations.
            pub fn assemble_from(estimate: &Coordinates, t: f64 #inputs, settings: Settings) -> Result<Self, Failure> {
                #start
            }

            #with_parameters

            /// Moves the mechanism to time `t` (s), starting from the last frame, which a failure leaves as it is.
            ///
            /// # Errors
            /// A [`Failure`] where the equations cannot be solved from there.
            pub fn advance(&mut self, t: f64 #inputs) -> Result<&Frame, Failure> {
                #own
                #check
                let last = kinematics::Frame {
                    t: self.frame.t,
                    q: SVector::from(self.frame.q.to_array()),
                    qd: SVector::from(self.frame.qd.to_array()),
                    qdd: SVector::from(self.frame.qdd.to_array()),
                };
                let solved = kinematics::advance(&Textbook #equations, &last, t, &self.settings)?;
                self.frame = Self::frame_of(&solved #frame_passed);
                Ok(&self.frame)
            }

            /// The last solved instant.
            pub fn frame(&self) -> &Frame {
                &self.frame
            }

            #access

            /// One Newton-Raphson step from the pose `q` at time `t` (s), with its matrix and right-hand side.
            ///
            /// # Errors
            /// A [`Failure`] where the Jacobian is singular.
            pub fn newton_step(q: &Coordinates, #with t: f64 #inputs) -> Result<Step<f64, Const<#size>>, Failure> {
                newton::step(&Textbook #equations, &SVector::from(q.to_array()), t, &Settings::default())
            }

            fn frame_of(solved: &kinematics::Frame<f64, Const<#size>> #frame_with) -> Frame {
                Frame {
                    t: solved.t,
                    q: Textbook::named(&solved.q),
                    qd: Textbook::named(&solved.qd),
                    qdd: Textbook::named(&solved.qdd),
                    #in_frame
                }
            }
        }
    }
}

/// The parameters of the type that a user holds.
pub(super) fn own_parameters(given: Given) -> TokenStream {
    only(given.parameters, quote!(let parameters = &self.parameters;))
}
