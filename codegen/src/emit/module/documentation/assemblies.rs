//! Writes the documentation of stored assemblies.

use super::Module;
use crate::assemblies::StoredAssembly;
use crate::joint::Quantity;

/// Documentation of the list.
pub(in crate::emit) const ASSEMBLIES: [&str; 3] = [
    "All assemblies of the mechanism at t = 0 s, with the parameters and the initial inputs of the description. The list is",
    "proven to be complete. At another time, or with other values, Newton-Raphson starts from the same pose and may end in",
    "another assembly.",
];

/// Documentation of the field that requests an assembly.
pub(in crate::emit) fn of_wanted_assembly(nothing: &str) -> String {
    format!(
        "Index of the stored assembly from which Newton-Raphson starts; {nothing} for the estimate, and after assembly."
    )
}

/// Returns the label of an assembly with the values of the iterated unknowns, from which all others follow.
pub(in crate::emit) fn of_assembly(assembly: &StoredAssembly, module: &Module<'_>) -> String {
    let mut values = assembly.values.iter();
    let mut coordinates = Vec::new();
    for newton in module
        .program
        .blocks
        .iter()
        .filter_map(|it| it.newton.as_ref())
    {
        for (place, &unknown) in newton.unknowns.iter().enumerate() {
            let Some(value) = values.next() else { break };
            let tears = newton.tearing.as_ref().map(|it| &it.tears);
            if tears.is_none_or(|tears| tears.contains(&place)) {
                let unknown = &module.system.vector_form.unknowns[unknown];
                coordinates.push(match unknown.quantity {
                    Quantity::Angle => format!("{} {:.4}°", unknown.name, value.to_degrees()),
                    _ => format!("{} {value:.6}", unknown.name),
                });
            }
        }
    }
    format!("`{}`: {}", assembly.label, coordinates.join(", "))
}
