//! The type that a user holds.

use proc_macro2::TokenStream;
use quote::quote;

use super::block::{Needs, checks_itself};
use super::frame::estimated_frame;
use crate::emit::rust::coordinates::derives;
use crate::emit::rust::docs::docs;
use crate::emit::rust::expression::identifier;
use crate::emit::rust::given::{Given, access, drawn_pose, finite_check, kept_in_frame, only};
use crate::emit::rust::literal::count;
use crate::emit::rust::solver::own_parameters;
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
    let estimated = estimated_frame(system, program, solved);
    let mut all = Needs::default();
    let calls: Vec<TokenStream> = solved
        .blocks
        .iter()
        .map(|block| {
            let needs = Needs::of(block, system);
            all.last |= needs.last;
            all.branches |= needs.branches;
            all.settings |= needs.settings;
            all.start |= needs.start;
            all.length |= needs.length;
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
    // Blocks that need Newton-Raphson are assembled from an estimate, but go on from a frame, and find their modes.
    let newton = all.start;
    let many = only(
        newton
            && !system.mechanism.parameters.is_empty()
            && (all.length || !system.mechanism.inputs.is_empty()),
        quote!(#[allow(clippy::too_many_arguments)]),
    );
    let branches_found = only(newton, quote!(let mut branches = branches;));
    let start_declared = only(newton, quote!(start: Start,));
    let estimate_passed = only(newton, quote!(Start::Estimate,));
    let exclusive = only(newton, quote!(mut));
    let given = Given::of(system);
    // Other parameters make the last frame an estimate.
    let keeps_start = newton && given.parameters;
    let start_field = only(
        keeps_start,
        quote! {
            /// What the last frame is for the next one.
            start: Start,
        },
    );
    let start_kept = only(keeps_start, quote!(start: Start::LastFrame,));
    let start_noted = only(keeps_start, quote!(self.start = Start::Estimate;));
    let start_done = only(keeps_start, quote!(self.start = Start::LastFrame;));
    let start_read = only(keeps_start, quote!(start,));
    let start_copied = only(keeps_start, quote!(let mut start = *start;));
    let start_left = only(keeps_start, quote!(start = Start::LastFrame;));
    let (start_own, start_passed) = match (newton, keeps_start) {
        (false, _) => Default::default(),
        (true, false) => (quote!(Start::LastFrame,), quote!(Start::LastFrame,)),
        (true, true) => (quote!(self.start,), quote!(start,)),
    };
    // What lengths are judged against is found once for all instants with the same parameters.
    let length_declared = only(all.length, quote!(length: f64,));
    let length_field = only(
        all.length,
        quote! {
            /// What lengths are judged against (m).
            length: f64,
        },
    );
    let length_found = only(
        all.length,
        quote!(let length = characteristic_length(parameters);),
    );
    let length_kept = only(all.length, quote!(length,));
    let length_own = only(all.length, quote!(self.length,));
    let length_read = only(all.length, quote!(*length,));
    let length_noted = only(
        all.length,
        quote!(self.length = characteristic_length(parameters);),
    );
    let changes_noted = quote!(#length_noted #start_noted);
    let inputs_field = only(given.inputs, quote!(inputs: Inputs,));
    let inputs_kept = only(given.inputs, quote!(inputs: *inputs,));
    let inputs_done = only(given.inputs, quote!(self.inputs = *inputs;));
    let inputs_read = only(given.inputs, quote!(inputs: before,));
    let inputs_between = only(
        given.inputs,
        quote! {
            let inputs = &if target == t { *inputs } else { before.towards(inputs, t - last.t, (target - last.t) / (t - last.t)) };
        },
    );
    let parameters_read = only(given.parameters, quote!(parameters,));
    let inputs_text = if given.inputs {
        docs([
            "",
            "On the way the inputs go from their last values to the new ones by the polynomial of the fifth degree that has values,",
            "rates and accelerations of both ends.",
        ])
    } else {
        TokenStream::new()
    };
    let (with, passed) = (given.parameters_declared(), given.parameters_passed());
    let (inputs, inputs_passed) = (given.inputs_declared(), given.inputs_passed());
    let (field, kept) = (
        only(given.parameters, quote!(parameters: Parameters,)),
        only(given.parameters, quote!(parameters: *parameters,)),
    );
    let signals = only(given.inputs, quote!(inputs: &Inputs,));
    let signals_passed = only(given.inputs, quote!(inputs,));
    let in_frame = only(kept_in_frame(program), quote!(at.parameters = *parameters;));
    let (equations, check, access) = (
        given.copied(quote!(characteristic_length(parameters))),
        finite_check(system),
        access(system, &changes_noted),
    );
    let drawn = drawn_pose(program);
    let nominal = only(
        given.parameters,
        quote!(let parameters = &Parameters::NOMINAL;),
    );
    let own_parameters = own_parameters(given);
    let for_parameters = only(
        given.parameters,
        quote! {
            /// Assembles the mechanism of these parameters at time `t` (s) as it is drawn.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble_for(parameters: &Parameters, t: f64 #inputs) -> Result<Self, Failure> {
                let estimate = #drawn;
                Self::assemble_with(parameters, estimate, Branches::DRAWN, t #inputs_passed, Settings::default())
            }
        },
    );
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
            pub fn newton_step(q: &Coordinates, #with #signals t: f64) -> Result<Step<f64, Const<#size>>, Failure> {
                newton::step(&Textbook #equations, &SVector::from(q.to_array()), t, &Settings::default())
            }
        },
        None => TokenStream::new(),
    };
    let derives = derives(system.coordinates.len());
    quote! {
        /// Solves all blocks at time `t` (s), one after another.
        #many
        fn solve(
            at: &mut Frame,
            #last: &Frame,
            #start_declared
            #branches: &#exclusive Branches,
            #settings: &Settings,
            #length_declared
            #with
            #signals
            t: f64,
        ) -> Result<(), Failure> {
            #check
            at.t = t;
            #in_frame
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
            #field
            #inputs_field
            #start_field
            #length_field
            settings: Settings,
        }

        #[allow(dead_code)]
        impl #name {
            /// Assembles the mechanism at time `t` (s) as it is drawn.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble(t: f64 #inputs) -> Result<Self, Failure> {
                Self::assemble_on(Branches::DRAWN, t #inputs_passed)
            }

            #for_parameters

            /// Assembles the mechanism at time `t` (s) in other modes than the drawing's.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble_on(branches: Branches, t: f64 #inputs) -> Result<Self, Failure> {
                #nominal
                Self::assemble_with(#passed #drawn, branches, t #inputs_passed, Settings::default())
            }

            /// Assembles the mechanism at time `t` (s) in the drawing's modes, with angles near those of `estimate`, a measured pose
            /// for example.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble_from(estimate: &Coordinates, t: f64 #inputs, settings: Settings) -> Result<Self, Failure> {
                #nominal
                Self::assemble_with(#passed estimate, Branches::DRAWN, t #inputs_passed, settings)
            }

            /// Assembles the mechanism at time `t` (s) in these modes, with angles near those of `estimate`. Where a block needs
            /// Newton-Raphson, it starts from there, and the estimate may be poor.
            ///
            /// # Errors
            /// A [`Failure`] where it cannot be assembled so.
            pub fn assemble_with(
                #with
                estimate: &Coordinates,
                branches: Branches,
                t: f64
                #inputs,
                settings: Settings,
            ) -> Result<Self, Failure> {
                let last = #estimated;
                #length_found
                let mut at = last;
                #branches_found
                solve(&mut at, &last, #estimate_passed &#exclusive branches, &settings, #length_kept #passed #signals_passed t)?;
                Ok(Self { frames: [at, last], second_is_last: false, branches, #kept #inputs_kept #start_kept #length_kept settings })
            }

            /// Moves the mechanism to time `t` (s), starting from the last frame, which a failure leaves as it is.
            ///
            /// Where that is not possible in one step, it goes in at most [`Settings::substeps`] attempts, all blocks in each.
            /// A loop with a closed form is assembled at `t` in its mode, also where it would come apart on the way there.
            #inputs_text
            ///
            /// # Errors
            /// A [`Failure`] where the equations cannot be solved from there. Its time is where the motion ends, or how far it could
            /// be followed; see `linkwright::in_steps`.
            pub fn advance(&mut self, t: f64 #inputs) -> Result<&Frame, Failure> {
                #own_parameters
                let [first, second] = &mut self.frames;
                let (last, at) = if self.second_is_last { (&*second, first) } else { (&*first, second) };
                if let Err(failure) = solve(at, last, #start_own &#exclusive self.branches, &self.settings, #length_own #passed #signals_passed t) {
                    self.advance_in_steps(failure, t #inputs_passed)?;
                }
                #inputs_done
                #start_done
                self.second_is_last = !self.second_is_last;
                Ok(self.frame())
            }

            /// Moves the mechanism to time `t` (s) in several steps, because one has ended with `failure`, or finds the time at
            /// which this is no longer possible. The new frame takes the place of the older one.
            #[cold]
            fn advance_in_steps(&mut self, failure: Failure, t: f64 #inputs) -> Result<(), Failure> {
                let Self { frames: [first, second], second_is_last, branches, #parameters_read #inputs_read #start_read #length_kept settings } = self;
                if settings.substeps <= 1 {
                    return Err(failure);
                }
                let (last, at) = if *second_is_last { (&*second, first) } else { (&*first, second) };
                let mut reached = *last;
                #start_copied
                in_steps(last.t, t, settings.substeps, |target| {
                    #inputs_between
                    solve(at, &reached, #start_passed branches, settings, #length_read #passed #signals_passed target)?;
                    #start_left
                    core::mem::swap(at, &mut reached);
                    Ok(())
                })
                .map_err(|broken| broken.failure)?;
                *at = reached;
                Ok(())
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

            #access

            #newton_step
        }
    }
}
