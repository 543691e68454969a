//! Takes the modules of all variants, or of the one that the environment names, and writes the list of them.
//!
//! The program `embedded` of `linkwright-tests` has generated them in the folder `MODULES`, so that no compiler of firmware compiles the
//! generator.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=memory.x");
    println!("cargo::rerun-if-env-changed=MODULES");
    println!("cargo::rerun-if-env-changed=VARIANT");
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let modules = env::var_os("MODULES").map(PathBuf::from);
    let modules = modules
        .expect("MODULES is the folder that `cargo run -p linkwright-tests --bin embedded` writes");
    println!("cargo::rerun-if-changed={}", modules.display());
    let list = fs::read_to_string(modules.join("list")).expect("the list of modules");
    let chosen = env::var("VARIANT").ok();
    fs::create_dir_all(output.join("linkwright")).expect("a folder for the modules");
    let (mut declared, mut calls) = (String::new(), String::new());
    for line in list.lines() {
        let [variant, type_name, real] = line.split(' ').collect::<Vec<_>>()[..] else {
            panic!("not a variant, a type and a scalar: {line}");
        };
        if chosen.as_deref().is_some_and(|it| it != variant) {
            continue;
        }
        let module = format!("{variant}.rs");
        fs::copy(
            modules.join(&module),
            output.join("linkwright").join(&module),
        )
        .expect("the module is copied");
        declared += &format!(
            "/// See the crate.\n#[allow(missing_docs)]\npub mod {variant} {{\n    include!(concat!(env!(\"OUT_DIR\"), \"/linkwright/{variant}.rs\"));\n}}\nmoved!({variant}, {type_name}, {real});\n"
        );
        calls += &format!(
            "    machine.write(\"variant {variant}\\n\");\n    motion::run::<{variant}::{type_name}, M>(machine);\n"
        );
    }
    assert!(!calls.is_empty(), "no variant is called {chosen:?}");
    declared += &format!(
        "/// Moves every variant that was chosen.\npub fn run<M: Machine>(machine: &mut M) {{\n{calls}}}\n"
    );
    fs::write(output.join("variants.rs"), declared).expect("the list is written");
    // Where the linker looks for the memory of the board.
    fs::copy("memory.x", output.join("memory.x")).expect("the memory is written");
    println!("cargo::rustc-link-search={}", output.display());
}
