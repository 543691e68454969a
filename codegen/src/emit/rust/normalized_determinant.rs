//! Writes the normalized determinants of the loops as functions of the frame.

use crate::emit::code::Code;
use crate::emit::module::Module;
use crate::program::Measured;

/// Writes the functions that say it; nothing if the description does not ask.
pub(super) fn smallest_determinant(module: &Module<'_>, code: &mut Code) {
    if !module.system.mechanism.monitor {
        return;
    }
    let blocks = module.program.blocks.iter().enumerate();
    let each = blocks.flat_map(|(number, block)| {
        block.measured.iter().map(move |measured| {
            let measure = measure(measured, module);
            format!("NormalizedDeterminant::new({number}, {measure}, BLOCKS[{number}])")
        })
    });
    let each: Vec<String> = each.collect();
    code.getter(
        ["Returns the normalized determinant of each loop, in solve order; see `linkwright::NormalizedDeterminant`."],
        "normalized_determinants",
        &format!("[NormalizedDeterminant; {}]", each.len()),
        format!("[{}]", each.join(", ")),
    );
    code.getter(
        ["Returns the smallest normalized determinant of all loops."],
        "smallest_determinant",
        "NormalizedDeterminant",
        "NormalizedDeterminant::closest(&self.normalized_determinants())",
    );
}

fn measure(measured: &Measured, module: &Module<'_>) -> String {
    let own = |symbol| module.field(symbol, "self");
    match measured {
        Measured::Sine(sine) => format!("Measure::sine({})", own(*sine)),
        Measured::Slope(slope) => format!("Measure::slope({})", own(*slope)),
        Measured::Block(both) => {
            let [determinant, condition] = both.map(own);
            format!("Measure {{ determinant: {determinant}, reciprocal_condition: {condition} }}")
        }
    }
}
