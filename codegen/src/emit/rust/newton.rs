//! The equations of blocks without a closed form, as the runtime sees them, and the calls that solve them.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::docs::docs;
use super::equation::Equation;
use super::lints;
use super::literal::count;
use super::module::only;
use super::names::identifier;
use super::textbook::{Length, length, scales};
use super::torn;
use crate::emit::module::scope::{Place, Reads, Scope};
use crate::emit::module::{Module, documentation};
use crate::expr::SymbolId;
use crate::joint::Quantity;
use crate::program::{Block, Function, Lengths, NewtonBlock, Statement, TornFields};
use crate::system::Unknown;

/// A type with the equations of every Newton block.
pub(super) fn equations(module: &Module<'_>) -> TokenStream {
    let blocks = module.program.blocks.iter();
    let types = blocks.filter_map(|block| Some(structure(block, block.newton.as_ref()?, module)));
    types.collect()
}

/// The unknowns of a block.
fn tears<'a>(newton: &NewtonBlock, module: &'a Module<'_>) -> Vec<&'a Unknown> {
    let unknowns = newton.unknowns.iter();
    unknowns
        .map(|&unknown| &module.system.vector_form.unknowns[unknown])
        .collect()
}

/// `LoopPQR` of the block `loop_p_q_r`.
fn type_name(block: &Block) -> Ident {
    format_ident!("{}", super::names::type_name(&block.name))
}

/// What the equations of a block read of what was found before it and of what is given.
fn reads(newton: &NewtonBlock, module: &Module<'_>) -> Reads {
    let mut all = Reads::default();
    let equations = newton.equations().into_iter();
    let equations = equations.map(|function| scope(newton, function, true, module).reads());
    let tearing = newton.tearing.iter();
    let torn = tearing.flat_map(|tearing| torn::reads(newton, tearing, module));
    for reads in equations.chain(torn) {
        all.frame |= reads.frame;
        all.parameters |= reads.parameters;
        all.inputs |= reads.inputs;
    }
    all
}

/// The names of one of the functions; `with_rates` where it is given the rates of the tears.
fn scope<'a>(
    newton: &NewtonBlock,
    function: &'a Function,
    with_rates: bool,
    module: &'a Module<'a>,
) -> Scope<'a> {
    let tears = tears(newton, module);
    let positions = tears.iter().map(|it| it.position);
    let rates = tears.iter().map(|it| it.rate).filter(|_| with_rates);
    Scope::with_tears(
        module,
        function,
        Place::Tears,
        positions.chain(rates).collect(),
    )
}

/// Whether parameters change what the residuals or the tears of a block are scaled by.
fn scales_follow(newton: &NewtonBlock, module: &Module<'_>) -> bool {
    let tears = tears(newton, module);
    let of_tears: Vec<Quantity> = tears.iter().map(|it| it.quantity).collect();
    let follow = |(lengths, quantities): (&Lengths, &Vec<Quantity>)| {
        lengths.following.is_some() && quantities.iter().any(|it| it.power_of_length() != 0)
    };
    newton
        .scaled_by
        .iter()
        .zip([&newton.quantities, &of_tears])
        .any(follow)
}

fn structure(block: &Block, newton: &NewtonBlock, module: &Module<'_>) -> TokenStream {
    let (name, size) = (type_name(block), count(newton.unknowns.len()));
    let tears = tears(newton, module);
    let reads = reads(newton, module);
    let at = only(reads.frame, quote!(at: &'a Frame,));
    let parameters = only(
        reads.parameters || scales_follow(newton, module),
        quote!(parameters: &'a Parameters,),
    );
    let inputs = only(reads.inputs, quote!(inputs: &'a Inputs,));
    let fields = quote!(#at #parameters #inputs);
    let (declaration, lifetime) = match fields.is_empty() {
        true => (quote!(struct #name;), TokenStream::new()),
        false => (quote!(struct #name<'a> { #fields }), quote!(<'_>)),
    };
    let borrowed = only(!fields.is_empty(), quote!('_,));
    let part = |function: &Function, with_rates: bool| {
        let scope = scope(newton, function, with_rates, module);
        let equation = Equation::new(&scope);
        let [q, qd] = [
            (tears.iter().map(|it| it.position).collect::<Vec<_>>(), "q"),
            (tears.iter().map(|it| it.rate).collect(), "qd"),
        ]
        .map(|(symbols, whole)| equation.pattern(&symbols, whole, &scope));
        let t = equation.time();
        let Equation {
            given,
            statements,
            results,
            ..
        } = equation;
        (quote!(#given #statements), results, q, qd, t)
    };
    let (residual_body, residual, residual_q, _, residual_t) = part(&newton.residual, false);
    let (jacobian_body, jacobian, jacobian_q, _, jacobian_t) = part(&newton.jacobian, false);
    let (drift_body, drift, drift_q, _, drift_t) = part(&newton.time_derivative, false);
    let (gamma_body, gamma, gamma_q, gamma_qd, gamma_t) = part(&newton.gamma, true);
    let columns: Vec<Quantity> = tears.iter().map(|it| it.quantity).collect();
    let [of_rows, of_columns] = newton.scaled_by.each_ref().map(|it| length(module, it));
    let scaled = |quantities: &[Quantity], length: Length| {
        let scales = scales(quantities, &length.name);
        let reads = quantities.iter().any(|it| it.power_of_length() != 0);
        let statement = only(reads, length.statement);
        quote!(#statement #scales)
    };
    let row_scales = scaled(&newton.quantities, of_rows);
    let column_scales = scaled(&columns, of_columns);
    let angles = angles(&columns);
    let found = documentation::found_by(newton, module.system);
    let title = docs([format!("The equations of `{}` for {found}.", block.name)]);
    let implementation = quote! {
        impl BlockEquations<Scalar, #size> for #name #lifetime {
            fn residual(&self, #residual_q: &[Scalar; #size], #residual_t: Scalar) -> [Scalar; #size] {
                #residual_body
                [#(#residual),*]
            }

            fn jacobian(&self, #jacobian_q: &[Scalar; #size], #jacobian_t: Scalar) -> Matrix<#size, #size> {
                #jacobian_body
                Matrix::from_row_slice(&[#(#jacobian),*])
            }

            fn time_derivative(&self, #drift_q: &[Scalar; #size], #drift_t: Scalar) -> [Scalar; #size] {
                #drift_body
                [#(#drift),*]
            }

            fn gamma(
                &self,
                #gamma_q: &[Scalar; #size],
                #gamma_qd: &[Scalar; #size],
                #gamma_t: Scalar,
            ) -> [Scalar; #size] {
                #gamma_body
                [#(#gamma),*]
            }

            fn row_scales(&self) -> [Scalar; #size] {
                #row_scales
            }

            fn column_scales(&self) -> [Scalar; #size] {
                #column_scales
            }

            #angles
        }
    };
    let tearing = torn::implementation(&name, &lifetime, newton, module);
    let tearing = match tearing.is_empty() {
        true => tearing,
        false => {
            let (capitals, approximate) = lints::both(&tearing);
            quote!(#capitals #approximate #tearing)
        }
    };
    let (capitals, approximate) = lints::both(&implementation);
    quote! {
        #title #declaration #capitals #approximate #implementation
        ::linkwright::generated::equations!(#name, #borrowed #size);
        #tearing
    }
}

/// A statement of a block that concerns its Newton-Raphson.
pub(super) fn statement(
    statement: &Statement,
    index: usize,
    block: &Block,
    scope: &Scope<'_>,
) -> TokenStream {
    let Some(newton) = &block.newton else {
        return TokenStream::new();
    };
    match statement {
        Statement::Newton { measure, torn, .. } => {
            solve(index, block, newton, (*measure, torn.as_ref()), scope)
        }
        Statement::Factorize => factorize(index, block, newton, scope),
        _ => TokenStream::new(),
    }
}

/// The equations with what they read.
pub(super) fn instance(block: &Block, newton: &NewtonBlock, module: &Module<'_>) -> TokenStream {
    let name = type_name(block);
    let reads = reads(newton, module);
    let reads_parameters = reads.parameters || scales_follow(newton, module);
    let at = only(reads.frame, quote!(at: &*at,));
    let parameters = only(reads_parameters, quote!(parameters: conditions.parameters,));
    let inputs = only(reads.inputs, quote!(inputs: conditions.inputs,));
    let fields = quote!(#at #parameters #inputs);
    match fields.is_empty() {
        true => quote!(#name),
        false => quote!(#name { #fields }),
    }
}

/// The call of the runtime that finds the tears with their rates.
fn solve(
    index: usize,
    block: &Block,
    newton: &NewtonBlock,
    (measure, torn): (Option<[SymbolId; 2]>, Option<&TornFields>),
    scope: &Scope<'_>,
) -> TokenStream {
    let module = scope.module;
    let tears = tears(newton, module);
    let fields = |of: fn(&Unknown) -> SymbolId, frame: &str| -> Vec<TokenStream> {
        tears.iter().map(|it| module.field(of(it), frame)).collect()
    };
    let of: [fn(&Unknown) -> SymbolId; 3] = [|it| it.position, |it| it.rate, |it| it.acceleration];
    let [q, qd, qdd] = of.map(|of| fields(of, "at"));
    let [last_q, last_qd, last_qdd] = of.map(|of| fields(of, "last"));
    let (number, mode) = (count(index), identifier(&block.name));
    let equations = instance(block, newton, module);
    let (call, declared, passed, measured) = match measure {
        None => (
            quote!(solve),
            TokenStream::new(),
            TokenStream::new(),
            TokenStream::new(),
        ),
        Some(both) => {
            let [determinant, condition] = both.map(|symbol| scope.symbol(symbol));
            let measured = quote! {
                #determinant = measure.determinant;
                #condition = measure.reciprocal_condition;
            };
            let declared = quote!(let mut measure = Measure::sine(0.0););
            (
                quote!(solve_measured),
                declared,
                quote!(, &mut measure),
                measured,
            )
        }
    };
    let solved = match torn {
        Some(torn) => torn::solve(number, &mode, block, (newton, torn), scope),
        None => quote! {
            let equations = #equations;
            let tears = block::#call(&equations, &tears, conditions.start, &mut branches.#mode, conditions.t, conditions.settings #passed)
                .map_err(|failure| failure.in_block(#number))?;
        },
    };
    quote! {
        #declared
        let tears = kinematics::Frame {
            t: last.t,
            q: Vector::from([#(#last_q),*]),
            qd: Vector::from([#(#last_qd),*]),
            qdd: Vector::from([#(#last_qdd),*]),
        };
        #solved
        [#(#q),*] = tears.q.data.0[0];
        [#(#qd),*] = tears.qd.data.0[0];
        [#(#qdd),*] = tears.qdd.data.0[0];
        #measured
    }
}

/// The Jacobian at the tears that were found, factorized once more for what responds to drivers and parameters.
fn factorize(index: usize, block: &Block, newton: &NewtonBlock, scope: &Scope<'_>) -> TokenStream {
    let module = scope.module;
    let tears = tears(newton, module);
    let q = tears.iter().map(|it| module.field(it.position, "at"));
    let (number, equations) = (count(index), instance(block, newton, module));
    quote! {
        let tears = Vector::from([#(#q),*]);
        let factorization = kinematics::factorize(&#equations, &tears, conditions.t, conditions.settings)
            .map_err(|failure| failure.in_block(#number))?;
    }
}

/// `fn angles`, where there are any.
fn angles(columns: &[Quantity]) -> TokenStream {
    let is_angle: Vec<bool> = columns.iter().map(|it| *it == Quantity::Angle).collect();
    let size = count(columns.len());
    let values = match (is_angle.contains(&true), is_angle.contains(&false)) {
        (false, _) => return TokenStream::new(),
        (true, false) => quote!([true; #size]),
        (true, true) => quote!([#(#is_angle),*]),
    };
    quote! {
        fn angles(&self) -> [bool; #size] {
            #values
        }
    }
}
