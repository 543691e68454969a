//! Writes the names of the blocks and of their singular poses, for messages of failures.

use crate::emit::code::Code;
use crate::emit::derivation::BlockWords;
use crate::emit::module::Module;

/// Writes the names of all blocks.
pub(super) fn block_names(module: &Module<'_>, code: &mut Code) {
    let names = module.words.iter();
    let names = names.map(|BlockWords { name, singular }| block_name(name, singular));
    let names: Vec<String> = names.collect();
    code.gap();
    code.docs(["Names of the blocks in solve order, with descriptions of their singular poses."]);
    code.line(format!(
        "pub const BLOCKS: [BlockName<'static>; {}] = [{}];",
        module.program.blocks.len(),
        names.join(", ")
    ));
}

/// Returns the literal of a name with its explanation.
pub(super) fn block_name(name: &str, singular: &str) -> String {
    format!("BlockName::new({name:?}, {singular:?})")
}
