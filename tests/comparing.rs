//! Writes comparisons of modules with the interpreter, for build scripts.
//!
//! Every motion of every description without errors is compared, with the forces and derivatives of its frames,
//! without a list of names.

use linkwright_codegen::stages::emit::rust::type_name;
use linkwright_codegen::stages::model::Mechanism;
use linkwright_codegen::stages::program::{Kept, Output, Program, Reaction};
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::structure::Shift;
use linkwright_codegen::stages::system::Component;

use crate::described::motions_in_folder;
use crate::registry;

/// Writes `comparing.rs`: the modules of the package's own descriptions, and a list of all motions.
pub fn write(own: &str, others: &str) {
    let (mut modules, mut list) = (String::new(), String::new());
    for (is_own, folder) in [(true, own), (false, others)] {
        for motions in motions_in_folder(folder) {
            let name = motions[0].system.mechanism.name.clone();
            let module = match is_own {
                true => name.clone(),
                false => format!("linkwright_mechanisms::{name}"),
            };
            if is_own {
                modules.push_str(&format!(
                    "pub mod {name} {{\n    linkwright::include_mechanism!({name});\n}}\n"
                ));
            }
            for (place, derived) in motions.into_iter().enumerate() {
                let motion = derived.system.mechanism.motion.as_ref();
                let path = motion.map_or(module.clone(), |it| format!("{module}::{}", it.name));
                let mechanism_type = type_name(&name);
                let Ok(solved) = Solved::of(derived, Shift::Directions, Kept::Requested) else {
                    continue;
                };
                let program = solved.program();
                let (outputs, reported) = (
                    outputs(program),
                    reported(program, &solved.system().mechanism),
                );
                let derivatives = derivatives(program);
                list.push_str(&format!(
                    "    Compared {{\n        name: {name:?},\n        motion: {place},\n        compare: |derived| compare::<{path}::{mechanism_type}>(\n            derived,\n            |it| {{ {} }},\n            |it| {{ {} }},\n            |it| {{ {} }},\n        ),\n    }},\n",
                    collected(&outputs),
                    collected(&reported),
                    collected(&derivatives),
                ));
            }
        }
    }
    let text = format!("{modules}\npub const ALL: &[Compared] = &[\n{list}];\n");
    registry::write("comparing.rs", &text);
}

/// An expression of all values in one list.
fn collected(values: &[String]) -> String {
    match values {
        [] => "let _ = it; Vec::new()".to_string(),
        _ => format!("[{}].concat()", values.join(", ")),
    }
}

/// The coordinates and points that a frame offers where `output` limits it, with their levels.
fn outputs(program: &Program) -> Vec<String> {
    let mut values = Vec::new();
    for output in program.outputs.iter().flatten() {
        match output {
            Output::Coordinate { name, fields, .. } => {
                let suffixes = ["", "_rate", "_acceleration"].iter().enumerate();
                values.extend(suffixes.take(fields.len()).map(|(level, suffix)| {
                    format!("vec![({name:?}, {level}, vec![it.{name}{suffix}()])]")
                }));
            }
            // Points with all levels are compared as those of any frame.
            Output::Point { fields, .. } if fields.len() == 3 => {}
            Output::Point { name, fields } => {
                let suffixes = ["position", "velocity"].iter().enumerate();
                values.extend(suffixes.take(fields.len()).map(|(level, suffix)| {
                    format!("vec![({name:?}, {level}, it.point_{name}_{suffix}().to_vec())]")
                }));
            }
        }
    }
    values
}

/// Expressions for the forces and measures of a frame, in the order of the interpreter's columns; NaN for measures that `output` omits.
fn reported(program: &Program, mechanism: &Mechanism) -> Vec<String> {
    let forces = &program.forces;
    let mut values = Vec::new();
    for effort in &forces.efforts {
        values.extend(["effort", "power"].map(|it| format!("vec![it.{it}_{}()]", effort.name)));
    }
    for Reaction {
        name, components, ..
    } in &forces.reactions
    {
        let mut components = &components[..];
        if let [(Component::X, _), (Component::Y, _), rest @ ..] = components {
            values.push(format!("it.reaction_{name}().to_vec()"));
            components = rest;
        }
        let rest = components.iter();
        values.extend(rest.map(|(it, _)| format!("vec![it.reaction_{name}_{}()]", it.suffix())));
    }
    if forces.energy.is_some() {
        let names = ["kinetic_energy", "potential_energy", "added_power"];
        values.extend(names.map(|it| format!("vec![it.{it}()]")));
    }
    for (joint, _) in forces.resistance.iter().flat_map(|it| &it.joints) {
        let slug = &mechanism.joints[*joint].slug;
        values.push(format!("vec![it.friction_{slug}()]"));
    }
    if forces.resistance.is_some() {
        let names = ["frictionless_power", "backward_power"];
        values.extend(names.map(|it| format!("vec![it.{it}()]")));
    }
    let measurements = 0..mechanism.measurements.len();
    values.extend(measurements.map(|place| {
        let mut measures = program.measures.iter();
        match measures.find(|it| it.measurement == place) {
            Some(measure) => format!("vec![it.measure_{}()]", measure.name),
            None => "vec![f64::NAN]".to_string(),
        }
    }));
    values
}

/// Expressions for the transmissions of a frame, row by row, and the sensitivities of all coordinates.
fn derivatives(program: &Program) -> Vec<String> {
    let transmissions = program.transmissions.iter();
    let transmissions = transmissions.map(|it| {
        format!(
            "it.transmission_{}().transpose().as_slice().to_vec()",
            it.name
        )
    });
    let sensitivities = program.sensitivities.iter();
    let sensitivities = sensitivities.filter(|it| it.coordinates.is_some());
    let sensitivities = sensitivities.flat_map(|it| {
        let levels = ["position", "velocity"];
        let coordinates =
            levels.map(|level| format!("it.sensitivity_{}().{level}.to_array().to_vec()", it.name));
        let measures = it.quantities.iter().filter(|it| it.is_measure);
        let measures =
            measures.map(move |of| format!("vec![it.{}_sensitivity_{}()]", of.name, it.name));
        coordinates.into_iter().chain(measures)
    });
    transmissions.chain(sensitivities).collect()
}
