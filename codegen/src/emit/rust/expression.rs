//! Functions → statements and expressions of Rust.

use std::collections::HashSet;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::layout::{Lines, comment, tokens};
use super::literal::count;
use super::names::{identifier, identifier_text};
use super::tables::table_name;
use crate::emit::module::arithmetic::{Arithmetic, Choice, Elementary};
use crate::emit::module::documentation;
use crate::emit::module::scope::Scope;
use crate::expr::{ExprId, SplineId, SymbolId};
use crate::model::field_name;
use crate::program::{Function, Statement};

impl Scope<'_> {
    /// The statements of the function; those of Newton-Raphson by `iterated`.
    pub(super) fn statements(
        &self,
        block: usize,
        iterated: &dyn Fn(&Statement) -> TokenStream,
    ) -> Vec<TokenStream> {
        let mut found = Vec::new();
        // What is a line already needs no syntax, which takes the formatter most of its time.
        let mut lines = Lines::default();
        for statement in &self.function.statements {
            let line = self.line(statement);
            if line.as_ref().is_some_and(|line| lines.take(line)) {
                continue;
            }
            found.extend(lines.statement());
            found.push(match line {
                Some(line) => tokens(&line),
                None => self.statement(statement, block, iterated),
            });
        }
        found.extend(lines.statement());
        found
    }

    /// Those of a function without Newton-Raphson.
    pub(super) fn plain_statements(&self) -> Vec<TokenStream> {
        self.statements(0, &|_| TokenStream::new())
    }

    /// A statement that computes some value, as a line.
    fn line(&self, statement: &Statement) -> Option<String> {
        let write = |expr: &ExprId| self.written(&self.arithmetic(*expr, &[]));
        match statement {
            Statement::Let { target, value, .. } => {
                let value = self.written(&self.arithmetic_of(*target, *value));
                let name = self.read(*target);
                Some(match self.is_field(*target) {
                    true => format!("{name} = {value};"),
                    false => format!("let {name} = {value};"),
                })
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let [sine, cosine] = [sine, cosine].map(|symbol| match self.is_unnamed(*symbol) {
                    true => "_".to_string(),
                    false => self.read(*symbol),
                });
                let angle = write(angle);
                Some(format!("let ({sine}, {cosine}) = math::sin_cos({angle});"))
            }
            Statement::Angle {
                target,
                sine,
                cosine,
            } => {
                let (sine, cosine) = (write(sine), write(cosine));
                let [at, near] = ["at", "last"].map(|frame| self.module.field_text(*target, frame));
                Some(format!("{at} = angle_near({sine}, {cosine}, {near});"))
            }
            Statement::Require { value, block } => {
                let number = self.module.block_number(*block);
                Some(format!("required({}, {number})?;", write(value)))
            }
            _ => None,
        }
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
            Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. } => {
                let said = documentation::of_statement(statement, self.module);
                said.map_or(TokenStream::new(), |text| comment(&text))
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
                let lookup = tokens(&self.lookup(*spline, &self.arithmetic(*argument, &[])));
                quote!(let [#(#names),* #rest] = #lookup;)
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
            // Lines.
            Statement::Let { .. }
            | Statement::SineCosine { .. }
            | Statement::Angle { .. }
            | Statement::Require { .. } => TokenStream::new(),
            Statement::Newton { .. } | Statement::Factorize => iterated(statement),
            Statement::Signal { input, found } => {
                let field = identifier(&field_name(
                    &self.module.system.mechanism.inputs[*input].name,
                ));
                let signal = quote!(span.signal(&before.#field, &inputs.#field));
                let [radius, sag] = found.map(|symbol| self.found(symbol));
                quote!(let [#radius, #sag] = #signal;)
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
            Statement::Multipliers {
                targets,
                jacobian,
                forces,
            } => {
                let rows = jacobian.chunks(forces.len()).map(|row| {
                    let row = row.iter().map(write);
                    quote!([#(#row),*])
                });
                let forces = forces.iter().map(write);
                let found = targets.iter().enumerate();
                let assignments = found.filter_map(|(place, target)| {
                    let place = count(place);
                    Some(self.assignment((*target)?, quote!(balance[#place])))
                });
                quote! {
                    let balance = multipliers([#(#rows),*], [#(#forces),*], t, #number)?;
                    #(#assignments)*
                }
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
        let call = match varied {
            // What is linear does not vary.
            [] => quote!(isolate(#bounds, &jacobian, |_, _| {})?),
            _ => quote! {
                isolate(#bounds, &jacobian, |sags, variation| {
                    let &[#(#arguments),*] = sags;
                    #(#statements)*
                    #(#results)*
                })?
            },
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
        count(usize::from(self.module.block_number(place)))
    }

    /// The name of what a statement of a path finds, or else `_` where nobody reads it.
    fn found(&self, symbol: SymbolId) -> TokenStream {
        match self.is_wanted(symbol) {
            true => self.symbol(symbol),
            false => quote!(_),
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

    /// The results in order, each with its terms in the order of its row.
    pub(super) fn results(&self) -> Vec<TokenStream> {
        let results = self.function.results.iter();
        results
            .map(|result| self.expression(result.expr, &result.bodies))
            .collect()
    }

    /// An expression whose terms mention the bodies in this order.
    pub(super) fn expression(&self, expr: ExprId, bodies: &[usize]) -> TokenStream {
        tokens(&self.written(&self.arithmetic(expr, bodies)))
    }

    /// What computes a number.
    fn written(&self, arithmetic: &Arithmetic) -> String {
        match arithmetic {
            Arithmetic::Number(value) => self.module.number(*value),
            Arithmetic::Constant(name) => identifier_text(name),
            Arithmetic::Variable(symbol) => self.read(*symbol),
            Arithmetic::Sum(terms) => {
                let terms = terms.iter().enumerate().map(|(place, (negative, term))| {
                    let term = match term {
                        Arithmetic::Choice(_) => self.operand(term),
                        _ => self.written(term),
                    };
                    match (place, negative) {
                        (0, false) => term,
                        (0, true) => format!("-{term}"),
                        (_, false) => format!(" + {term}"),
                        (_, true) => format!(" - {term}"),
                    }
                });
                chained(terms.collect())
            }
            Arithmetic::Product { factors, divisors } => {
                let numerator = self.product(factors);
                match divisors.as_slice() {
                    [] => numerator,
                    [only] => format!("{numerator} / {}", self.operand(only)),
                    _ => format!("{numerator} / ({})", self.product(divisors)),
                }
            }
            Arithmetic::Call(function, arguments) => {
                let arguments = arguments.iter().map(|argument| self.written(argument));
                let arguments: Vec<String> = arguments.collect();
                format!("math::{}({})", called(*function), arguments.join(", "))
            }
            Arithmetic::Lookup {
                spline,
                order,
                place,
            } => format!("{}[{order}]", self.lookup(*spline, place)),
            Arithmetic::Choice(choice) => self.choice(choice),
        }
    }

    /// `if x < 2.0 { … } else { … }`; a second arm that is another choice continues with `else if`.
    fn choice(&self, choice: &Choice) -> String {
        let [left, right] = [&choice.left, &choice.right].map(|side| match side {
            Arithmetic::Choice(_) => self.operand(side),
            _ => self.written(side),
        });
        let sign = if choice.is_less { "<" } else { ">" };
        let [below, otherwise] = [&choice.below, &choice.otherwise].map(|arm| self.written(arm));
        let otherwise = match choice.otherwise {
            Arithmetic::Choice(_) => otherwise,
            _ => format!("{{ {otherwise} }}"),
        };
        format!("if {left} {sign} {right} {{ {below} }} else {otherwise}")
    }

    /// `TABLE_LIFT.at(x)`: the value and three derivatives.
    fn lookup(&self, spline: SplineId, place: &Arithmetic) -> String {
        let table = table_name(&self.module.system.mechanism.graph.spline_of(spline).name);
        format!("{table}.at({})", self.written(place))
    }

    fn product(&self, factors: &[Arithmetic]) -> String {
        let factors = factors.iter().enumerate().map(|(place, factor)| {
            let factor = self.operand(factor);
            match place {
                0 => factor,
                _ => format!(" * {factor}"),
            }
        });
        chained(factors.collect())
    }

    /// What stands beside a multiplication sign.
    fn operand(&self, arithmetic: &Arithmetic) -> String {
        let written = self.written(arithmetic);
        match arithmetic {
            Arithmetic::Sum(_) | Arithmetic::Product { .. } | Arithmetic::Choice(_) => {
                format!("({written})")
            }
            _ => written,
        }
    }
}

/// What the runtime calls an elementary function.
fn called(function: Elementary) -> &'static str {
    match function {
        Elementary::Sin => "sin",
        Elementary::Cos => "cos",
        Elementary::Exp => "exp",
        Elementary::Ln => "ln",
        Elementary::Atan2 => "atan2",
        Elementary::Floor => "floor",
        Elementary::Abs => "abs",
        Elementary::Sqrt => "sqrt",
        Elementary::Power => "powf",
    }
}

/// So many operations of one chain nest in the syntax of Rust, which compilers and formatters walk by recursion.
const LONGEST_CHAIN: usize = 500;

/// Operations one after the other; a long chain in steps, in the same order.
fn chained(parts: Vec<String>) -> String {
    let mut chunks = parts.chunks(LONGEST_CHAIN);
    let first = chunks.next().unwrap_or_default().concat();
    let Some(last) = chunks.next_back() else {
        return first;
    };
    let steps = chunks.map(|chunk| format!("let partial = partial{};", chunk.concat()));
    let steps: String = steps.collect();
    format!(
        "{{ let partial = {first}; {steps} partial{} }}",
        last.concat()
    )
}
