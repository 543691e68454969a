//! Writes the documentation of transmissions and sensitivities.

use crate::emit::module::Module;
use crate::model::Dimension;
use crate::program::{SensitiveQuantity, Sensitivity, Transmission};
use crate::system::System;

/// Documentation of a transmission: of its rates and of its forces.
pub(in crate::emit) fn of_transmission(
    transmission: &Transmission,
    system: &System,
) -> [Vec<String>; 2] {
    let Transmission { what, rows, .. } = transmission;
    let is_point = rows.len() == 2;
    let unit = |dimension: Dimension| match dimension.column_unit() {
        plain if plain.is_empty() => "1".to_string(),
        unit => unit,
    };
    let drivers = system.driven().map(|(_, joint, quantity)| {
        let unit = format!("{}/{}", unit(rows[0]), unit(Dimension::of(quantity)));
        format!("`{}` ({unit})", system.mechanism.joints[joint].label)
    });
    let listed: Vec<String> = drivers
        .enumerate()
        .map(|(column, driver)| format!("{column} {driver}"))
        .collect();
    let shape = if is_point { "Rows: x, y. " } else { "" };
    let rates = vec![
        format!(
            "Rate of {what} per unit rate of each driver. The rate is this matrix times the rates of the drivers."
        ),
        String::new(),
        format!("{shape}Columns: {}.", listed.join(", ")),
    ];
    let load = match (is_point, rows[0]) {
        (true, _) => format!("a force (N) at {what}"),
        (false, Dimension::Angle) => format!("a torque (N·m) on {what}"),
        (false, _) => format!("a force (N) along {what}"),
    };
    let forces = vec![format!(
        "Driving forces (N; torques, N·m, for angles) that have the power of {load}: the transposed transmission times the load. A driver that balances the load applies the opposite force."
    )];
    [rates, forces]
}

/// Documentation of the sensitivity of all coordinates.
pub(in crate::emit) fn of_sensitivity(
    sensitivity: &Sensitivity,
    module: &Module<'_>,
) -> Vec<String> {
    let [parameter, unit] = parameter(sensitivity, module);
    vec![
        format!(
            "Derivatives of all coordinates and their rates with respect to the parameter {parameter}:"
        ),
        format!("∂q/∂{parameter} and ∂q̇/∂{parameter}, where {parameter} is in {unit}."),
    ]
}

/// Returns the functions for the sensitivity of a point or a coordinate: names and documentation.
pub(in crate::emit) fn of_quantity(
    sensitivity: &Sensitivity,
    quantity: &SensitiveQuantity,
    module: &Module<'_>,
) -> Vec<(String, String)> {
    let [parameter, unit] = parameter(sensitivity, module);
    let SensitiveQuantity { name, what, .. } = quantity;
    let label = &sensitivity.name;
    if quantity.components.len() == 2 {
        return vec![match quantity.levels.len() {
            2 => (
                format!("point_{name}_sensitivity_{label}"),
                format!(
                    "Derivatives of position and velocity of {what} with respect to the parameter {parameter} (in {unit})."
                ),
            ),
            _ => (
                format!("point_{name}_position_sensitivity_{label}"),
                format!(
                    "Derivative of the position of {what} with respect to the parameter {parameter} (in {unit}), in m per unit."
                ),
            ),
        }];
    }
    let measured = match quantity.components[0].column_unit() {
        plain if plain.is_empty() => "1".to_string(),
        unit => unit,
    };
    let levels = [("", "", ""), ("_rate", "the rate of ", "/s")];
    let levels = levels.into_iter().take(quantity.levels.len());
    levels
        .map(|(suffix, rate, per_second)| {
            (
                format!("{name}{suffix}_sensitivity_{label}"),
                format!(
                    "Derivative of {rate}{what} with respect to the parameter {parameter} (in {unit}), in {measured}{per_second} per unit."
                ),
            )
        })
        .collect()
}

/// Returns the name and the unit of the parameter, such as `L2` and `m`.
fn parameter(sensitivity: &Sensitivity, module: &Module<'_>) -> [String; 2] {
    let parameter = &module.system.mechanism.parameters[sensitivity.parameter];
    [parameter.name.clone(), parameter.dimension.unit()]
}
