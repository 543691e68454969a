//! Functions → statements and expressions of Rust.

use std::collections::HashSet;

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::layout::comment;
use super::literal::count;
use super::names::identifier;
use super::scope::Scope;
use super::tables::table_name;
use crate::expr::{ExprId, Node, SplineId, SymbolId};
use crate::model::field_name;
use crate::program::{
    Addend, Compared, ConstantPart, Function, LARGEST_PRODUCT, Level, Power, Statement, addends,
    compared,
};
use crate::system::{Cause, WrittenOrder};

impl Scope<'_> {
    /// The statements of the function; those of Newton-Raphson by `iterated`.
    pub(super) fn statements(
        &self,
        block: usize,
        iterated: &dyn Fn(&Statement) -> TokenStream,
    ) -> Vec<TokenStream> {
        let statements = self.function.statements.iter();
        statements
            .map(|statement| self.statement(statement, block, iterated))
            .collect()
    }

    /// Those of a function without Newton-Raphson.
    pub(super) fn plain_statements(&self) -> Vec<TokenStream> {
        self.statements(0, &|_| TokenStream::new())
    }

    fn statement(
        &self,
        statement: &Statement,
        block: usize,
        iterated: &dyn Fn(&Statement) -> TokenStream,
    ) -> TokenStream {
        let number = count(block);
        let write = |expr: &ExprId| self.expression(*expr, &[]);
        match statement {
            Statement::Section(level) => comment(&self.section(*level)),
            Statement::Heading(words) => comment(&self.module.said(words)),
            Statement::Note(_) | Statement::Shown { .. } => TokenStream::new(),
            Statement::Let { target, value, .. } => {
                let value = self
                    .named_function(*target, *value)
                    .unwrap_or_else(|| self.expression(*value, &[]));
                self.assignment(*target, value)
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let angle = write(angle);
                let [sine, cosine] = [sine, cosine].map(|symbol| self.symbol(*symbol));
                quote!(let (#sine, #cosine) = math::sin_cos(#angle);)
            }
            Statement::Lookup {
                targets,
                spline,
                argument,
            } => {
                let last = targets.iter().rposition(Option::is_some).unwrap_or(0);
                let names = targets[..=last].iter().map(|target| match target {
                    Some(target) => self.symbol(*target),
                    None => quote!(_),
                });
                let names: Vec<TokenStream> = names.collect();
                let rest = if last < 3 {
                    quote!(, ..)
                } else {
                    TokenStream::new()
                };
                let lookup = self.lookup(*spline, *argument);
                quote!(let [#(#names),* #rest] = #lookup;)
            }
            Statement::Angle {
                target,
                sine,
                cosine,
            } => {
                let (sine, cosine) = (write(sine), write(cosine));
                let [at, near] = ["at", "last"]
                    .map(|frame| self.module.field(*target, &format_ident!("{frame}")));
                quote!(#at = angle_near(#sine, #cosine, #near);)
            }
            Statement::Reach {
                excess,
                scale,
                distance,
                longest,
                shortest,
            } => {
                let [excess, scale, distance, longest, shortest] =
                    [excess, scale, distance, longest, shortest].map(write);
                if self.is_inside() {
                    return quote! {
                        if !spans(#excess, #scale) {
                            return None;
                        }
                    };
                }
                quote! {
                    if !spans(#excess, #scale) {
                        return Err(no_span(#distance, #longest, #shortest, t, #number));
                    }
                }
            }
            Statement::Nonzero { value, scale } => {
                let (value, scale) = (write(value), write(scale));
                if self.is_inside() {
                    return quote! {
                        if !spans(#value * #value, #scale * #scale) {
                            return None;
                        }
                    };
                }
                quote! {
                    if !spans(#value * #value, #scale * #scale) {
                        return Err(singular_divisor(#value, #scale, t, #number));
                    }
                }
            }
            Statement::Newton { .. } | Statement::Factorize => iterated(statement),
            Statement::Signal { input, found } => {
                let field = identifier(&field_name(
                    &self.module.system.mechanism.inputs[*input].name,
                ));
                let signal = quote!(span.signal(&before.#field, &inputs.#field));
                let [radius, sag] = found.map(|symbol| self.found(symbol));
                quote!(let [#radius, #sag] = #signal;)
            }
            Statement::Require { value, block } => {
                let value = write(value);
                let block = self.block_number(*block);
                quote!(required(#value, #block)?;)
            }
            Statement::Isolate {
                blocks,
                found,
                bounds,
                sizes,
                jacobian,
                varied,
                variation,
            } => {
                let blocks = blocks.iter().map(|&place| self.block_number(place));
                let bounds = bounds.iter().map(write);
                let (order, one) = (count(sizes.len()), self.module.system.mechanism.graph.one());
                let sizes = match sizes.iter().all(|size| *size == one) {
                    true => quote!([1.0; #order]),
                    false => {
                        let sizes = sizes.iter().map(write);
                        quote!([#(#sizes),*])
                    }
                };
                let bounds = quote!([#(#blocks),*], [#(#bounds),*], #sizes);
                self.isolation(found, bounds, jacobian, (varied, variation))
            }
            Statement::Solve {
                targets,
                right_hand_side,
            } => {
                let values = right_hand_side.iter().map(write);
                let found = targets.iter().enumerate();
                let assignments = found.filter_map(|(place, target)| {
                    let place = count(place);
                    Some(self.assignment((*target)?, quote!(response[#place])))
                });
                quote! {
                    let mut response = Vector::from([#(#values),*]);
                    factorization.solve(&mut response);
                    #(#assignments)*
                }
            }
        }
    }

    /// Finds the sags of unknowns about the line that they should run along.
    fn isolation(
        &self,
        found: &[SymbolId],
        bounds: TokenStream,
        jacobian: &[([usize; 2], ExprId)],
        (varied, variation): (&[[usize; 2]], &Function),
    ) -> TokenStream {
        let filled = |matrix: TokenStream, [row, column]: [usize; 2], value: TokenStream| {
            let [row, column] = [row, column].map(count);
            quote!(#matrix[(#row, #column)] = #value;)
        };
        let entries = jacobian.iter();
        let entries = entries
            .map(|&(place, entry)| filled(quote!(jacobian), place, self.expression(entry, &[])));
        let inner = self.inner(variation);
        let statements = inner.plain_statements();
        let results = varied.iter().zip(inner.results());
        let results = results.map(|(&place, result)| filled(quote!(variation), place, result));
        let graph = &self.module.system.mechanism.graph;
        let read: HashSet<SymbolId> = variation
            .values()
            .flat_map(|expr| graph.symbols(expr))
            .copied()
            .collect();
        let arguments = found.iter().map(|symbol| match read.contains(symbol) {
            true => self.symbol(*symbol),
            false => quote!(_),
        });
        let call = quote! {
            isolate(#bounds, &jacobian, |sags, variation| {
                let &[#(#arguments),*] = sags;
                #(#statements)*
                #(#results)*
            })?
        };
        let outer: Vec<TokenStream> = found.iter().map(|symbol| self.found(*symbol)).collect();
        let found = match outer.iter().all(|name| name.to_string() == "_") {
            true => quote!(#call;),
            false => quote!(let [#(#outer),*] = #call;),
        };
        quote! {
            let mut jacobian = Matrix::zeros();
            #(#entries)*
            #found
        }
    }

    fn block_number(&self, place: usize) -> Literal {
        count(usize::from(self.module.program.number_of(place)))
    }

    /// The name of what a statement of a path finds, or else `_` where nobody reads it.
    fn found(&self, symbol: SymbolId) -> TokenStream {
        match self.module.has_tube(symbol) || self.is_read(symbol) {
            true => self.symbol(symbol),
            false => quote!(_),
        }
    }

    fn section(&self, level: Level) -> String {
        let system = self.module.system;
        match level {
            Level::Position => "Position.".to_string(),
            Level::Velocity => "Velocity.".to_string(),
            Level::Acceleration => "Acceleration.".to_string(),
            Level::Response(direction) => match system.directions[direction].cause {
                Cause::Driver { joint, .. } => {
                    format!("Response to {}.", system.mechanism.joints[joint].label)
                }
                Cause::Parameter(place) => {
                    format!(
                        "Sensitivity to {}.",
                        system.mechanism.parameters[place].name
                    )
                }
            },
            Level::ResponseRate(_) => "Rate of this sensitivity.".to_string(),
        }
    }

    /// `let name = value;`, or an assignment to a field.
    fn assignment(&self, target: SymbolId, value: TokenStream) -> TokenStream {
        let name = self.symbol(target);
        match self.is_field(target) {
            true => quote!(#name = #value;),
            false => quote!(let #name = #value;),
        }
    }

    /// The value of an expression where it gets its name.
    fn named_function(&self, target: SymbolId, expr: ExprId) -> Option<TokenStream> {
        (self.function.name_of(expr) == Some(target)).then(|| {
            self.function_call(expr)
                .unwrap_or_else(|| self.sum(expr, &[]))
        })
    }

    /// A function's call.
    fn function_call(&self, expr: ExprId) -> Option<TokenStream> {
        match *self.module.system.mechanism.graph.node(expr) {
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
            } => Some(
                match self.module.system.mechanism.graph.magnitude_of(expr) {
                    Some(value) => self.call("abs", &[value]),
                    None => self.choice(condition, below, otherwise),
                },
            ),
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
        let graph = &self.module.system.mechanism.graph;
        let named = |other: ExprId| self.function.name_of(other).is_some();
        let order = WrittenOrder::new(self.module.system, &[]);
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
        let table = table_name(&self.module.system.mechanism.graph.spline_of(spline).name);
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
    pub(super) fn results(&self) -> Vec<TokenStream> {
        let results = self.function.results.iter();
        results
            .map(|result| self.expression(result.expr, &result.bodies))
            .collect()
    }

    /// An expression whose terms mention the bodies in this order.
    pub(super) fn expression(&self, expr: ExprId, bodies: &[usize]) -> TokenStream {
        self.atom(expr).unwrap_or_else(|| self.sum(expr, bodies))
    }

    /// A name, an input or a call.
    fn atom(&self, expr: ExprId) -> Option<TokenStream> {
        if let Some(name) = self.value(expr) {
            return Some(quote!(#name));
        }
        let graph = &self.module.system.mechanism.graph;
        match graph.node(expr) {
            Node::Symbol(symbol) => Some(self.symbol(*symbol)),
            _ if graph.is_constant(expr) => None,
            _ => self.function_call(expr),
        }
    }

    fn sum(&self, expr: ExprId, bodies: &[usize]) -> TokenStream {
        let named = |other: ExprId| self.function.name_of(other).is_some();
        let order = WrittenOrder::new(self.module.system, bodies);
        let addends = addends(expr, &self.module.system.mechanism.graph, &order, &named);
        self.addends(&addends)
    }

    fn addends(&self, addends: &[Addend]) -> TokenStream {
        // A sum without terms is the number zero.
        if addends.is_empty() {
            return quote!(0.0);
        }
        let value = |(position, addend): (usize, &Addend)| {
            let value = self.addend(addend);
            match (position, addend.negative) {
                (0, false) => value,
                (0, true) => quote!(-#value),
                (_, false) => quote!(+ #value),
                (_, true) => quote!(- #value),
            }
        };
        chained(addends.iter().enumerate().map(value).collect())
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
        match self.module.program.constants.name_of(part) {
            Some(name) => {
                let name = super::names::identifier(name);
                quote!(#name)
            }
            None => self
                .module
                .float(part.value(&self.module.system.mechanism.graph)),
        }
    }

    /// The factors that a power is written as.
    fn power(&self, power: &Power) -> Vec<TokenStream> {
        match (power.exponent.numerator(), power.exponent.denominator()) {
            (whole, 1) if whole <= LARGEST_PRODUCT => {
                vec![self.operand(power.base); whole.unsigned_abs() as usize]
            }
            (1, 2) => {
                let radicand = self.expression(power.base, &[]);
                vec![quote!(math::sqrt(#radicand))]
            }
            _ => {
                let (base, exponent) = (
                    self.expression(power.base, &[]),
                    self.module.float(power.exponent.to_f64()),
                );
                vec![quote!(math::powf(#base, #exponent))]
            }
        }
    }

    /// What stands beside a multiplication sign.
    fn operand(&self, expr: ExprId) -> TokenStream {
        let graph = &self.module.system.mechanism.graph;
        let is_choice =
            matches!(graph.node(expr), Node::Choose { .. }) && graph.magnitude_of(expr).is_none();
        let atom = self.atom(expr);
        match atom {
            Some(atom) if !is_choice || self.value(expr).is_some() => atom,
            Some(choice) => quote!((#choice)),
            None => {
                let sum = self.sum(expr, &[]);
                quote!((#sum))
            }
        }
    }
}

fn product(factors: &[TokenStream]) -> TokenStream {
    let parts = factors
        .iter()
        .enumerate()
        .map(|(position, factor)| match position {
            0 => factor.clone(),
            _ => quote!(* #factor),
        });
    chained(parts.collect())
}

/// So many operations of one chain nest in the syntax of Rust, which compilers and formatters walk by recursion.
const LONGEST_CHAIN: usize = 500;

/// Operations one after the other; a long chain in steps, in the same order.
fn chained(parts: Vec<TokenStream>) -> TokenStream {
    let mut chunks = parts.chunks(LONGEST_CHAIN);
    let first = chunks.next().unwrap_or_default();
    let Some(last) = chunks.next_back() else {
        return quote!(#(#first)*);
    };
    let steps = chunks.map(|chunk| quote!(let partial = partial #(#chunk)*;));
    quote!({ let partial = #(#first)*; #(#steps)* partial #(#last)* })
}
