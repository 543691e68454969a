//! Writes the structure of a mechanism, its solve function and its descriptor for the runtime.

use super::block;
use super::loads;
use super::points::point_functions;
use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::checks::final_check;
use crate::emit::module::documentation;
use crate::emit::module::drawing::frame_keeps_parameters;
use crate::emit::module::needs::Needs;
use crate::emit::module::path_enclosures::enclosure_count;
use crate::program::Requirements;

/// Writes the structure of a mechanism.
pub(super) fn structure(printer: &Printer<'_>, text: &mut Code) {
    let (module, declared) = (printer.module, printer.declared());
    let name = &printer.type_prefix;
    let type_of = |it| printer.type_of(it);
    let mut lines = match module.system.mechanism.motion {
        None => documentation::of_mechanism(module.system),
        Some(_) => documentation::of_motion(module.system),
    };
    lines.push(String::new());
    lines.push(
        "The caller owns the structure. Its field `failure` describes a failure of the last call."
            .to_string(),
    );
    text.gap();
    text.comment(lines);
    text.open(format!("typedef struct {name} {{"));
    text.comment(["Failure of the last call, if any."]);
    text.line(format!("{} failure;", printer.runtime("failure")));
    text.comment(["Assembly modes."]);
    text.line(format!("{} branches;", type_of("Branches")));
    if declared.parameters {
        text.comment([format!(
            "Parameters of the next frame; {} changes them.",
            printer.function("set_parameters")
        )]);
        text.line(format!("{} parameters;", type_of("Parameters")));
    }
    text.comment([format!(
        "The other fields belong to the runtime; {} returns the last frame.",
        printer.function("frame")
    )]);
    if declared.inputs {
        text.line(format!("{} inputs;", type_of("Inputs")));
        text.line(format!("{} window_inputs[2];", type_of("Inputs")));
    }
    text.line(format!("{} frames[2];", type_of("Frame")));
    if enclosure_count(module) > 0 {
        text.line(format!(
            "{} enclosures[{}];",
            printer.runtime("enclosure"),
            enclosure_count(module)
        ));
    }
    text.line(format!("{} state;", printer.runtime("state")));
    text.close(format!("}} {name};"));
}

/// Writes the function that solves all blocks at one time.
pub(super) fn solve(printer: &Printer<'_>, text: &mut Code) {
    let module = printer.module;
    let (frame, branches) = (printer.type_of("Frame"), printer.type_of("Branches"));
    let mut body = Code::default();
    body.line("at->t = conditions->t;");
    if module.holds_coordinates() && frame_keeps_parameters(module) {
        let parameters = printer.type_of("Parameters");
        body.line(format!(
            "at->parameters = *(const {parameters} *)conditions->parameters;"
        ));
    }
    for block in &module.program.blocks {
        block::call(block, printer, &mut body);
    }
    let access = |symbol| printer.field(symbol, "at");
    let checked = final_check(module, module.is_large(), access, "at->t");
    let all_needs = module
        .program
        .blocks
        .iter()
        .map(|block| Needs::of(block, module));
    let finds_branch = all_needs.clone().any(|it| it.finds_branch);
    let (reads_last, reads_branches) = (
        all_needs.clone().any(|it| it.last),
        all_needs.clone().any(|it| it.branches),
    );
    let fails = all_needs.clone().any(|it| it.fails);
    text.gap();
    text.comment(["Solves all blocks at one time, one after another."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static linkwright_status {}(void *found, const void *before, void *modes, const {} *conditions)",
        printer.own("solve"),
        printer.runtime("conditions")
    ));
    text.open("{");
    text.line(format!("{frame} *const at = ({frame} *)found;"));
    match reads_last {
        true => text.line(format!(
            "const {frame} *const last = (const {frame} *)before;"
        )),
        false => text.line("(void)before;"),
    }
    match (reads_branches, finds_branch) {
        (true, true) => text.line(format!("{branches} *const branches = ({branches} *)modes;")),
        (true, false) => text.line(format!(
            "const {branches} *const branches = (const {branches} *)modes;"
        )),
        (false, _) => text.line("(void)modes;"),
    }
    if fails {
        text.line("linkwright_status status;");
    }
    text.gap();
    text.append(body);
    if checked.is_empty() {
        text.line("return LINKWRIGHT_OK;");
    } else {
        let count = checked.len();
        text.comment(["A value that is not finite makes one of these not finite."]);
        text.line(printer.array("checked", &checked));
        let finite = printer.runtime("all_finite");
        let failed = format!("{}(conditions, 0U)", printer.runtime("not_finite"));
        if module.program.loads.is_some() {
            text.open(format!("if (!{finite}(checked, {count}U)) {{"));
            text.line(format!("(void){failed};"));
            text.line(format!("return {};", loads::call(printer)));
            text.close("}");
            text.line("return LINKWRIGHT_OK;");
        } else {
            text.line(format!(
                "return {finite}(checked, {count}U) ? LINKWRIGHT_OK : {failed};"
            ));
        }
    }
    text.close("}");
}

/// Writes functions that return the time of a frame and the values by which poses are compared. Returns the number of values.
pub(super) fn values(printer: &Printer<'_>, text: &mut Code) -> usize {
    let module = printer.module;
    let (frame, real) = (printer.type_of("Frame"), printer.real());
    text.gap();
    text.line(format!(
        "LINKWRIGHT_FUNCTION static {real} {}(const void *found)",
        printer.own("time_of")
    ));
    text.open("{");
    text.line(format!("const {frame} *const at = (const {frame} *)found;"));
    text.line("return at->t;");
    text.close("}");
    if module.program.path.is_none() {
        return 0;
    }
    // Coordinates are found by their place in the frame.
    if module.holds_coordinates() {
        return module.system.coordinates.len();
    }
    let points = point_functions(printer);
    if points.is_empty() {
        return 0;
    }
    text.gap();
    text.comment(["Returns a component of a frame's points, by which poses are compared."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static {real} {}(const void *found, uint16_t index)",
        printer.own("value_of")
    ));
    text.open("{");
    text.line(format!("const {frame} *const at = (const {frame} *)found;"));
    text.line(format!("{real} value = {};", printer.number(0.0)));
    text.line("switch (index) {");
    for (place, point) in points.iter().enumerate() {
        for axis in 0..2 {
            let index = 2 * place + axis;
            text.open(format!("case {index}U:"));
            text.line(format!("value = {point}(at).position[{axis}];"));
            text.line("break;");
            text.end();
        }
    }
    text.open("default:");
    text.line("break;");
    text.end();
    text.line("}");
    text.line("return value;");
    text.close("}");
    2 * points.len()
}

/// Writes the descriptor of the mechanism.
pub(super) fn blocks(printer: &Printer<'_>, values: usize, text: &mut Code) {
    let (module, declared) = (printer.module, printer.declared());
    let is_guarded = module.program.path.is_some();
    let some = |is_there: bool, name: &str| match is_there {
        true => printer.own(name),
        false => "NULL".to_string(),
    };
    let inputs = match declared.inputs {
        true => format!("sizeof({})", printer.type_of("Inputs")),
        false => "0U".to_string(),
    };
    let requirements = module.program.requirements.as_ref();
    let limits_parameters = requirements.is_some_and(Requirements::limit_parameters);
    let entries = [
        format!("sizeof({})", printer.type_of("Frame")),
        format!("sizeof({})", printer.type_of("Branches")),
        inputs,
        format!("{}U", module.system.mechanism.inputs.len()),
        is_guarded.to_string(),
        printer.own("solve"),
        some(declared.inputs, "inputs_are_finite"),
        some(declared.parameters, "parameters_are_finite"),
        some(declared.inputs, "signal"),
        some(declared.inputs, "read_signal"),
        printer.own("exchanged"),
        match is_guarded && block::may_cross(printer) {
            true => printer.runtime("pass"),
            false => "NULL".to_string(),
        },
        some(is_guarded, "verify_path"),
        some(module.program.closed_path().is_some(), "verify_nonsingular"),
        some(is_guarded && enclosure_count(module) > 0, "is_within"),
        printer.own("time_of"),
        format!("{values}U"),
        module.holds_coordinates().to_string(),
        some(values > 0 && !module.holds_coordinates(), "value_of"),
        some(limits_parameters, "not_positive"),
    ];
    text.gap();
    let descriptor = printer.runtime("blocks");
    text.comment(["Returns the mechanism descriptor."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static const {descriptor} *{}(void)",
        printer.own("descriptor")
    ));
    text.open("{");
    text.open(format!("static const {descriptor} found = {{"));
    for entry in entries {
        text.line(format!("{entry},"));
    }
    text.close("};");
    text.line("return &found;");
    text.close("}");
}
