//! Divides the statements of a block among loops over the lanes.
//!
//! Compilers vectorize a loop that calls no function of another file. Statements that need one have a loop of their own. Sines, cosines
//! and angles of rare arguments are computed once more after their loop, before other statements read them.

use std::collections::HashSet;

use super::super::printer::{Printer, in_lane};
use crate::emit::code::Code;
use crate::emit::module::scope::Scope;
use crate::expr::SymbolId;
use crate::program::Statement;

/// Statements of one loop, in order.
pub(super) struct Loop<'a> {
    /// Statements, with the headings before them.
    pub statements: Vec<&'a Statement>,
    /// Names that the statements mention.
    mentioned: HashSet<String>,
    /// True if the loop calls no function of another file.
    is_vectorized: bool,
    /// Names of results that the loop does not find for rare arguments.
    unfinished: HashSet<String>,
}

impl Loop<'_> {
    /// True if a statement mentions the name.
    pub(super) fn mentions(&self, name: &str) -> bool {
        self.mentioned.contains(name)
    }

    /// True if results of rare arguments follow the loop.
    pub(super) fn has_rare(&self) -> bool {
        !self.unfinished.is_empty()
    }

    /// Returns the statements that find the results of rare arguments.
    pub(super) fn rare(&self, scope: &Scope<'_>, printer: &Printer<'_>) -> Code {
        let mut text = Code::default();
        for statement in &self.statements {
            rare(statement, scope, printer, &mut text);
        }
        text
    }
}

/// Divides the statements of a block, and shares local values that several loops read.
pub(super) fn divided<'a>(scope: &Scope<'a>, block: usize, printer: &Printer<'_>) -> Vec<Loop<'a>> {
    let mut loops: Vec<Loop<'a>> = Vec::new();
    let mut headings = Vec::new();
    for statement in &scope.function.statements {
        if statement.is_said() {
            headings.push(statement);
            continue;
        }
        let mut text = Code::default();
        printer.statement(statement, scope, block, &|_, _| {}, &mut text);
        let mentioned = names(&text);
        let is_vectorized = !mentioned.iter().any(|name| is_called_outside(name));
        let continues = loops.last().is_some_and(|it| {
            it.is_vectorized == is_vectorized && it.unfinished.is_disjoint(&mentioned)
        });
        if !continues {
            loops.push(Loop {
                statements: Vec::new(),
                mentioned: HashSet::new(),
                is_vectorized,
                unfinished: HashSet::new(),
            });
        }
        if let Some(it) = loops.last_mut() {
            it.statements.append(&mut headings);
            it.statements.push(statement);
            it.mentioned.extend(mentioned);
            it.unfinished.extend(unfinished(statement, scope, printer));
        }
    }
    scope.share(shared(&loops, scope, printer));
    loops
}

/// Returns the local values of a loop that other loops mention.
fn shared(loops: &[Loop<'_>], scope: &Scope<'_>, printer: &Printer<'_>) -> Vec<SymbolId> {
    let rare: Vec<HashSet<String>> = loops
        .iter()
        .map(|it| names(&it.rare(scope, printer)))
        .collect();
    let mut shared = Vec::new();
    for (place, it) in loops.iter().enumerate() {
        let targets = it
            .statements
            .iter()
            .flat_map(|statement| statement.targets());
        for target in targets.filter(|&target| !scope.is_field(target)) {
            let name = printer.symbol(target, scope);
            let mut others = loops
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != place);
            let is_shared = others.any(|(_, other)| other.mentions(&name))
                || rare.iter().any(|names| names.contains(&name));
            if is_shared {
                shared.push(target);
            }
        }
    }
    shared
}

/// Names in statements, and fields with the structures that they are in: `phi_crank` and `q.phi_crank`.
fn names(text: &Code) -> HashSet<String> {
    text.names()
        .chain(text.words())
        .map(str::to_string)
        .collect()
}

/// True for functions of the runtime and those of `<math.h>` that compilers do not vectorize.
fn is_called_outside(name: &str) -> bool {
    name.starts_with("linkwright") || ["log", "logf", "pow", "powf"].contains(&name)
}

/// Names of the results of a statement that are found apart for rare arguments.
fn unfinished(statement: &Statement, scope: &Scope<'_>, printer: &Printer<'_>) -> Vec<String> {
    let has_rare = matches!(
        statement,
        Statement::SineCosine { .. } | Statement::Angle { .. }
    );
    let targets = statement.targets().into_iter().filter(|_| has_rare);
    let mut accesses = Code::default();
    targets.for_each(|target| accesses.line(printer.symbol(target, scope)));
    let words = accesses
        .words()
        .filter(|word| !["at", "lane"].contains(word));
    words.map(str::to_string).collect()
}

/// Writes the call of the runtime for the arguments of a statement that may be rare.
fn rare(statement: &Statement, scope: &Scope<'_>, printer: &Printer<'_>, text: &mut Code) {
    match statement {
        Statement::SineCosine {
            sine,
            cosine,
            angle,
        } => {
            let (call, angle) = (
                printer.runtime("sin_cos"),
                printer.expression(*angle, scope),
            );
            let [sine, cosine] = [sine, cosine].map(|it| printer.symbol(*it, scope));
            text.line(format!("{call}({angle}, &{sine}, &{cosine});"));
        }
        Statement::Angle {
            target,
            sine,
            cosine,
        } => {
            let [sine, cosine] = [sine, cosine].map(|it| printer.expression(*it, scope));
            let [at, near] = ["at", "last"].map(|frame| in_lane(&printer.field(*target, frame)));
            let call = printer.runtime("angle_near");
            text.line(format!("{at} = {call}({sine}, {cosine}, {near});"));
        }
        _ => {}
    }
}
