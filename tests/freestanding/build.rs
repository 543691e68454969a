//! Lists the repository's mechanisms, and generates those that only tests need.

// The list needs less of them than the tests do.
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
    let functions = registry::listed("../../mechanisms").into_iter().map(|it| {
        let (name, module) = (&it.name, format!("linkwright_mechanisms::{}", it.name));
        format!(
            "/// See [`run`].\n#[unsafe(no_mangle)]\npub fn {name}(call: &mut Call<'_>) -> bool {{\n    run::<{module}::{}, {module}::Textbook, _>(call)\n}}\n",
            it.mechanism
        )
    });
    registry::write("mechanisms.rs", &functions.collect::<String>());
}
