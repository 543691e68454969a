//! A torn block, as the runtime sees it, and the call that solves it.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::equation::Equation;
use super::literal::count;
use super::newton::instance;
use crate::emit::module::Module;
use crate::emit::module::scope::{Place, Reads, Scope};
use crate::expr::SymbolId;
use crate::program::{Block, NewtonBlock, Tearing, TornFields};

/// The tearing of a block's equations, for the type that states them.
pub(super) fn implementation(
    name: &Ident,
    lifetime: &TokenStream,
    newton: &NewtonBlock,
    module: &Module<'_>,
) -> TokenStream {
    let Some(tearing) = &newton.tearing else {
        return TokenStream::new();
    };
    let (size, tear_count) = (count(newton.unknowns.len()), count(tearing.tears.len()));
    let (sign_count, carried_count) = (count(tearing.signs.len()), count(tearing.carried.len()));
    let places = tearing.tears.iter().map(|&place| count(place));
    let scales = scales(tearing, module);
    let terms = tearing.terms.iter().map(|&it| module.float(it));
    let evaluate = evaluate(newton, tearing, module);
    let complete = complete(newton, tearing, module);
    let signs = signs(newton, tearing, module);
    quote! {
        impl Torn<Scalar, Const<#size>, #tear_count> for #name #lifetime {
            type Signs = [Scalar; #sign_count];
            type Carried = [Scalar; #carried_count];

            fn tears(&self) -> [usize; #tear_count] {
                [#(#places),*]
            }

            #scales

            fn terms(&self) -> [Scalar; #tear_count] {
                [#(#terms),*]
            }

            #evaluate

            #complete

            #signs
        }
    }
}

/// What each of the functions reads; what one carries for another is read of nothing else.
pub(super) fn reads(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>) -> [Reads; 4] {
    let all = tearing.named();
    let whole = Scope::with_tears(module, &all, Place::Tears, tears(newton, tearing, module));
    let unknowns = positions(newton.unknowns.iter().copied(), module);
    [
        Scope::with_tears(module, &tearing.scales, Place::Tears, Vec::new()).reads(),
        whole.part(&tearing.evaluate).reads(),
        whole.part(&tearing.complete).reads(),
        Scope::with_tears(module, &tearing.sign_values, Place::Tears, unknowns).reads(),
    ]
}

/// The positions of unknowns.
fn positions(unknowns: impl Iterator<Item = usize>, module: &Module<'_>) -> Vec<SymbolId> {
    let own = &module.system.vector_form.unknowns;
    unknowns.map(|unknown| own[unknown].position).collect()
}

fn tears(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>) -> Vec<SymbolId> {
    let tears = tearing.tears.iter().map(|&place| newton.unknowns[place]);
    positions(tears, module)
}

fn scales(tearing: &Tearing, module: &Module<'_>) -> TokenStream {
    let tear_count = count(tearing.tears.len());
    let scope = Scope::with_tears(module, &tearing.scales, Place::Tears, Vec::new());
    let equation = Equation::new(&scope);
    let (given, statements, time) = (&equation.given, &equation.statements, equation.time());
    let one = module.pool.graph.one();
    let factors = tearing.scales.results.iter().zip(&equation.results);
    let rows = tearing
        .rows
        .iter()
        .zip(factors)
        .map(|(&row, (factor, written))| {
            let row = count(row);
            match factor.expr == one {
                true => quote!(rows[#row]),
                false => quote!(rows[#row] * (#written)),
            }
        });
    quote! {
        #[inline]
        fn scales(&self, #time: Scalar) -> [Scalar; #tear_count] {
            #given
            #statements
            let rows = BlockEquations::row_scales(self);
            [#(#rows),*]
        }
    }
}

fn evaluate(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>) -> TokenStream {
    let all = tearing.named();
    let whole = Scope::with_tears(module, &all, Place::Tears, tears(newton, tearing, module));
    let scope = whole.part(&tearing.evaluate);
    let equation = Equation::new(&scope);
    let tear_count = tearing.tears.len();
    let tears = equation.pattern(&tears(newton, tearing, module), "tears", &scope);
    let signs = equation.pattern(&tearing.signs, "signs", &scope);
    let (given, statements, time) = (&equation.given, &equation.statements, equation.time());
    let (residual, rest) = equation.results.split_at(tear_count);
    let (inverse, determinant) = rest.split_at(tear_count * tear_count);
    let inverse = inverse.chunks(tear_count).map(|row| quote!([#(#row),*]));
    let determinant = quote!(#(#determinant)*);
    // What has the name of its field already is written once.
    let determinant = match determinant.to_string() == "determinant" {
        true => determinant,
        false => quote!(determinant: #determinant),
    };
    let carried = tearing.carried.iter().map(|&symbol| scope.symbol(symbol));
    let tear_count = count(tear_count);
    quote! {
        #[inline]
        fn evaluate(
            &self,
            #tears: &[Scalar; #tear_count],
            #signs: &Self::Signs,
            #time: Scalar,
        ) -> Option<torn::Evaluation<Scalar, #tear_count, Self::Carried>> {
            #given
            #statements
            Some(torn::Evaluation {
                residual: [#(#residual),*],
                inverse: [#(#inverse),*],
                #determinant,
                carried: [#(#carried),*],
            })
        }
    }
}

fn complete(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>) -> TokenStream {
    let all = tearing.named();
    let whole = Scope::with_tears(module, &all, Place::Tears, tears(newton, tearing, module));
    let scope = whole.part(&tearing.complete);
    let equation = Equation::new(&scope);
    let tears = equation.pattern(&tears(newton, tearing, module), "tears", &scope);
    let signs = equation.pattern(&tearing.signs, "signs", &scope);
    let carried = equation.pattern(&tearing.carried, "carried", &scope);
    let (given, statements, time) = (&equation.given, &equation.statements, equation.time());
    let size = newton.unknowns.len();
    let mut parts = equation.results.chunks(size.max(1));
    let mut vector = || {
        let part = parts.next().unwrap_or_default();
        quote!(Vector::from([#(#part),*]))
    };
    let [cosines, sines, rates, accelerations, residual] = std::array::from_fn(|_| vector());
    let responses = equation.results.get(5 * size..).unwrap_or_default();
    let (tear_count, size) = (count(tearing.tears.len()), count(size));
    quote! {
        #[inline]
        fn complete(
            &self,
            #tears: &[Scalar; #tear_count],
            #signs: &Self::Signs,
            #carried: &Self::Carried,
            #time: Scalar,
        ) -> torn::Completion<Scalar, Const<#size>> {
            #given
            #statements
            torn::Completion {
                cosines: #cosines,
                sines: #sines,
                rates: #rates,
                accelerations: #accelerations,
                residual: #residual,
                response: torn::largest_of(&[#(#responses),*]),
            }
        }
    }
}

fn signs(newton: &NewtonBlock, tearing: &Tearing, module: &Module<'_>) -> TokenStream {
    let all = positions(newton.unknowns.iter().copied(), module);
    let scope = Scope::with_tears(module, &tearing.sign_values, Place::Tears, all.clone());
    let equation = Equation::new(&scope);
    let q = equation.pattern(&all, "q", &scope);
    let (given, statements, time) = (&equation.given, &equation.statements, equation.time());
    let results = equation
        .results
        .iter()
        .map(|value| quote!(torn::sign(#value)));
    let size = count(newton.unknowns.len());
    let (argument, taken) = match q.to_string().starts_with('_') {
        true => (quote!(_q), TokenStream::new()),
        false => (quote!(q), quote!(let #q = &q.data.0[0];)),
    };
    quote! {
        fn signs(&self, #argument: &Vector<#size>, #time: Scalar) -> Self::Signs {
            #given
            #taken
            #statements
            [#(#results),*]
        }
    }
}

/// The call of the runtime that finds the unknowns with their rates, by way of the tears where it can.
pub(super) fn solve(
    number: Literal,
    mode: &Ident,
    block: &Block,
    (newton, torn): (&NewtonBlock, &TornFields),
    scope: &Scope<'_>,
) -> TokenStream {
    let module = scope.module;
    let equations = instance(block, newton, module);
    let fields = |frame: &str| -> Vec<TokenStream> {
        let memory = torn.memory.iter();
        memory.map(|&symbol| module.field(symbol, frame)).collect()
    };
    let (last, at) = (fields("last"), fields("at"));
    let ([determinant, signs @ ..], [kept, kept_signs @ ..]) = (&last[..], &at[..]) else {
        return TokenStream::new();
    };
    let kept_signs = match kept_signs {
        [] => TokenStream::new(),
        _ => quote!([#(#kept_signs),*] = found.memory.signs;),
    };
    let directions = [(1, quote!(cosines)), (0, quote!(sines))].map(|(which, part)| {
        let names: Vec<Option<TokenStream>> = torn
            .directions
            .iter()
            .map(|pair| {
                let symbol = (*pair)?[which];
                scope.is_read(symbol).then(|| scope.symbol(symbol))
            })
            .collect();
        if names.iter().all(Option::is_none) {
            return TokenStream::new();
        }
        let names = names.into_iter().map(|name| name.unwrap_or(quote!(_)));
        quote!(let [#(#names),*] = found.#part.data.0[0];)
    });
    quote! {
        let equations = #equations;
        let memory = torn::Memory { determinant: #determinant, signs: [#(#signs),*] };
        let found = torn::solve(&equations, &tears, &memory, conditions.start, &mut branches.#mode, conditions.t, conditions.settings)
            .map_err(|failure| failure.in_block(#number))?;
        let tears = found.frame;
        #kept = found.memory.determinant;
        #kept_signs
        #(#directions)*
    }
}
