//! Adds the transmission of every point and every angle to descriptions, for build scripts.
//!
//! So every mechanism of the repository is tested for the transmissions of its drivers without a list of names.

use std::path::PathBuf;
use std::{env, fs};

use linkwright_codegen::stages::emit::rust::type_name;
use linkwright_codegen::stages::model::Role;

use crate::described::{empty_folder, in_folder};

/// Writes every description without `output` statements as `transmitting_NAME`, and `transmitting.rs` with a list of
/// samples.
pub fn write(folders: &[&str]) {
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let descriptions = empty_folder("transmitting");
    let (mut modules, mut list) = (String::new(), String::new());
    for folder in folders {
        for described in in_folder(folder) {
            let system = &described.derived.system;
            let mechanism = &system.mechanism;
            let limited = described.reads_files
                || !mechanism.requests.is_empty()
                || !mechanism.transmissions.is_empty();
            // A time-dependent equation is not the driver of a quantity.
            let mut joints = mechanism.joints.iter();
            let limited =
                limited || joints.any(|it| it.role == Role::Driver && it.operands.value.is_none());
            // Signals would need values.
            if limited || mechanism.motion.is_some() || !mechanism.inputs.is_empty() {
                continue;
            }
            let name = &mechanism.name;
            let points: Vec<&str> = mechanism.points.iter().map(|it| it.name.as_str()).collect();
            let bodies = mechanism.moving_bodies().iter();
            let angles: Vec<String> = bodies.map(|body| format!("phi({})", body.name)).collect();
            let angle_fields: Vec<&str> = system
                .coordinates
                .iter()
                .take(3 * mechanism.moving_bodies().len())
                .skip(2)
                .step_by(3)
                .map(|it| it.name.as_str())
                .collect();
            // Angles alone have no body that a driver could move.
            if points.is_empty() && angle_fields.is_empty() {
                continue;
            }
            let quantities: Vec<&str> = points
                .iter()
                .copied()
                .chain(angles.iter().map(String::as_str))
                .collect();
            let statement = format!("transmission {};", quantities.join(", "));
            let text = described.extended(&format!("transmitting_{name}"), &statement);
            fs::write(descriptions.join(format!("{name}.mech")), text).expect("a new file");
            modules.push_str(&format!(
                "pub mod {name} {{\n    linkwright::include_mechanism!(transmitting_{name});\n}}\n"
            ));
            let original = if *folder == "descriptions" {
                "None".to_string()
            } else {
                let type_name_alone = type_name(name);
                format!("Some(follow::<linkwright_mechanisms::{name}::{type_name_alone}>)")
            };
            let quantities = points.iter().map(|it| quantity(it, &it.to_lowercase()));
            let angles = angle_fields.iter().map(|it| quantity(it, it));
            let quantities: String = quantities.chain(angles).collect();
            let type_name_alone = type_name(&format!("transmitting_{name}"));
            list.push_str(&format!(
                "    Transmitting {{\n        name: {name:?},\n        sample: |times, load| sample::<{name}::{type_name_alone}>(times, load, &[\n{quantities}        ]),\n        original: {original},\n    }},\n"
            ));
        }
    }
    linkwright_codegen::build(&descriptions);
    let text = format!("{modules}\npub const ALL: &[Transmitting] = &[\n{list}];\n");
    fs::write(output.join("transmitting.rs"), text).expect("a new file");
}

/// Expression for a quantity of a frame: a point, or a coordinate.
fn quantity(name: &str, field: &str) -> String {
    // The load on an angle is one number.
    let load = if name.starts_with("phi") {
        "load[0]"
    } else {
        "load"
    };
    format!(
        "            Quantity {{ name: {name:?}, transmission: |it| dynamic(it.transmission_{field}()), forces: |it, load| vector(it.forces_{field}({load})) }},\n"
    )
}
