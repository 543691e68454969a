//! Lists the repository's mechanisms.

#[path = "../registry.rs"]
mod registry;

fn main() {
    println!("cargo::rerun-if-changed=../../mechanisms");
    println!("cargo::rerun-if-changed=../registry.rs");
    registry::write("../../mechanisms");
}
