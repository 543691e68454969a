//! Prints the body of a function that the runtime calls with vectors and the time.

use std::collections::{HashMap, HashSet};

use super::code::argument;
use crate::emit::code::Code;
use crate::emit::module::scope::Scope;
use crate::expr::SymbolId;

/// Statements and results of a function; the statements begin with the fields of `self` that they read.
pub(super) struct Equation {
    pub statements: Code,
    pub results: Vec<String>,
    mentioned: HashSet<String>,
}

impl Equation {
    pub fn new(scope: &Scope<'_>) -> Equation {
        let reads = scope.reads();
        let fields = ["at", "parameters", "inputs"];
        let fields = fields
            .into_iter()
            .zip([reads.frame, reads.parameters, reads.inputs]);
        let mut statements = Code::default();
        for (name, _) in fields.filter(|(_, is_read)| *is_read) {
            statements.line(format!("let {name} = self.{name};"));
        }
        let (named, results) = (scope.plain_statements(), scope.results());
        let mut whole = named.clone();
        results.iter().for_each(|it| whole.line(it));
        let idle = idle(scope, &whole);
        statements.append(match idle.is_empty() {
            true => named,
            false => {
                scope.leave_unnamed(idle);
                scope.plain_statements()
            }
        });
        Equation {
            statements,
            results,
            mentioned: whole.names().map(str::to_string).collect(),
        }
    }

    /// Returns the pattern of a vector argument, with names only for the components that are read.
    pub fn pattern(&self, symbols: &[SymbolId], whole: &str, scope: &Scope<'_>) -> String {
        let names = symbols.iter().map(|&it| scope.read(it));
        let names = names.map(|name| match self.mentioned.contains(&name) {
            true => name,
            false => "_".to_string(),
        });
        let names: Vec<String> = names.collect();
        match names.iter().all(|it| it == "_") {
            true => format!("_{whole}"),
            false => format!("&[{}]", names.join(", ")),
        }
    }

    pub fn time(&self) -> String {
        argument("t", self.mentioned.contains("t"))
    }
}

/// Returns the local sines and cosines that the code mentions only where it computes them.
pub(super) fn idle(scope: &Scope<'_>, code: &Code) -> Vec<SymbolId> {
    let mut symbols = scope.sines_and_cosines().peekable();
    if symbols.peek().is_none() {
        return Vec::new();
    }
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for word in code.names() {
        *counts.entry(word).or_default() += 1;
    }
    let is_idle = |symbol: &SymbolId| counts.get(scope.read(*symbol).as_str()) == Some(&1);
    symbols.filter(is_idle).collect()
}
