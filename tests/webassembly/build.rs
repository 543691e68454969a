//! Names the generated modules in the folder `MODULES` as `linkwright_codegen::build` does.
//!
//! The part `webassembly` of `.ci/run` writes them by the command, so that the generator is not compiled once more.

use std::env;
use std::path::PathBuf;

fn main() {
    println!("cargo::rerun-if-env-changed=MODULES");
    let modules = env::var_os("MODULES").map(PathBuf::from);
    let modules = modules.expect("MODULES is the folder that `.ci/run webassembly` writes");
    println!("cargo::rerun-if-changed={}", modules.display());
    println!(
        "cargo::rustc-env=LINKWRIGHT_MECHANISMS=see {}",
        modules.display()
    );
    for name in ["four_bar_f64", "excavator_f64", "four_bar_f32"] {
        let path = modules.join(name).with_extension("rs");
        println!("cargo::rustc-env=LINKWRIGHT_{name}={}", path.display());
    }
}
