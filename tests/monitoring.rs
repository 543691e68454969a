//! *Descriptions* → *the same, monitored*, for build scripts.
//!
//! One of each kind of block, also with parameters and with outputs. The platform and the exam are written in single precision
//! too.

use std::path::PathBuf;
use std::{env, fs};

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::model::type_name;
use linkwright_codegen::{Options, Scalar, generate_with};

/// What is monitored, with its folder.
const MONITORED: [(&str, &str); 13] = [
    ("descriptions", "folding"),
    ("descriptions", "sensed_four_bar"),
    ("descriptions", "leveled_slider"),
    ("descriptions", "turning_guide"),
    ("descriptions", "two_guides"),
    ("../mechanisms", "disc_cam"),
    ("../mechanisms", "double_wishbone"),
    ("../mechanisms", "excavator"),
    ("../mechanisms", "excavator_tool"),
    ("../mechanisms", "four_bar"),
    ("../mechanisms", "inverted_slider_crank"),
    ("../mechanisms", "planetary_gear"),
    ("../mechanisms", "platform_3rpr"),
];

/// Each as `monitoring_NAME`, and `monitoring.rs` with a list of them.
pub fn write() {
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let descriptions = output.join("monitoring");
    fs::create_dir_all(&descriptions).expect("a folder of its own");
    let mut list = String::new();
    for (folder, name) in MONITORED {
        println!("cargo::rerun-if-changed={folder}/{name}.mech");
        // A description that is missing is missed by the tests.
        let Ok(text) = fs::read_to_string(format!("{folder}/{name}.mech")) else {
            continue;
        };
        let renamed = text.replacen(
            &format!("mechanism {name}"),
            &format!("mechanism monitoring_{name}"),
            1,
        );
        let end = renamed.rfind('}').expect("a mechanism ends in a brace");
        let text = format!("{}\n    monitor;\n{}", &renamed[..end], &renamed[end..]);
        if ["folding", "platform_3rpr"].contains(&name) {
            let single = Options {
                scalar: Scalar::F32,
            };
            if let Ok(module) = generate_with(&Source::new(name, text.clone()), &single) {
                let target = output.join(format!("linkwright/monitoring_{name}_single.rs"));
                fs::write(target, module.code).expect("the module is written");
            }
        }
        fs::write(descriptions.join(format!("{name}.mech")), text).expect("a new file");
        list.push_str(&format!(
            "monitored!({name}, monitoring_{name}, {});\n",
            type_name(&format!("monitoring_{name}"))
        ));
    }
    linkwright_codegen::build(&descriptions);
    fs::write(output.join("monitoring.rs"), list).expect("a new file");
}
