//! Functions → statements of Rust.

use std::collections::HashSet;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::code::{Code, tokens};
use super::literal::count;
use super::names::identifier_text;
use crate::emit::module::documentation;
use crate::emit::module::scope::Scope;
use crate::expr::{ExprId, SymbolId};
use crate::model::field_name;
use crate::program::{Arithmetic, Function, Statement};

impl Scope<'_> {
    /// The statements of the function; those of Newton-Raphson by `iterated`.
    pub(super) fn statements(
        &self,
        block: usize,
        iterated: &dyn Fn(&Statement) -> TokenStream,
    ) -> Code {
        let mut code = Code::default();
        for statement in &self.function.statements {
            match self.lines(statement, block) {
                Some(lines) => code.push(&lines),
                None => self.statement(statement, block, iterated, &mut code),
            }
        }
        code
    }

    /// Those of a function without Newton-Raphson.
    pub(super) fn plain_statements(&self) -> Code {
        self.statements(0, &|_| TokenStream::new())
    }

    /// A statement in lines, where it is one of those that there are many of.
    fn lines(&self, statement: &Statement, block: usize) -> Option<String> {
        let write = |expr: &ExprId| self.value(*expr);
        match statement {
            Statement::Let { target, value, .. } => {
                let value = self.written(&self.evaluation().assigned(*target, *value));
                Some(self.assignment(*target, &value))
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
            Statement::Positive { length, joint } => {
                let (place, length) = (self.module.requirement_place(*joint), write(length));
                Some(format!(
                    "if {length} <= 0.0 {{\n    return Err(not_positive({length}, t, {place}));\n}}"
                ))
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
                Some(self.unless(
                    &format!("exceeds_rounding({excess}, {scale})"),
                    &format!("out_of_reach({distance}, {longest}, {shortest}, t, {block})"),
                ))
            }
            Statement::Nonzero { value, scale } => {
                let [value, scale] = [value, scale].map(|expr| self.evaluation().value(*expr));
                let square = |of: &Arithmetic| {
                    let factor = self.operand(of);
                    format!("{factor} * {factor}")
                };
                Some(self.unless(
                    &format!("exceeds_rounding({}, {})", square(&value), square(&scale)),
                    &format!(
                        "singular_divisor({}, {}, t, {block})",
                        self.written(&value),
                        self.written(&scale)
                    ),
                ))
            }
            _ => None,
        }
    }

    /// Leaves the function where a condition does not hold.
    fn unless(&self, condition: &str, failure: &str) -> String {
        let left = match self.is_inside() {
            true => "None".to_string(),
            false => format!("Err({failure})"),
        };
        format!("if !{condition} {{\n    return {left};\n}}")
    }

    /// Adds what takes more than lines.
    fn statement(
        &self,
        statement: &Statement,
        block: usize,
        iterated: &dyn Fn(&Statement) -> TokenStream,
        code: &mut Code,
    ) {
        let number = count(block);
        let write = |expr: &ExprId| self.expression(*expr);
        match statement {
            Statement::Section(_)
            | Statement::Heading(_)
            | Statement::Note(_)
            | Statement::Shown { .. } => {
                if let Some(said) = documentation::of_statement(statement, self.module) {
                    code.comment(&said);
                }
            }
            // In lines.
            Statement::Let { .. }
            | Statement::SineCosine { .. }
            | Statement::Angle { .. }
            | Statement::Require { .. }
            | Statement::Positive { .. }
            | Statement::Reach { .. }
            | Statement::Nonzero { .. } => {}
            Statement::Lookup {
                targets,
                spline,
                argument,
            } => {
                let last = targets.iter().rposition(Option::is_some).unwrap_or(0);
                let names = targets[..=last].iter().map(|target| match target {
                    Some(target) => self.read(*target),
                    None => "_".to_string(),
                });
                let mut names: Vec<String> = names.collect();
                if last < 3 {
                    names.push("..".to_string());
                }
                let lookup = self.lookup(*spline, &self.evaluation().value(*argument));
                code.push(&format!("let [{}] = {lookup};", names.join(", ")));
            }
            Statement::Newton { .. } | Statement::Factorize => {
                code.syntax(iterated(statement));
            }
            Statement::Signal { input, found } => {
                let input = &self.module.system.mechanism.inputs[*input].name;
                let field = identifier_text(&field_name(input));
                let [radius, deviation] = found.map(|symbol| self.found(symbol));
                code.push(&format!(
                    "let [{radius}, {deviation}] = window.signal(&before.{field}, &inputs.{field});"
                ));
            }
            Statement::Isolate {
                is_chain,
                blocks,
                found,
                bounds,
                curvatures,
                changes,
                sizes,
                jacobian,
                turns,
                turning,
                varied,
                variation,
            } => {
                let numbers = blocks.iter().map(|&place| self.block_number(place));
                let numbers = quote!([#(#numbers),*]);
                let written = |values: &[ExprId]| {
                    let values = uniform(values.iter().map(write).collect());
                    quote!(Vector::from(#values))
                };
                let [bounds, curvatures, changes, sizes] =
                    [bounds, curvatures, changes, sizes].map(|it| written(it));
                let turns = uniform(turns.iter().map(|it| quote!(#it)).collect());
                for (matrix, entries) in [("jacobian", jacobian), ("turning", turning)] {
                    self.matrix(matrix, entries, code);
                }
                let turning = match turning[..] {
                    [] => quote!(&mut Matrix::zeros()),
                    _ => quote!(&mut turning),
                };
                let chord = quote!(Chord {
                    remainder: window.remainder,
                    bounds: #bounds,
                    curvatures: #curvatures,
                    changes: #changes,
                    sizes: #sizes,
                    jacobian: &mut jacobian,
                    turns: #turns.into(),
                    turning: #turning,
                });
                let given = match is_chain {
                    true => quote!(#numbers, window, #chord),
                    false => quote!(#numbers, #chord),
                };
                self.isolation(*is_chain, found, given, (varied, variation), code);
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
                code.syntax(quote! {
                    let balance = multipliers([#(#rows),*], [#(#forces),*], t, #number)?;
                });
                self.distribute(targets, "balance", code);
            }
            Statement::Solve {
                targets,
                right_hand_side,
            } => {
                let values = right_hand_side.iter().map(write);
                code.syntax(quote! {
                    let mut response = Vector::from([#(#values),*]);
                    factorization.solve(&mut response);
                });
                self.distribute(targets, "response", code);
            }
        }
    }

    /// Gives targets the elements of a vector.
    fn distribute(&self, targets: &[Option<SymbolId>], vector: &str, code: &mut Code) {
        for (place, target) in targets.iter().enumerate() {
            if let Some(target) = target {
                code.push(&self.assignment(*target, &format!("{vector}[{place}]")));
            }
        }
    }

    /// A matrix of zeros but for these entries, where there are any.
    fn matrix(&self, name: &str, entries: &[([usize; 2], ExprId)], code: &mut Code) {
        if !entries.is_empty() {
            code.push(&format!("let mut {name} = Matrix::zeros();"));
        }
        for (place, entry) in entries {
            let value = self.value(*entry);
            code.push(&filled(name, *place, &value));
        }
    }

    /// Finds the deviations of unknowns about the line that they should run along.
    fn isolation(
        &self,
        is_chain: bool,
        found: &[SymbolId],
        given: TokenStream,
        (varied, variation): (&[[usize; 2]], &Function),
        code: &mut Code,
    ) {
        let graph = &self.module.pool.graph;
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
            _ if is_chain => quote!(isolate_chain(#given)?),
            // What is linear does not vary, and what turns is known.
            [] => quote!(isolate(#given, |_, _| {})?),
            _ => {
                let inner = self.inner(variation);
                let statements = inner.plain_statements();
                let mut results = Code::default();
                for (place, value) in varied.iter().zip(inner.written_results()) {
                    results.push(&filled("variation", *place, &value));
                }
                quote! {
                    isolate(#given, |deviations, variation| {
                        let &[#(#arguments),*] = deviations;
                        #statements
                        #results
                    })?
                }
            }
        };
        let outer: Vec<String> = found.iter().map(|symbol| self.found(*symbol)).collect();
        code.syntax(match outer.iter().all(|name| name == "_") {
            true => quote!(#call;),
            false => {
                let outer = outer.iter().map(|name| tokens(name));
                quote!(let [#(#outer),*] = #call;)
            }
        });
    }

    fn block_number(&self, place: usize) -> Literal {
        count(usize::from(self.module.block_number(place)))
    }

    /// The name of what a statement of a path finds, or else `_` where nobody reads it.
    fn found(&self, symbol: SymbolId) -> String {
        match self.is_wanted(symbol) {
            true => self.read(symbol),
            false => "_".to_string(),
        }
    }

    /// `let name = value;`, or an assignment to a field.
    fn assignment(&self, target: SymbolId, value: &str) -> String {
        let name = self.read(target);
        match self.is_field(target) {
            true => format!("{name} = {value};"),
            false => format!("let {name} = {value};"),
        }
    }
}

/// An entry of a matrix gets its value.
fn filled(matrix: &str, [row, column]: [usize; 2], value: &str) -> String {
    format!("{matrix}[({row}, {column})] = {value};")
}

/// An array of these entries, which are written once where all are the same.
fn uniform(entries: Vec<TokenStream>) -> TokenStream {
    let texts: HashSet<String> = entries.iter().map(TokenStream::to_string).collect();
    match (&entries[..], texts.len()) {
        ([first, _, ..], 1) => {
            let order = count(entries.len());
            quote!([#first; #order])
        }
        _ => quote!([#(#entries),*]),
    }
}
