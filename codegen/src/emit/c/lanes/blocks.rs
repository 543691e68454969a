//! Writes one function per block, which solves it for all lanes, and the function that solves all blocks.

use super::super::printer::Printer;
use super::loops::{Loop, divided};
use crate::emit::code::Code;
use crate::emit::module::checks::final_check;
use crate::emit::module::documentation;
use crate::emit::module::drawing::frame_keeps_parameters;
use crate::emit::module::needs::{Needs, listed};
use crate::emit::module::scope::{Place, Reads, Scope};
use crate::program::{Block, Statement};

/// Arguments of a function, as declared and as passed.
fn arguments(needs: Needs, reads: Reads, printer: &Printer<'_>) -> [String; 2] {
    let structure = |is_needed: bool, constant: &str, kind: &str, name: &'static str| {
        let kind = printer.type_of(kind);
        let declared = format!("{constant}{kind} *LINKWRIGHT_RESTRICT {name}");
        (is_needed, declared, name)
    };
    let (real, word) = (printer.real(), printer.word());
    let times = format!("const {real} *LINKWRIGHT_RESTRICT times");
    let unsolved = format!("{word} *LINKWRIGHT_RESTRICT unsolved");
    let arguments = [
        structure(true, "", "LaneFrames", "at"),
        structure(needs.last, "const ", "LaneFrames", "last"),
        structure(needs.branches, "const ", "LaneBranches", "branches"),
        structure(reads.parameters, "const ", "LaneParameters", "parameters"),
        structure(reads.inputs, "const ", "LaneInputs", "inputs"),
        (reads.time, times, "times"),
        (needs.fails, unsolved, "unsolved"),
    ];
    listed(arguments)
}

fn name(block: &Block, printer: &Printer<'_>) -> String {
    printer.own(&format!("solve_lanes_{}", block.name))
}

/// Opens a loop over the lanes.
fn open_loop(printer: &Printer<'_>, text: &mut Code) {
    text.open(format!(
        "for (size_t lane = 0U; lane < {}; lane++) {{",
        printer.lanes()
    ));
}

/// Writes the functions of all blocks.
pub(super) fn functions(printer: &Printer<'_>, text: &mut Code) {
    for (index, block) in printer.module.program.blocks.iter().enumerate() {
        function(index, block, printer, text);
    }
}

fn function(index: usize, block: &Block, printer: &Printer<'_>, text: &mut Code) {
    let module = printer.module;
    let scope = Scope::new(module, &block.function, Place::Lanes);
    let loops = divided(&scope, index, printer);
    let needs = Needs::in_lanes(block, module);
    let [declared, _] = arguments(needs, scope.reads(), printer);
    text.gap();
    text.comment(documentation::of_block(block, module));
    text.line(format!(
        "static LINKWRIGHT_APART void {}({declared})",
        name(block, printer)
    ));
    text.open("{");
    for target in scope.function.targets().filter(|it| scope.is_shared(*it)) {
        let array = printer.symbol(target, &scope);
        let array = array.replace("[lane]", &format!("[{}]", printer.lanes()));
        text.line(format!("{} {array};", printer.real()));
    }
    let statements = &block.function.statements;
    if statements.iter().any(|it| {
        matches!(
            it,
            Statement::Multipliers { .. } | Statement::Friction { .. }
        )
    }) {
        let (failure, conditions) = (printer.runtime("failure"), printer.runtime("conditions"));
        let zero = printer.number(0.0);
        text.line(format!("{failure} failure;"));
        text.line(format!(
            "const {conditions} unused = {{{zero}, LINKWRIGHT_LAST_FRAME, NULL, NULL, NULL, &failure}};"
        ));
        text.line(format!("const {conditions} *const conditions = &unused;"));
    }
    let mut has_rare = false;
    for it in &loops {
        if it.has_rare() {
            match has_rare {
                true => text.line("rare = 0U;"),
                false => text.line(format!("{} rare = 0U;", printer.word())),
            }
            has_rare = true;
        }
        one_loop(index, it, &scope, printer, text);
    }
    text.close("}");
}

/// Writes a loop, and the results of rare arguments after it.
fn one_loop(
    index: usize,
    it: &Loop<'_>,
    scope: &Scope<'_>,
    printer: &Printer<'_>,
    text: &mut Code,
) {
    let time = format!("const {} t = times[lane];", printer.real());
    open_loop(printer, text);
    if it.mentions("t") {
        text.line(&time);
    }
    if it.mentions("failed") {
        text.line(format!("{} failed = 0U;", printer.word()));
    }
    for statement in &it.statements {
        printer.statement(statement, scope, index, &|_, _| {}, text);
    }
    if it.mentions("failed") {
        text.line("unsolved[lane] |= failed;");
    }
    text.close("}");
    if it.has_rare() {
        let rare = it.rare(scope, printer);
        text.open("if (rare != 0U) {");
        open_loop(printer, text);
        if rare.mentions("t") {
            text.line(&time);
        }
        text.append(rare);
        text.close("}");
        text.close("}");
    }
}

/// Arguments of the function that solves all blocks, as declared and as passed by a group.
pub(super) fn of_all(printer: &Printer<'_>) -> [String; 2] {
    let module = printer.module;
    let blocks = module.program.blocks.iter();
    let mut all = (Needs::default(), Reads::default());
    for block in blocks {
        let reads = Scope::new(module, &block.function, Place::Lanes).reads();
        let needs = Needs::in_lanes(block, module);
        all.0.last |= needs.last;
        all.0.branches |= needs.branches;
        all.1.parameters |= reads.parameters;
        all.1.inputs |= reads.inputs;
    }
    all.1.parameters |= module.holds_coordinates() && frame_keeps_parameters(module);
    all.0.fails = true;
    all.1.time = true;
    arguments(all.0, all.1, printer)
}

/// Writes the function that solves all blocks, and marks the lanes without a solution.
pub(super) fn solve(printer: &Printer<'_>, text: &mut Code) {
    let module = printer.module;
    let [declared, _] = of_all(printer);
    text.gap();
    text.comment(["Solves all blocks, one after another, and marks the lanes without a solution."]);
    text.line(format!(
        "static void {}({declared})",
        printer.own("solve_lanes")
    ));
    text.open("{");
    open_loop(printer, text);
    text.line("at->t[lane] = times[lane];");
    text.line("unsolved[lane] = 0U;");
    text.close("}");
    if module.holds_coordinates() && frame_keeps_parameters(module) {
        text.line("at->parameters = *parameters;");
    }
    for block in &module.program.blocks {
        let reads = Scope::new(module, &block.function, Place::Lanes).reads();
        let [_, passed] = arguments(Needs::in_lanes(block, module), reads, printer);
        text.line(format!("{}({passed});", name(block, printer)));
    }
    let zero = printer.number(0.0);
    let access = |symbol| printer.field(symbol, "at");
    let checked = final_check(module, false, access, "at->t").into_iter();
    let checked: Vec<String> = checked
        .map(|field| format!("({zero} * {field}[lane])"))
        .collect();
    if !checked.is_empty() {
        text.comment(["Zero times a value that is infinite or NaN is NaN."]);
        open_loop(printer, text);
        text.line(format!("{} sum = {zero};", printer.real()));
        // Sums of four are independent of one another.
        for values in checked.chunks(4) {
            text.line(format!("sum += {};", values.join(" + ")));
        }
        text.line(format!("unsolved[lane] |= (sum >= {zero}) ? 0U : 1U;"));
        text.close("}");
    }
    text.close("}");
}
