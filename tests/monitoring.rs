//! Adds `monitor` statements to descriptions, for build scripts.
//!
//! One of each kind of block, also with parameters and with outputs. The platform and the exam are written in single
//! precision too.

use std::path::PathBuf;
use std::{env, fs};

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::emit::rust::type_name;
use linkwright_codegen::{Options, Scalar, generate};

use crate::described::{empty_folder, in_folder};

/// Names of the monitored mechanisms.
const MONITORED: [&str; 13] = [
    "disc_cam",
    "double_wishbone",
    "excavator",
    "excavator_tool",
    "folding",
    "four_bar",
    "inverted_slider_crank",
    "leveled_slider",
    "planetary_gear",
    "platform_3rpr",
    "sensed_four_bar",
    "turning_guide",
    "two_guides",
];

/// Writes each as `monitoring_NAME`, and `monitoring.rs` with a list of them.
pub fn write(folders: &[&str]) {
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let descriptions = empty_folder("monitoring");
    let (mut modules, mut list) = (String::new(), String::new());
    for described in folders.iter().flat_map(|folder| in_folder(folder)) {
        let name = described.derived.system.mechanism.name.as_str();
        if !MONITORED.contains(&name) {
            continue;
        }
        let new_name = format!("monitoring_{name}");
        let text = described.extended(&new_name, "monitor;");
        if ["folding", "platform_3rpr"].contains(&name) {
            let single = Options {
                scalar: Scalar::F32,
                ..Options::default()
            };
            if let Ok(module) = generate(&Source::new(name, text.clone()), &single) {
                let name = format!("{new_name}_single");
                linkwright_codegen::write_module(&name, module.code())
                    .expect("the module is written");
            }
        }
        fs::write(descriptions.join(format!("{name}.mech")), text).expect("a new file");
        modules.push_str(&format!(
            "pub mod {name} {{\n    linkwright::include_mechanism!({new_name});\n}}\n"
        ));
        let of = type_name(&new_name);
        list.push_str(&format!(
            "    ({name:?}, |times| measures::<{name}::{of}>(times, |it| (it.normalized_determinants().to_vec(), it.smallest_determinant()))),\n"
        ));
    }
    linkwright_codegen::build(&descriptions);
    let text = format!("{modules}\npub const ALL: &[(&str, Measures)] = &[\n{list}];\n");
    fs::write(output.join("monitoring.rs"), text).expect("a new file");
}
