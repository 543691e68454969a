//! One function per block.

use std::collections::HashMap;

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::code::{Code, taken_apart};
use super::docs::doc_lines;
use super::equation::words;
use super::layout::Verbatim;
use super::lints;
use super::loads;
use super::names::{identifier, identifier_text};
use super::newton;
use crate::emit::module::needs::{Needs, checked_at_once};
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::expr::SymbolId;
use crate::program::{Block, Statement};

/// Up to so many blocks become one function.
const MOST_INLINED: usize = 16;

impl Needs {
    /// The arguments as they are declared, and as they are passed.
    fn arguments(self) -> (String, String) {
        let branches = match self.finds_branch {
            true => "branches: &mut Branches",
            false => "branches: &Branches",
        };
        let arguments = [
            (true, "at: &mut Frame", "at"),
            (self.last, "last: &Frame", "last"),
            (self.branches, branches, "branches"),
            (self.conditions, "conditions: &Conditions<'_>", "conditions"),
        ];
        let needed = arguments.into_iter().filter(|(is_needed, ..)| *is_needed);
        let (declared, passed): (Vec<_>, Vec<_>) = needed
            .map(|(_, declared, passed)| (declared, passed))
            .unzip();
        (declared.join(", "), passed.join(", "))
    }
}

/// The call of a block's function.
pub(super) fn call(block: &Block, module: &Module<'_>) -> String {
    let needs = Needs::of(block, module);
    let (name, (_, arguments)) = (identifier_text(&block.name), needs.arguments());
    let failure = match needs.fails {
        true => loads::handed_on(block, module),
        false => String::new(),
    };
    format!("{name}({arguments}){failure};")
}

/// The functions of all blocks.
pub(super) fn functions(module: &Module<'_>) -> TokenStream {
    let mut code = Code::default();
    for (index, block) in module.program.blocks.iter().enumerate() {
        function(index, block, module, &mut code);
    }
    code.to_token_stream()
}

fn function(index: usize, block: &Block, module: &Module<'_>, code: &mut Code) {
    let needs = Needs::of(block, module);
    let scope = Scope::new(module, &block.function, Place::Frame);
    let iterated = |statement: &Statement| newton::statement(statement, index, block, &scope);
    let mut statements = scope.statements(index, &iterated);
    let idle = idle(&scope, &statements);
    if !idle.is_empty() {
        scope.leave_unnamed(idle);
        statements = scope.statements(index, &iterated);
    }
    let reads = scope.reads();
    let read = [
        (needs.time, "t"),
        (reads.parameters, "parameters"),
        (reads.inputs, "inputs"),
    ];
    let mut inside = Code::default();
    if let Some(taken) = taken_apart("&Conditions", "conditions", &read) {
        inside.lines(&taken);
    }
    inside.append(statements);
    if module.is_large() {
        own_check(index, block, &scope, &mut inside);
    }
    let (arguments, _) = needs.arguments();
    let name = identifier_text(&block.name);
    let mut head = format!("fn {name}({arguments})");
    if needs.fails {
        inside.push("Ok(())");
        head += " -> Result<(), Failure>";
    }
    // One function of thousands of blocks would take the compiler longer than all of them alone.
    let inline = match module.program.blocks.len() > MOST_INLINED {
        true => "#[inline(never)]",
        false => "#[inline]",
    };
    let allow = lints::of_code(&inside);
    let title = documentation::of_block(block, module);
    code.function(title, allow.into_iter().chain([inline]), &head, inside);
}

/// Sines and cosines that are local to a function and are mentioned nowhere but where they are found.
fn idle(scope: &Scope<'_>, statements: &Code) -> Vec<SymbolId> {
    let mut found = scope.sines_and_cosines().peekable();
    if found.peek().is_none() {
        return Vec::new();
    }
    let code = quote!(#statements).to_string();
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for word in words(&code) {
        *counts.entry(word).or_default() += 1;
    }
    let is_idle = |symbol: &SymbolId| counts.get(scope.read(*symbol).as_str()) == Some(&1);
    found.filter(is_idle).collect()
}

/// Fails where a coordinate, a rate or an acceleration of the block is not finite. A frame of thousands of coordinates is not
/// looked through at once: the compiler would turn it into as many local values.
fn own_check(index: usize, block: &Block, scope: &Scope<'_>, code: &mut Code) {
    let found = checked_at_once(block, scope).into_iter();
    let fields = found.map(|symbol| scope.read(symbol) + ",");
    let fields: Vec<String> = fields.collect();
    let fields = fields.join(" ");
    code.lines(&format!(
        "if !all_finite(&[\n    {fields}\n]) {{\n    return Err(not_finite(t, {index}));\n}}"
    ));
}

/// `struct Branches` with the drawing's choice.
pub(super) fn branches(module: &Module<'_>) -> TokenStream {
    let drawn = |positive: bool| match positive {
        true => "Branch::Positive",
        false => "Branch::Negative",
    };
    let blocks = &module.program.blocks;
    let iterated = blocks
        .iter()
        .enumerate()
        .filter_map(|(number, block)| Some((number, block, block.newton.as_ref()?)));
    let mut text = Verbatim::default();
    text.open("::linkwright::generated::branches! {");
    text.docs([documentation::of_branches(module)]);
    text.open("Branches {");
    for branch in &module.program.branches {
        let name = identifier(&branch.name);
        let of = module.exchanged.get(&branch.symbol);
        let of = of.map_or(String::new(), |number| format!(", block {number}"));
        text.docs(doc_lines([documentation::of_branch(&branch.meaning)]));
        text.line(format!(
            "{name}: Branch = {}{of};",
            drawn(branch.is_positive())
        ));
    }
    for (number, block, newton) in iterated {
        let name = identifier(&block.name);
        let drawn = newton.drawn.sign().map_or("None".to_string(), |positive| {
            format!("Some({})", drawn(positive))
        });
        text.docs(doc_lines([format!(
            "The sign of the determinant of `{}`, which finds {}. `None` lets the estimate decide.",
            block.name,
            documentation::found_by(newton, module.system)
        )]));
        text.line(format!("{name}: Option<Branch> = {drawn}, block {number};"));
    }
    if module.assemblies.is_some() {
        text.docs(doc_lines([documentation::of_wanted_assembly("`None`")]));
        text.line("assembly: Option<u8> = None;");
    }
    text.close("}");
    text.close("}");
    text.item()
}
