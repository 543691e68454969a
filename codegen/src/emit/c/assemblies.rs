//! Writes the stored assemblies.

use super::constants::Constant;
use super::printer::Printer;
use crate::assemblies::{StoredAssemblies, StoredAssembly};
use crate::emit::code::Code;
use crate::emit::module::documentation;

/// Declares the constants in the header.
pub(super) fn declarations(printer: &Printer<'_>, text: &mut Code) {
    let Some(StoredAssemblies { all, .. }) = &printer.module.assemblies else {
        return;
    };
    let listed = all.iter().enumerate();
    let listed = listed.map(|(number, assembly)| {
        let label = documentation::of_assembly(assembly, printer.module);
        format!("{number}: {}", label.replace('`', ""))
    });
    let lines = documentation::ASSEMBLIES.map(str::to_string).into_iter();
    text.gap();
    text.comment(lines.chain(listed).collect::<Vec<String>>());
    text.line(format!("#define {} {}U", count(printer), all.len()));
    constant(printer).declare(text);
}

/// Constant with the modes of each assembly.
fn constant(printer: &Printer<'_>) -> Constant {
    Constant {
        type_name: printer.type_of("Branches"),
        name: printer.constant("ASSEMBLIES"),
        count: Some(count(printer)),
    }
}

/// Defines the modes of each assembly.
pub(super) fn constants(printer: &Printer<'_>, text: &mut Code) {
    let Some(StoredAssemblies { all, .. }) = &printer.module.assemblies else {
        return;
    };
    let listed = all.iter().enumerate();
    let listed = listed.map(|(number, assembly)| {
        let StoredAssembly {
            signs,
            determinants,
            ..
        } = assembly;
        let sign = |is_positive: bool| match is_positive {
            true => "LINKWRIGHT_POSITIVE",
            false => "LINKWRIGHT_NEGATIVE",
        };
        let closed = signs.iter().map(|&it| sign(it).to_string());
        let iterated = determinants
            .iter()
            .map(|it| it.map_or("LINKWRIGHT_NEAREST", sign).to_string());
        let modes: Vec<String> = closed.chain(iterated).collect();
        format!("{{{}, {}U}}", modes.join(", "), number + 1)
    });
    constant(printer).define(&listed.collect::<Vec<String>>(), text);
}

/// Writes `begin`, which sets the estimate of the first frame to the requested assembly.
pub(super) fn begin(printer: &Printer<'_>, text: &mut Code) {
    let Some(StoredAssemblies { unknowns, all }) = &printer.module.assemblies else {
        return;
    };
    let (branches, frame) = (printer.type_of("Branches"), printer.type_of("Frame"));
    text.gap();
    text.comment(["Moves the frame before the first one to the requested assembly, if any."]);
    text.line(format!(
        "LINKWRIGHT_FUNCTION static void {}({branches} *branches, {frame} *at)",
        printer.own("begin")
    ));
    text.open("{");
    text.open(format!(
        "static const {} poses[{}][{}] = {{",
        printer.real(),
        all.len(),
        unknowns.len()
    ));
    for assembly in all {
        let values = assembly.values.iter().map(|&it| printer.number(it));
        text.line(format!("{{{}}},", values.collect::<Vec<_>>().join(", ")));
    }
    text.close("};");
    text.line("const uint8_t wanted = branches->assembly;");
    text.gap();
    text.open(format!(
        "if (wanted > 0U && wanted <= {}) {{",
        count(printer)
    ));
    for (place, &unknown) in unknowns.iter().enumerate() {
        let position = printer.module.system.vector_form.unknowns[unknown].position;
        let field = printer.field(position, "at");
        text.line(format!("{field} = poses[wanted - 1U][{place}];"));
    }
    text.close("}");
    text.line("branches->assembly = 0U;");
    text.close("}");
}

/// Name of the constant with their number: `PLATFORM_ASSEMBLY_COUNT`.
fn count(printer: &Printer<'_>) -> String {
    printer.constant("ASSEMBLY_COUNT")
}
