//! Generates the modules of all variants, or of the one that the environment names, and the list of them.
//!
//! A variant is a mechanism in a scalar, with or without the guard: `four_bar_f32`, `four_bar_f32_unguarded`.

use std::path::{Path, PathBuf};
use std::{env, fs};

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::emit::rust::type_name;
use linkwright_codegen::{Options, Scalar, generate_with, write_module};

const MECHANISMS: [&str; 5] = ["two_body", "four_bar", "excavator", "arm", "platform_3rpr"];
const SCALARS: [(&str, Scalar); 2] = [("f32", Scalar::F32), ("f64", Scalar::F64)];
const FOLDER: &str = "../../mechanisms";

fn main() {
    println!("cargo::rerun-if-changed={FOLDER}");
    println!("cargo::rerun-if-changed=memory.x");
    println!("cargo::rerun-if-env-changed=VARIANT");
    let output = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let chosen = env::var("VARIANT").ok();
    let is_chosen = |name: &str| chosen.as_deref().is_none_or(|it| it == name);
    let (mut modules, mut calls) = (String::new(), String::new());
    for mechanism in MECHANISMS {
        let text = fs::read_to_string(Path::new(FOLDER).join(mechanism).with_extension("mech"));
        let text = text.expect("the description");
        for (real, scalar) in SCALARS {
            for guard in ["", "_unguarded"] {
                let variant = format!("{mechanism}_{real}{guard}");
                if !is_chosen(&variant) {
                    continue;
                }
                let text = match guard {
                    "" => text.clone(),
                    _ => unguarded(&text),
                };
                write_variant(&variant, &text, scalar);
                let type_name = type_name(mechanism);
                modules += &format!(
                    "/// See the crate.\n#[allow(missing_docs)]\npub mod {variant} {{\n    linkwright::include_mechanism!({variant});\n}}\nmoved!({variant}, {type_name}, {real});\n"
                );
                calls += &format!(
                    "    machine.write(\"variant {variant}\\n\");\n    motion::run::<{variant}::{type_name}, M>(machine);\n"
                );
            }
        }
    }
    assert!(!calls.is_empty(), "no variant is called {chosen:?}");
    modules += &format!(
        "/// Moves every variant that was chosen.\npub fn run<M: Machine>(machine: &mut M) {{\n{calls}}}\n"
    );
    fs::write(output.join("variants.rs"), modules).expect("the list is written");
    // Where the linker looks for the memory of the board.
    fs::copy("memory.x", output.join("memory.x")).expect("the memory is written");
    println!("cargo::rustc-link-search={}", output.display());
}

/// The description with one more statement.
fn unguarded(text: &str) -> String {
    let end = text.rfind('}').expect("a mechanism ends in a brace");
    format!("{}    unguarded;\n{}", &text[..end], &text[end..])
}

fn write_variant(variant: &str, text: &str, scalar: Scalar) {
    let source = Source::new(format!("{variant}.mech"), text.to_string());
    let options = Options {
        scalar,
        ..Options::default()
    };
    match generate_with(&source, &options) {
        Ok(generated) => {
            write_module(variant, &generated.code).expect("the module is written");
        }
        Err(found) => panic!("{}", found.render(&source)),
    }
}
