//! Lists the repository's mechanisms, and generates those that only tests need.

#[path = "../registry.rs"]
mod registry;

fn main() {
    println!("cargo::rerun-if-changed=../../mechanisms");
    println!("cargo::rerun-if-changed=../registry.rs");
    linkwright_codegen::build("../descriptions");
    registry::write("../../mechanisms");
}
