//! *The descriptions in a folder* → *one macro call that lists them*, for build scripts.
//!
//! Modules have no names at run time, so what the tests do with every mechanism is a macro over a list. The list is written here
//! from the descriptions: a new file is compiled, timed and compared without being named anywhere else.

use std::fs;
use std::path::Path;

use linkwright_codegen::model::type_name;

use crate::described::{Described, in_folder};

/// Writes `registry.rs` into the build script's output folder: `registry! { name: Type { "K" => point_k, … } … }`, by name.
///
/// Listed are the mechanisms without motions that are not limited by `output` statements, whose frames hold all coordinates, and
/// that are given nothing but a time: no parameters and no inputs. A description with
/// errors is left out here; generating its module reports them.
pub fn write(folder: &str) {
    let lines: String = in_folder(folder).iter().filter_map(line).collect();
    let target = Path::new(&std::env::var("OUT_DIR").expect("cargo's folder")).join("registry.rs");
    fs::write(target, format!("registry! {{\n{lines}}}\n")).expect("the list is written");
}

/// `name: Type { "K" => point_k, … }`
fn line(described: &Described) -> Option<String> {
    let mechanism = &described.system.mechanism;
    let given = !mechanism.parameters.is_empty() || !mechanism.inputs.is_empty();
    if given || mechanism.motion.is_some() || !mechanism.requests.is_empty() {
        return None;
    }
    let points: String = mechanism
        .points
        .iter()
        .map(|point| {
            let function = point.name.to_lowercase();
            format!("\"{}\" => point_{function}, ", point.name)
        })
        .collect();
    let name = &mechanism.name;
    Some(format!("    {name}: {} {{ {points}}}\n", type_name(name)))
}
