//! Lists the repository's mechanisms, and generates those that only tests need.

// The list needs less of it than the tests do.
#[allow(dead_code)]
#[path = "../described.rs"]
mod described;
#[path = "../registry.rs"]
mod registry;

fn main() {
    println!("cargo::rerun-if-changed=../../mechanisms");
    println!("cargo::rerun-if-changed=../described.rs");
    println!("cargo::rerun-if-changed=../registry.rs");
    linkwright_codegen::build("../descriptions");
    registry::write("../../mechanisms");
}
