//! Writes one function per block, and the modes of all blocks.

use super::constants::Constant;
use super::loads;
use super::newton;
use super::printer::Printer;
use super::words::identifier;
use crate::emit::code::Code;
use crate::emit::module::documentation;
use crate::emit::module::needs::{Needs, checked_at_once, listed};
use crate::emit::module::scope::{Place, Scope};
use crate::program::Block;

/// Arguments of a block's function, as declared and as passed.
fn arguments(needs: Needs, printer: &Printer<'_>) -> [String; 2] {
    let constant = if needs.finds_branch { "" } else { "const " };
    let (frame, branches) = (printer.type_of("Frame"), printer.type_of("Branches"));
    let conditions = printer.runtime("conditions");
    let arguments = [
        (true, format!("{frame} *at"), "at"),
        (needs.last, format!("const {frame} *last"), "last"),
        (
            needs.branches,
            format!("{constant}{branches} *branches"),
            "branches",
        ),
        (
            needs.conditions,
            format!("const {conditions} *conditions"),
            "conditions",
        ),
    ];
    listed(arguments)
}

fn name(block: &Block, printer: &Printer<'_>) -> String {
    printer.own(&format!("solve_{}", block.name))
}

/// Writes the call of a block's function; its failure ends the caller.
pub(super) fn call(block: &Block, printer: &Printer<'_>, text: &mut Code) {
    let needs = Needs::of(block, printer.module);
    let [_, passed] = arguments(needs, printer);
    let call = format!("{}({passed})", name(block, printer));
    match needs.fails {
        true => {
            text.line(format!("status = {call};"));
            loads::blame(block, printer, text);
            text.open("if (status != LINKWRIGHT_OK) {");
            text.line("return status;");
            text.close("}");
        }
        false => text.line(format!("{call};")),
    }
}

/// Writes the functions of all blocks.
pub(super) fn functions(printer: &Printer<'_>, text: &mut Code) {
    let module = printer.module;
    for (index, block) in module.program.blocks.iter().enumerate() {
        let needs = Needs::of(block, module);
        let scope = Scope::new(module, &block.function, Place::Frame);
        let reads = scope.reads();
        let mut body = Code::default();
        if reads.time {
            body.line(format!("const {} t = conditions->t;", printer.real()));
        }
        if reads.parameters {
            let parameters = printer.type_of("Parameters");
            body.line(format!(
                "const {parameters} *const parameters = (const {parameters} *)conditions->parameters;"
            ));
        }
        if reads.inputs {
            let inputs = printer.type_of("Inputs");
            body.line(format!(
                "const {inputs} *const inputs = (const {inputs} *)conditions->inputs;"
            ));
        }
        if block.newton.is_some() {
            body.line("linkwright_status status;");
        }
        body.gap();
        let iterated = |statement: &_, text: &mut Code| {
            newton::statement(statement, index, block, &scope, printer, text);
        };
        printer.statements(&scope, index, &iterated, &mut body);
        if module.is_large() {
            own_check(index, block, &scope, printer, &mut body);
        }
        let result = if needs.fails {
            "linkwright_status"
        } else {
            "void"
        };
        let [declared, _] = arguments(needs, printer);
        text.gap();
        text.comment(documentation::of_block(block, module));
        text.line(format!(
            "LINKWRIGHT_FUNCTION static {result} {}({declared})",
            name(block, printer)
        ));
        text.open("{");
        text.append(body);
        if needs.fails {
            text.line("return LINKWRIGHT_OK;");
        }
        text.close("}");
    }
}

/// Writes checks that the block's coordinates, rates and accelerations are finite.
fn own_check(
    index: usize,
    block: &Block,
    scope: &Scope<'_>,
    printer: &Printer<'_>,
    text: &mut Code,
) {
    let fields = checked_at_once(block, scope).into_iter();
    let fields: Vec<String> = fields.map(|it| printer.symbol(it, scope)).collect();
    let (finite, failed) = (printer.runtime("is_finite"), printer.runtime("not_finite"));
    for field in fields {
        text.open(format!("if (!{finite}({field})) {{"));
        text.line(format!("return {failed}(conditions, {index}U);"));
        text.close("}");
    }
}

/// One assembly mode.
pub(super) struct Mode {
    /// Field of the structure.
    pub name: String,
    /// Meaning of its sign.
    pub text: String,
    /// Sign in the design configuration.
    pub drawn: &'static str,
    /// Block that can exchange the mode; `None` if none can.
    pub block: Option<usize>,
}

/// Modes of all loops; those of closed forms come first.
pub(super) fn modes(printer: &Printer<'_>) -> Vec<Mode> {
    let module = printer.module;
    let sign = |is_positive: bool| match is_positive {
        true => "LINKWRIGHT_POSITIVE",
        false => "LINKWRIGHT_NEGATIVE",
    };
    let closed = module.program.branches.iter().map(|branch| Mode {
        name: identifier(&branch.name),
        text: documentation::of_branch(&branch.meaning),
        drawn: sign(branch.is_positive()),
        block: module.exchanged.get(&branch.symbol).copied(),
    });
    let blocks = module.program.blocks.iter().enumerate();
    let iterated = blocks.filter_map(|(number, block)| {
        let newton = block.newton.as_ref()?;
        let unknowns = documentation::found_by(newton, module.system);
        Some(Mode {
            name: identifier(&block.name),
            text: format!(
                "Sign of the determinant of `{}`, which finds {unknowns}; LINKWRIGHT_NEAREST if the estimate decides.",
                block.name
            ),
            drawn: newton.drawn.sign().map_or("LINKWRIGHT_NEAREST", sign),
            block: Some(number),
        })
    });
    closed.chain(iterated).collect()
}

/// True if the modes of a block may meet.
pub(super) fn may_cross(printer: &Printer<'_>) -> bool {
    modes(printer).iter().any(|mode| mode.block.is_some())
}

/// Writes the structure with the modes of all loops.
pub(super) fn branches(printer: &Printer<'_>, text: &mut Code) {
    let (name, modes) = (printer.type_of("Branches"), modes(printer));
    text.gap();
    text.comment([documentation::of_branches(printer.module)]);
    text.open(format!("typedef struct {name} {{"));
    for mode in &modes {
        text.comment([&mode.text]);
        text.line(format!("linkwright_branch {};", mode.name));
    }
    if modes.is_empty() {
        text.comment(["Placeholder: a structure of C has at least one field."]);
        text.line("linkwright_branch none;");
    }
    if printer.module.assemblies.is_some() {
        text.comment([documentation::of_wanted_assembly("0")]);
        text.line("uint8_t assembly;");
    }
    text.close(format!("}} {name};"));
}

/// Defines the modes of the design configuration.
pub(super) fn drawn_branches(printer: &Printer<'_>, text: &mut Code) {
    let modes = modes(printer);
    let mut drawn: Vec<String> = match modes.is_empty() {
        true => vec!["LINKWRIGHT_NEAREST".to_string()],
        false => modes.iter().map(|mode| mode.drawn.to_string()).collect(),
    };
    if printer.module.assemblies.is_some() {
        drawn.push("0U".to_string());
    }
    let (name, constant) = (
        printer.type_of("Branches"),
        printer.constant("DESIGN_BRANCHES"),
    );
    Constant::new(name, constant).define(&drawn, text);
}

/// Writes `exchanged`, which finds the modes beyond a change point.
pub(super) fn exchanged(printer: &Printer<'_>, text: &mut Code) {
    let (function, name, modes) = (
        printer.own("exchanged"),
        printer.type_of("Branches"),
        modes(printer),
    );
    text.gap();
    text.comment([
        "Finds the modes beyond a change point of a block; returns false if they are not known.",
    ]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static bool {function}(const void *modes, uint16_t block, void *others)"
    ));
    text.open("{");
    let known: Vec<&Mode> = modes.iter().filter(|mode| mode.block.is_some()).collect();
    if known.is_empty() {
        for unread in ["modes", "block", "others"] {
            text.line(format!("(void){unread};"));
        }
        text.line("return false;");
        text.close("}");
        return;
    }
    text.line(format!(
        "const {name} *const branches = (const {name} *)modes;"
    ));
    text.line(format!("{name} *const other = ({name} *)others;"));
    text.line("linkwright_branch *exchanged_mode = NULL;");
    text.gap();
    text.line("*other = *branches;");
    text.line("switch (block) {");
    for mode in known {
        if let Some(block) = mode.block {
            text.open(format!("case {block}U:"));
            text.line(format!("exchanged_mode = &other->{};", mode.name));
            text.line("break;");
            text.end();
        }
    }
    text.open("default:");
    text.line("break;");
    text.end();
    text.line("}");
    text.open("if ((exchanged_mode == NULL) || (*exchanged_mode == LINKWRIGHT_NEAREST)) {");
    text.line("return false;");
    text.close("}");
    text.line("*exchanged_mode = (*exchanged_mode == LINKWRIGHT_POSITIVE) ? LINKWRIGHT_NEGATIVE : LINKWRIGHT_POSITIVE;");
    text.line("return true;");
    text.close("}");
}
