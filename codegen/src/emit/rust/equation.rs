//! A function that the runtime calls with vectors and the time → what it takes out of them, its statements and its results.

use std::collections::{HashMap, HashSet};

use super::code::argument;
use crate::emit::code::Code;
use crate::emit::module::scope::Scope;
use crate::expr::SymbolId;

/// The statements of a function, after what it reads of its type.
pub(super) struct Equation {
    pub statements: Code,
    pub results: Vec<String>,
    mentioned: HashSet<String>,
}

impl Equation {
    pub fn new(scope: &Scope<'_>) -> Equation {
        let reads = scope.reads();
        let own = ["at", "parameters", "inputs"];
        let own = own
            .into_iter()
            .zip([reads.frame, reads.parameters, reads.inputs]);
        let mut statements = Code::default();
        for (name, _) in own.filter(|(_, is_read)| *is_read) {
            statements.line(format!("let {name} = self.{name};"));
        }
        let (found, results) = (scope.plain_statements(), scope.results());
        let mut whole = found.clone();
        results.iter().for_each(|it| whole.line(it));
        let idle = idle(scope, &whole);
        statements.append(match idle.is_empty() {
            true => found,
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

    /// An argument that is taken apart into values, as far as they are read.
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

/// Sines and cosines that are local to a function and are mentioned nowhere but where they are found.
pub(super) fn idle(scope: &Scope<'_>, code: &Code) -> Vec<SymbolId> {
    let mut found = scope.sines_and_cosines().peekable();
    if found.peek().is_none() {
        return Vec::new();
    }
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for word in code.names() {
        *counts.entry(word).or_default() += 1;
    }
    let is_idle = |symbol: &SymbolId| counts.get(scope.read(*symbol).as_str()) == Some(&1);
    found.filter(is_idle).collect()
}
