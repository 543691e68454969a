//! Straight-line code → statements and expressions of Rust.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::given::read;
use super::literal::{count, float};
use super::tables::table_name;
use crate::expr::{ExprId, Node, SplineId, SymbolId};
use crate::program::{
    Addend, Compared, ConstantPart, Constants, LARGEST_PRODUCT, Power, Program, Statement,
    Straight, addends, compared,
};
use crate::system::{SymbolRole, System, WrittenOrder};

/// What expressions are called where they are written.
pub(super) trait Names {
    /// The name of an expression that was computed before.
    fn value(&self, expr: ExprId) -> Option<Ident>;
    /// How a variable is read.
    fn symbol(&self, symbol: SymbolId) -> TokenStream;
}

/// Writes expressions.
#[derive(Clone, Copy)]
pub(super) struct Writer<'a> {
    pub system: &'a System,
    pub constants: &'a Constants,
    pub names: &'a dyn Names,
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
    /// Definitions of functions' values and of what is shared.
    pub(super) fn statements(&self, straight: &Straight) -> Vec<TokenStream> {
        let statements = straight.statements.iter();
        statements
            .map(|statement| self.statement(statement))
            .collect()
    }

    /// One definition.
    pub(super) fn statement(&self, statement: &Statement) -> TokenStream {
        match statement {
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let (sine, cosine) = (identifier(sine), identifier(cosine));
                let angle = self.expression(*angle, &[]);
                quote!(let (#sine, #cosine) = math::sin_cos(#angle);)
            }
            Statement::Value { name, expr } => {
                let name = identifier(name);
                let value = self.function(*expr).unwrap_or_else(|| self.sum(*expr, &[]));
                quote!(let #name = #value;)
            }
            Statement::Lookup {
                names,
                spline,
                argument,
            } => {
                let last = names.iter().rposition(Option::is_some).unwrap_or(0);
                let names = names[..=last].iter().map(|name| match name {
                    Some(name) => {
                        let name = identifier(name);
                        quote!(#name,)
                    }
                    None => quote!(_,),
                });
                let rest = if last < 3 {
                    quote!(..)
                } else {
                    TokenStream::new()
                };
                let lookup = self.lookup(*spline, *argument);
                quote!(let [#(#names)* #rest] = #lookup;)
            }
        }
    }

    /// A function's call.
    fn function(&self, expr: ExprId) -> Option<TokenStream> {
        match *self.system.mechanism.graph.node(expr) {
            Node::Sin(x) => Some(self.call("sin", &[x])),
            Node::Cos(x) => Some(self.call("cos", &[x])),
            Node::Exp(x) => Some(self.call("exp", &[x])),
            Node::Ln(x) => Some(self.call("ln", &[x])),
            Node::Atan2(y, x) => Some(self.call("atan2", &[y, x])),
            Node::Floor(x) => Some(self.call("floor", &[x])),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => Some(self.choice(condition, below, otherwise)),
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let (lookup, order) = (self.lookup(spline, argument), count(order.into()));
                Some(quote!(#lookup[#order]))
            }
            Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Sum(_) | Node::Product(_) => None,
        }
    }

    /// `if x < 2.0 { … } else { … }`; a second arm that is another choice without a name continues with `else if`.
    fn choice(&self, condition: ExprId, below: ExprId, otherwise: ExprId) -> TokenStream {
        let graph = &self.system.mechanism.graph;
        let named = |other: ExprId| self.names.value(other).is_some();
        let order = WrittenOrder::new(self.system, &[]);
        let Compared {
            left,
            is_less,
            right,
        } = compared(condition, graph, &order, &named);
        let [left, right] = [left, right].map(|side| self.addends(&side));
        let sign = if is_less { quote!(<) } else { quote!(>) };
        let continues = matches!(graph.node(otherwise), Node::Choose { .. }) && !named(otherwise);
        let [below, otherwise] = [below, otherwise].map(|arm| self.expression(arm, &[]));
        if continues {
            quote!(if #left #sign #right { #below } else #otherwise)
        } else {
            quote!(if #left #sign #right { #below } else { #otherwise })
        }
    }

    /// `TABLE_LIFT.at(x)`: the value and three derivatives.
    fn lookup(&self, spline: SplineId, argument: ExprId) -> TokenStream {
        let table = table_name(&self.system.mechanism.graph.spline_of(spline).name);
        let argument = self.expression(argument, &[]);
        quote!(#table.at(#argument))
    }

    fn call(&self, function: &str, arguments: &[ExprId]) -> TokenStream {
        let function = format_ident!("{function}");
        let arguments = arguments
            .iter()
            .map(|argument| self.expression(*argument, &[]));
        quote!(math::#function(#(#arguments),*))
    }

    /// The results in order, each with its terms in the order of its row.
    pub(super) fn results(&self, straight: &Straight) -> Vec<TokenStream> {
        straight
            .results
            .iter()
            .map(|(expr, bodies)| self.expression(*expr, bodies))
            .collect()
    }

    /// An expression whose terms mention the bodies in this order.
    pub(super) fn expression(&self, expr: ExprId, bodies: &[usize]) -> TokenStream {
        self.atom(expr).unwrap_or_else(|| self.sum(expr, bodies))
    }

    /// A name, an input or a call.
    fn atom(&self, expr: ExprId) -> Option<TokenStream> {
        if let Some(name) = self.names.value(expr) {
            return Some(quote!(#name));
        }
        let graph = &self.system.mechanism.graph;
        match graph.node(expr) {
            Node::Symbol(symbol) => Some(self.names.symbol(*symbol)),
            _ if graph.is_constant(expr) => None,
            _ => self.function(expr),
        }
    }

    fn sum(&self, expr: ExprId, bodies: &[usize]) -> TokenStream {
        let named = |other: ExprId| self.names.value(other).is_some();
        let order = WrittenOrder::new(self.system, bodies);
        let addends = addends(expr, &self.system.mechanism.graph, &order, &named);
        self.addends(&addends)
    }

    fn addends(&self, addends: &[Addend]) -> TokenStream {
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
        let is_choice = matches!(self.system.mechanism.graph.node(expr), Node::Choose { .. });
        let atom = self.atom(expr);
        match atom {
            Some(atom) if !is_choice || self.names.value(expr).is_some() => atom,
            Some(choice) => quote!((#choice)),
            None => {
                let sum = self.sum(expr, &[]);
                quote!((#sum))
            }
        }
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

/// The textbook's functions: coordinates are fields of `q`, `qd` and `qdd`.
pub(super) struct TextbookNames<'a> {
    pub system: &'a System,
    pub straight: &'a Straight,
}

impl Names for TextbookNames<'_> {
    fn value(&self, expr: ExprId) -> Option<Ident> {
        self.straight.name_of(expr).map(identifier)
    }

    fn symbol(&self, symbol: SymbolId) -> TokenStream {
        let (vector, unknown) = match self.system.roles[symbol.index()] {
            SymbolRole::Position(unknown) => ("q", unknown),
            SymbolRole::Rate(unknown) => ("qd", unknown),
            SymbolRole::Acceleration(unknown) => ("qdd", unknown),
            SymbolRole::Time => return quote!(t),
            SymbolRole::Parameter(_) | SymbolRole::Input { .. } => {
                return read(symbol, self.system).unwrap_or_default();
            }
            SymbolRole::Arm(_) | SymbolRole::Intermediate => {
                let name = identifier(self.system.local_name(symbol));
                return quote!(#name);
            }
        };
        let (vector, field) = (
            format_ident!("{vector}"),
            identifier(self.system.unknown_name(unknown)),
        );
        quote!(#vector.#field)
    }
}

/// The statements of a function of the textbook view, and its results.
pub(super) fn written(
    system: &System,
    program: &Program,
    straight: &Straight,
) -> (Vec<TokenStream>, Vec<TokenStream>) {
    let names = TextbookNames { system, straight };
    let writer = Writer {
        system,
        constants: &program.constants,
        names: &names,
    };
    (writer.statements(straight), writer.results(straight))
}
