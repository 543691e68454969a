//! States the final results of a torn block from its unknowns, and the fields that keep them.

use super::Torn;
use super::functions::is_angle;
use crate::expr::{ExprId, Number};
use crate::program::block::NewtonBlock;
use crate::program::builder::Builder;
use crate::program::function::Level;
use crate::program::tearing::{self, Tearing};

/// States the values of each instant besides the unknowns, and returns their fields.
pub(super) fn found(
    torn: &Torn,
    tearing: &Tearing,
    builder: &mut Builder<'_>,
) -> tearing::TornFields {
    let mut directions = Vec::with_capacity(torn.whole.unknowns.len());
    for &unknown in &torn.whole.unknowns {
        let name = builder.system.unknown_name(unknown).to_string();
        directions.push(is_angle(unknown, builder).then(|| {
            let named = |function: &str| format!("{function}_{name}");
            ["sin", "cos"].map(|function| builder.pool.intermediate(&named(function)))
        }));
    }
    let tears = torn.sequence.tears.iter();
    let names: Vec<&str> = tears.map(|&it| builder.system.unknown_name(it)).collect();
    let name = names.join("_");
    let signs = (1..=tearing.signs.len()).map(|number| format!("sign_{number}_{name}"));
    let memory: Vec<String> = [format!("determinant_{name}")]
        .into_iter()
        .chain(signs)
        .collect();
    let memory = memory.iter();
    tearing::TornFields {
        directions,
        memory: memory.map(|name| builder.pool.intermediate(name)).collect(),
    }
}

/// Returns the cosine of each unknown, or the unknown itself if it is a length; then their sines, rates and accelerations; then
/// all residuals; then the responses of the unknowns to the tearing variables, in scales.
pub(super) fn completed(
    torn: &Torn,
    places: &[usize],
    block: &NewtonBlock,
    builder: &mut Builder<'_>,
) -> Option<Vec<ExprId>> {
    let zero = builder.graph().zero();
    let unknowns = &torn.whole.unknowns;
    let (mut cosines, mut sines) = (Vec::new(), Vec::new());
    for &unknown in unknowns {
        if is_angle(unknown, builder) {
            let inside = builder.inside.as_ref()?;
            let direction = inside.directions.get(&unknown)?;
            cosines.push(direction.cosine);
            sines.push(direction.sine);
        } else {
            cosines.push(builder.position(unknown));
            sines.push(zero);
        }
    }
    let mut results = [cosines, sines].concat();
    for level in [Level::Velocity, Level::Acceleration] {
        for &unknown in unknowns {
            let unknown = &builder.system.vector_form.unknowns[unknown];
            let symbol = match level {
                Level::Velocity => unknown.rate,
                _ => unknown.acceleration,
            };
            results.push(builder.graph().variable(symbol));
        }
    }
    results.extend(&torn.whole.residuals);
    let scale = |unknown: usize, builder: &Builder<'_>| {
        let quantity = builder.system.vector_form.unknowns[unknown].quantity;
        block.scaled_by[1].scale(quantity)
    };
    for (&place, &tear) in places.iter().zip(&torn.sequence.tears) {
        let tear_scale = scale(tear, builder);
        for &unknown in unknowns
            .iter()
            .filter(|&it| !torn.sequence.tears.contains(it))
        {
            let response = builder.derivatives.of_unknown(unknown, place, builder.pool);
            let factor = tear_scale / scale(unknown, builder);
            results.push(match factor == 1.0 {
                true => response,
                false => builder.graph().scale(Number::float(factor), response),
            });
        }
    }
    Some(results)
}
