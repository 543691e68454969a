//! Names the generated modules in the folder `MODULES` as `linkwright_codegen::build` does.
//!
//! The test `builds::freestanding` of `linkwright-tests` writes them, so that the generator is not compiled once more.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-env-changed=MODULES");
    let modules = env::var_os("MODULES").map(PathBuf::from);
    let modules = modules
        .expect("MODULES is the folder that `cargo test -p linkwright-tests --test builds` writes");
    println!("cargo::rerun-if-changed={}", modules.display());
    println!(
        "cargo::rustc-env=LINKWRIGHT_MECHANISMS=see {}",
        modules.display()
    );
    for entry in fs::read_dir(modules).expect("the folder of modules") {
        let path = entry.expect("a listed file").path();
        let name = path.file_stem().expect("a file").display();
        println!("cargo::rustc-env=LINKWRIGHT_{name}={}", path.display());
    }
}
