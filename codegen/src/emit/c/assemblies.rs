//! The assemblies that are stored.

use super::printer::Printer;
use super::text::Text;
use crate::assemblies::{StoredAssemblies, StoredAssembly};
use crate::emit::module::documentation;

/// The constants, as others see them.
pub(super) fn declarations(printer: &Printer<'_>, text: &mut Text) {
    let Some(StoredAssemblies { all, .. }) = &printer.module.assemblies else {
        return;
    };
    let listed = all.iter().enumerate();
    let listed = listed.map(|(number, assembly)| {
        let said = documentation::of_assembly(assembly, printer.module);
        format!("{number}: {}", said.replace('`', ""))
    });
    let lines = documentation::ASSEMBLIES.map(str::to_string).into_iter();
    text.gap();
    text.comment(lines.chain(listed).collect::<Vec<String>>());
    let (count, name) = (count(printer), printer.constant("ASSEMBLIES"));
    text.line(format!("#define {count} {}U", all.len()));
    text.line(format!(
        "extern const {} {name}[{count}];",
        printer.type_of("Branches")
    ));
}

/// The modes of each of them.
pub(super) fn constants(printer: &Printer<'_>, text: &mut Text) {
    let Some(StoredAssemblies { all, .. }) = &printer.module.assemblies else {
        return;
    };
    text.gap();
    text.open(format!(
        "const {} {}[{}] = {{",
        printer.type_of("Branches"),
        printer.constant("ASSEMBLIES"),
        count(printer)
    ));
    for (number, assembly) in all.iter().enumerate() {
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
        let found = determinants.iter();
        let found = found.map(|it| it.map_or("LINKWRIGHT_NEAREST", sign).to_string());
        let modes: Vec<String> = closed.chain(found).collect();
        text.line(format!("{{{}, {}U}},", modes.join(", "), number + 1));
    }
    text.close("};");
}

/// `begin`: puts the frame before the first one near the assembly that is wanted.
pub(super) fn begin(printer: &Printer<'_>, text: &mut Text) {
    let Some(StoredAssemblies { unknowns, all }) = &printer.module.assemblies else {
        return;
    };
    let (branches, frame) = (printer.type_of("Branches"), printer.type_of("Frame"));
    text.gap();
    text.comment(["Moves the frame before the first one to the requested assembly, if any."]);
    text.line(format!(
        "static void {}({branches} *branches, {frame} *at)",
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

/// How many there are: `PLATFORM_ASSEMBLY_COUNT`.
fn count(printer: &Printer<'_>) -> String {
    printer.constant("ASSEMBLY_COUNT")
}
