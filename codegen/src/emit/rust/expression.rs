//! Straight-line code → statements and expressions of Rust.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::literal::float;
use crate::expr::{ExprId, Node};
use crate::program::{
    Addend, ConstantPart, Constants, LARGEST_PRODUCT, Power, Statement, Straight,
};
use crate::system::{SymbolRole, System};

/// Writes the code of one function.
#[derive(Clone, Copy)]
pub(super) struct Writer<'a> {
    pub system: &'a System,
    pub constants: &'a Constants,
    pub straight: &'a Straight,
}

/// A name as an identifier; words that Rust reserves get an underscore.
pub(super) fn identifier(name: &str) -> Ident {
    if syn::parse_str::<Ident>(name).is_ok() {
        format_ident!("{name}")
    } else {
        format_ident!("{name}_")
    }
}

impl Writer<'_> {
    /// The definitions before the results.
    pub(super) fn statements(&self) -> Vec<TokenStream> {
        let graph = &self.system.mechanism.graph;
        let statement = |statement: &Statement| match statement {
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let (sine, cosine, angle) = (
                    identifier(sine),
                    identifier(cosine),
                    self.expression(*angle, &[]),
                );
                quote!(let (#sine, #cosine) = math::sin_cos(#angle);)
            }
            Statement::Value { name, expr } => {
                let name = identifier(name);
                let value = match *graph.node(*expr) {
                    Node::Sin(x) => self.call("sin", &[x]),
                    Node::Cos(x) => self.call("cos", &[x]),
                    Node::Exp(x) => self.call("exp", &[x]),
                    Node::Ln(x) => self.call("ln", &[x]),
                    Node::Atan2(y, x) => self.call("atan2", &[y, x]),
                    _ => self.sum(*expr, &[]),
                };
                quote!(let #name = #value;)
            }
        };
        self.straight.statements.iter().map(statement).collect()
    }

    fn call(&self, function: &str, arguments: &[ExprId]) -> TokenStream {
        let function = format_ident!("{function}");
        let arguments = arguments
            .iter()
            .map(|argument| self.expression(*argument, &[]));
        quote!(math::#function(#(#arguments),*))
    }

    /// The results in order, each with its terms in the order of its row.
    pub(super) fn results(&self) -> Vec<TokenStream> {
        self.straight
            .results
            .iter()
            .map(|(expr, bodies)| self.expression(*expr, bodies))
            .collect()
    }

    fn expression(&self, expr: ExprId, bodies: &[usize]) -> TokenStream {
        self.atom(expr).unwrap_or_else(|| self.sum(expr, bodies))
    }

    /// A name or an input.
    fn atom(&self, expr: ExprId) -> Option<TokenStream> {
        if let Some(name) = self.straight.name_of(expr) {
            let name = identifier(name);
            return Some(quote!(#name));
        }
        let Node::Symbol(symbol) = self.system.mechanism.graph.node(expr) else {
            return None;
        };
        let (vector, coordinate) = match self.system.roles[symbol.index()] {
            SymbolRole::Position(coordinate) => ("q", coordinate),
            SymbolRole::Rate(coordinate) => ("qd", coordinate),
            SymbolRole::Acceleration(coordinate) => ("qdd", coordinate),
            SymbolRole::Time => return Some(quote!(t)),
        };
        let (vector, field) = (
            format_ident!("{vector}"),
            identifier(&self.system.coordinates[coordinate].name),
        );
        Some(quote!(#vector.#field))
    }

    fn sum(&self, expr: ExprId, bodies: &[usize]) -> TokenStream {
        let addends = self.straight.addends(expr, self.system, bodies);
        let mut tokens = TokenStream::new();
        for (position, addend) in addends.iter().enumerate() {
            let value = self.addend(addend);
            tokens.extend(match (position, addend.negative) {
                (0, false) => value,
                (0, true) => quote!(-#value),
                (_, false) => quote!(+ #value),
                (_, true) => quote!(- #value),
            });
        }
        // A sum without terms is the number zero.
        if addends.is_empty() {
            quote!(0.0)
        } else {
            tokens
        }
    }

    /// An addend without its sign.
    fn addend(&self, addend: &Addend) -> TokenStream {
        let constant = addend.constant.iter().map(|part| self.constant(part));
        let factors: Vec<TokenStream> = constant
            .chain(addend.factors.iter().flat_map(|power| self.power(power)))
            .collect();
        let numerator = if factors.is_empty() {
            quote!(1.0)
        } else {
            product(&factors)
        };
        let divisors: Vec<TokenStream> = addend
            .divisors
            .iter()
            .flat_map(|power| self.power(power))
            .collect();
        match divisors.as_slice() {
            [] => numerator,
            [only] => quote!(#numerator / #only),
            _ => {
                let divisor = product(&divisors);
                quote!(#numerator / (#divisor))
            }
        }
    }

    /// A literal or the name of a constant.
    fn constant(&self, part: &ConstantPart) -> TokenStream {
        match self.constants.name_of(part) {
            Some(name) => {
                let name = identifier(name);
                quote!(#name)
            }
            None => float(part.value(&self.system.mechanism.graph)),
        }
    }

    /// The factors that a power is written as.
    fn power(&self, power: &Power) -> Vec<TokenStream> {
        let base = self.operand(power.base);
        match (power.exponent.numerator(), power.exponent.denominator()) {
            (whole, 1) if whole <= LARGEST_PRODUCT => vec![base; whole.unsigned_abs() as usize],
            (1, 2) => {
                let radicand = self.expression(power.base, &[]);
                vec![quote!(math::sqrt(#radicand))]
            }
            _ => {
                let (base, exponent) = (
                    self.expression(power.base, &[]),
                    float(power.exponent.to_f64()),
                );
                vec![quote!(math::powf(#base, #exponent))]
            }
        }
    }

    /// What stands beside a multiplication sign.
    fn operand(&self, expr: ExprId) -> TokenStream {
        self.atom(expr).unwrap_or_else(|| {
            let sum = self.sum(expr, &[]);
            quote!((#sum))
        })
    }
}

fn product(factors: &[TokenStream]) -> TokenStream {
    let mut tokens = TokenStream::new();
    for (position, factor) in factors.iter().enumerate() {
        tokens.extend(if position == 0 {
            factor.clone()
        } else {
            quote!(* #factor)
        });
    }
    tokens
}
