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
    if !system.lengths.is_empty() {
        return quote! {
            /// The largest coordinate in the drawing, in m.
            const CHARACTERISTIC_LENGTH: f64 = #length;
        };
    }
    quote! {
        /// The largest coordinate in the drawing, in m: residuals in m are judged against it.
        const CHARACTERISTIC_LENGTH: f64 = #length;
    }
}

/// What values of a quantity are judged against, with this for the characteristic length.
pub(super) fn scale(quantity: Quantity, length: &TokenStream) -> TokenStream {
    let power = quantity.power_of_length();
    let product =
        (1..power.unsigned_abs()).fold(length.clone(), |product, _| quote!(#product * #length));
    match power {
        0 => quote!(1.0),
        1.. => product,
        _ => quote!(1.0 / (#product)),
    }
}

/// `fn row_scale` or `fn coordinate_scale` that finds the scales of these quantities from `self.length`.
pub(super) fn scales_by_length(
    function: &str,
    place: &str,
    quantities: &[Quantity],
) -> TokenStream {
    let length = quote!(self.length);
    let mut powers: Vec<i32> = quantities.iter().map(|it| it.power_of_length()).collect();
    powers.sort_unstable();
    powers.dedup();
    let function = identifier(function);
    if let [_] = powers[..] {
        let (place, value) = (
            identifier(&format!("_{place}")),
            scale(quantities[0], &length),
        );
        return quote!(fn #function(&self, #place: usize) -> f64 { #value });
    }
    let place = identifier(place);
    let arms = powers.iter().filter(|power| **power != 0).map(|power| {
        let own = quantities.iter().enumerate();
        let own = own.filter(|(_, it)| it.power_of_length() == *power);
        let places = patterns(own.map(|(place, _)| place));
        let value = scale(Quantity::Power(*power), &length);
        quote!(#(#places)|* => #value,)
    });
    quote! {
        fn #function(&self, #place: usize) -> f64 {
            match #place { #(#arms)* _ => 1.0 }
        }
    }
}

/// Patterns for these ascending numbers: those that follow one another as a range.
fn patterns(places: impl Iterator<Item = usize>) -> Vec<TokenStream> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for place in places {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == place => *last = place,
            _ => runs.push((place, place)),
        }
    }
    let pattern = |(first, last): (usize, usize)| {
        let (from, to) = (count(first), count(last));
        match last - first {
            0 => quote!(#from),
            1 => quote!(#from | #to),
            _ => quote!(#from..=#to),
        }
    };
    runs.into_iter().map(pattern).collect()
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
    let length = quote!(CHARACTERISTIC_LENGTH);
    let scales = system.rows.iter().map(|row| scale(row.quantity, &length));
    let column_scales = system
        .coordinates
        .iter()
        .map(|coordinate| scale(coordinate.quantity, &length));
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
    let row_scales = only(
        !given.lengths,
        quote! {
            /// What the residual of each row is judged against.
            const ROW_SCALES: [f64; #size] = [#(#scales),*];
        },
    );
    let (derived, made) = if given.lengths {
        (quote!(Clone, Copy, Debug), textbook_of_parameters(given))
    } else {
        (quote!(Clone, Copy, Debug, Default), TokenStream::new())
    };
    let judged = if given.lengths {
        let of_rows: Vec<Quantity> = system.rows.iter().map(|row| row.quantity).collect();
        let of_columns: Vec<Quantity> = system.coordinates.iter().map(|it| it.quantity).collect();
        let rows = scales_by_length("row_scale", "row", &of_rows);
        let columns = if system.coordinates.iter().all(is_pose) {
            quote! {
                fn coordinate_scale(&self, column: usize) -> f64 {
                    if column % 3 == 2 { 1.0 } else { self.length }
                }
            }
        } else {
            scales_by_length("coordinate_scale", "column", &of_columns)
        };
        quote!(#rows #columns)
    } else {
        quote! {
            fn row_scale(&self, row: usize) -> f64 {
                ROW_SCALES.get(row).copied().unwrap_or(1.0)
            }

            fn coordinate_scale(&self, column: usize) -> f64 {
                #coordinate_scale
            }
        }
    };
    quote! {
        #row_scales

        /// All equations as one dense system, as `linkwright::newton` solves it.
        #[derive(#derived)]
        #structure

        #made

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

            #judged
        }
    }
}

/// How a [`Textbook`] is made whose scales follow its parameters.
fn textbook_of_parameters(given: Given) -> TokenStream {
    let inputs = only(given.inputs, quote!(inputs: &Inputs,));
    let initial = only(given.inputs, quote!(&Inputs::INITIAL,));
    let fields = given.copied(quote!(characteristic_length(parameters)));
    quote! {
        #[allow(dead_code)]
        impl Textbook {
            /// The equations of the mechanism with these parameters.
            pub fn new(parameters: &Parameters, #inputs) -> Self {
                Self #fields
            }
        }

        impl Default for Textbook {
            fn default() -> Self {
                Self::new(&Parameters::NOMINAL, #initial)
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
    let length_field = only(
        given.lengths,
        quote! {
            /// What lengths are judged against (m).
            length: f64,
        },
    );
    let length_kept = only(given.lengths, quote!(length,));
    let length_found = only(
        given.lengths,
        quote!(let length = characteristic_length(parameters);),
    );
    let length_noted = only(
        given.lengths,
        quote!(self.length = characteristic_length(parameters);),
    );
    let (with, passed) = (given.parameters_declared(), given.parameters_passed());
    let (inputs, inputs_passed) = (given.inputs_declared(), given.inputs_passed());
    let (equations, own) = (given.copied(quote!(length)), own_parameters(given));
    let length_own = only(given.lengths, quote!(let length = self.length;));
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
        access(system, &length_noted),
    );
    let start = quote! {
        #check
        #length_found
        let estimate = SVector::from(estimate.to_array());
        let solved = kinematics::assemble(&Textbook #equations, &estimate, t, &settings)?;
        Ok(Self { frame: Self::frame_of(&solved #frame_passed), #kept #length_kept settings })
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
            #length_field
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
                #length_own
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
                #length_found
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
