//! The type that a user holds.

use proc_macro2::TokenStream;
use quote::quote;

use super::block::{Needs, checks_itself};
use super::frame::estimated_frame;
use crate::emit::rust::coordinates::derives;
use crate::emit::rust::docs::docs;
use crate::emit::rust::expression::identifier;
use crate::emit::rust::literal::count;
use crate::model::type_name;
use crate::program::Program;
use crate::program::solved::SolvedProgram;
use crate::system::System;

/// The mechanism's own type, and the function that calls all blocks.
pub(in crate::emit::rust) fn mechanism(
    system: &System,
    program: &Program,
    solved: &SolvedProgram,
) -> TokenStream {
    let size = count(system.rows.len());
    let name = identifier(&type_name(&system.mechanism.name));
    let mut lines = system.mechanism.docs.clone();
    if lines.is_empty() {
        lines.push(format!("The mechanism `{}`.", system.mechanism.name));
    }
    let text = docs(lines);
    let estimated = estimated_frame(system, solved);
    let mut all = Needs::default();
    let calls: Vec<TokenStream> = solved
        .blocks
        .iter()
        .map(|block| {
            let needs = Needs::of(block, system);
            all.last |= needs.last;
            all.branches |= needs.branches;
            all.settings |= needs.settings;
            let (function, arguments) = (identifier(&block.name), needs.arguments());
            let try_it = if needs.fails {
                quote!(?)
            } else {
                TokenStream::new()
            };
            quote!(#function(#arguments)#try_it;)
        })
        .collect();
    let last = if all.last {
        quote!(last)
    } else {
        quote!(_last)
    };
    let branches = if all.branches {
        quote!(branches)
    } else {
        quote!(_branches)
    };
    let settings = if all.settings {
        quote!(settings)
    } else {
        quote!(_settings)
    };
    let verdict = if checks_itself(system) {
        quote!(Ok(()))
    } else {
        quote!(if at.is_finite() {
            Ok(())
        } else {
            Err(failed(FailureKind::NotFinite, t, 0))
        })
    };
    let newton_step = match program.textbook {
        Some(_) => quote! {
            /// One Newton-Raphson step of the textbook view from the pose `q` at time `t` (s), with its matrix and right-hand
            /// side.
            ///
            /// # Errors
            /// A [`Failure`] where the Jacobian is singular.
            pub fn newton_step(q: &Coordinates, t: f64) -> Result<Step<f64, Const<#size>>, Failure> {
                newton::step(&Textbook, &SVector::from(q.to_array()), t, &Settings::default())
            }
        },
        None => TokenStream::new(),
    };
    let derives = derives(system.coordinates.len());
    quote! {
        /// Solves all blocks at time `t` (s), one after another.
        fn solve(
            at: &mut Frame,
            #last: &Frame,
            #branches: &Branches,
            #settings: &Settings,
            t: f64,
        ) -> Result<(), Failure> {
            at.t = t;
            #(#calls)*
            #verdict
        }

        #text
        #derives
        pub struct #name {
            /// The last frame and the one before it, whose place the next one takes.
            frames: [Frame; 2],
            second_is_last: bool,
            branches: Branches,
            settings: Settings,
        }

        #[allow(dead_code)]
        impl #name {
            /// Assembles the mechanism at time `t` (s) as it is drawn.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble(t: f64) -> Result<Self, Failure> {
                Self::assemble_on(Branches::DRAWN, t)
            }

            /// Assembles the mechanism at time `t` (s) in other modes than the drawing's.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble_on(branches: Branches, t: f64) -> Result<Self, Failure> {
                Self::assemble_with(&Coordinates::DRAWN, branches, t, Settings::default())
            }

            /// Assembles the mechanism at time `t` (s) in the drawing's modes, with angles near those of `estimate`, a measured pose
            /// for example.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble_from(estimate: &Coordinates, t: f64, settings: Settings) -> Result<Self, Failure> {
                Self::assemble_with(estimate, Branches::DRAWN, t, settings)
            }

            /// Assembles the mechanism at time `t` (s) in these modes, with angles near those of `estimate`. Where a block needs
            /// Newton-Raphson, it starts from there.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble_with(
                estimate: &Coordinates,
                branches: Branches,
                t: f64,
                settings: Settings,
            ) -> Result<Self, Failure> {
                let last = #estimated;
                let mut at = last;
                solve(&mut at, &last, &branches, &settings, t)?;
                Ok(Self { frames: [at, last], second_is_last: false, branches, settings })
            }

            /// Moves the mechanism to time `t` (s), starting from the last frame, which a failure leaves as it is.
            ///
            /// # Errors
            /// A [`Failure`] where the equations cannot be solved from there.
            pub fn advance(&mut self, t: f64) -> Result<&Frame, Failure> {
                let [first, second] = &mut self.frames;
                let (last, at) = if self.second_is_last { (&*second, first) } else { (&*first, second) };
                solve(at, last, &self.branches, &self.settings, t)?;
                self.second_is_last = !self.second_is_last;
                Ok(self.frame())
            }

            /// The last solved instant.
            pub fn frame(&self) -> &Frame {
                let [first, second] = &self.frames;
                if self.second_is_last { second } else { first }
            }

            /// The assembly modes.
            pub fn branches(&self) -> Branches {
                self.branches
            }

            #newton_step
        }
    }
}
