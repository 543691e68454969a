//! Writes the stored assemblies.

use super::names::identifier;
use crate::emit::code::Code;
use crate::emit::module::{Module, documentation};

/// Length up to which all modes of an assembly are on one line, in characters.
const MAX_LINE_LENGTH: usize = 100;

/// Writes `Branches::ASSEMBLIES`, with the start values of Newton-Raphson for each assembly.
pub(super) fn assemblies(module: &Module<'_>, code: &mut Code) {
    let Some(stored) = &module.assemblies else {
        return;
    };
    let unknowns = stored.unknowns.iter();
    let fields = unknowns.map(|&unknown| {
        let position = module.system.vector_form.unknowns[unknown].position;
        let field = module.field(position, "");
        field.trim_start_matches('.').to_string()
    });
    let fields: Vec<String> = fields.collect();
    let iterated = module.program.blocks.iter();
    let iterated = iterated.filter(|block| block.newton.is_some());
    code.gap();
    code.open("::linkwright::generated::assemblies! {");
    code.docs(documentation::ASSEMBLIES);
    code.open(format!("Branches [{}] of [", stored.all.len()));
    code.list(&fields);
    code.close("]");
    code.open("{");
    for (number, assembly) in stored.all.iter().enumerate() {
        let sign = |is_positive: bool| match is_positive {
            true => "Branch::Positive",
            false => "Branch::Negative",
        };
        let closed = module.program.branches.iter().zip(&assembly.signs);
        let closed = closed.map(|(branch, &is_positive)| {
            format!("{}: {}", identifier(&branch.name), sign(is_positive))
        });
        let determinants = iterated.clone().zip(&assembly.determinants);
        let determinants = determinants.map(|(block, determinant)| {
            let mode = determinant.map_or("None".to_string(), |it| format!("Some({})", sign(it)));
            format!("{}: {mode}", identifier(&block.name))
        });
        let modes: Vec<String> = closed.chain(determinants).collect();
        code.remark(&documentation::of_assembly(assembly, module).replace('`', ""));
        let (label, all) = (&assembly.label, modes.join(", "));
        let line = format!("{number}, {label:?} {{ {all} }} at [");
        if line.len() <= MAX_LINE_LENGTH {
            code.open(line);
        } else {
            code.open(format!("{number}, {label:?} {{"));
            code.list(&modes);
            code.close("}");
            code.open("at [");
        }
        let values = assembly.values.iter();
        let values: Vec<String> = values.map(|&value| module.number(value)).collect();
        code.list(&values);
        code.close("];");
    }
    code.close("}");
    code.close("}");
}
