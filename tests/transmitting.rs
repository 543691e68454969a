//! *Descriptions* → *the same with the transmission of every point and every angle*, for build scripts.
//!
//! So every mechanism of the repository is tested for what its drivers transmit without being named anywhere.

use std::path::PathBuf;
use std::{env, fs};

use linkwright_codegen::stages::emit::rust::type_name;
use linkwright_codegen::stages::model::Role;

use crate::described::{empty_folder, in_folder};

/// Every description that is not limited by `output`, as `transmitting_NAME`, and `transmitting.rs` with a list of samples.
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
            // An equation that moves with time is no driver of a quantity.
            let mut joints = mechanism.joints.iter();
            let limited =
                limited || joints.any(|it| it.role == Role::Driver && it.operands.value.is_none());
            // Signals would have to be supplied.
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
            let wanted: Vec<&str> = points
                .iter()
                .copied()
                .chain(angles.iter().map(String::as_str))
                .collect();
            let statement = format!("transmission {};", wanted.join(", "));
            let text = described.extended(&format!("transmitting_{name}"), &statement);
            fs::write(descriptions.join(format!("{name}.mech")), text).expect("a new file");
            modules.push_str(&format!(
                "pub mod {name} {{\n    linkwright::include_mechanism!(transmitting_{name});\n}}\n"
            ));
            let original = if *folder == "descriptions" {
                "None".to_string()
            } else {
                let own = type_name(name);
                format!("Some(follow::<linkwright_mechanisms::{name}::{own}>)")
            };
            let quantities = points.iter().map(|it| quantity(it, &it.to_lowercase()));
            let angles = angle_fields.iter().map(|it| quantity(it, it));
            let quantities: String = quantities.chain(angles).collect();
            let own = type_name(&format!("transmitting_{name}"));
            list.push_str(&format!(
                "    Transmitting {{\n        name: {name:?},\n        sample: |times, load| sample::<{name}::{own}>(times, load, &[\n{quantities}        ]),\n        original: {original},\n    }},\n"
            ));
        }
    }
    linkwright_codegen::build(&descriptions);
    let text = format!("{modules}\npub const ALL: &[Transmitting] = &[\n{list}];\n");
    fs::write(output.join("transmitting.rs"), text).expect("a new file");
}

/// What a mechanism's frames say of a quantity: a point, or a coordinate.
fn quantity(name: &str, field: &str) -> String {
    // What turns a body is one number.
    let load = if name.starts_with("phi") {
        "load[0]"
    } else {
        "load"
    };
    format!(
        "            Quantity {{ name: {name:?}, transmission: |it| dynamic(it.transmission_{field}()), forces: |it, load| vector(it.forces_{field}({load})) }},\n"
    )
}
