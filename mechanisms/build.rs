//! Generates a module for every description in this folder.

fn main() {
    linkwright_codegen::build(".");
}
