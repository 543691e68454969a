//! Takes the generated modules and the lists of them from the folder `MODULES`.
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
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    fs::create_dir_all(output.join("linkwright")).expect("a folder for the modules");
    for entry in fs::read_dir(modules).expect("the folder of modules") {
        let path = entry.expect("a listed file").path();
        let name = path.file_name().expect("a file");
        let place = match name.to_str() {
            Some("gallery.rs" | "functions.rs") => output.join(name),
            _ => output.join("linkwright").join(name),
        };
        fs::copy(&path, place).expect("the file is copied");
    }
}
