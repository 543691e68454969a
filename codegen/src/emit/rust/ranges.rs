//! Writes the ranges of parameters and inputs.

use crate::emit::code::Code;
use crate::emit::module::{Module, documentation};
use crate::model::{Dimension, si_unit};

/// Writes a list for parameters and one for inputs; nothing where none has a range.
pub(super) fn ranges(module: &Module<'_>, code: &mut Code) {
    let mechanism = &module.system.mechanism;
    let parameters = mechanism.parameters.iter();
    let parameters: Vec<_> = parameters.map(|it| (it.range, it.dimension)).collect();
    let inputs = mechanism.inputs.iter();
    let inputs: Vec<_> = inputs.map(|it| (it.range, it.dimension)).collect();
    list(module, "parameter", &parameters, code);
    list(module, "input", &inputs, code);
}

fn list(
    module: &Module<'_>,
    noun: &str,
    ranges: &[(Option<[f64; 2]>, Dimension)],
    code: &mut Code,
) {
    if ranges.iter().all(|it| it.0.is_none()) {
        return;
    }
    let items = ranges.iter().map(|(ends, dimension)| match ends {
        Some(ends) => {
            let [low, high] = ends.map(|end| module.number(end));
            let unit = si_unit(*dimension);
            format!("Some(ValueRange {{ ends: [{low}, {high}], unit: {unit:?} }})")
        }
        None => "None".to_string(),
    });
    let items: Vec<String> = items.collect();
    code.gap();
    code.docs([documentation::of_ranges(noun)]);
    let name = noun.to_uppercase();
    code.open(format!(
        "pub const {name}_RANGES: [Option<ValueRange>; {}] = [",
        ranges.len()
    ));
    for item in items {
        code.line(format!("{item},"));
    }
    code.close("];");
}

/// Returns the arguments of the runtime's macro.
pub(super) fn lines(module: &Module<'_>) -> Vec<&'static str> {
    let mechanism = &module.system.mechanism;
    let mut lines = Vec::new();
    if mechanism.parameters.iter().any(|it| it.range.is_some()) {
        lines.push("parameter_ranges: PARAMETER_RANGES;");
    }
    if mechanism.inputs.iter().any(|it| it.range.is_some()) {
        lines.push("input_ranges: INPUT_RANGES;");
    }
    lines
}
