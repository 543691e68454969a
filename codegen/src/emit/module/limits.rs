//! Lists the ends of the limits of measures.
//!
//! Every language offers their names, and a function that returns the margins of a frame in the same order.

use super::Module;
use crate::expr::SymbolId;

/// End of a limit.
#[derive(Clone, Debug)]
pub(in crate::emit) struct LimitEnd {
    /// Name: `stroke at most 80 mm`.
    pub name: String,
    /// Field of the measure.
    pub field: SymbolId,
    /// Limiting value in SI units.
    pub value: f64,
    /// True if the measure is at most the value.
    pub is_upper: bool,
}

/// Documentation of the function.
pub(in crate::emit) const MARGINS: &str =
    "Margin of each measure to its limits, in SI units: negative where a limit is broken.";

/// Documentation of the names.
pub(in crate::emit) const NAMES: &str = "Limits of measures, one for each margin.";

/// Returns the ends of all limits, in written order, the lower end first.
pub(in crate::emit) fn ends(module: &Module<'_>) -> Vec<LimitEnd> {
    let mechanism = &module.system.mechanism;
    let units = mechanism.units.of_tables();
    let mut ends = Vec::new();
    for limit in &mechanism.limits {
        let mut measures = module.program.measures.iter();
        let Some(measure) = measures.find(|it| it.measurement == limit.measurement) else {
            continue;
        };
        let measured = &mechanism.measurements[limit.measurement].name;
        for (side, value) in limit.ends.into_iter().enumerate() {
            let Some(value) = value else { continue };
            let mut alone = limit.clone();
            alone.ends[1 - side] = None;
            ends.push(LimitEnd {
                name: format!("{measured} {}", alone.text(&units)),
                field: measure.field,
                value,
                is_upper: side == 1,
            });
        }
    }
    ends
}
