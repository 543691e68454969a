//! Writes one function per block, and the structure of modes.

use super::code::taken_apart;
use super::equation::idle;
use super::lints;
use super::loads;
use super::names::identifier;
use super::newton;
use super::statement::Iterated;
use crate::emit::code::Code;
use crate::emit::module::needs::{Needs, checked_at_once, listed};
use crate::emit::module::scope::{Place, Scope};
use crate::emit::module::{Module, documentation};
use crate::program::{Block, Statement};

/// Number of blocks up to which the compiler may inline their functions.
const MOST_INLINED: usize = 16;

impl Needs {
    /// Returns the arguments as declared and as passed.
    pub(super) fn arguments(self) -> [String; 2] {
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
        listed(arguments)
    }
}

/// Returns the call of a block's function.
pub(super) fn call(block: &Block, module: &Module<'_>) -> String {
    let needs = Needs::of(block, module);
    let (name, [_, arguments]) = (identifier(&block.name), needs.arguments());
    let failure = match needs.fails {
        true => loads::handed_on(block, module),
        false => String::new(),
    };
    format!("{name}({arguments}){failure};")
}

/// Writes the functions of all blocks.
pub(super) fn functions(module: &Module<'_>, code: &mut Code) {
    for (index, block) in module.program.blocks.iter().enumerate() {
        function(index, block, module, code);
    }
}

/// Returns the statements of a block's function, in which sines and cosines that nothing reads have no name.
pub(super) fn used_statements(scope: &Scope<'_>, index: usize, iterated: Iterated<'_>) -> Code {
    let statements = scope.statements(index, iterated);
    let idle = idle(scope, &statements);
    if idle.is_empty() {
        return statements;
    }
    scope.leave_unnamed(idle);
    scope.statements(index, iterated)
}

fn function(index: usize, block: &Block, module: &Module<'_>, code: &mut Code) {
    let needs = Needs::of(block, module);
    let scope = Scope::new(module, &block.function, Place::Frame);
    let iterated = |statement: &Statement, code: &mut Code| {
        newton::statement(statement, index, block, &scope, code);
    };
    let statements = used_statements(&scope, index, &iterated);
    let reads = scope.reads();
    let read = [
        (needs.time, "t"),
        (reads.parameters, "parameters"),
        (reads.inputs, "inputs"),
    ];
    let mut inside = Code::default();
    if let Some(taken) = taken_apart("&Conditions", "conditions", &read) {
        inside.line(taken);
    }
    inside.append(statements);
    if module.is_large() {
        own_check(index, block, &scope, &mut inside);
    }
    let [arguments, _] = needs.arguments();
    let name = identifier(&block.name);
    let mut head = format!("fn {name}({arguments})");
    if needs.fails {
        inside.line("Ok(())");
        head += " -> Result<(), Failure>";
    }
    // One function of thousands of blocks would take the compiler longer than all of them alone.
    let inline = match module.program.blocks.len() > MOST_INLINED {
        true => "#[inline(never)]",
        false => "#[inline]",
    };
    let allow: Vec<&str> = lints::of_code(&inside).chain([inline]).collect();
    let title = documentation::of_block(block, module);
    code.function(title, allow, &head, inside);
}

/// Writes the check that the block's coordinates, rates and accelerations are finite.
fn own_check(index: usize, block: &Block, scope: &Scope<'_>, code: &mut Code) {
    let symbols = checked_at_once(block, scope).into_iter();
    let fields: Vec<String> = symbols.map(|symbol| scope.read(symbol)).collect();
    code.open(format!("if !all_finite(&[{}]) {{", fields.join(", ")));
    code.line(format!("return Err(not_finite(t, {index}));"));
    code.close("}");
}

/// Writes `struct Branches` with the modes of the design configuration.
pub(super) fn branches(module: &Module<'_>, code: &mut Code) {
    let drawn = |positive: bool| match positive {
        true => "Branch::Positive",
        false => "Branch::Negative",
    };
    let blocks = &module.program.blocks;
    let iterated = blocks
        .iter()
        .enumerate()
        .filter_map(|(number, block)| Some((number, block, block.newton.as_ref()?)));
    code.gap();
    code.open("::linkwright::generated::branches! {");
    code.docs([documentation::of_branches(module)]);
    code.open("Branches {");
    for branch in &module.program.branches {
        let name = identifier(&branch.name);
        let of = module.exchanged.get(&branch.symbol);
        let of = of.map_or(String::new(), |number| format!(", block {number}"));
        code.docs([documentation::of_branch(&branch.meaning)]);
        code.whole(format!(
            "{name}: Branch = {}{of};",
            drawn(branch.is_positive())
        ));
    }
    for (number, block, newton) in iterated {
        let name = identifier(&block.name);
        let drawn = newton.drawn.sign().map_or("None".to_string(), |positive| {
            format!("Some({})", drawn(positive))
        });
        code.docs([format!(
            "Sign of the determinant of `{}`, which finds {}. `None` if the estimate decides.",
            block.name,
            documentation::found_by(newton, module.system)
        )]);
        code.whole(format!("{name}: Option<Branch> = {drawn}, block {number};"));
    }
    if module.assemblies.is_some() {
        code.docs([documentation::of_wanted_assembly("`None`")]);
        code.line("assembly: Option<u8> = None;");
    }
    code.close("}");
    code.close("}");
}
