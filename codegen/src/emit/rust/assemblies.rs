//! The assemblies that are stored.

use proc_macro2::TokenStream;

use super::docs::doc_lines;
use super::layout::Verbatim;
use super::names::identifier;
use crate::emit::module::{Module, documentation};

/// The longest line on which all modes of an assembly stand, in characters.
const LONGEST: usize = 100;

/// `Branches::ASSEMBLIES`, and where Newton-Raphson starts from for each of them.
pub(super) fn assemblies(module: &Module<'_>) -> TokenStream {
    let Some(stored) = &module.assemblies else {
        return TokenStream::new();
    };
    let unknowns = stored.unknowns.iter();
    let fields = unknowns.map(|&unknown| {
        let position = module.system.vector_form.unknowns[unknown].position;
        let field = module.field_text(position, "");
        field.trim_start_matches('.').to_string()
    });
    let fields: Vec<String> = fields.collect();
    let iterated = module.program.blocks.iter();
    let iterated = iterated.filter(|block| block.newton.is_some());
    let mut text = Verbatim::default();
    text.open("::linkwright::generated::assemblies! {");
    text.docs(doc_lines(documentation::ASSEMBLIES));
    text.open(&format!("Branches [{}] of [", stored.all.len()));
    text.list(fields);
    text.close("]");
    text.open("{");
    for (number, assembly) in stored.all.iter().enumerate() {
        let sign = |is_positive: bool| match is_positive {
            true => "Branch::Positive",
            false => "Branch::Negative",
        };
        let closed = module.program.branches.iter().zip(&assembly.signs);
        let closed = closed.map(|(branch, &is_positive)| {
            format!("{}: {}", identifier(&branch.name), sign(is_positive))
        });
        let found = iterated.clone().zip(&assembly.determinants);
        let found = found.map(|(block, determinant)| {
            let mode = determinant.map_or("None".to_string(), |it| format!("Some({})", sign(it)));
            format!("{}: {mode}", identifier(&block.name))
        });
        let modes: Vec<String> = closed.chain(found).collect();
        text.line(format!(
            "// {}",
            documentation::of_assembly(assembly, module).replace('`', "")
        ));
        let (label, all) = (&assembly.label, modes.join(", "));
        let line = format!("{number}, {label:?} {{ {all} }} at [");
        if line.len() <= LONGEST {
            text.open(&line);
        } else {
            text.open(&format!("{number}, {label:?} {{"));
            text.list(modes);
            text.close("}");
            text.open("at [");
        }
        let values = assembly.values.iter();
        text.list(values.map(|&value| module.number(value)));
        text.close("];");
    }
    text.close("}");
    text.close("}");
    text.item()
}
