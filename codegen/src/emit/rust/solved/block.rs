//! One function per block.

use std::collections::HashSet;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::explained::determinants;
use super::names::{BlockNames, plain_name};
use super::newton::{reads_frame, reads_length};
use crate::emit::derivation::SingularPose;
use crate::emit::rust::docs::docs;
use crate::emit::rust::expression::{Names, Writer, identifier};
use crate::emit::rust::given::only;
use crate::emit::rust::layout::comment;
use crate::emit::rust::lints;
use crate::emit::rust::literal::count;
use crate::expr::{ExprId, SymbolId};
use crate::program::solved::{Action, BlockProgram, Level, NewtonBlock, SolvedProgram};
use crate::program::{Inputs, LARGEST_TEXTBOOK, Program};
use crate::system::{Cause, System, Unknown};

/// What a block's function needs to be given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Needs {
    pub last: bool,
    /// Where the block goes on from, and its mode, which its assembly finds.
    pub start: bool,
    pub branches: bool,
    pub settings: bool,
    /// What lengths are judged against, where it follows the parameters.
    pub length: bool,
    pub parameters: bool,
    pub inputs: bool,
    pub time: bool,
    pub fails: bool,
}

impl Needs {
    pub(super) fn of(block: &BlockProgram, system: &System) -> Needs {
        let checks = checks_itself(system);
        let mut needs = Needs {
            fails: checks,
            time: checks,
            branches: block.reads_branch,
            ..Needs::default()
        };
        for action in &block.actions {
            match action {
                Action::Angle { .. } => needs.last = true,
                Action::Newton => {
                    (needs.last, needs.settings, needs.fails, needs.time) =
                        (true, true, true, true);
                    (needs.start, needs.branches) = (true, true);
                }
                Action::Reach { .. } | Action::Nonzero { .. } => {
                    (needs.fails, needs.time) = (true, true)
                }
                _ => {}
            }
        }
        let values = block.actions.iter().flat_map(Action::values);
        needs.time |= reads(values.clone(), system).time;
        let own = reads(values, system);
        let newton = block
            .newton
            .as_ref()
            .map(|newton| Needs::given(newton, system));
        let newton = newton.unwrap_or_default();
        needs.length = block
            .newton
            .as_ref()
            .is_some_and(|it| reads_length(it, system));
        needs.parameters = own.parameters || newton.parameters;
        needs.inputs = own.inputs || newton.inputs;
        needs
    }

    /// What the equations of a Newton block read of parameters and inputs.
    pub(super) fn given(newton: &NewtonBlock, system: &System) -> Inputs {
        let geometry = newton.geometry.iter().flat_map(Action::values);
        reads(newton.expressions().chain(geometry), system)
    }

    /// The arguments of a call, in the order of the parameters.
    pub(super) fn arguments(self) -> TokenStream {
        let last = if self.last {
            quote!(last,)
        } else {
            TokenStream::new()
        };
        let start = only(self.start, quote!(start,));
        let branches = if self.branches {
            quote!(branches,)
        } else {
            TokenStream::new()
        };
        let settings = if self.settings {
            quote!(settings,)
        } else {
            TokenStream::new()
        };
        let length = only(self.length, quote!(length,));
        let parameters = only(self.parameters, quote!(parameters,));
        let inputs = only(self.inputs, quote!(inputs,));
        let time = if self.time {
            quote!(t)
        } else {
            TokenStream::new()
        };
        quote!(at, #last #start #branches #settings #length #parameters #inputs #time)
    }

    fn parameters(self) -> TokenStream {
        let last = if self.last {
            quote!(last: &Frame,)
        } else {
            TokenStream::new()
        };
        let start = only(self.start, quote!(start: Start,));
        let branches = match (self.branches, self.start) {
            (_, true) => quote!(branches: &mut Branches,),
            (true, false) => quote!(branches: &Branches,),
            (false, false) => TokenStream::new(),
        };
        let settings = if self.settings {
            quote!(settings: &Settings,)
        } else {
            TokenStream::new()
        };
        let length = only(self.length, quote!(length: f64,));
        let parameters = only(self.parameters, quote!(parameters: &Parameters,));
        let inputs = only(self.inputs, quote!(inputs: &Inputs,));
        let time = if self.time {
            quote!(t: f64)
        } else {
            TokenStream::new()
        };
        quote!(at: &mut Frame, #last #start #branches #settings #length #parameters #inputs #time)
    }
}

/// What expressions read beside what blocks compute.
pub(super) fn reads(expressions: impl Iterator<Item = ExprId>, system: &System) -> Inputs {
    let mut read = Inputs::default();
    for expr in expressions {
        for symbol in system.mechanism.graph.symbols(expr) {
            read.note(system.roles[symbol.index()]);
        }
    }
    read
}

/// Up to so many blocks become one function.
const MOST_INLINED: usize = 16;

/// The functions of all blocks.
pub(in crate::emit::rust) fn blocks(
    system: &System,
    program: &Program,
    solved: &SolvedProgram,
    poses: &[SingularPose],
) -> TokenStream {
    // One function of thousands of blocks would take the compiler longer than all of them alone.
    let inline = if solved.blocks.len() > MOST_INLINED {
        quote!(#[inline(never)])
    } else {
        quote!(#[inline])
    };
    // Most mechanisms have no capital letter in any name, and then no token needs to be looked at.
    let has_capitals = system
        .mechanism
        .bodies
        .iter()
        .any(|body| body.name.contains(char::is_uppercase));
    let functions = solved.blocks.iter().enumerate().map(|(index, block)| {
        let needs = Needs::of(block, system);
        let names = BlockNames { system, solved, named: block.named(), local: HashSet::new() };
        let writer = Writer { system, constants: &program.constants, names: &names };
        // What only the equations of a Newton-Raphson read, they compute themselves.
        let read: Vec<ExprId> = block.actions.iter().flat_map(Action::values).collect();
        let time = writer.statements(&block.time.for_results(&read, system));
        let actions = block.actions.iter().map(|action| statement(action, index, block, &writer, &names));
        let (name, parameters) = (identifier(&block.name), needs.parameters());
        let determinants = determinants(block, poses);
        let title = docs([block.title.clone()].into_iter().chain(determinants));
        let check = if checks_itself(system) { own_check(index, block, &names) } else { TokenStream::new() };
        // All that a block can be given is one more than a linter takes.
        let many = only(
            needs.start && [needs.length, needs.parameters, needs.inputs].map(usize::from).iter().sum::<usize>() >= 2,
            quote!(#[allow(clippy::too_many_arguments)]),
        );
        let body = if needs.fails {
            quote!(#inline fn #name(#parameters) -> Result<(), Failure> { #(#time)* #(#actions)* #check Ok(()) })
        } else {
            quote!(#inline fn #name(#parameters) { #(#time)* #(#actions)* })
        };
        let capitals = if has_capitals { lints::capitals(&body) } else { TokenStream::new() };
        let approximate = lints::approximate(&body);
        quote!(#title #capitals #approximate #many #body)
    });
    quote!(#(#functions)*)
}

/// Whether every block checks that what it found are numbers. A frame of thousands of coordinates is not looked through at
/// once: the compiler would turn it into as many local values.
pub(super) fn checks_itself(system: &System) -> bool {
    system.coordinates.len() > LARGEST_TEXTBOOK
}

/// Fails where a coordinate, a rate or an acceleration of the block is no number.
fn own_check(index: usize, block: &BlockProgram, names: &BlockNames<'_>) -> TokenStream {
    let found = block
        .actions
        .iter()
        .flat_map(Action::targets)
        .filter(|&symbol| names.is_field(symbol));
    let fields: Vec<TokenStream> = found.map(|symbol| names.symbol(symbol)).collect();
    let number = count(index);
    quote! {
        if !all_finite(&[#(#fields),*]) {
            return Err(failed(FailureKind::NotFinite, t, #number));
        }
    }
}

/// One statement of a block.
pub(super) fn statement(
    action: &Action,
    index: usize,
    block: &BlockProgram,
    writer: &Writer<'_>,
    names: &BlockNames<'_>,
) -> TokenStream {
    let number = count(index);
    match action {
        Action::Section(Level::Position) => comment("Position."),
        Action::Section(Level::Velocity) => comment("Velocity."),
        Action::Section(Level::Acceleration) => comment("Acceleration."),
        Action::Section(Level::Response(direction)) => {
            let mechanism = &names.system.mechanism;
            comment(&match names.system.directions[*direction].cause {
                Cause::Driver { joint, .. } => {
                    format!("Response to {}.", mechanism.joints[joint].label)
                }
                Cause::Parameter(place) => {
                    format!("Sensitivity to {}.", mechanism.parameters[place].name)
                }
            })
        }
        Action::Section(Level::ResponseRate(_)) => comment("Rate of this sensitivity."),
        Action::Comment(text) => comment(text),
        Action::Let { target, value } => assignment(*target, writer.expression(*value, &[]), names),
        Action::Share(statement) => writer.statement(statement),
        Action::SineCosine {
            sine,
            cosine,
            angle,
        } => {
            let angle = writer.expression(*angle, &[]);
            let [sine, cosine] = [sine, cosine].map(|symbol| plain_name(*symbol, names.system));
            quote!(let (#sine, #cosine) = math::sin_cos(#angle);)
        }
        Action::Angle {
            unknown,
            sine,
            cosine,
        } => {
            let (sine, cosine) = (
                writer.expression(*sine, &[]),
                writer.expression(*cosine, &[]),
            );
            let symbol = names.system.vector_form.unknowns[*unknown].position;
            let [angle, near] = ["at", "last"].map(|frame| names.field(symbol, frame));
            quote!(#angle = angle_near(#sine, #cosine, #near);)
        }
        Action::Reach {
            excess,
            scale,
            distance,
            longest,
            shortest,
        } => {
            let [excess, scale, distance, longest, shortest] =
                [excess, scale, distance, longest, shortest]
                    .map(|expr| writer.expression(*expr, &[]));
            quote! {
                if !spans(#excess, #scale) {
                    return Err(no_span(#distance, #longest, #shortest, t, #number));
                }
            }
        }
        Action::Nonzero { value, scale } => {
            let (value, scale) = (
                writer.expression(*value, &[]),
                writer.expression(*scale, &[]),
            );
            quote! {
                if !spans(#value * #value, #scale * #scale) {
                    let kind = FailureKind::Singular { pivot_ratio: #value / #scale, column: 0 };
                    return Err(failed(kind, t, #number));
                }
            }
        }
        Action::Newton => newton_call(index, block, names),
        Action::Factorize => factorization(index, block, names),
        Action::Solve {
            targets,
            right_hand_side,
        } => {
            let values = right_hand_side
                .iter()
                .map(|&value| writer.expression(value, &[]));
            let found = targets.iter().enumerate();
            let assignments = found.filter_map(|(place, target)| {
                let place = count(place);
                Some(assignment((*target)?, quote!(response[#place]), names))
            });
            quote! {
                let mut response = SVector::from([#(#values),*]);
                factorization.solve(&mut response);
                #(#assignments)*
            }
        }
    }
}

/// `let name = value;`, or an assignment to a field.
fn assignment(target: SymbolId, value: TokenStream, names: &BlockNames<'_>) -> TokenStream {
    if names.is_field(target) {
        let field = names.symbol(target);
        quote!(#field = #value;)
    } else {
        let name = plain_name(target, names.system);
        quote!(let #name = #value;)
    }
}

/// The call of the runtime that finds the tears with their rates.
fn newton_call(index: usize, block: &BlockProgram, names: &BlockNames<'_>) -> TokenStream {
    let Some(newton) = &block.newton else {
        return TokenStream::new();
    };
    let number = count(index);
    let unknowns: Vec<_> = newton
        .unknowns
        .iter()
        .map(|&unknown| &names.system.vector_form.unknowns[unknown])
        .collect();
    let fields = |of: fn(&Unknown) -> SymbolId, frame: &str| -> Vec<TokenStream> {
        unknowns
            .iter()
            .map(|unknown| names.field(of(unknown), frame))
            .collect()
    };
    let of: [fn(&Unknown) -> SymbolId; 3] = [
        |unknown| unknown.position,
        |unknown| unknown.rate,
        |unknown| unknown.acceleration,
    ];
    let [q, qd, qdd] = of.map(|of| fields(of, "at"));
    let [last_q, last_qd, last_qdd] = of.map(|of| fields(of, "last"));
    let places: Vec<_> = (0..q.len()).map(count).collect();
    let equations = equations(block, newton, names);
    let mode = identifier(&block.name);
    let (solve, measure, measured) = match newton.measure {
        None => (quote!(solve), TokenStream::new(), TokenStream::new()),
        Some(both) => {
            let [determinant, condition] = both.map(|symbol| names.symbol(symbol));
            let measured = quote! {
                #determinant = measure.determinant;
                #condition = measure.reciprocal_condition;
            };
            (quote!(solve_measured), quote!(, &mut measure), measured)
        }
    };
    let declared = only(
        newton.measure.is_some(),
        quote!(let mut measure = Measure::sine(0.0);),
    );
    quote! {
        #declared
        let tears = kinematics::Frame {
            t: last.t,
            q: SVector::from([#(#last_q),*]),
            qd: SVector::from([#(#last_qd),*]),
            qdd: SVector::from([#(#last_qdd),*]),
        };
        let tears = block::#solve(&#equations, &tears, start, &mut branches.#mode, t, settings #measure)
            .map_err(|failure| failure.in_block(#number))?;
        #measured
        #(#q = tears.q[#places];)*
        #(#qd = tears.qd[#places];)*
        #(#qdd = tears.qdd[#places];)*
    }
}

/// The value of a Newton block's equations: with the fields that they read.
fn equations(block: &BlockProgram, newton: &NewtonBlock, names: &BlockNames<'_>) -> TokenStream {
    let type_name = equations_name(block);
    let needs = Needs::given(newton, names.system);
    let at = only(
        reads_frame(block, newton, names.system, names.solved),
        quote!(at,),
    );
    let parameters = only(needs.parameters, quote!(parameters,));
    let inputs = only(needs.inputs, quote!(inputs,));
    let length = only(reads_length(newton, names.system), quote!(length,));
    let fields = quote!(#at #parameters #inputs #length);
    if fields.is_empty() {
        quote!(#type_name)
    } else {
        quote!(#type_name { #fields })
    }
}

/// The call of the runtime that factorizes the Jacobian at the tears.
fn factorization(index: usize, block: &BlockProgram, names: &BlockNames<'_>) -> TokenStream {
    let Some(newton) = &block.newton else {
        return TokenStream::new();
    };
    let number = count(index);
    let q = newton.unknowns.iter().map(|&unknown| {
        let symbol = names.system.vector_form.unknowns[unknown].position;
        names.field(symbol, "at")
    });
    let equations = equations(block, newton, names);
    quote! {
        let tears = SVector::from([#(#q),*]);
        let factorization = kinematics::factorize(&#equations, &tears, t, settings)
            .map_err(|failure| failure.in_block(#number))?;
    }
}

/// `LoopPqr`: the type of a block's equations.
pub(super) fn equations_name(block: &BlockProgram) -> proc_macro2::Ident {
    format_ident!("{}", crate::model::type_name(&block.name))
}
