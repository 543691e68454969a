//! Writes the header and the source of a mechanism with all its motions, and those of the runtime.

use super::constants::Constant;
use super::printer::Printer;
use super::words::WORDS;
use super::{
    api, assemblies, assembly, block, block_names, coordinates, equations, frame, lanes, limits,
    loads, normalized_determinant, parameters, path, points, ranges, runtime, sensitivity, shell,
    tables, textbook, transmission,
};
use crate::emit::Form;
use crate::emit::code::Code;
use crate::emit::layout::Lists;
use crate::emit::lines::WIDTH;
use crate::emit::module::forces::force_functions;
use crate::emit::module::{Module, accessors, documentation, facts};
use crate::emit::scalar::Scalar;
use crate::emit::text;
use crate::solved::Solved;

/// Instructions and terms in the head of each header.
const TERMS: [&str; 2] = [
    "Compile this file with linkwright.c of the same folder, as C99 and without -ffast-math; linkwright.h explains the options for identical bits.",
    "This file is the output of a generator. Anyone who generates it may use, change and distribute it for any purpose and under any licence, without a notice. Warranties are excluded.",
];

/// Returns the source and the header of a mechanism, named `stem`, and those of the runtime.
pub fn texts(motions: &[Solved], stem: &str, form: Form<'_>) -> Vec<String> {
    let modules = motions.iter();
    let modules: Vec<Module<'_>> = modules
        .map(|solved| Module::new(solved, form.scalar, WORDS))
        .collect();
    let printers: Vec<Printer<'_>> = modules.iter().map(Printer::new).collect();
    let Some(first) = printers.first() else {
        return Vec::new();
    };
    vec![
        source(first, &printers, stem, form),
        header(first, &printers, form),
        runtime::source(),
        runtime::header(),
    ]
}

/// Public functions in order of declaration.
fn offered(printer: &Printer<'_>) -> Vec<points::Offered> {
    let mut all = api::offered(printer);
    all.extend(assembly::drawn_pose(printer));
    all.extend(points::offered(printer));
    all.extend(transmission::offered(printer));
    let kept = force_functions(printer.module).into_iter();
    let kept = kept.chain(accessors::measures(printer.module));
    let kept = kept.chain(accessors::sensitivities(printer.module));
    all.extend(kept.map(|it| printer.accessor(it)));
    all.extend(limits::offered(printer));
    all.extend(normalized_determinant::offered(printer));
    all.extend(textbook::offered(printer));
    all
}

/// Qualifiers of functions.
const QUALIFIERS: [&str; 2] = ["LINKWRIGHT_FUNCTION", "static LINKWRIGHT_APART void"];

/// Returns the text, in which a function that is too long stands below its qualifiers.
fn finished(code: &Code) -> String {
    let text = code.finish(Lists::Filled);
    let qualified = |line: &str| {
        let is_long = line.chars().count() > WIDTH;
        let mut qualifiers = QUALIFIERS.iter().filter(|_| is_long);
        let split = qualifiers.find_map(|it| Some((it, line.strip_prefix(it)?.strip_prefix(' ')?)));
        match split {
            Some((qualifiers, function)) => format!("{qualifiers}\n{function}\n"),
            None => format!("{line}\n"),
        }
    };
    text.lines().map(qualified).collect()
}

fn header(first: &Printer<'_>, printers: &[Printer<'_>], form: Form<'_>) -> String {
    let mut text = Code::default();
    text.comment([facts::origin(first.module)]);
    let mechanism = &first.module.system.mechanism;
    let mut lines = Vec::new();
    if mechanism.motion.is_none() {
        lines.extend(facts::facts(first.module));
    } else {
        lines.extend(documentation::of_mechanism(first.module.system));
        let motions = printers
            .iter()
            .filter_map(|it| it.module.system.mechanism.motion.as_ref());
        let names: Vec<String> = motions.map(|motion| format!("`{}`", motion.name)).collect();
        lines.push(format!(
            "Separate functions and types for each motion: {}.",
            names.join(", ")
        ));
    }
    lines.push(String::new());
    lines.extend(TERMS.map(str::to_string));
    text.comment(lines);
    let guard = format!("LINKWRIGHT_{}_H", mechanism.name.to_uppercase());
    text.line(format!("#ifndef {guard}"));
    text.line(format!("#define {guard}"));
    text.gap();
    text.line("#include \"linkwright.h\"");
    text.gap();
    text.line(format!("#if LINKWRIGHT_VERSION != {}", runtime::version()));
    text.line("#error \"this header and linkwright.h were written by different generators: generate both again\"");
    text.line("#endif");
    if first.module.scalar == Scalar::F64 {
        text.line("#if DBL_MANT_DIG != 53");
        text.line("#error \"double has fewer bits here than this mechanism needs: generate it with --scalar f32\"");
        text.line("#endif");
    }
    text.gap();
    text.line(format!("LINKWRIGHT_HEADER_BEGIN(of_{})", mechanism.name));
    for printer in printers {
        if printer.module.system.mechanism.motion.is_some() {
            let mut lines = documentation::of_motion(printer.module.system);
            lines.push(String::new());
            lines.extend(facts::facts(printer.module));
            text.gap();
            text.comment(lines);
        }
        declarations(printer, &mut text);
        if form.has_lanes {
            lanes::declarations(printer, &mut text);
        }
    }
    text.gap();
    text.line("LINKWRIGHT_HEADER_END");
    text.gap();
    text.line("#endif");
    finished(&text)
}

/// Writes the public structures, constants and functions of one motion.
fn declarations(printer: &Printer<'_>, text: &mut Code) {
    parameters::parameters(printer, text);
    coordinates::structure(printer, text);
    parameters::inputs(printer, text);
    block::branches(printer, text);
    frame::structure(printer, text);
    sensitivity::structures(printer, text);
    shell::structure(printer, text);
    text.gap();
    text.comment(["Design pose, from which the mechanism is assembled, and its assembly modes."]);
    for (kind, name) in [("Coordinates", "DESIGN"), ("Branches", "DESIGN_BRANCHES")] {
        Constant::new(printer.type_of(kind), printer.constant(name)).declare(text);
    }
    assemblies::declarations(printer, text);
    if printer.declared().inputs {
        text.comment(["Inputs of the description, at rest."]);
        Constant::new(printer.type_of("Inputs"), printer.constant("INITIAL")).declare(text);
    }
    block_names::declarations(printer, text);
    points::declare(&offered(printer), text);
}

fn source(first: &Printer<'_>, printers: &[Printer<'_>], stem: &str, form: Form<'_>) -> String {
    let mut text = Code::default();
    text.comment([facts::origin(first.module)]);
    text.line(format!("#include \"{stem}.h\""));
    text.gap();
    text.line("#include <math.h>");
    text.line("#include <string.h>");
    text.gap();
    text.comment(["Products and sums are not fused; for GCC see linkwright.h."]);
    text.line("#ifdef __clang__");
    text.line("#pragma STDC FP_CONTRACT OFF");
    text.line("#endif");
    text.comment([
        "GCC 12 fuses them when it vectorizes straight-line code, regardless of its options.",
    ]);
    text.line("#if defined(__GNUC__) && !defined(__clang__) && (defined(__FP_FAST_FMA) || defined(__FP_FAST_FMAF))");
    text.line("#pragma GCC optimize (\"no-tree-slp-vectorize\")");
    text.line("#endif");
    text.gap();
    let name = &first.module.system.mechanism.name;
    text.line(format!("LINKWRIGHT_SOURCE_BEGIN(of_{name})"));
    if form.has_lanes {
        lanes::functions(first, printers, &mut text);
    }
    for printer in printers {
        parameters::nominal(printer, &mut text);
        definitions(printer, form, &mut text);
    }
    text.gap();
    text.line("LINKWRIGHT_SOURCE_END");
    finished(&text)
}

/// Writes the constants and functions of one motion.
fn definitions(printer: &Printer<'_>, form: Form<'_>, text: &mut Code) {
    let mut code = Code::default();
    equations::given(printer, &mut code);
    parameters::drawn(printer, &mut code);
    equations::equations(printer, &mut code);
    block::functions(printer, &mut code);
    path::declarations(printer, &mut code);
    loads::function(printer, &mut code);
    shell::solve(printer, &mut code);
    frame::estimate(printer, &mut code);
    assemblies::begin(printer, &mut code);
    block::exchanged(printer, &mut code);
    parameters::accessors(printer, &mut code);
    parameters::requirements(printer, &mut code);
    ranges::functions(printer, &mut code);
    let values = shell::values(printer, &mut code);
    shell::blocks(printer, values, &mut code);
    api::parts(printer, &mut code);
    points::define(offered(printer), &mut code);
    path::path(printer, &mut code);
    if form.has_lanes {
        lanes::definitions(printer, &mut code);
    }
    constants(printer, &code, text);
    tables::tables(printer, &code, text);
    coordinates::drawn(printer, text);
    block::drawn_branches(printer, text);
    assemblies::constants(printer, text);
    if printer.declared().inputs {
        parameters::initial(printer, text);
    }
    block_names::definitions(printer, text);
    text.gap();
    text.append(code);
}

/// Writes the named constants that the code mentions.
fn constants(printer: &Printer<'_>, code: &Code, text: &mut Code) {
    let list = printer.module.program.constants.list().iter();
    let used = list.filter(|constant| code.mentions(&printer.own_constant(&constant.name)));
    text.gap();
    for constant in used {
        let line = format!(
            "static const {} {} = {};",
            printer.real(),
            printer.own_constant(&constant.name),
            printer.number(constant.value)
        );
        let room = WIDTH.saturating_sub(line.len() + " /*  */".len());
        let remark = text::constant(printer.module.pool, printer.module.system, constant, room);
        let remark = remark.map_or(String::new(), |remark| {
            format!(" {}", printer.beside(&remark))
        });
        text.whole(format!("{line}{remark}"));
    }
}
