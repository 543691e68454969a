//! Adds the sensitivity to each parameter to descriptions, for build scripts.
//!
//! So every kind of joint with parameters is differentiated without a list of names.

use std::path::PathBuf;
use std::{env, fs};

use linkwright_codegen::stages::emit::rust::type_name;

use crate::described::{empty_folder, in_folder};

/// Writes every description with parameters and without `output` as `sensing_NAME`, and `sensing.rs` with a list of
/// samples.
pub fn write(folder: &str) {
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let descriptions = empty_folder("sensing");
    let (mut modules, mut list) = (String::new(), String::new());
    for described in in_folder(folder) {
        let mechanism = &described.derived.system.mechanism;
        let limited = described.reads_files
            || !mechanism.requests.is_empty()
            || !mechanism.sensitivities.is_empty();
        // Signals would need values.
        if limited || mechanism.parameters.is_empty() || !mechanism.inputs.is_empty() {
            continue;
        }
        // Parameters of forces alone move nothing.
        let graph = &described.derived.pool.graph;
        let rows = described.derived.system.rows.iter();
        let local = mechanism.points.iter().flat_map(|it| it.mark.local);
        let moving = rows.map(|row| row.residual).chain(local);
        let moving: Vec<_> = moving.flat_map(|it| graph.symbols(it).to_vec()).collect();
        let mut parameters = mechanism.parameters.iter();
        if !parameters.all(|it| moving.contains(&it.symbol)) {
            continue;
        }
        let name = &mechanism.name;
        let parameters: Vec<&str> = mechanism
            .parameters
            .iter()
            .map(|it| it.name.as_str())
            .collect();
        let points: Vec<&str> = mechanism.points.iter().map(|it| it.name.as_str()).collect();
        let statement = format!("sensitivity {};", parameters.join(", "));
        let text = described.extended(&format!("sensing_{name}"), &statement);
        fs::write(descriptions.join(format!("{name}.mech")), text).expect("a new file");
        modules.push_str(&format!(
            "pub mod {name} {{\n    linkwright::include_mechanism!(sensing_{name});\n}}\n"
        ));
        let sensing_type = type_name(&format!("sensing_{name}"));
        let derivatives = parameters.iter().map(|it| derivatives(it, &points));
        let derivatives: String = derivatives.collect();
        list.push_str(&format!(
            "    Sensing {{\n        name: {name:?},\n        parameters: &{parameters:?},\n        nominal: nominal::<{name}::{sensing_type}>,\n        sample: |parameters, times| sample::<{name}::{sensing_type}>(parameters, times, &[\n{derivatives}        ]),\n    }},\n"
        ));
    }
    linkwright_codegen::build(&descriptions);
    let text = format!("{modules}\npub const ALL: &[Sensing] = &[\n{list}];\n");
    fs::write(output.join("sensing.rs"), text).expect("a new file");
}

/// Expression for the sensitivities of a frame to a parameter: the derivatives of all coordinates, then of each
/// point.
fn derivatives(parameter: &str, points: &[&str]) -> String {
    let parameter = parameter.to_lowercase();
    let points = points.iter().map(|point| {
        let point = point.to_lowercase();
        format!("{{ let it = it.point_{point}_sensitivity_{parameter}(); [it.position, it.velocity] }}, ")
    });
    let points: String = points.collect();
    format!(
        "            |it| all({{ let it = it.sensitivity_{parameter}(); [it.position, it.velocity] }}, &[{points}]),\n"
    )
}
