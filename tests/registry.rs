//! Lists the modules of the descriptions in a folder, for build scripts.
//!
//! Modules have no names at run time. So tests of every mechanism are written for any type, and the list of types is
//! written here from the descriptions: a new file is compiled, timed and compared without being named elsewhere.

use std::path::Path;
use std::{env, fs};

use linkwright_codegen::stages::emit::rust::type_name;

use crate::described::{Described, in_folder};

/// Mechanism whose frames hold all coordinates, and whose only input is the time.
pub struct Listed {
    /// Name of its module.
    pub name: String,
    /// Its type.
    pub mechanism: String,
}

/// Mechanisms of a folder, by name: without motions, parameters and inputs, and without `output` statements. A
/// description with errors is left out here; generating its module reports them.
pub fn listed(folder: &str) -> Vec<Listed> {
    in_folder(folder).iter().filter_map(whole).collect()
}

fn whole(described: &Described) -> Option<Listed> {
    let mechanism = &described.derived.system.mechanism;
    let has_inputs = !mechanism.parameters.is_empty() || !mechanism.inputs.is_empty();
    let whole = !has_inputs && mechanism.motion.is_none() && mechanism.requests.is_empty();
    whole.then(|| Listed {
        name: mechanism.name.clone(),
        mechanism: type_name(&mechanism.name),
    })
}

/// Writes a file into the build script's output folder.
pub fn write(file: &str, text: &str) {
    let target = Path::new(&env::var_os("OUT_DIR").expect("cargo's folder")).join(file);
    fs::write(target, text).expect("the list is written");
}
