//! Writes the methods of a frame that return normalized determinants.

use crate::emit::code::Code;
use crate::emit::module::Module;
use crate::program::Measured;

/// Writes the methods if the description has `monitor`.
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
    let field = |symbol| module.field(symbol, "self");
    match measured {
        Measured::Sine(sine) => format!("Measure::sine({})", field(*sine)),
        Measured::Slope(slope) => format!("Measure::slope({})", field(*slope)),
        Measured::Block(both) => {
            let [determinant, condition] = both.map(field);
            format!("Measure {{ determinant: {determinant}, reciprocal_condition: {condition} }}")
        }
    }
}
